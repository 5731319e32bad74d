// The exact flow of the linear part against exponentials of a larger matrix, made here by scaling
// and squaring, and against closed forms: defective, overdamped and free motions, slow ones beside
// fast ones.

#include "libdyn/flow/linear_flow.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::linear_flow_test {

using test::MassInRing;
using test::RotorStator;

constexpr int terms = 4;              ///< of a force
constexpr double of_squaring = 1e-9;  ///< what some ten squarings leave of the digits
constexpr double rounding = 1e-12;

/// exp(A): Taylor series of A / 2^k with |A| / 2^k <= 1/4, then k squarings.
Mat exponential(Mat A) {
  int halvings = 0;
  for (; A.cwiseAbs().rowwise().sum().maxCoeff() > 0.25; ++halvings) A *= 0.5;
  Mat sum = Mat::Identity(A.rows(), A.cols()), power = sum;
  for (int k = 1; k < 20; ++k) {
    power = (power * A / k).eval();
    sum += power;
  }
  for (int i = 0; i < halvings; ++i) sum = (sum * sum).eval();
  return sum;
}

/// P_j(2 s - 1) as powers of s: column j.
Mat legendre_powers() {
  return Mat{{1.0, -1.0, 1.0, -1.0},
             {0.0, 2.0, -6.0, 12.0},
             {0.0, 0.0, 6.0, -30.0},
             {0.0, 0.0, 0.0, 20.0}};
}

/// The state after a fraction of a step h with the force a on the whole of it. The motion, its
/// loads and the powers of s that the force is made of are one linear system z' = E z.
Vec moved(const ContactSystem& system, double h, double fraction, double phase, const Vec& a,
          const Vec& y) {
  const Eigen::Index n = system.coordinates(), N = 2 * n;
  const double w = system.phase_rate(), unit = std::sqrt(system.K().cwiseAbs().maxCoeff());
  Mat E = Mat::Zero(N + 3 + terms, N + 3 + terms);  // of eta, eta' / unit, loads, powers
  E.block(0, n, n, n) = unit * Mat::Identity(n, n);
  E.block(n, 0, n, n) = -system.K() / unit;
  E.block(n, n, n, n) = -system.D();
  E.block(n, N, n, 1) = system.constant_load() / unit;
  E.block(n, N + 1, n, 1) = system.synchronous_load().cosine / unit;
  E.block(n, N + 2, n, 1) = system.synchronous_load().sine / unit;
  E(N + 1, N + 2) = -w;
  E(N + 2, N + 1) = w;
  const Mat powers = legendre_powers();
  for (int d = 0; d < 2; ++d) {
    E.block(n, N + 3, n, terms) -=
        system.contacts()[0].B.col(d) * (powers * a.segment(d * terms, terms)).transpose() / unit;
  }
  for (int k = 1; k < terms; ++k) E(N + 3 + k, N + 2 + k) = k / h;
  Vec z = Vec::Zero(N + 3 + terms);
  z << y.head(n), y.tail(n) / unit, 1.0, std::cos(phase), std::sin(phase), Vec::Zero(terms);
  z(N + 3) = 1.0;  // s^0; the others are zero at s = 0
  const Vec end = exponential(fraction * h * E) * z;
  Vec result(N);
  result << end.head(n), unit * end.segment(n, n);
  return result;
}

/// A rotor in its stator, a state of it and a force in its ring.
struct Case {
  Scene scene = RotorStator{.e = 2e-3, .phase = 0.7}.scene();
  double phase = 0.4;
  Vec y = Vec{{1e-3, -2e-3, 3e-4, 1e-4, 0.2, 0.1, -0.05, 0.3}};
  Vec a = Vec{{3e3, -2e3, 1e3, 500.0, -4e3, 800.0, 300.0, -2e3}};  // [N]

  const ContactSystem& system() const { return scene.contacts; }
  Eigen::Vector3d load() const { return {1.0, std::cos(phase), std::sin(phase)}; }
};

constexpr double longest = 0.05;  ///< [s], 27 times the shortest time of the linear motion
constexpr std::array fractions{1.0, 0.5, 0.37, 1.0 / 3.0, 0.999, 1e-3};

TEST(LinearFlow, IsTheExponentialOfTheWholeSystem) {
  const Case c;
  LinearFlow flow(c.system(), longest, terms);
  const std::vector<int> touching{0};
  for (const int level : {0, 1, 5, 9}) {
    EXPECT_EQ(flow.size(level), longest / static_cast<double>(1 << level));
    for (const double fraction : fractions) {
      Vec y = c.y;
      flow.advance(level, fraction, c.load(), c.a, touching, y);
      const Vec expected = moved(c.system(), flow.size(level), fraction, c.phase, c.a, c.y);
      EXPECT_LT(distance(c.system(), y, expected), of_squaring) << level << " " << fraction;
    }
  }
}

