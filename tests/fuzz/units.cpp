// Numbers with units: a finite number comes of a text, or a problem in words.

#include "libio/text/units.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto quantity = whirl::parse_quantity(text);
  if (quantity ? !std::isfinite(quantity->value) : quantity.problem.empty()) std::abort();
  for (const char* unit : {"", "m", "rad/s", "N/m^1.5", "N.m/rad"}) {
    const auto value = whirl::parse_as(text, unit);
    if (value ? !std::isfinite(*value) : value.problem.empty()) std::abort();
  }
  return 0;
}
