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

}  // namespace whirl::inline io
