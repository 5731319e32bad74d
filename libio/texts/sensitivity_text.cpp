#include "libio/texts/sensitivity_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

std::string text_of(const Sensitivity& found) {
  Table table({"bearing", "axis", "largest |S|", "[dB]", shown_heading("at", "Hz"), "zone"});
  std::string before;
  for (const LoopSensitivity& loop : found.loops) {
    table.row({loop.bearing == before ? "" : loop.bearing, fmt::format("{}", loop.axis),
               fmt::format("{:.4g}", loop.largest),
               fmt::format("{:.2f}", 20.0 * std::log10(loop.largest)),
               shown_number(loop.largest_at, "Hz", ".4g"), loop.zone});
    before = loop.bearing;
  }
  return fmt::format(
      "Sensitivity of control loops at {}, {} to {}\n\n{}\n"
      "  Zones A, B and C end at 3, 4 and 5 (9.5, 12 and 14 dB).\n",
      shown_value(found.speed, "rpm", ".0f"), shown_number(found.frequencies.front(), "Hz", ".4g"),
      shown_value(found.frequencies.back(), "Hz", ".4g"), table.text());
}

std::string text_of(const StepResponse& found) {
  const auto milliseconds = [](double time) {
    return std::isfinite(time) ? fmt::format("{:.4g}", 1e3 * time) : std::string("-");
  };
  const auto per_newton = [](double displacement) {
    return std::isfinite(displacement) ? fmt::format("{:.4g}", 1e6 * displacement)
                                       : std::string("-");
  };
  Table table({"bearing", "axis", "overshoot", "rise [ms]", "settled [ms]", "x/r", "largest [um/N]",
               "x/F [um/N]"});
  std::string before;
  for (const LoopStep& step : found.steps) {
    table.row(
        {step.bearing == before ? "" : step.bearing, fmt::format("{}", step.axis),
         std::isfinite(step.overshoot) ? fmt::format("{:.1f} %", 100.0 * step.overshoot) : "-",
         milliseconds(step.rise_time), milliseconds(step.settling_time),
         std::isfinite(step.reference_end) ? fmt::format("{:.4g}", step.reference_end) : "-",
         per_newton(step.force_largest), per_newton(step.force_end)});
    before = step.bearing;
  }
  return fmt::format(
      "Step responses over {} s, of the reference r (left) and of a force F (right)\n\n{}\n"
      "  Rise from 10 to 90 %; settled within 2 % of x/r in the end.\n",
      shown_number(found.times.back(), "s", ".4g"), table.text());
}

}  // namespace whirl::inline io