// Without contacts in touch the force is left out, whatever its coefficients are.
TEST(LinearFlow, LeavesOutForcesOfContactsThatDoNotTouch) {
  const Case c;
  LinearFlow flow(c.system(), longest, terms);
  Vec y = c.y;
  flow.advance(0, 0.7, c.load(), c.a, {}, y);
  const Vec expected = moved(c.system(), longest, 0.7, c.phase, Vec::Zero(2 * terms), c.y);
  EXPECT_LT(distance(c.system(), y, expected), of_squaring);
  EXPECT_GT(distance(c.system(), y, moved(c.system(), longest, 0.7, c.phase, c.a, c.y)), 1e-3);
}

TEST(LinearFlow, HasRowsOfTheSameMotion) {
  const Case c;
  LinearFlow flow(c.system(), longest, terms);
  Mat r(2, 8);
  r << 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0,  // of a displacement, and of a velocity
      0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5;
  for (const int level : {0, 4, 9}) {
    for (const double fraction : fractions) {
      const auto rows = flow.rows(level, fraction, r);
      const Vec of = rows.y * c.y + rows.load * c.load() + rows.force * c.a;
      const Vec expected = r * moved(c.system(), flow.size(level), fraction, c.phase, c.a, c.y);
      const double length = c.system().length_scale();
      EXPECT_NEAR(of(0), expected(0), of_squaring * length) << level << " " << fraction;
      EXPECT_NEAR(of(1), expected(1), of_squaring * length * c.system().phase_rate());
      const auto free = flow.rows(level, fraction, r, LinearFlow::Forces::none);
      EXPECT_EQ(free.force.size(), 0);
      EXPECT_LT((free.y - rows.y).norm(), rounding * rows.y.norm());
    }
  }
}

// A table moves states on by its whole step: two of a level are one of the level above.
TEST(LinearFlow, HasTablesThatMoveOnByTheirSize) {
  const Case c;
  LinearFlow flow(c.system(), longest, terms);
  for (const int level : {2, 8}) {
    const auto& t = flow.table(level);
    EXPECT_EQ(t.h, flow.size(level));
    const Vec end = c.y + t.X * c.y + t.L * c.load() + t.G * c.a;
    const Vec expected = moved(c.system(), t.h, 1.0, c.phase, c.a, c.y);
    EXPECT_LT(distance(c.system(), end, expected), of_squaring) << level;
    const double later = c.phase + c.system().phase_rate() * t.h;
    EXPECT_LT((t.R * c.load() - load_at(later)).norm(), rounding);
  }
}

TEST(LinearFlow, RestrictsForcesToTheHalvesOfAStep) {
  const Case c;
  const LinearFlow flow(c.system(), longest, terms);
  const std::vector<int> touching{0};
  const Mat powers = legendre_powers();
  const auto force = [&](const Vec& a, int d, double s) {
    const Vec of_s = powers * a.segment(d * terms, terms);
    return ((of_s(3) * s + of_s(2)) * s + of_s(1)) * s + of_s(0);
  };
  for (const bool second : {false, true}) {
    Vec half = c.a;
    flow.restrict_to_half(second, touching, half);
    for (const int d : {0, 1}) {
      for (const double s : {0.0, 0.3, 1.0}) {
        EXPECT_NEAR(force(half, d, s), force(c.a, d, 0.5 * ((second ? 1.0 : 0.0) + s)),
                    rounding * c.a.norm());
      }
    }
  }
}

// ---- closed forms -------------------------------------------------------------------------------

Vec moved_freely(LinearFlow& flow, double fraction, const Vec& y) {
  Vec end = y;
  flow.advance(0, fraction, load_at(0.0), {}, {}, end);
  return end;
}

// A mass that falls: neither a frequency nor an eigenvector.
TEST(LinearFlow, LetsAFreeMassFall) {
  const Scene scene = MassInRing{.m = 3.0, .k = 0.0, .gravity = 9.81}.scene();
  LinearFlow flow(scene.contacts, 0.7, terms);
  for (const double fraction : fractions) {
    const double t = 0.7 * fraction;
    const Vec y = moved_freely(flow, fraction, Vec{{0.1, 0.2, -0.3, 0.4}});
    EXPECT_NEAR(y(0), 0.1 - 0.3 * t, rounding);
    EXPECT_NEAR(y(1), 0.2 + 0.4 * t - 0.5 * 9.81 * t * t, rounding);
    EXPECT_NEAR(y(2), -0.3, rounding);
    EXPECT_NEAR(y(3), 0.4 - 9.81 * t, rounding);
  }
}

