// Tables of bearings: a table comes of a text, or problems with their lines.

#include "libio/model/bearing_table.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<whirl::Problem> problems;
  const whirl::CoefficientTable table = whirl::parse_bearing_table(text, "table.csv", problems);
  if (!problems.empty()) return 0;
  if (table.speed.empty() || table.speed.size() != table.rows.size()) std::abort();
  for (const double Omega : {-1.0, 0.0, table.speed.front(), table.speed.back(), 1e300}) {
    table.at(Omega);
  }
  return 0;
}
