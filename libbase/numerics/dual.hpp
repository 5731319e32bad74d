#pragma once
/// Numbers that carry their derivatives: a function called with them gives its slopes with its
/// value.

#include <Eigen/Core>
#include <cmath>

namespace whirl::inline base {

/// A value and its derivatives by N variables.
///
///   (a b)' = a' b + a b',   f(a)' = f'(a) a'
///
/// @source [GriewankWalther2008], ch. 3: the forward mode
template <int N>
struct Dual {
  using Slopes = Eigen::Matrix<double, N, 1>;
  double value = 0.0;
  Slopes slopes = Slopes::Zero();

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: numbers are duals
  Dual(double a, const Slopes& by) : value(a), slopes(by) {}
  /// Variable number i.
  static Dual variable(double a, int i) { return {a, Slopes::Unit(i)}; }

  friend Dual operator-(const Dual& a) { return {-a.value, -a.slopes}; }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.slopes + b.slopes};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.slopes - b.slopes};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slopes * b.value + a.value * b.slopes};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.value / b.value;
    return {q, (a.slopes - q * b.slopes) / b.value};
  }

  friend double value_of(const Dual& a) { return a.value; }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slopes / (2.0 * root)};
  }
  friend Dual ninth_root(const Dual& a) {
    const double root = a.value > 0.0 ? std::pow(a.value, 1.0 / 9.0) : 0.0;
    return {root, root / (9.0 * a.value) * a.slopes};
  }
  friend Dual exp(const Dual& a) { return {std::exp(a.value), std::exp(a.value) * a.slopes}; }
  friend Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.slopes}; }
  friend Dual cos(const Dual& a) { return {std::cos(a.value), -std::sin(a.value) * a.slopes}; }
  friend Dual tanh(const Dual& a) {
    const double y = std::tanh(a.value);
    return {y, (1.0 - y * y) * a.slopes};
  }
};

}  // namespace whirl::inline base
