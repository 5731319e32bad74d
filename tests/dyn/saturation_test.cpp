// Currents and voltages of magnetic bearings that saturate.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "libdyn/motions/run_model.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/system/support_limits.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libfe/parts/control.hpp"
#include "tests/support/law_proofs.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::saturation_test {

/// A disk with unbalance in a magnetic bearing, whose equations are written down below once more.
struct InMagneticBearing {
  double Omega = 330.0;
  double m = 10.0, ki = 200.0, ks = -1.5e6, U = 0.0045;  // a spring keeps what no current can
  double P = 1.5e4, D = 30.0;
  double filter = 4000.0;     // of the derivative [rad/s]; 0: it has no end
  double amplifier = 2500.0;  // [rad/s]; 0: it has none
  AmplifierLimits limits{.current_limit = 1.5};

  StateSpace control() const {
    return chain({transfer_function(
        PidController{.proportional = P, .derivative = D, .derivative_bandwidth = filter})});
  }
  Model model() const {
    Model all;
    all.speed = Omega;
    all.has_speed = true;
    Structure& s = all.structure;
    s.bodies = {{.name = "disk", .m = m, .spins = true}};
    s.unbalances = {{.at = test::body("disk"), .moment = U}};
    s.bearings = {test::bearing(test::body("disk"), test::isotropic(-ks))};
    LimitedCurrents currents = limited_currents(control().repeated(2), amplifier, limits);
    Support support{.name = "amb", .sensors = 2};
    support.sees = support.acts_on = {{.at = test::body("disk"), .x = 1.0, .y = 0.0},
                                      {.at = test::body("disk"), .x = 0.0, .y = 1.0}};
    support.law = currents.law;
    support.law.C *= ki;
    support.law.D *= ki;
    support.law.D_rate *= ki;
    for (SignalLimit& limit : currents.limits) {
      limit.to_forces *= ki;
      limit.force *= ki;
      support.limits.push_back(limit);
    }
    s.supports = {support};
    add_limits(all);
    all.reduction.method = ReductionMethod::none;
    return all;
  }
  Scene scene() const { return make_scene(model()); }

  /// u, u', the filtered displacement of the derivative and the current, of one axis.
  using Axis = std::array<double, 4>;
  static double clamp(double x, double limit) {
    return limit > 0.0 ? std::clamp(x, -limit, limit) : x;
  }
  Axis rates(const Axis& y, double load) const {
    const auto [u, v, q, i] = y;
    const double slope = filter > 0.0 ? filter * (u - q) : v;
    const double asked = clamp(P * u + D * slope, limits.current_limit);
    const double current = amplifier > 0.0 ? i : asked;
    double charge = amplifier * (asked - i);
    if (limits.voltage_limit > 0.0) {
      const double L = limits.inductance, R = limits.resistance;
      charge = (clamp(L * charge + R * i, limits.voltage_limit) - R * i) / L;
    }
    return {v, (load - ki * current + ks * u) / m, filter * (u - q), charge};
  }
  /// The disk after some revolutions from rest, by Runge-Kutta steps that are short.
  Vec end_after(double revolutions) const {
    Vec end(4);
    const double h = 0.25e-6 * 2.0 * std::numbers::pi / Omega * 20.0;
    const auto steps = std::lround(revolutions / 20.0 * 4e6);
    for (const int axis : {0, 1}) {
      Axis y{};
      const auto at = [&](const Axis& from, const Axis& k, double part) {
        Axis to;
        for (std::size_t j = 0; j < 4; ++j) to[j] = from[j] + part * k[j];
        return to;
      };
      const auto load = [&](double t) {
        return U * Omega * Omega * (axis == 0 ? std::cos(Omega * t) : std::sin(Omega * t));
      };
      for (long n = 0; n < steps; ++n) {
        const double t = double(n) * h;
        const Axis a = rates(y, load(t)), b = rates(at(y, a, h / 2), load(t + h / 2)),
                   c = rates(at(y, b, h / 2), load(t + h / 2)), d = rates(at(y, c, h), load(t + h));
        for (std::size_t j = 0; j < 4; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
      }
      end(axis) = y[0];
      end(2 + axis) = y[1];
    }
    return end;
  }
};

std::vector<InMagneticBearing> kinds() {
  InMagneticBearing of_current, ideal, of_voltage;
  ideal.filter = ideal.amplifier = 0.0;
  of_voltage.limits = {.voltage_limit = 15.0, .inductance = 0.02, .resistance = 2.0};
  return {of_current, ideal, of_voltage};
}

Vec disk_of(const Scene& scene, const MotionState& state) {
  const FullState full = full_state(scene, state);
  Vec disk(4);
  disk << full.displacement.head(2), full.velocity.head(2);
  return disk;
}

MotionState rest(const Scene& scene) {
  return {.y = Vec::Zero(scene.contacts.size())};
}

TEST(Saturation, MovesAsItsEquationsSay) {
  for (const InMagneticBearing& rotor : kinds()) {
    const Scene scene = rotor.scene();
    std::vector<Trajectory> one{
        {.system = &scene.contacts, .state = rest(scene), .revolutions = 8}};
    integrate_batch(one, {.tolerance = 1e-12, .measures = true});
    ASSERT_EQ(one[0].outcome, Outcome::reached_end) << one[0].failure;
    EXPECT_GT(one[0].contacts.at(0).impacts, 8);
    const Vec expected = rotor.end_after(8), found = disk_of(scene, one[0].state);
    EXPECT_LT((found - expected).norm(), 1e-8 * expected.norm()) << found.transpose() << "\n"
                                                                 << expected.transpose();
  }
}

class SaturationByMethod : public ::testing::TestWithParam<std::pair<const char*, double>> {};
INSTANTIATE_TEST_SUITE_P(Methods, SaturationByMethod,
                         ::testing::Values(std::pair("dop853", 1e-6),
                                           std::pair("cvode_adams", 1e-3),
                                           std::pair("arkode", 1e-5)),
                         [](const auto& member) { return member.param.first; });

TEST_P(SaturationByMethod, MovesAsInQuadruplePrecision) {
  const auto [name, accuracy] = GetParam();
  for (const InMagneticBearing& rotor : kinds()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, rest(scene), 1, 4};
    test::expect_end_by(name, s, test::exact_end(s, 1e-18), accuracy);
  }
}

