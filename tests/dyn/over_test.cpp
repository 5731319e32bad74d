// Linear analyses over a value of the model, against closed forms and against single models.

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/linear/critical_over.hpp"
#include "libdyn/linear/modes_over.hpp"
#include "libdyn/linear/unbalance_over.hpp"
#include "libfe/analyses/campbell.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::over_test {

using test::pi;
constexpr double m = 2.0, k = 2e4, c = 40.0;
const double omega = std::sqrt(k / m);

/// A mass on springs and dampers, at 50 rad/s.
Model jeffcott(const BearingCoefficients& bearing) {
  const Station rotor = test::body("rotor");
  Model model;
  model.structure.bodies = {{.name = "rotor", .m = m, .spins = true}};
  model.structure.bearings = {test::bearing(rotor, bearing)};
  model.structure.unbalances = {{.at = rotor, .moment = 1e-4}};
  model.speed = 50.0;
  model.has_speed = true;
  return model;
}

/// K = [[k, q], [-q, k]] of q = the value.
Model cross_coupled(double q) {
  BearingCoefficients b = test::isotropic(k, c);
  b.K << k, q, -q, k;
  return jeffcott(b);
}

// z = x + i y:  m s^2 + c s + k - i q = 0, s = -c / 2m + sqrt((c / 2m)^2 - (k - i q) / m)
Complex forward_root(double q) {
  const Complex root = std::sqrt(Complex(c * c / (4.0 * m * m)) - Complex(k, -q) / m);
  return -c / (2.0 * m) + (root.imag() > 0.0 ? root : -root);
}

// It loses its damping at q = c omega_n, where it whirls forward at omega_n.
TEST(ModesOver, CrossCouplingTakesTheDampingOfAJeffcottRotor) {
  constexpr double solves = 1e-10;
  std::vector<double> values;
  for (int i = 0; i <= 8; ++i) values.push_back(750.0 * i);
  const ModesOver found = modes_over(cross_coupled, {"bearing.1.stiffness.xy", "N/m"}, values, 2);
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_TRUE(found.gaps.empty());
  const bool is_first = found.branches[0].whirl == Whirl::forward;
  const ModesOverBranch& forward = found.branches[is_first ? 0 : 1];
  const ModesOverBranch& backward = found.branches[is_first ? 1 : 0];
  EXPECT_EQ(forward.whirl, Whirl::forward);
  EXPECT_EQ(backward.whirl, Whirl::backward);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Complex s = forward_root(values[i]);
    EXPECT_LT(std::abs(forward.eigenvalue(row) - s), solves * omega);
    EXPECT_NEAR(forward.frequency(row), s.imag(), solves * omega);
    EXPECT_NEAR(forward.log_decrement(row), -2.0 * pi * s.real() / s.imag(), solves);
    const Complex other(-c / m - s.real(), s.imag());  // the other root, as seen in a mirror
    EXPECT_LT(std::abs(backward.eigenvalue(row) - other), solves * omega);
  }
  ASSERT_EQ(found.thresholds.size(), 1u);
  EXPECT_NEAR(found.thresholds[0].value, c * omega, 1e-7 * c * omega);
  EXPECT_NEAR(found.thresholds[0].frequency, omega, 1e-9 * omega);
  EXPECT_EQ(found.thresholds[0].branch, is_first ? 0 : 1);
}

// Where only whole steps make a model, as with a number of elements, the threshold is on the
// straight line between its neighbors; nothing between them is told as left out.
TEST(ModesOver, AThresholdBetweenModelsThatAreNoneIsOnTheLine) {
  constexpr double step = 750.0, solves = 1e-9;
  const ModelAt at = [](double q) {
    if (std::fmod(q, step) != 0.0) throw ModelError({}, "", "expected a whole number");
    return cross_coupled(q);
  };
  const double left = 5.0 * step, right = 6.0 * step;  // c omega = 4000 N/m
  const ModesOver found = modes_over(at, {}, {left, right}, 2);
  ASSERT_EQ(found.thresholds.size(), 1u);
  EXPECT_TRUE(found.gaps.empty());
  const Complex a = forward_root(left), b = forward_root(right);
  const double share = a.real() / (a.real() - b.real()), expected = left + share * step;
  EXPECT_NEAR(found.thresholds[0].value, expected, solves * expected);
  EXPECT_NEAR(found.thresholds[0].frequency, a.imag() + share * (b.imag() - a.imag()),
              solves * omega);
}

// The second of two numbers that grow with the value, at the end where it is larger.
TEST(ShapeLimit, IsThatOfTheHigherEnd) {
  const SolveShapes rising = [](double at) {
    if (at > 4.0) throw NumericalError("too stiff");
    return std::vector<ShapedValue>{{at, {}}, {2.0 * at, {}}, {9.0 * at, {}}};
  };
  const SolveShapes falling = [&](double at) { return rising(5.0 - at); };
  EXPECT_DOUBLE_EQ(shape_limit({1.0, 2.0, 3.0, 4.0, 5.0}, rising, 2), 1.05 * 8.0);
  EXPECT_DOUBLE_EQ(shape_limit({0.0, 1.0, 4.0}, falling, 2), 1.05 * 8.0);
  EXPECT_DOUBLE_EQ(shape_limit({3.0}, rising, 2), 1.05 * 6.0);
  EXPECT_THROW(shape_limit({6.0, 7.0}, rising, 2), NumericalError);
}

