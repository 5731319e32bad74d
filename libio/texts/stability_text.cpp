#include "libio/texts/stability_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

constexpr double grows = 1e-6;  ///< real part over size, beyond what rounding leaves of no damping
constexpr double growing_decrement = -1e-5;
constexpr int looked_at = 8;         ///< modes
constexpr int looked_at_loops = 80;  ///< of rotors with controllers, which reach far beyond

bool is_unstable(const Modes& modes) {
  const auto is_growing = [](Complex lambda) { return lambda.real() > grows * std::abs(lambda); };
  return std::any_of(modes.oscillatory.begin(), modes.oscillatory.end(),
                     [&](const Mode& m) { return is_growing(m.lambda); }) ||
         std::any_of(modes.overdamped.begin(), modes.overdamped.end(), is_growing);
}

}  // namespace

std::vector<std::string> unstable_notes(const Assembler& assembler, std::vector<double> speeds) {
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  std::vector<std::string> unstable;
  const bool has_loops = std::ranges::any_of(
      assembler.structure().supports, [](const Support& support) { return support.sensors > 0; });
  for (const double Omega : speeds) {
    try {
      const int count = has_loops ? looked_at_loops : looked_at;
      if (!is_unstable(complex_modes(assembler, Omega, count))) continue;
      unstable.push_back(shown_value(Omega, "rpm", ".0f"));
    } catch (const NumericalError&) {  // films carry nothing without speed
    }
  }
  if (unstable.empty()) return {};
  return {
      fmt::format("the rotor is unstable at {}: a mode grows by itself, and the rotor does not "
                  "settle to the response that is told",
                  fmt::join(unstable, ", "))};
}

std::vector<std::string> unstable_notes(const Campbell& diagram) {
  std::vector<std::string> growing;
  for (std::size_t i = 0; i < diagram.branches.size(); ++i) {
    const std::vector<double>& decrement = diagram.branches[i].log_decrement;
    const auto first =
        std::find_if(decrement.begin(), decrement.end(), [](double d) { return std::isfinite(d); });
    if (first == decrement.end() || *first > growing_decrement) continue;
    const double speed = diagram.speeds[static_cast<std::size_t>(first - decrement.begin())];
    growing.push_back(fmt::format("mode {} from {}", i + 1, shown_value(speed, "rpm", ".0f")));
  }
  if (growing.empty()) return {};
  return {
      fmt::format("the rotor is unstable from the first speed on, where no threshold is told: {} "
                  "grows by itself",
                  fmt::join(growing, ", "))};
}

}  // namespace whirl::inline io
