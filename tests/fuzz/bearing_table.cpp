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
  const std::size_t rows = table.rows.size();
  const auto fits = [&](const std::vector<double>& places) {
    return places.empty() || places.size() == rows;
  };
  if (rows == 0 || !fits(table.speed) || !fits(table.whirl)) std::abort();
  if (table.speed.empty() && table.whirl.empty()) std::abort();
  for (const double Omega : {-1.0, 0.0, 1.0, 1e300}) {
    for (const double omega : {0.0, 1.0, 1e300}) {
      for (const auto how : {whirl::Interpolation::linear, whirl::Interpolation::pchip}) {
        table.at(Omega, omega, how);
      }
    }
  }
  return 0;
}
