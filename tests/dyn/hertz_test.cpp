// Hertz contact in time: its force has no Taylor series at the surface, where every contact begins
// and ends.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "libbase/numerics/quadrature.hpp"
#include "libbase/numerics/roots.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::hertz_test {

using test::MassInRing;

/// An impact of a free mass at v on a Hertz spring at rest.
///
///   d_max = (5 m v^2 / (4 k))^(2/5),   T = 4 sqrt(pi) Gamma(7/5) / Gamma(9/10) d_max / v
///
/// @source [Johnson1985], section 11.4
struct Impact {
  double m, k, v;
  double depth() const { return std::pow(1.25 * m * v * v / k, 0.4); }
  double duration() const {
    return 4.0 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / (2.0 * std::tgamma(0.9)) *
           depth() / v;
  }
};

/// An impact of a free mass at v on a damped Hertz spring at rest, m d'' = -k d^(3/2) (1 + b d')
/// with b = (3/2) alpha, by quadrature in the plane of depth and rate:
///
///   (2/5) (k / m) d^(5/2) = int_{d'}^v s / (1 + b s) ds,
///   dt = -dd' / ((k / m) d^(3/2) (1 + b d'))
///
/// @source [HuntCrossley1975]
struct DampedImpact {
  double m, k, alpha, v;

  static const Quadrature& gauss() {
    static const Quadrature rule = Quadrature::gauss(40);
    return rule;
  }
  /// Integral of s / (1 + b s) from a rate that is slower by `change` to one.
  double work(double change, double to) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < gauss().x.size(); ++i) {
      const double s = to - gauss().x(i) * change;
      sum += gauss().w(i) * s / (1.0 + 1.5 * alpha * s);
    }
    return sum * change;
  }
  /// Speed at which the mass leaves: at zero depth, too.
  double exit() const {
    return bracketed_root([&](double u) { return work(v + u, v); },
                          0.5 * v / (1.0 + 1.5 * alpha * v), std::min(v, 0.999 / (1.5 * alpha)),
                          1e-16 * v);
  }
  double depth(double work_left) const { return std::pow(2.5 * m / k * work_left, 0.4); }
  double largest_depth() const { return depth(work(v, v)); }
  /// From the surface to rest or back: d' = end (1 - x^5) makes the integrand smooth at the
  /// surface.
  double time_from(double end) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < gauss().x.size(); ++i) {
      const double x = gauss().x(i), change = end * std::pow(x, 5), rate = end - change;
      const double force = k / m * std::pow(depth(work(change, end)), 1.5);
      sum += gauss().w(i) * 5.0 * std::abs(end) * std::pow(x, 4) /
             (force * (1.0 + 1.5 * alpha * rate));
    }
    return sum;
  }
  double duration() const { return time_from(v) + time_from(-exit()); }
};

TEST(DampedImpact, OfASlowMassGivesBackWhatHuntAndCrossleySay) {
  for (const double v : {1e-3, 1e-2}) {
    const DampedImpact impact{.m = 2.0, .k = 1e9, .alpha = 1.0, .v = v};
    EXPECT_NEAR(impact.exit() / v, 1.0 - v, v * v);
  }
  const Impact plain{2.0, 1e9, 0.1};  // all but undamped: the closed forms of Hertz' impact
  const DampedImpact faint{.m = 2.0, .k = 1e9, .alpha = 1e-10, .v = 0.1};
  EXPECT_NEAR(faint.largest_depth(), plain.depth(), 1e-10 * plain.depth());
  EXPECT_NEAR(faint.duration(), plain.duration(), 1e-10 * plain.duration());
}

