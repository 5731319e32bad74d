// Ranges of values, "0:8000:50rpm", and axes of studies, "contact.ring.friction=0.1:0.3:0.01".

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "libio/text/parameter_axis.hpp"
#include "libio/text/value_range.hpp"

namespace {

constexpr double most_made = 1e5;  ///< values that are worth the time to make them here

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto range = whirl::parse_range(text, "rad/s");
  if (!range && range.problem.empty()) std::abort();
  if (range && range->step && (range->last - range->first) / *range->step < most_made) {
    for (const double v : whirl::values(*range)) {
      if (!std::isfinite(v)) std::abort();
    }
  }
  // an axis makes all of its values at once: up to a million
  const bool is_short = text.find(':') == std::string_view::npos || !range || !range->step ||
                        (range->last - range->first) / *range->step < most_made;
  if (!is_short) return 0;
  for (const int points : {0, 5}) {
    const auto axis = whirl::parse_axis(text, points);
    if (axis ? axis->values.empty() : axis.problem.empty()) std::abort();
    if (axis) axis->assignments(axis->values.size() - 1);
  }
  return 0;
}
