// Tables of shafts and of bows: they come of a text, or problems with their lines.

#include "libio/model/shaft_table.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "libfe/parts/bow.hpp"
#include "libio/model/bow_table.hpp"

namespace {

void read_shaft(const std::string& text) {
  std::vector<whirl::Problem> problems;
  const auto rows = whirl::parse_shaft_table(text, "table.csv", problems);
  if (!problems.empty()) return;
  if (rows.empty() || rows.front().layer != 1) std::abort();
  for (const whirl::ShaftRow& row : rows) {
    if (row.is_end) {  // the last row, behind a segment
      if (&row == &rows.front() || &row != &rows.back()) std::abort();
      continue;
    }
    if (!(row.length > 0.0) || !(row.left.inner < row.left.outer)) std::abort();
  }
}

void read_bow(const std::string& text) {
  std::vector<whirl::Problem> problems;
  const whirl::Bow bow = whirl::parse_bow_table(text, "table.csv", problems);
  if (!problems.empty()) return;
  if (bow.z.size() < 2 || bow.x.size() != bow.z.size() || bow.y.size() != bow.z.size())
    std::abort();
  whirl::bow_states(bow, {-1.0, bow.z.front(), bow.z.back(), 1e300});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_shaft(text);
  read_bow(text);
  return 0;
}