// The same threshold if it is one of the values, and none if all grow or none do.
TEST(ModesOver, AThresholdMayBeOneOfTheValues) {
  const double q = c * omega;
  const ModesOver at = modes_over(cross_coupled, {}, {0.5 * q, q, 1.5 * q}, 2);
  ASSERT_EQ(at.thresholds.size(), 1u);
  EXPECT_NEAR(at.thresholds[0].value, q, 1e-7 * q);
  EXPECT_TRUE(modes_over(cross_coupled, {}, {0.0, 0.9 * q}, 2).thresholds.empty());
  EXPECT_TRUE(modes_over(cross_coupled, {}, {1.1 * q, 1.2 * q}, 2).thresholds.empty());
}

/// A shaft of 1 m with a disk, on bearings of a stiffness, the right one at a place.
Model flexible(double stiffness, double right = 1.0) {
  Model model;
  Structure& s = model.structure;
  s.shaft = {test::cylinder(1.0, 0.03, 8)};
  s.disks = {{.name = "disk", .at = test::node(4), .m = 20.0, .Id = 0.12, .Ip = 0.23}};
  s.bearings = {test::bearing(test::at(0.0), test::isotropic(stiffness, 500.0)),
                test::bearing(test::at(right), test::isotropic(stiffness, 500.0))};
  s.unbalances = {{.at = test::node(4), .moment = 1e-4}};
  s.probes = {{.name = "1X", .at = test::node(4), .angle = 0.25 * pi}};
  model.speed = 300.0;
  model.has_speed = true;
  return model;
}
/// Of its stiffness.
Model on_bearings(double stiffness) {
  return flexible(stiffness);
}

TEST(ModesOver, OneValueIsThatModel) {
  const Model model = flexible(1e6);
  const ModesOver found = modes_over(on_bearings, {}, {1e6}, 6);
  const Modes modes = complex_modes(Assembler(model.structure), model.speed, 6);
  ASSERT_EQ(found.branches.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(found.branches[i].frequency(0), modes.oscillatory[i].frequency());
    EXPECT_EQ(found.branches[i].log_decrement(0), modes.oscillatory[i].log_decrement());
    EXPECT_EQ(found.branches[i].whirl, modes.oscillatory[i].whirl);
  }
}

// Over the speed they are a Campbell diagram, which follows modes in its own way.
TEST(ModesOver, OverTheSpeedIsACampbellDiagram) {
  constexpr double solves = 1e-9;
  const std::vector<double> speeds{50.0, 150.0, 250.0, 350.0, 450.0};
  const ModelAt at = [](double speed) {
    Model model = flexible(1e6);
    model.speed = speed;
    return model;
  };
  const ModesOver found = modes_over(at, {}, speeds, 6);
  const Campbell diagram = campbell(Assembler(flexible(1e6).structure), speeds, 6);
  ASSERT_GE(found.branches.size(), 6u);
  ASSERT_EQ(diagram.branches.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(found.branches[i].whirl, diagram.branches[i].whirl);
    for (std::size_t n = 0; n < speeds.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      const double frequency = diagram.branches[i].frequency[n];
      EXPECT_NEAR(found.branches[i].frequency(row), frequency, solves * frequency);
      EXPECT_NEAR(found.branches[i].log_decrement(row), diagram.branches[i].log_decrement[n],
                  solves);
    }
  }
}

// The first value that fails is a gap as any other; if all fail there is no answer.
TEST(ModesOver, AValueThatCannotBeComputedIsAGap) {
  const ModelAt at = [](double value) {
    if (value < 2.5) throw ModelError({}, "", "no such model");
    return jeffcott(test::isotropic(k, c));
  };
  const ModelAt later = [&, calls = 0](double value) mutable {
    return calls++ == 0 ? at(3.0) : at(value);  // the first is asked for its points
  };
  const ModesOver found = modes_over(later, {}, {1.0, 2.0, 3.0}, 2);
  ASSERT_EQ(found.gaps.size(), 2u);
  EXPECT_EQ(found.gaps[1].value, 2.0);
  ASSERT_EQ(found.branches.size(), 2u);
  EXPECT_TRUE(std::isnan(found.branches[0].frequency(0)));
  EXPECT_TRUE(std::isfinite(found.branches[0].frequency(2)));
}

