// Steady motions averaged to one period, and the parameters that are found in it.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/random.hpp"
#include "libdata/fit/fit.hpp"
#include "libdata/fit/model_source.hpp"
#include "libdata/fit/steady_record.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::steady_fit_test {

using test::RotorStator;

constexpr double noise = 2e-5;  // [m]

/// A rotor in a stator whose displacements were measured.
struct Rig {
  RotorStator truth;
  int settled = 300, revolutions = 40;
  double per_revolution = 47.3;  // samples, which do not go evenly into a revolution
  std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(truth.scene());
  Mat rows = scene->displacement_map();
  MotionState start = begin();
  FitRecord exact = measured();

  MotionState begin() const {
    MotionState state = test::start_of(truth.model(), *scene);
    test::run(*scene, state, settled, {});
    return state;
  }
  std::vector<double> times(double most) const {
    std::vector<double> all;
    for (int i = 0; i < most * per_revolution; ++i) {
      all.push_back(scene->contacts.period() * i / per_revolution);
    }
    return all;
  }
  FitRecord measured() const {
    const std::vector<double> at = times(revolutions);
    const MotionSlopes motion = motion_slopes(scene->contacts, start, at, {}, {.by_start = false});
    return {.name = "rig",
            .times = Vec::Map(at.data(), std::ssize(at)),
            .readings = rows * motion.states.topRows(rows.cols()),
            .noise = Vec::Constant(rows.rows(), noise),
            .phase = start.phase};
  }
  FitRecord record(unsigned seed) const {
    FitRecord noisy = exact;
    std::mt19937_64 random(seed);
    for (double& reading : noisy.readings.reshaped()) reading += noise * random_normal(random);
    return noisy;
  }
  std::vector<FreeParameter> free(double share) const {
    return {{.path = "stiffness", .start = share * truth.kC, .size = truth.kC},
            {.path = "friction", .start = share * truth.mu, .size = truth.mu},
            {.path = "clearance", .start = share * truth.gap, .size = truth.gap}};
  }
  Vec values() const { return Vec{{truth.kC, truth.mu, truth.gap}}; }
  FitSource source(FitRecord record, const std::vector<FreeParameter>& parameters) const {
    return model_source(std::move(record), scene, rows, parameters,
                        [rotor = truth](const Vec& values) {
                          RotorStator other = rotor;
                          other.kC = values(0);
                          other.mu = values(1);
                          other.gap = values(2);
                          return other.model();
                        });
  }
  /// What is told at most by a motion that repeats after some revolutions: its start follows from
  /// the parameters, y0_p = (I - Phi)^-1 psi.
  Vec least_deviations(int period) const {
    const FitSystem system = source(exact, free(1.0)).system_at(values());
    std::vector<double> at = times(period);
    at.push_back(period * scene->contacts.period());
    const MotionSlopes motion = motion_slopes(system.system, start, at, system.slopes);
    const Eigen::Index n = rows.cols();
    const Mat open = Mat::Identity(2 * n, 2 * n) - motion.by_start.back();
    const Mat by_parameter = DenseLu<Mat>(open).solve(motion.by_parameter.back());
    Mat information = Mat::Zero(3, 3);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const Mat by = rows * (motion.by_start[i] * by_parameter + motion.by_parameter[i]).topRows(n);
      information += by.transpose() * by;
    }
    information *= revolutions * per_revolution / double(at.size() - 1) / (noise * noise);
    return DenseLu<Mat>(information).solve(Mat::Identity(3, 3)).diagonal().cwiseSqrt();
  }
};

constexpr double chance = 4.0;  // standard deviations, beyond which it leaves one in 16 000

// Two impacts a revolution, and seven in each of two that differ.
const RotorStator once = test::P2, twice{.Omega = 138.4, .kC = 64e6, .mu = 0.12};

