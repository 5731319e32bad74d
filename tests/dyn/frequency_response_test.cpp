// Frequency responses against closed forms and the sum over complex modes.

#include "libdyn/linear/frequency_response.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::frequency_response_test {

using test::node;

ResponseEnd end(int number, Direction direction, const char* name = "") {
  return {{{Point::Kind::node, number - 1}, name}, direction};
}

/// A body on an isotropic spring and damper.
Structure one_mass(double m, double k, double c) {
  Structure s;
  s.bodies.push_back({.name = "rotor", .m = m, .spins = true});
  const Station body{.kind = Station::Kind::body, .body = "rotor"};
  s.bearings.push_back(test::bearing(body, test::isotropic(k, c)));
  return s;
}

const ResponseEnd along_x{{{Point::Kind::body, 0}, "rotor"}, Direction::x};

// 1 / (k - m w^2 + i c w), times i w, times -w^2
TEST(FrequencyResponse, OfOneMassIsTheClosedForm) {
  constexpr double m = 3.0, k = 4e4, c = 20.0;
  const std::vector<double> frequencies{0.0, 50.0, 115.0, 900.0};
  const FrequencyResponse found =
      frequency_response(Assembler(one_mass(m, k, c)), 0.0, frequencies, {along_x}, {along_x});
  const ResponsePair& pair = found.pairs.at(0);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double w = frequencies[i];
    const auto row = static_cast<Eigen::Index>(i);
    const Complex H = 1.0 / Complex(k - m * w * w, c * w);
    EXPECT_LT(std::abs(pair.receptance(row) - H), 1e-13 * std::abs(H));
    EXPECT_LE(std::abs(pair.mobility(row) - Complex(0.0, w) * H), 1e-13 * std::abs(w * H));
    EXPECT_LE(std::abs(pair.accelerance(row) + w * w * H), 1e-13 * std::abs(w * w * H));
  }
  EXPECT_EQ(pair.from, "rotor x");
}

TEST(FrequencyResponse, AtAnUndampedResonanceIsUnbounded) {
  const FrequencyResponse found =
      frequency_response(Assembler(one_mass(1.0, 1e4, 0.0)), 0.0, {100.0}, {along_x}, {along_x});
  EXPECT_EQ(found.unbounded, std::vector<double>{100.0});
  EXPECT_TRUE(std::isnan(found.pairs.at(0).receptance(0).real()));
}

// A free shaft has no place to come back to: at 0 Hz every response is infinite, whatever rounding
// has left of the stiffness; numbers stood there before. At other frequencies it has one.
TEST(FrequencyResponse, OfAFreeShaftIsUnboundedAtRest) {
  Structure s = test::two_disk(test::isotropic(1e7));
  s.bearings.clear();
  const FrequencyResponse found = frequency_response(
      Assembler(s), 100.0, {0.0, 50.0}, {end(2, Direction::x)}, {end(2, Direction::x)});
  EXPECT_EQ(found.unbounded, std::vector<double>{0.0});
  EXPECT_TRUE(std::isnan(found.pairs.at(0).receptance(0).real()));
  EXPECT_TRUE(std::isfinite(found.pairs.at(0).receptance(1).real()));
}

/// A rotor whose matrices are not symmetric: gyroscopics, bearings with cross coupling.
Structure general() {
  BearingCoefficients oil = test::orthotropic(2e7, 3e7, 4e3, 5e3);
  oil.K(0, 1) = 3e6;
  oil.K(1, 0) = -5e6;
  oil.C(0, 1) = oil.C(1, 0) = -400.0;
  return test::two_disk(oil);
}

