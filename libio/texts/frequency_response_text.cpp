#include "libio/texts/frequency_response_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/amplification.hpp"
#include "libfe/analyses/modes.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

namespace {

/// The largest share of each force that a support bears.
std::string transmitted_text(const FrequencyResponse& found) {
  if (found.transmitted.empty()) return "";
  Table table({"from", "force on", "", "largest [N/N]", shown_heading("at", "Hz")});
  std::string before;
  for (const TransmittedForce& t : found.transmitted) {
    double largest = 0.0, at = 0.0;
    for (Eigen::Index k = 0; k < t.x.size(); ++k) {
      const double size = Orbit(t.x(k), t.y(k)).major();
      if (!(size > largest)) continue;
      largest = size, at = found.frequencies[static_cast<std::size_t>(k)];
    }
    table.row({t.from == before ? "" : t.from, t.name, t.kind, fmt::format("{:.4g}", largest),
               largest > 0.0 ? shown_number(at, "Hz", ".4g") : "-"});
    before = t.from;
  }
  return "\nForces on supports, at these frequencies\n\n" + table.text();
}

}  // namespace

std::string text_of(const FrequencyResponse& found) {
  constexpr std::size_t most = 6;
  Table table({"from", "to", shown_heading("peak", "Hz"), shown_heading("receptance", "m/N"),
               "phase [deg]", "amplification"});
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
      table.row({from, to, shown_number(peak.speed, "Hz", ".4g"),
                 shown_digits(peak.amplitude, "m/N", 4),
                 fmt::format("{:.0f}", std::arg(H) / degree),
                 std::isfinite(factor) ? fmt::format("{:.3g}", factor) : "-"});
      from = to = "";
    }
    if (!from.empty()) table.row({from, to, "none", "-", "-", "-"});
  }
  std::string infinite;
  for (const double w : found.unbounded) {
    infinite += fmt::format("{}{}", infinite.empty() ? "\n  Infinite at " : ", ",
                            shown_value(w, "Hz", ".4g"));
  }
  if (!infinite.empty()) {
    infinite += found.unbounded.front() == 0.0
                    ? ": at 0 Hz nothing holds the rotor, elsewhere a resonance without damping\n"
                    : ": resonances without damping\n";
  }
  return fmt::format("Frequency responses at {}, {} to {}\n\n{}{}{}",
                     shown_value(found.speed, "rpm", ".0f"),
                     shown_number(found.frequencies.front(), "Hz", ".4g"),
                     shown_value(found.frequencies.back(), "Hz", ".4g"), table.text(), infinite,
                     transmitted_text(found));
}

}  // namespace whirl::inline io