// Critically damped, x = (1 + w t) e^(-w t): two eigenvectors are one.
TEST(LinearFlow, IsExactWhereEigenvectorsAreNot) {
  const double m = 2.0, w = 100.0;
  const Scene scene = MassInRing{.m = m, .k = m * w * w, .c = 2.0 * m * w}.scene();
  LinearFlow flow(scene.contacts, 0.1, terms);
  for (const double fraction : fractions) {
    const double wt = w * 0.1 * fraction;
    const Vec y = moved_freely(flow, fraction, Vec{{1.0, 0.0, 0.0, 0.0}});
    EXPECT_NEAR(y(0), (1.0 + wt) * std::exp(-wt), rounding);
    EXPECT_NEAR(y(2), -w * wt * std::exp(-wt), rounding * w);
  }
}

// Beside a rate of 1e4 1/s one of 1e-10 1/s keeps its digits: in I + X it would have six.
TEST(LinearFlow, KeepsTheDigitsOfSlowMotionsBesideFastOnes) {
  constexpr double kept = 1e-10;  // relative: rounding, some 16 doublings of it
  const double k = 1e-6, c = 1e4, h = 1.0;
  const Scene scene = MassInRing{.m = 1.0, .k = k, .c = c}.scene();
  LinearFlow flow(scene.contacts, h, terms);
  const double fast = -0.5 * c - std::sqrt(0.25 * c * c - k), slow = k / fast;
  const double change = (fast * std::expm1(slow * h) - slow * std::expm1(fast * h)) / (fast - slow);
  ASSERT_NEAR(change, -k / c * h, 1e-3 * k / c);
  EXPECT_NEAR(flow.table(0).X(0, 0) / change, 1.0, kept);
}

TEST(LinearFlow, RefusesWhatNoStepIsShortEnoughFor) {
  const Scene scene = MassInRing{}.scene();
  EXPECT_NO_THROW(LinearFlow(scene.contacts, 1.0, terms));
  EXPECT_THROW(LinearFlow(scene.contacts, 1e30, terms), NumericalError);
}

// ---- frequencies --------------------------------------------------------------------------------

TEST(BalancedNorm, BoundsEigenvaluesInGoodUnits) {
  const double w = 1e4;
  const double norm = balanced_norm(Mat{{0.0, 1.0}, {-w * w, 0.0}});
  EXPECT_GE(norm, w);
  EXPECT_LE(norm, 2.0 * w);  // powers of two: no factor is off by more than 2^(1/2)
  EXPECT_EQ(balanced_norm(3.0 * Mat::Identity(3, 3)), 3.0);
}

TEST(LinearFlow, ComesFromTheEquationsOfMotion) {
  const Case c;
  const Mat A = first_order_matrix(c.system());
  const Vec rates = A * c.y;
  Vec acceleration(4);
  const ContactStates apart{{}};
  c.system().acceleration(c.phase, c.y.data(), apart, acceleration.data());
  acceleration -= c.system().constant_load() +
                  std::cos(c.phase) * c.system().synchronous_load().cosine +
                  std::sin(c.phase) * c.system().synchronous_load().sine;
  EXPECT_EQ(Vec(rates.head(4)), Vec(c.y.tail(4)));
  EXPECT_LT((rates.tail(4) - acceleration).norm(), rounding * (1.0 + acceleration.norm()) * 10.0);
  EXPECT_EQ(Vec(load_at(0.3)), (Vec{{1.0, std::cos(0.3), std::sin(0.3)}}));
}

// Rotor and stator give way with 1 / m_r + 1 / m_s; the stator on its spring is the fastest alone.
TEST(LinearFlow, KnowsTheFrequenciesOfContactsAndModes) {
  const RotorStator p{.kC = 2e7, .mr = 40.0, .ms = 25.0, .cr = 0.0, .cs = 0.0};
  const Scene scene = p.scene();
  const double gain = 1.0 / p.mr + 1.0 / p.ms;
  EXPECT_NEAR(contact_gain(scene.contacts.contacts()[0]), gain, rounding * gain);
  const double contact = std::sqrt(p.kC * gain), mode = std::sqrt(p.ks / p.ms);
  EXPECT_NEAR(contact_frequency(scene.contacts), contact, 1e-9 * contact);
  EXPECT_NEAR(fastest_mode(scene.contacts), mode, 1e-9 * mode);
}

}  // namespace whirl::linear_flow_test
