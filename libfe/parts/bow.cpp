#include "libfe/parts/bow.hpp"

#include <algorithm>
#include <cassert>

namespace whirl::inline fe {

namespace {

/// Second derivatives at the positions, zero at both ends: a tridiagonal system.
std::vector<Complex> curvatures(const std::vector<double>& z, const std::vector<Complex>& r) {
  const std::size_t n = z.size();
  std::vector<Complex> bend(n, 0.0);
  if (n < 3) return bend;
  std::vector<double> diagonal(n, 1.0);
  std::vector<Complex> right(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = z[i] - z[i - 1], after = z[i + 1] - z[i];
    diagonal[i] = 2.0 * (before + after);
    right[i] = 6.0 * ((r[i + 1] - r[i]) / after - (r[i] - r[i - 1]) / before);
  }
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double below = z[i] - z[i - 1], factor = below / diagonal[i - 1];
    diagonal[i] -= factor * below;
    right[i] -= factor * right[i - 1];
  }
  for (std::size_t i = n - 2; i >= 1; --i) {
    bend[i] = (right[i] - (z[i + 1] - z[i]) * bend[i + 1]) / diagonal[i];
  }
  return bend;
}

}  // namespace

std::vector<BowState> bow_states(const Bow& bow, const std::vector<double>& z) {
  std::vector<BowState> states;
  if (bow.z.empty()) return states;
  assert(bow.z.size() >= 2 && bow.x.size() == bow.z.size() && bow.y.size() == bow.z.size());
  std::vector<Complex> r;
  for (std::size_t i = 0; i < bow.z.size(); ++i) r.emplace_back(bow.x[i], bow.y[i]);
  const std::vector<Complex> bend = curvatures(bow.z, r);
  for (const double at : z) {
    const auto above = std::upper_bound(bow.z.begin() + 1, bow.z.end() - 1, at);
    const auto i = static_cast<std::size_t>(above - bow.z.begin()) - 1;
    const double h = bow.z[i + 1] - bow.z[i];
    const double within = std::clamp(at, bow.z[i], bow.z[i + 1]);
    const double a = (bow.z[i + 1] - within) / h, b = 1.0 - a;
    const Complex value = a * r[i] + b * r[i + 1] +
                          h * h / 6.0 * ((a * a * a - a) * bend[i] + (b * b * b - b) * bend[i + 1]);
    const Complex slope =
        (r[i + 1] - r[i]) / h +
        h / 6.0 * ((3.0 * b * b - 1.0) * bend[i + 1] - (3.0 * a * a - 1.0) * bend[i]);
    states.push_back({value + (at - within) * slope, slope});
  }
  return states;
}

}  // namespace whirl::inline fe