std::string refusal(const FitRecord& record, double speed, const SteadyOptions& options = {}) {
  try {
    steady_record(record, speed, options);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

/// Readings of a signal of the rotor's angle, a revolution a second.
template <class Signal>
FitRecord sampled(const Signal& signal, int samples, double per_revolution, double deviation) {
  std::mt19937_64 random(1);
  FitRecord record{.name = "signal",
                   .times = Vec(samples),
                   .readings = Mat(1, samples),
                   .noise = Vec::Constant(1, deviation),
                   .phase = 0.3};
  for (int i = 0; i < samples; ++i) {
    record.times(i) = 5.0 + i / per_revolution;
    record.readings(0, i) = signal(turn * i / per_revolution) + deviation * random_normal(random);
  }
  return record;
}

double harmonics_of(double angle) {  // [m]
  return 1e-3 * (0.2 + std::cos(angle) + 0.3 * std::sin(2.0 * angle) - 0.1 * std::cos(4.0 * angle));
}
double kinks_of(double angle) {
  return 1e-3 * std::abs(std::cos(angle + 0.2));
}

/// Readings of one probe in a period, less what they should be.
template <class Signal>
Vec errors(const FitRecord& period, const Signal& signal) {
  Vec off = period.readings.row(0);
  for (Eigen::Index i = 0; i < off.size(); ++i) off(i) -= signal(turn * (period.times(i) - 5.0));
  return off;
}

// Errors of readings are as large as is told, whatever the samples' angles are.
TEST(SteadyRecord, HasTheErrorsThatItTells) {
  for (const double per_revolution : {32.0, 32.37, 61.9}) {
    const int periods = 50;
    const auto samples = static_cast<int>(periods * per_revolution);
    const auto found = steady_record(sampled(harmonics_of, samples, per_revolution, noise), turn);
    EXPECT_EQ(found.periods, periods);
    const FitRecord& period = found.period;
    EXPECT_EQ(period.period, 1);
    ASSERT_EQ(period.times.size(), static_cast<int>(per_revolution + 0.01));
    const auto count = static_cast<double>(period.times.size());
    const double expected = noise * std::sqrt(count / (periods * per_revolution));
    EXPECT_NEAR(period.noise(0), expected,
                chance * expected / std::sqrt(2.0 * (periods - 1) * count));
    EXPECT_NEAR((errors(period, harmonics_of) / period.noise(0)).squaredNorm() / count, 1.0,
                chance * std::sqrt(2.0 / count));
    EXPECT_NEAR(period.phase, 0.3 + turn * (period.times(0) - 5.0), 1e-12);
  }
}

// Bins smear what is curved in them. Harmonics up to an eighth of the bins are put right, others
// smeared by k^2 pi^2 / (6 bins^2); where samples go evenly into the revolution nothing is.
TEST(SteadyRecord, HasNoBiasButOfHighHarmonics) {
  constexpr double little = 1e-9;  // noise [m], so that the bias is seen
  constexpr int samples = 6000;
  const auto worst = [&](const auto& signal, double per_revolution) {
    const FitRecord record = sampled(signal, samples, per_revolution, little);
    return errors(steady_record(record, turn).period, signal).cwiseAbs().maxCoeff();
  };
  const double error = little / std::sqrt(samples / 60.0);
  EXPECT_LT(worst(harmonics_of, 60.37), 5.0 * error);
  EXPECT_LT(worst(kinks_of, 60.0), 5.0 * error);
  const double high = std::pow(10.0 * 0.5 * turn / 60.0, 2) / 6.0;
  const auto tenth = [](double angle) { return 1e-5 * std::cos(10.0 * angle); };
  FitRecord record = sampled(tenth, samples, 60.37, little);
  record.noise(0) = 1e-5;  // the scatter within a bin is not that of the motion
  const double smeared = errors(steady_record(record, turn).period, tenth).cwiseAbs().maxCoeff();
  EXPECT_NEAR(smeared, 1e-5 * high, 0.1 * 1e-5 * high);
}

TEST(SteadyRecord, LeavesMissingSamplesOut) {
  FitRecord record = sampled(harmonics_of, 3200, 32.0, noise);
  record.readings.middleCols(40, 100).setConstant(std::nan(""));
  const FitRecord period = steady_record(record, turn).period;
  ASSERT_EQ(period.times.size(), 32);
  EXPECT_LT(errors(period, harmonics_of).cwiseAbs().maxCoeff(), chance * noise / 10.0);
}

TEST(SteadyRecord, RefusesWhatIsNotSteady) {
  const auto drifting = [](double angle) { return harmonics_of(angle) + 2e-8 * angle; };
  EXPECT_NE(refusal(sampled(drifting, 3200, 32.0, noise), turn).find("two halves"),
            std::string::npos);
  const auto settling = [](double angle) {
    return harmonics_of(angle) + 1e-3 * std::exp(-0.01 * angle) * std::cos(0.71 * angle);
  };
  EXPECT_NE(refusal(sampled(settling, 3200, 32.0, noise), turn).find("times its noise"),
            std::string::npos);
  // twice the period, by less than the noise
  const auto doubled = [](double angle) {
    return harmonics_of(angle) + 1e-5 * std::cos(1.5 * angle);
  };
  const FitRecord record = sampled(doubled, 3200, 32.0, noise);
  const std::string message = refusal(record, turn);
  EXPECT_NE(message.find("every second period differ by"), std::string::npos) << message;
  EXPECT_NE(message.find("it repeats after 2 revolutions"), std::string::npos) << message;
  EXPECT_EQ(refusal(record, turn, {.revolutions = 2}), "");
  // a speed that is one in a thousand off
  EXPECT_NE(refusal(record, 1.001 * turn, {.revolutions = 2}), "");
}

TEST(SteadyRecord, RefusesWhatCannotBeAveraged) {
  const FitRecord record = sampled(harmonics_of, 320, 32.0, noise);
  EXPECT_NE(refusal(record, turn, {.revolutions = 3}).find("lasts 3.33 periods"),
            std::string::npos);
  EXPECT_NE(refusal(record, turn, {.readings = 40}).find("too few for 40"), std::string::npos);
  EXPECT_NE(refusal(record, 10.0 * turn).find("3.2 samples"), std::string::npos);
  EXPECT_NE(refusal(record, 0.0).find("at rest"), std::string::npos);
  FitRecord dead = record;
  dead.readings.setConstant(std::nan(""));
  EXPECT_NE(refusal(dead, turn).find("no readings of probe 1"), std::string::npos);
}

// An offset that wanders is taken off where it is unknown, and nothing of the motion with it.
TEST(SteadyRecord, FollowsAnOffsetThatWanders) {
  const auto wandering = [](double angle) { return harmonics_of(angle) + 1e-7 * angle; };
  FitRecord record = sampled(wandering, 3237, 32.37, noise);
  EXPECT_NE(refusal(record, turn), "");
  record.is_offset_known = false;
  Vec off = errors(steady_record(record, turn).period, harmonics_of);
  EXPECT_NEAR(off.mean(), 1e-7 * 50.0 * turn, noise);
  off.array() -= off.mean();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), chance * noise / 10.0);
}

