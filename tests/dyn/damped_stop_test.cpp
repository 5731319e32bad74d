// Saltation at a damped stop: without it a stable orbit would be called unstable, and the sum of
// the exponents would not betray that.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "libbase/numerics/dense.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::damped_stop_test {

/// x'' + 2 z x' + x = cos(w t) - (k (x - g) + c x') while in touch and pushing.
struct Stop {
  double z = 0.02, w = 1.3, g = 0.2, k = 25.0, c = 3.0;

  /// The same in a ring of radius R: the unbalance turns, but y is held by a stiff spring.
  static constexpr double R = 10.0, stiff = 1e4;
  Model model() const {
    Model m = test::MassInRing{.Omega = w,
                               .m = 1.0,
                               .k = 1.0,
                               .U = 1.0 / (w * w),
                               .kC = k,
                               .cC = c,
                               .clearance = R,
                               .offset = {g - R, 0.0}}
                  .model();
    BearingCoefficients spring;
    spring.K << 1.0, 0.0, 0.0, stiff;
    spring.C << 2.0 * z, 0.0, 0.0, 200.0;
    m.structure.bearings = {test::bearing(test::body("mass"), spring)};
    return m;
  }
};

/// An independent program: classical Runge-Kutta between events that are bisected, with the
/// variational equation; jumps of the tangent by S = I + (f+ - f-) n^T / (n^T f-), or left out.
struct Independent {
  enum State { apart, touching, receding };
  Stop p;
  bool has_saltation;
  State state = apart;
  double y[6] = {0, 0, 1, 0, 0, 1};  ///< x, x', columns of the tangent

  double force(const double* q) const { return p.k * (q[0] - p.g) + p.c * q[1]; }
  void rates(double t, const double* q, double* to) const {
    double stiffness = 1.0, damping = 2.0 * p.z, load = std::cos(p.w * t);
    if (state == touching) {
      stiffness += p.k;
      damping += p.c;
      load += p.k * p.g;
    }
    for (int j = 0; j < 6; j += 2) {
      to[j] = q[j + 1];
      to[j + 1] = (j == 0 ? load : 0.0) - stiffness * q[j] - damping * q[j + 1];
    }
  }
  void step(double t, double h, double* q) const {
    double a[6], b[6], c[6], d[6], s[6];
    rates(t, q, a);
    for (int i = 0; i < 6; ++i) s[i] = q[i] + 0.5 * h * a[i];
    rates(t + 0.5 * h, s, b);
    for (int i = 0; i < 6; ++i) s[i] = q[i] + 0.5 * h * b[i];
    rates(t + 0.5 * h, s, c);
    for (int i = 0; i < 6; ++i) s[i] = q[i] + h * c[i];
    rates(t + h, s, d);
    for (int i = 0; i < 6; ++i) q[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }
  /// Positive until the next event.
  double until(const double* q) const {
    return state == touching ? force(q) : state == receding ? q[0] - p.g : p.g - q[0];
  }
  void pass(double t) {
    if (has_saltation && state != receding) {
      double f[6];
      rates(t, y, f);
      const double nx = state == touching ? p.k : 1.0, nv = state == touching ? p.c : 0.0;
      const double jump = state == touching ? force(y) : -force(y);
      for (int j = 2; j < 6; j += 2) {
        y[j + 1] += jump * (nx * y[j] + nv * y[j + 1]) / (nx * f[0] + nv * f[1]);
      }
    }
    state = state == apart ? touching : state == touching ? receding : apart;
  }
  void revolution() {
    constexpr int steps = 1000;
    const double h = 2.0 * std::numbers::pi / (p.w * steps);
    for (int i = 0; i < steps; ++i) {
      double t = h * i, left = h;
      while (left > 1e-14 * h) {
        double end[6];
        std::copy(y, y + 6, end);
        step(t, left, end);
        if (until(end) > 0.0) {
          std::copy(end, end + 6, y);
          break;
        }
        double low = 0.0, high = left;
        for (int bisection = 0; bisection < 60; ++bisection) {
          const double middle = 0.5 * (low + high);
          std::copy(y, y + 6, end);
          step(t, middle, end);
          (until(end) > 0.0 ? low : high) = middle;
        }
        step(t, high, y);
        t += high;
        left -= high;
        pass(t);
      }
    }
  }
  /// Multipliers of the orbit after many revolutions.
  static CVec multipliers(const Stop& p, bool has_saltation) {
    Independent motion{.p = p, .has_saltation = has_saltation};
    for (int i = 0; i < 60; ++i) motion.revolution();
    const double unit[] = {1, 0, 0, 1};
    std::copy(unit, unit + 4, motion.y + 2);
    motion.revolution();
    Mat tangent(2, 2);
    tangent << motion.y[2], motion.y[4], motion.y[3], motion.y[5];
    return eigenvalues(tangent);
  }
};

TEST(DampedStop, WouldSeemUnstableWithoutSaltation) {
  const Stop p;
  const CVec without = Independent::multipliers(p, false);
  EXPECT_NEAR(without.cwiseAbs().maxCoeff(), 1.0099, 1e-4);  // unstable, or so it seems
  EXPECT_NEAR(without.cwiseAbs().minCoeff(), 0.1553, 1e-4);
  const CVec with = Independent::multipliers(p, true);
  EXPECT_NEAR(std::abs(with(0)), 0.3961, 1e-4);
  EXPECT_NEAR(std::abs(with(1)), 0.3961, 1e-4);
  EXPECT_NEAR(std::abs(with(0) * with(1)), std::abs(without(0) * without(1)), 1e-6);

  const Model model = p.model();
  const Scene scene = make_scene(model);
  Trajectory t{.system = &scene.contacts, .state = test::start_of(model, scene), .revolutions = 60};
  integrate_single(t, {.tolerance = 1e-12});
  const Vec settled = t.state.y;
  t.revolutions = 1;
  integrate_single(t, {.tolerance = 1e-12, .tangent = true});
  ASSERT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  EXPECT_LT(distance(scene.contacts, t.state.y, settled), 1e-9);  // the orbit attracts
  Mat along_x(2, 2);
  along_x << t.tangent(0, 0), t.tangent(0, 2), t.tangent(2, 0), t.tangent(2, 2);
  for (const Complex& multiplier : eigenvalues(along_x)) {
    EXPECT_NEAR(std::abs(multiplier), std::abs(with(0)), 1e-5);
  }
}

}  // namespace whirl::damped_stop_test
