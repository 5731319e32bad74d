// Order of convergence of the shaft element.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::element_order_test {

using test::pi;

constexpr double slope_tolerance = 0.1;  // of an order measured over a factor of two to four in h
constexpr double diameter = 0.1, length = 1.0;

/// Slope of log(error) over log(elements), by least squares, as a positive order.
double order_of(const std::vector<int>& elements, const std::function<double(int)>& error) {
  Mat A(static_cast<Eigen::Index>(elements.size()), 2);
  Vec b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const int n = elements[static_cast<std::size_t>(i)];
    A.row(i) << 1.0, std::log(static_cast<double>(n));
    b(i) = std::log(error(n));
  }
  return -A.colPivHouseholderQr().solve(b)(1);
}

/// The i-th frequency from 0 of a pinned shaft [rad/s]; frequencies come in pairs, backward first.
double frequency(const Segment& shaft, double Omega, std::size_t i) {
  const System system = assemble(test::pinned(shaft), Omega);
  return complex_modes(system, static_cast<int>(i) + 3).oscillatory.at(i).frequency();
}

/// Frequency n of a pinned Timoshenko shaft; sense +1 forward, -1 backward, w > 0 [rad/s].
///
///   (kAG k^2 - rho A w^2) (E I k^2 + kAG - rho I w^2 + 2 rho I Omega w) = (kAG k)^2,  k = n pi / L
///
/// with w < 0 for backward whirl; the lowest root, as in tests/data/rotors.json
/// (closed-pinned-timoshenko-spinning).
double timoshenko_root(int n, double Omega, int sense) {
  const Material m = test::steel();
  const Section s{.outer = diameter};
  const double A = s.A(), I = s.I(), k = n * pi / length;
  const double kAG = shear_coefficient({}, s, m.nu) * m.G * A;
  const auto determinant = [&](double size) {
    const double w = sense * size;
    return (kAG * k * k - m.rho * A * w * w) *
               (m.E * I * k * k + kAG - m.rho * I * w * w + 2.0 * m.rho * I * Omega * w) -
           kAG * kAG * k * k;
  };
  double a = 0.0, b = 1.0;  // positive at zero
  while (determinant(b) > 0.0) b *= 1.05;
  for (int it = 0; it < 200; ++it) {
    const double middle = 0.5 * (a + b);
    (determinant(middle) > 0.0 ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

/// The same without shear: E I k^4 + 2 rho I Omega k^2 w - (rho A + rho I k^2) w^2 = 0.
double rayleigh_root(int n, double Omega, int sense, bool rotary) {
  const Material m = test::steel();
  const Section s{.outer = diameter};
  const double k2 = std::pow(n * pi / length, 2), I = rotary ? m.rho * s.I() : 0.0;
  const double a = m.rho * s.A() + I * k2, b = sense * I * Omega * k2;
  return (b + std::sqrt(b * b + a * m.E * s.I() * k2 * k2)) / a;
}

struct Case {
  Theory theory;
  int internal_functions;
  std::vector<int> elements;
  int mode;  ///< from 1; high enough that rounding, 1e-11 of a frequency, is far below the error
  double order;
};

class ElementOrder : public testing::TestWithParam<Case> {};

// The error of a frequency falls as h^2 with shear and h^4 without; each pair of internal functions
// adds two to the order.
INSTANTIATE_TEST_SUITE_P(Pinned, ElementOrder,
                         testing::Values(Case{Theory::timoshenko, 0, {16, 32, 64}, 1, 2.0},
                                         Case{Theory::timoshenko, 1, {8, 12, 16}, 1, 4.0},
                                         Case{Theory::timoshenko, 2, {8, 12, 16}, 2, 6.0},
                                         Case{Theory::timoshenko, 3, {6, 8, 12}, 3, 8.0},
                                         Case{Theory::rayleigh, 0, {8, 16, 32}, 1, 4.0},
                                         Case{Theory::euler_bernoulli, 0, {8, 16, 32}, 1, 4.0},
                                         Case{Theory::euler_bernoulli, 1, {8, 12, 16}, 2, 6.0},
                                         Case{Theory::euler_bernoulli, 2, {8, 12, 16}, 3, 8.0}));

TEST_P(ElementOrder, OfACylinderAgainstClosedFormsAtRestAndAtSpeed) {
  const Case& c = GetParam();
  for (const double Omega : {0.0, 2000.0}) {
    for (const int sense : {-1, +1}) {
      const double exact = c.theory == Theory::timoshenko
                               ? timoshenko_root(c.mode, Omega, sense)
                               : rayleigh_root(c.mode, Omega, sense, c.theory == Theory::rayleigh);
      const double order = order_of(c.elements, [&](int n) {
        Segment shaft = test::cylinder(length, diameter, n, c.theory);
        shaft.internal_functions = c.internal_functions;
        const auto i = static_cast<std::size_t>(2 * c.mode - (sense < 0 ? 2 : 1));
        return std::abs(frequency(shaft, Omega, i) / exact - 1.0);
      });
      EXPECT_NEAR(order, c.order, slope_tolerance) << Omega << " rad/s, sense " << sense;
    }
  }
}

// A cone has no closed form: the reference is a fine mesh of elements of order eight.
TEST_P(ElementOrder, OfAConeAgainstAFineMesh) {
  const Case& c = GetParam();
  const double Omega = 2000.0;
  const auto i = static_cast<std::size_t>(2 * c.mode - 1);
  Segment shaft = test::cone(length, 0.06, 0.12, 24, c.theory);
  shaft.internal_functions = 3;
  const double reference = frequency(shaft, Omega, i);
  const double order = order_of(c.elements, [&](int n) {
    shaft.elements = n;
    shaft.internal_functions = c.internal_functions;
    return std::abs(frequency(shaft, Omega, i) / reference - 1.0);
  });
  EXPECT_NEAR(order, c.order, slope_tolerance);
}

}  // namespace whirl::element_order_test