/// Fits to several records of a motion that repeats after some revolutions.
void expect_least_errors(const Rig& rig, int period) {
  const Vec least = rig.least_deviations(period);
  const auto free = rig.free(0.8);
  constexpr int seeds = 8;
  Vec mean = Vec::Zero(3);  // deviation that is told, over the least
  double squares = 0.0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const auto steady = steady_record(rig.record(seed), rig.truth.Omega, {.revolutions = period});
    const Fit found = fit({rig.source(steady.period, free)}, free);
    ASSERT_TRUE(found.has_converged) << found.why_not;
    for (Eigen::Index p = 0; p < 3; ++p) {
      const FittedParameter& parameter = found.parameters[static_cast<std::size_t>(p)];
      const double error = (parameter.value - rig.values()(p)) / parameter.standard_deviation;
      EXPECT_LT(std::abs(error), chance) << parameter.path;
      squares += error * error;
      mean(p) += parameter.standard_deviation / least(p) / seeds;
    }
  }
  EXPECT_NEAR(squares / (3.0 * seeds), 1.0, chance * std::sqrt(2.0 / (3.0 * seeds)));
  // the noise is known from its scatter, to one in a hundred; near a period doubling the deviation
  // is a sixth more or less according to the stiffness that is found
  for (const double ratio : mean) EXPECT_NEAR(ratio, 1.0, 0.05);
}

// As sure as the motion lets a fit be that knows it to be periodic, and errors are so large.
TEST(SteadyFit, IsAsSureAsThePeriodicMotionLetsItBe) {
  expect_least_errors({.truth = once}, 1);
}
TEST(SteadyFit, IsAsSureOfTwiceThePeriod) {
  expect_least_errors({.truth = twice, .settled = 2000}, 2);
}

// Gaps of probes add constants that nobody knows; parameters are found all the same.
TEST(SteadyFit, FindsOffsets) {
  const Rig rig{.truth = once};
  const Vec offset{{1e-3, -2e-3, 5e-4, 0.0}};
  FitRecord record = rig.record(1);
  record.readings.colwise() += offset;
  record.is_offset_known = false;
  const FitRecord steady = steady_record(record, once.Omega).period;
  const auto free = rig.free(0.9);
  const Fit found = fit({rig.source(steady, free)}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  const FitResidual& left = found.records[0];
  for (Eigen::Index probe = 0; probe < 4; ++probe) {
    EXPECT_NEAR(left.offset(probe), offset(probe), chance * left.offset_deviation(probe));
    EXPECT_LT(left.offset_deviation(probe), noise);
  }
  const Vec least = rig.least_deviations(1);
  for (Eigen::Index p = 0; p < 3; ++p) {
    const FittedParameter& parameter = found.parameters[static_cast<std::size_t>(p)];
    EXPECT_NEAR(parameter.value, rig.values()(p), chance * parameter.standard_deviation);
    EXPECT_GT(parameter.standard_deviation, 0.95 * least(p));
  }
}

// Without weight a permanent rub is a circle: it says how hard the ring pushes and rubs, not how
// much of that is stiffness and how much clearance.
TEST(SteadyFit, SaysWhatAFullRubCannotTell) {
  const Rig rig{.truth = {.Omega = 151.0, .kC = 50e6, .mu = 0.05, .gravity = 0.0}};
  const auto free = rig.free(1.0);
  const FitRecord steady = steady_record(rig.record(1), rig.truth.Omega).period;
  const Fit found = fit({rig.source(steady, free)}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  EXPECT_FALSE(found.parameters[0].is_told);
  EXPECT_FALSE(found.parameters[2].is_told);
  EXPECT_GT(std::abs(found.correlation(0, 2)), 0.999999);
  const FittedParameter& friction = found.parameters[1];
  EXPECT_TRUE(friction.is_told);
  EXPECT_LT(friction.standard_deviation, 0.002 * rig.truth.mu);
  EXPECT_NEAR(friction.value, rig.truth.mu, chance * friction.standard_deviation);
}

TEST(SteadyFit, RefusesRecordsThatAreNotAPeriod) {
  const Rig rig{.truth = once};
  const auto free = rig.free(1.0);
  FitRecord record = rig.record(1);
  record.period = 1;
  EXPECT_THROW(fit({rig.source(record, free)}, free), ModelError);
}

}  // namespace whirl::steady_fit_test