class HertzImpact : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Methods, HertzImpact,
                         ::testing::Values("taylor", "collocation", "dop853", "cvode-adams"),
                         [](const auto& member) {
                           std::string name(member.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Thrown to and fro across the ring, straight along x: after a revolution with several impacts the
// mass is where the closed forms of impacts and flights say.
TEST_P(HertzImpact, LastsAsLongAsInClosedForm) {
  const double accuracy = std::string(GetParam()).starts_with("cvode") ? 1e-5 : 1e-7;
  for (const double k : {1e7, 1e9, 1e11}) {
    const MassInRing p{.Omega = 100.0, .k = 0.0, .kH = k};
    const Impact impact{p.m, k, 0.13};
    const Scene scene = p.scene();
    MotionState state = test::state_of({p.clearance, 0.0}, {impact.v, 0.0});
    const double cycle = impact.duration() + 2.0 * p.clearance / impact.v;
    const double impacts = std::floor(scene.contacts.period() / cycle);
    const double flight = scene.contacts.period() - impacts * cycle - impact.duration();
    ASSERT_GT(impacts, 1.0);
    ASSERT_GT(flight, 0.0);
    const double side = std::fmod(impacts, 2.0) == 0.0 ? 1.0 : -1.0;

    ContactMeter meter(scene.contacts);
    const Integration result =
        test::run(scene, state, 1, {.method = method_named(GetParam())}, [&](const Step& step) {
          meter.add(step);
          return true;
        });
    ASSERT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    EXPECT_NEAR(state.y(0), side * (p.clearance - impact.v * flight), accuracy * p.clearance) << k;
    EXPECT_NEAR(state.y(2), -side * impact.v, accuracy * impact.v) << k;
    const double largest = k * std::pow(impact.depth(), 1.5);
    EXPECT_NEAR(meter.measures()[0].max_normal, largest, 1e-3 * largest) << k;
  }
}

// The same with damped contacts: each impact is slower than the one before.
TEST_P(HertzImpact, GivesBackWhatAQuadratureSays) {
  const double accuracy = std::string(GetParam()).starts_with("cvode") ? 1e-5 : 1e-7;
  const double v = 0.26;
  for (const double alpha_v : {0.02, 0.3, 1.5}) {
    const MassInRing p{.Omega = 100.0, .k = 0.0, .kH = 1e9, .alpha = alpha_v / v};
    const Scene scene = p.scene();
    MotionState state = test::state_of({p.clearance, 0.0}, {v, 0.0});
    double time = 0.0, speed = v, side = 1.0;
    int impacts = 0;
    for (;; ++impacts) {
      const DampedImpact impact{p.m, p.kH, p.alpha, speed};
      time += impact.duration();
      speed = impact.exit();
      if (time + 2.0 * p.clearance / speed > scene.contacts.period()) break;
      time += 2.0 * p.clearance / speed;
      side = -side;
    }
    ASSERT_GT(impacts, 1);
    ASSERT_LT(time, scene.contacts.period());

    ContactMeter meter(scene.contacts);
    const Integration result =
        test::run(scene, state, 1, {.method = method_named(GetParam())}, [&](const Step& step) {
          meter.add(step);
          return true;
        });
    ASSERT_EQ(result.outcome, Outcome::reached_end) << result.failure;
    const double flight = scene.contacts.period() - time;
    EXPECT_NEAR(state.y(0), side * (p.clearance - speed * flight), accuracy * p.clearance);
    EXPECT_NEAR(state.y(2), -side * speed, accuracy * v);
    EXPECT_EQ(meter.measures()[0].impacts, impacts);
  }
}

/// A heavy mass that shakes on a flat stop below it, so that it is torn off faster than 2 / (3
/// alpha).
///
/// @param force  of the unbalance [N]; the weight is 9.81 N
Model shaken(double force) {
  Model m = MassInRing{.Omega = 100.0,
                       .k = 50.0,
                       .c = 5.0,
                       .U = force / 1e4,
                       .kH = 1e5,
                       .alpha = 30.0,
                       .mu = 0.1,
                       .gravity = 9.81}
                .model();
  m.contacts[0].geometry = geometry::Stop{.angle = -0.5 * std::numbers::pi};
  return m;
}

/// Its motion from where it has settled.
struct Shaking {
  Scene scene;
  MotionState start;

  explicit Shaking(double force) : scene(make_scene(shaken(force))) {
    start = test::start_of(shaken(force), scene);
    test::run(scene, start, 10);
    start.revolution = 0;
  }
  test::Stretch stretch(long revolutions = 3) const {
    return {scene, start, revolutions, 2 * revolutions};
  }
};

// Shaken gently, the mass sinks back before it has left the surface, and is pushed again as soon as
// it is slow enough; shaken harder it comes off.
TEST(DampedHertz, LetsGoWhereItWouldPull) {
  for (const double force : {15.0, 20.0}) {
    const Shaking m(force);
    const Scene& scene = m.scene;
    MotionState state = m.start;
    std::map<std::pair<Touch, Touch>, int> changes;
    Touch before = state.contacts[0].touch;
    std::vector<ContactForces> forces;
    Vec y(4);
    test::run(scene, state, 10, {}, [&](const Step& step) {
      const Touch now = step.contacts[0].touch;
      if (now != before) ++changes[{before, now}];
      before = now;
      for (const double s : {0.0, 0.3, 0.7, 1.0}) {
        step.at(s, y.data());
        scene.contacts.forces(step.angle(s), y.data(), step.contacts, forces);
        if (now == Touch::apart) continue;
        EXPECT_GT(forces[0].depth, -1e-12);
        const double sign = now == Touch::receding ? -1.0 : 1.0;
        EXPECT_GT(sign * forces[0].normal, -1e-9);
      }
      return true;
    });
    using enum Touch;
    const std::map<std::pair<Touch, Touch>, int> gentle{{{sliding, receding}, 10},
                                                        {{receding, sliding}, 10}},
        hard{{{sliding, receding}, 10}, {{receding, apart}, 10}, {{apart, sliding}, 10}};
    EXPECT_EQ(changes, force < 18.0 ? gentle : hard);
  }
}

TEST_P(HertzImpact, LetsGoWhereQuadruplePrecisionDoes) {
  const double accuracy = std::string(GetParam()).starts_with("cvode") ? 1e-5 : 1e-7;
  for (const double force : {15.0, 20.0}) {
    const Shaking m(force);
    test::expect_end_by(GetParam(), m.stretch(), test::exact_end(m.stretch(), 1e-18), accuracy);
  }
}

// Tolerances, tangents, divergence of the flow, and lanes bit by bit.
TEST(DampedHertz, IsAsGoodWhereItLetsGo) {
  for (const double force : {15.0, 20.0}) {
    const Shaking m(force);
    test::expect_error_follows_tolerance(m.stretch(), test::exact_end(m.stretch(), 1e-20));
    test::expect_tangent_of_differences(m.stretch(), 1e-6);
    test::expect_divergence(m.stretch(1));  // of three revolutions the determinant is e^-40
  }
  std::vector<Scene> scenes;
  std::vector<MotionState> starts;
  for (int i = 0; i < 19; ++i) {
    const Shaking m(10.0 + i);
    scenes.push_back(m.scene);
    starts.push_back(m.start);
  }
  test::expect_same_alone(scenes, starts, 1e-10, 200);
}

// P1 with a contact that is as stiff at 0.1 mm: against quadruple precision.
TEST(Hertz, ErrorFollowsTheTolerance) {
  test::RotorStator p = test::P1;
  p.kH = 1.5e10;
  const Scene scene = p.scene();
  MotionState start = test::start_of(p.model(), scene);
  test::run(scene, start, 50);
  start.revolution = 0;
  const test::Stretch s{scene, start, 3, 21};
  test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-22));
}

}  // namespace whirl::hertz_test
