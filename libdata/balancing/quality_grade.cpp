#include "libdata/balancing/quality_grade.hpp"

#include <algorithm>

namespace whirl::inline data {

double permissible_unbalance(double grade, double mass, double Omega) {
  return grade * mass / Omega;
}

std::optional<std::array<double, 2>> plane_shares(double left, double right, double center) {
  if (left == right || center < std::min(left, right) || center > std::max(left, right)) {
    return std::nullopt;
  }
  constexpr double least = 0.3, most = 0.7;
  const double of_left = (right - center) / (right - left);
  return std::array{std::clamp(of_left, least, most), std::clamp(1.0 - of_left, least, most)};
}

}  // namespace whirl::inline data
