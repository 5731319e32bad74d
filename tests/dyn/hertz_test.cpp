// Hertz contact in time: its force has no Taylor series at the surface, where every contact begins
// and ends.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