TEST(Saturation, ErrorFollowsTheTolerance) {
  for (const InMagneticBearing& rotor : kinds()) {
    const Scene scene = rotor.scene();
    const test::Stretch s{scene, rest(scene), 1, 4};
    test::expect_error_follows_tolerance(s, test::exact_end(s, 1e-20));
  }
}

TEST(Saturation, InABatchIsBitwiseTheSameAsAlone) {
  for (const InMagneticBearing& like : kinds()) {
    std::vector<Scene> scenes;
    std::vector<MotionState> starts;
    for (int i = 0; i < 11; ++i) {
      InMagneticBearing rotor = like;
      rotor.Omega = 300.0 + 9.0 * i;
      rotor.limits.current_limit *= 1.0 + 0.05 * i;
      rotor.limits.voltage_limit *= 1.0 + 0.05 * i;
      scenes.push_back(rotor.scene());
      starts.push_back(rest(scenes.back()));
    }
    test::expect_same_alone(scenes, starts, 1e-8, 50);
  }
}

TEST(Saturation, HasTangentsThatAreLimitsOfDifferences) {
  for (const InMagneticBearing& rotor : kinds()) {
    const Scene scene = rotor.scene();
    MotionState start = rest(scene);
    test::run(scene, start, 3, {.tolerance = 1e-12});
    test::expect_tangent_of_differences({scene, start, 1, 4}, 1e-5, 1e-6);
  }
}

TEST(Saturation, HasTheDivergenceOfItsTangent) {
  for (InMagneticBearing rotor : kinds()) {
    if (rotor.amplifier > 0.0) rotor.filter = 400.0, rotor.amplifier = 300.0;  // that leave digits
    const Scene scene = rotor.scene();
    MotionState start = rest(scene);
    test::run(scene, start, 3, {.tolerance = 1e-12});
    test::expect_divergence({scene, start, 1, 4});
  }
}

TEST(Saturation, MovesByRk4AsByTaylorSeries) {
  for (const InMagneticBearing& rotor : kinds()) {
    const Scene scene = rotor.scene();
    MotionState exact = rest(scene);
    test::run(scene, exact, 2, {.tolerance = 1e-13});
    const double h = scene.contacts.period() / 40000.0;
    std::vector<Trajectory> lanes(
        3, {.system = &scene.contacts, .state = rest(scene), .revolutions = 2});
    integrate_batch_rk4(lanes, {.fixed_step = h});
    EXPECT_LT(distance(scene.contacts, lanes[2].state.y, exact.y), 1e-5);
  }
}

// What does not get to its limit moves as if there were none.
TEST(Saturation, IsNotThereBelowItsLimit) {
  for (InMagneticBearing rotor : kinds()) {
    rotor.U *= 0.01;
    MotionState with = rest(rotor.scene()), without;
    const Scene scene = rotor.scene();
    test::run(scene, with, 5, {.tolerance = 1e-12});
    rotor.limits.current_limit = rotor.limits.voltage_limit = 0.0;
    const Scene free = rotor.scene();
    without = rest(free);
    EXPECT_EQ(free.contacts.contacts().size(), 0u);
    test::run(free, without, 5, {.tolerance = 1e-12});
    const Vec a = disk_of(scene, with), b = disk_of(free, without);
    EXPECT_LT((a - b).norm(), 1e-9 * b.norm());
  }
}

// The bearing does not push harder than its largest current does.
TEST(Saturation, LimitsTheForceOfTheBearing) {
  const InMagneticBearing rotor = kinds()[1];
  const auto run =
      run_model(rotor.model(), {.simulation = {.revolutions = 4, .discard = 4, .samples = 256}});
  const Mat& forces =
      run.simulation.recording.on_supports;  // of the spring -ks, then of the magnet
  ASSERT_EQ(forces.rows(), 4);
  const double largest = forces.bottomRows(2).cwiseAbs().maxCoeff();
  EXPECT_NEAR(largest, rotor.ki * rotor.limits.current_limit, 1e-6 * largest);  // of a float
}

}  // namespace whirl::saturation_test
