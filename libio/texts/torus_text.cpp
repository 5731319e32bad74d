#include "libio/texts/torus_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t most_rows = 25;  ///< of the table of circles, and the last one

std::string circle_text(const TorusResult& t) {
  return fmt::format(
      "  {} circle of {} harmonics, residual {:.1e} length scales, highest harmonics {:.0e} of the "
      "largest\n  it turns by {:.9f} in a revolution: lines {} and multiples beside those of the "
      "speed\n  largest exponent across it {:+.6f} per revolution, along it {:+.0e}\n",
      t.stability == 1 ? "stable" : "unstable", t.harmonics, t.residual, t.tail, t.rotation,
      shown_value(t.frequency, "rpm", ".4f"), t.exponents(0), t.along);
}

std::string walks_text(const TorusResult& t) {
  std::vector<CircleRow> rows;
  const std::size_t count = t.circles.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + most_rows - 1) / most_rows);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % stride == 0 || i + 1 == count) rows.push_back(t.circles[i]);
  }
  std::string text =
      "\n" + table_of(rows, {{label_of(t.parameter),
                              [](const CircleRow& c) { return fmt::format("{:.8g}", c.value); }},
                             shown("rotation", "", ".8f"),
                             shown("largest_exponent", "", "+.6f").as("exponent per rev"),
                             shown("tail", "", ".0e")});
  for (const std::string& end : t.ends) text += "  it ends: " + end + "\n";
  return text;
}

}  // namespace

std::string text_of(const TorusResult& result) {
  if (!result.is_good) return "";
  return circle_text(result) + (result.circles.empty() ? "" : walks_text(result));
}

}  // namespace whirl::inline io
