#include "libfe/parts/exceeded_tables.hpp"

#include <fmt/format.h>

#include <utility>

#include "libbase/structs/names.hpp"

namespace whirl::inline fe {

std::vector<ExceededTable> exceeded_tables(const Structure& structure, double lowest,
                                           double highest) {
  constexpr double rounding = 1e-12;  // of a speed that was told in another unit
  std::vector<ExceededTable> exceeded;
  for (const auto& [kind, list] : structure.connections()) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Connection& c = list[i];
      const auto told = told_speeds(c.coefficients);
      if (told.empty() || c.is_clamped) continue;
      const double first = told.front(), last = told.back();
      const double margin = rounding * last;
      if (lowest >= first - margin && highest <= last + margin) continue;
      const std::string name = c.name.empty() ? fmt::format("{}", i + 1) : c.name;
      exceeded.push_back({named(kind, name), first, last});
    }
  }
  return exceeded;
}

}  // namespace whirl::inline fe
