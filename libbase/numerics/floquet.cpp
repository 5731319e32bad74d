#include "libbase/numerics/floquet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline base {

void sort_by_size(CVec& values) {
  std::sort(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    const double x = std::abs(a), y = std::abs(b);
    // pairs stay together, whatever rounding makes of their sizes
    if (std::abs(x - y) > 1e-12 * (x + y)) return x > y;
    if (a.real() != b.real()) return a.real() > b.real();
    return a.imag() > b.imag();
  });
}

CVec multipliers_of(std::span<const Mat> tangents) {
  const Eigen::Index n = tangents[0].rows(), m = std::ssize(tangents);
  CVec found;
  if (m == 1) {
    found = eigenvalues(tangents[0]);
    sort_by_size(found);
    return found;
  }
  Mat cyclic = Mat::Zero(n * m, n * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    cyclic.block((i + 1) % m * n, i * n, n, n) = tangents[static_cast<std::size_t>(i)];
  }
  const CVec roots = eigenvalues(cyclic);
  std::vector<Complex> powers;
  for (const Complex& root : roots) powers.push_back(std::pow(root, static_cast<int>(m)));
  std::sort(powers.begin(), powers.end(),
            [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
  // every multiplier is there m times, from its m roots: those nearest to each other belong
  // together
  found.resize(n);
  for (Complex& value : found) {
    const Complex first = powers.front();
    std::partial_sort(powers.begin(), powers.begin() + m, powers.end(),
                      [&](const Complex& a, const Complex& b) {
                        return std::norm(a - first) < std::norm(b - first);
                      });
    value = 0.0;
    for (Eigen::Index k = 0; k < m; ++k) value += powers[static_cast<std::size_t>(k)];
    value /= static_cast<double>(m);
    if (std::abs(value.imag()) < 1e-10 * std::abs(value)) value = value.real();
    powers.erase(powers.begin(), powers.begin() + m);
    std::sort(powers.begin(), powers.end(),
              [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
  }
  sort_by_size(found);
  return found;
}

CVec multipliers_across(const Mat& tangent) {
  CVec all = multipliers_of({&tangent, 1});
  const auto along = std::min_element(
      all.begin(), all.end(), [](auto a, auto b) { return std::abs(a - 1.0) < std::abs(b - 1.0); });
  std::rotate(along, along + 1, all.end());
  return all.head(all.size() - 1);
}

}  // namespace whirl::inline base
