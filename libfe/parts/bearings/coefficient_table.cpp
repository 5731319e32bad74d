#include "libfe/parts/bearings/coefficient_table.hpp"

#include <array>
#include <span>
#include <utility>

namespace whirl::inline fe {

namespace {

constexpr std::size_t most_rows = 4;  ///< that a value depends on

/// Coefficients at one place of ascending ones.
/// @param row  row(i): coefficients at the place i
template <class Row>
BearingCoefficients between(std::span<const double> places, double x, Interpolation how,
                            const Row& row) {
  const Neighborhood n = neighborhood(places, x, how);
  if (n.is_beyond) return row(n.below);
  std::array<BearingCoefficients, most_rows> rows;
  for (std::size_t i = 0; i < n.count; ++i) rows[i] = row(n.first + i);
  const auto near = places.subspan(n.first, n.count);
  BearingCoefficients result;
  std::array<double, most_rows> values{};
  for (const auto part : BearingCoefficients::parts()) {
    for (Eigen::Index k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < n.count; ++i) values[i] = (rows[i].*part)(k);
      (result.*part)(k) = interpolated(near, std::span(values).first(n.count), x, how);
    }
  }
  return result;
}

/// Distinct speeds around one, and where their rows begin; ends with where the last ones end.
struct Groups {
  std::vector<double> speed;
  std::vector<std::size_t> begin;
};

Groups groups_of(const std::vector<double>& speed) {
  Groups groups;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (i > 0 && speed[i] == speed[i - 1]) continue;
    groups.speed.push_back(speed[i]);
    groups.begin.push_back(i);
  }
  groups.begin.push_back(speed.size());
  return groups;
}

}  // namespace

BearingCoefficients CoefficientTable::at(double Omega, double omega, Interpolation how) const {
  const auto row = [&](std::size_t i) { return rows[i]; };
  if (whirl.empty()) return between(speed, Omega, how, row);
  if (speed.empty()) return between(whirl, omega, how, row);
  const Groups groups = groups_of(speed);
  return between(groups.speed, Omega, how, [&](std::size_t g) {
    const std::size_t begin = groups.begin[g], count = groups.begin[g + 1] - begin;
    return between(std::span(whirl).subspan(begin, count), omega, how,
                   [&](std::size_t i) { return rows[begin + i]; });
  });
}

}  // namespace whirl::inline fe