// A bearing that moves along the shaft changes the nodes of the mesh: 9 where it is at one,
// else 10.
TEST(ModesOver, FollowsModesThroughMeshesThatDiffer) {
  const Model model = flexible(1e6);
  const ModelAt at = [](double value) { return flexible(1e6, value); };
  const std::vector<double> values{0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1.0};
  const ModesOver found = modes_over(at, {}, values, 4);
  EXPECT_TRUE(found.gaps.empty());
  ASSERT_GE(found.branches.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(found.branches[i].frequency.allFinite()) << i;
  }
  const Modes last = complex_modes(Assembler(model.structure), model.speed, 6);
  for (std::size_t i = 0; i < 4; ++i) {
    double nearest = INFINITY;
    for (const Mode& mode : last.oscillatory) {
      nearest = std::min(nearest, std::abs(mode.frequency() - found.branches[i].frequency(6)));
    }
    EXPECT_EQ(nearest, 0.0) << i;
  }
}

// A mass on a spring: omega = sqrt(k / m), undamped; damped sqrt(k / m - (c / 2m)^2)
TEST(CriticalOver, StiffnessMovesThatOfAMassOnASpring) {
  constexpr double solves = 1e-9;
  const ModelAt at = [](double stiffness) { return jeffcott(test::isotropic(stiffness, c)); };
  const std::vector<double> values{1e4, 2e4, 4e4, 8e4};
  const CriticalOver found = critical_over(at, {}, values, {.count = 2});
  ASSERT_EQ(found.branches.size(), 2u);
  for (const CriticalOverBranch& branch : found.branches) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double exact = std::sqrt(values[i] / m);
      EXPECT_NEAR(branch.speed(static_cast<Eigen::Index>(i)), exact, solves * exact);
      EXPECT_NEAR(branch.damped_speed(static_cast<Eigen::Index>(i)),
                  std::sqrt(values[i] / m - c * c / (4.0 * m * m)), solves * exact);
    }
  }
}

TEST(CriticalOver, OneValueIsThatModel) {
  const Model model = flexible(1e6);
  const CriticalOver found = critical_over(on_bearings, {}, {1e6}, {.count = 3});
  const auto criticals = critical_speeds(Assembler(model.structure), {.count = 3});
  ASSERT_EQ(found.branches.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.branches[i].speed(0), criticals[i].speed, 1e-9 * criticals[i].speed);
    EXPECT_NEAR(found.branches[i].damped_speed(0), criticals[i].damped_speed,
                1e-9 * criticals[i].speed);
  }
}

// What unbalance says of each model by itself.
TEST(UnbalanceOver, IsThatOfEveryModel) {
  const std::vector<double> values{5e5, 1e6};
  const std::vector<double> speeds{0.0, 600.0};
  const UnbalanceOver found =
      unbalance_over(on_bearings, {}, values,
                     {.speeds = [&](const Model&) { return speeds; }, .stations = "disk"});
  ASSERT_EQ(found.stations.size(), 1u);
  ASSERT_EQ(found.probes.size(), 1u);
  std::size_t peaks = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Model model = on_bearings(values[i]);
    const Assembler assembler(model.structure);
    const UnbalanceStudy study = unbalance_study(
        model, assembler, {.speeds = speeds, .stations = select_points(model, assembler, "disk")});
    EXPECT_EQ(found.stations[0].largest(row), study.largest[0].amplitude);
    EXPECT_EQ(found.stations[0].largest_speed(row), study.largest[0].speed);
    EXPECT_EQ(found.probes[0].largest(row), study.probes[0].largest.peak_to_peak());
    for (const StationPeak& peak : study.peaks) {
      EXPECT_EQ(found.peaks.at(peaks).value, values[i]);
      EXPECT_EQ(found.peaks.at(peaks++).speed, peak.speed);
    }
    const UnbalanceResponse there = unbalance_response(
        assembler, {model.speed}, {select_points(model, assembler, "disk")[0].point});
    EXPECT_EQ(found.stations[0].at_operation(row), Orbit(there.x(0, 0), there.y(0, 0)).major());
  }
  EXPECT_EQ(peaks, found.peaks.size());
}

// A value between the ends that makes no model, or none that can be computed, is left out and told.
TEST(UnbalanceOver, AValueThatCannotBeComputedIsAGap) {
  const ModelAt at = [](double value) {
    if (value == 2.0) throw ModelError({}, "", "no such model");
    return jeffcott(test::isotropic(k, c));
  };
  const UnbalanceOver found = unbalance_over(at, {}, {1.0, 2.0, 3.0},
                                             {.speeds =
                                                  [](const Model&) {
                                                    return std::vector<double>{0.0, 200.0};
                                                  },
                                              .stations = ""});
  ASSERT_EQ(found.gaps.size(), 1u);
  EXPECT_EQ(found.gaps[0].value, 2.0);
  EXPECT_NE(found.gaps[0].why.find("no such model"), std::string::npos);
  EXPECT_TRUE(std::isnan(found.stations[0].largest(1)));
  EXPECT_TRUE(std::isfinite(found.stations[0].largest(2)));
}

}  // namespace whirl::over_test
