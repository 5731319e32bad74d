#pragma once
/// Orders of convergence, measured.

#include <cmath>
#include <vector>

namespace whirl::test {

/// Order of convergence: slope of the line through log(error) over log(1 / number), least squares.
inline double order_of(const std::vector<double>& number, const std::vector<double>& error) {
  const auto n = static_cast<double>(number.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const double a = -std::log(number[i]), b = std::log(error[i]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace whirl::test