// H = L^T (sum over all eigenvalues of r l^T / (i w - lambda)) L, by the dense eigenproblem of the
// states: an independent path to the same number.
TEST(FrequencyResponse, IsTheSumOverComplexModes) {
  const Assembler assembler(general());
  constexpr double Omega = 400.0;
  const System s = assembler.at(Omega);
  const Eigen::Index n = s.size();
  Mat A = Mat::Zero(2 * n, 2 * n);
  const Eigen::PartialPivLU<Mat> M{Mat(s.M)};
  constexpr double rate = 2e4;  // [1/s], of velocities: entries of one size
  A.topRightCorner(n, n).diagonal().setConstant(rate);
  A.bottomLeftCorner(n, n) = -M.solve(Mat(s.K)) / rate;
  A.bottomRightCorner(n, n) = -M.solve(Mat(s.D()));
  const Eigen::EigenSolver<Mat> modes(A);
  const CMat right = modes.eigenvectors();
  const CMat left = right.inverse();
  const ResponseEnd from = end(3, Direction::x), to = end(5, Direction::y);
  const Point p = from.at.point, q = to.at.point;
  const Vec load = Mat(s.dofs.T).row(s.dofs.full_index(p, X)).transpose();
  const Vec motion = Mat(s.dofs.T).row(s.dofs.full_index(q, Y)).transpose();
  CVec force = CVec::Zero(2 * n);
  force.tail(n) = (M.solve(load) / rate).cast<Complex>();
  const std::vector<double> frequencies{30.0, 333.0, 1200.0, 5000.0};
  const FrequencyResponse found = frequency_response(assembler, Omega, frequencies, {from}, {to});
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Complex iw(0.0, frequencies[i]);
    Complex sum = 0.0;
    for (Eigen::Index k = 0; k < 2 * n; ++k) {
      sum += motion.dot(right.col(k).head(n)) * (left.row(k) * force)(0) /
             (iw - modes.eigenvalues()(k));
    }
    const Complex H = found.pairs.at(0).receptance(static_cast<Eigen::Index>(i));
    EXPECT_LT(std::abs(H - sum), 1e-10 * std::abs(H)) << frequencies[i];
  }
}

// Of an isotropic rotor a forward force moves it forward only, and the receptance is x by x plus
// i times y by x.
TEST(FrequencyResponse, SensesOfWhirlDoNotMixInAnIsotropicRotor) {
  const Assembler assembler(test::two_disk(test::isotropic(2e7, 1e3)));
  const std::vector<double> frequencies{100.0, 500.0, 2000.0};
  const auto at = [](Direction d) { return end(3, d); };
  using enum Direction;
  const FrequencyResponse f =
      frequency_response(assembler, 600.0, frequencies, {at(forward), at(x)},
                         {at(forward), at(backward), at(x), at(y)});
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Complex ff = f.pairs[0].receptance(i), xx = f.pairs[6].receptance(i),
                  yx = f.pairs[7].receptance(i);
    EXPECT_EQ(f.pairs[1].receptance(i), 0.0);  // but for rounding
    EXPECT_EQ(f.pairs[1].mobility(i), 0.0);
    EXPECT_LT(std::abs(ff - (xx + Complex(0.0, 1.0) * yx)), 1e-10 * std::abs(ff));
  }
}

// It is told from the motion of the whole rotor: no other response need be asked for.
TEST(FrequencyResponse, ThatIsRoundingAloneIsZero) {
  const Assembler assembler(test::two_disk(test::isotropic(2e7, 1e3)));
  const auto at = [](Direction d) { return end(3, d); };
  using enum Direction;
  for (const auto& [from, to] : {std::pair{forward, backward}, {backward, forward}}) {
    const FrequencyResponse f =
        frequency_response(assembler, 600.0, {100.0, 500.0}, {at(from)}, {at(to)});
    EXPECT_EQ(f.pairs.at(0).receptance.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(f.silent_pairs(), std::vector<bool>{true});
  }
  const FrequencyResponse still =
      frequency_response(assembler, 0.0, {100.0}, {at(x)}, {at(theta_x)});
  EXPECT_EQ(still.pairs.at(0).receptance(0), 0.0);  // planes do not mix
  const FrequencyResponse heard =
      frequency_response(assembler, 0.0, {100.0}, {at(x)}, {at(theta_y)});
  EXPECT_EQ(heard.silent_pairs(), std::vector<bool>{false});
}

// Static receptance of a cantilever's tip: L^3 / (3 E I).
TEST(FrequencyResponse, AtZeroFrequencyIsTheFlexibility) {
  const test::Overhung overhung;
  const FrequencyResponse f =
      frequency_response(Assembler(overhung.structure()), 0.0, {0.0}, {end(3, Direction::x)},
                         {end(3, Direction::x), end(3, Direction::theta_y)});
  const Mat2 flexibility = overhung.K().inverse();
  EXPECT_NEAR(f.pairs[0].receptance(0).real() / flexibility(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(f.pairs[1].receptance(0)) / std::abs(flexibility(0, 1)), 1.0, 1e-9);
}

}  // namespace whirl::frequency_response_test
