#include "libio/texts/frequency_response_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/amplification.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

std::string text_of(const FrequencyResponse& found) {
  constexpr std::size_t most = 6;
  Table table({"from", "to", "peak [Hz]", "receptance [m/N]", "phase [deg]", "amplification"});
  const std::vector<bool> silent = found.silent_pairs();
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    const ResponsePair& pair = found.pairs[i];
    if (silent[i]) {
      table.row({pair.from, pair.to, "none", "0", "-", "-"});
      continue;
    }
    const Mat amplitude = pair.receptance.cwiseAbs().transpose();
    std::string from = pair.from, to = pair.to;
    for (const ResponsePeak& peak : response_peaks(found.frequencies, amplitude, most)) {
      const auto at = std::min_element(
          found.frequencies.begin(), found.frequencies.end(),
          [&](double a, double b) { return std::abs(a - peak.speed) < std::abs(b - peak.speed); });
      const Complex H = pair.receptance(at - found.frequencies.begin());
      const double factor = peak.amplification();
      table.row({from, to, fmt::format("{:.4g}", peak.speed / hertz),
                 fmt::format("{:.4g}", peak.amplitude), fmt::format("{:.0f}", std::arg(H) / degree),
                 std::isfinite(factor) ? fmt::format("{:.3g}", factor) : "-"});
      from = to = "";
    }
    if (!from.empty()) table.row({from, to, "none", "-", "-", "-"});
  }
  std::string infinite;
  for (const double w : found.unbounded) {
    infinite += fmt::format("{}{:.4g} Hz", infinite.empty() ? "\n  Infinite at " : ", ", w / hertz);
  }
  if (!infinite.empty()) {
    infinite += found.unbounded.front() == 0.0
                    ? ": at 0 Hz nothing holds the rotor, elsewhere a resonance without damping\n"
                    : ": resonances without damping\n";
  }
  return fmt::format("Frequency responses at {:.0f} rpm, {:.4g} to {:.4g} Hz\n\n{}{}",
                     found.speed / rpm, found.frequencies.front() / hertz,
                     found.frequencies.back() / hertz, table.text(), infinite);
}

}  // namespace whirl::inline io
