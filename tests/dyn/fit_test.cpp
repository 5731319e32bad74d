// Parameters that are found in motions with noise, and how sure they are.

#include "libdata/fit/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/random.hpp"
#include "libdata/fit/fit_spread.hpp"
#include "libdata/fit/model_source.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::fit_test {

using test::RotorStator;

constexpr int per_revolution = 32;
constexpr double chance = 4.0;  // standard deviations, beyond which it leaves one in 16 000
constexpr double noise = 2e-5;  // [m], half a percent of the rotor's motion

/// A rotor in a stator, touched twice a revolution, whose displacements were measured.
struct Rig {
  RotorStator truth = test::P2;
  int revolutions = 8;
  std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(truth.scene());
  MotionState start = settled();
  Mat rows = scene->displacement_map();

  MotionState settled() const {
    MotionState state = test::start_of(truth.model(), *scene);
    test::run(*scene, state, 40, {});
    return state;
  }
  std::vector<double> times() const {
    std::vector<double> all;
    for (int i = 0; i <= revolutions * per_revolution; ++i) {
      all.push_back(scene->contacts.period() * i / per_revolution);
    }
    return all;
  }
  FitRecord record(unsigned seed) const {
    const std::vector<double> at = times();
    const MotionSlopes motion = motion_slopes(scene->contacts, start, at, {}, {.by_start = false});
    FitRecord record{.name = "rig",
                     .times = Vec::Map(at.data(), std::ssize(at)),
                     .readings = rows * motion.states.topRows(rows.cols()),
                     .noise = Vec::Constant(rows.rows(), noise),
                     .phase = start.phase};
    std::mt19937_64 random(seed);
    for (double& reading : record.readings.reshaped()) reading += noise * random_normal(random);
    return record;
  }
  /// Of stiffness and friction of the ring, in this order.
  static Model model(RotorStator rotor, const Vec& values) {
    rotor.kC = values(0);
    rotor.mu = values(1);
    return rotor.model();
  }
  std::vector<FreeParameter> free(double share) const {
    return {{.path = "stiffness", .start = share * truth.kC, .size = truth.kC},
            {.path = "friction", .start = share * truth.mu, .size = truth.mu}};
  }
  FitSource source(FitRecord record, const std::vector<FreeParameter>& parameters) const {
    return model_source(std::move(record), scene, rows, parameters,
                        [rotor = truth](const Vec& values) { return model(rotor, values); });
  }
};

TEST(Fit, FindsStiffnessAndFrictionInNoise) {
  const Rig rig;
  for (const double share : {0.6, 1.4}) {
    const auto free = rig.free(share);
    const Fit found = fit({rig.source(rig.record(1), free)}, free);
    ASSERT_TRUE(found.has_converged) << found.why_not;
    EXPECT_NEAR(found.residual, 1.0, 0.05);
    const double truth[]{rig.truth.kC, rig.truth.mu};
    for (std::size_t p = 0; p < 2; ++p) {
      const FittedParameter& parameter = found.parameters[p];
      EXPECT_NEAR(parameter.value, truth[p], chance * parameter.standard_deviation)
          << parameter.path;
      EXPECT_LT(parameter.standard_deviation, 0.02 * truth[p]) << parameter.path;
      EXPECT_TRUE(parameter.is_told);
      EXPECT_FALSE(parameter.is_at_bound);
    }
  }
}

// From a clearance that no window's motion reaches nothing of the contact is told, so that a search
// alone would stay where it is.
TEST(Fit, MovesAContactThatIsOutOfReach) {
  const Rig rig;
  const double truth = rig.truth.gap;
  const auto with_clearance = [rotor = rig.truth](const Vec& values) {
    RotorStator other = rotor;
    other.gap = values(0);
    return other.model();
  };
  for (const double share : {1.6, 2.4}) {
    const std::vector<FreeParameter> free{
        {.path = "clearance", .start = share * truth, .size = truth, .lower = 0.0}};
    const Fit found =
        fit({model_source(rig.record(8), rig.scene, rig.rows, free, with_clearance)}, free);
    ASSERT_TRUE(found.has_converged) << found.why_not;
    EXPECT_NEAR(found.parameters[0].value, truth, chance * found.parameters[0].standard_deviation);
    EXPECT_EQ(found.parameters[0].start, share * truth);
  }
}

/// The bound of Cramer and Rao for the parameters of a record: their part of the inverse of the
/// information that one motion through the whole record has of its start and of them.
Mat least_covariance(const FitSource& source, const Vec& parameters, const MotionState& start) {
  const FitSystem exact = source.system_at(parameters);
  const Vec& at = source.record.times;
  const std::vector<double> times(at.begin(), at.end());
  const MotionSlopes motion = motion_slopes(exact.system, start, times, exact.slopes);
  const Eigen::Index n = source.rows.cols(), all = 2 * n + parameters.size();
  Mat rows(source.rows.rows() * at.size(), all);
  for (std::size_t i = 0; i < times.size(); ++i) {
    Mat by(source.rows.rows(), all);
    by << source.rows * motion.by_start[i].topRows(n),
        source.rows * motion.by_parameter[i].topRows(n);
    rows.middleRows(static_cast<Eigen::Index>(i) * by.rows(), by.rows()) =
        source.record.noise.cwiseInverse().asDiagonal() * by;
  }
  const Vec per = rows.colwise().norm().cwiseInverse();
  rows = rows * per.asDiagonal();
  const Mat inverse = DenseLu<Mat>(rows.transpose() * rows).solve(Mat::Identity(all, all));
  return (per.asDiagonal() * inverse * per.asDiagonal())
      .bottomRightCorner(parameters.size(), parameters.size());
}

/// Compares what a fit says of its errors with that bound, to a share of it.
void expect_least_errors(const Fit& found, const Mat& bound, double share) {
  for (Eigen::Index p = 0; p < bound.rows(); ++p) {
    const FittedParameter& parameter = found.parameters[static_cast<std::size_t>(p)];
    const double least = std::sqrt(bound(p, p));
    EXPECT_NEAR(parameter.standard_deviation, least, share * least) << parameter.path;
    for (Eigen::Index q = 0; q < p; ++q) {
      EXPECT_NEAR(found.correlation(p, q), bound(p, q) / (least * std::sqrt(bound(q, q))), share)
          << parameter.path << ", " << found.parameters[static_cast<std::size_t>(q)].path;
    }
  }
}

// Windows that are tied together keep nothing back.
TEST(Fit, IsAsSureAsTheNoiseLetsItBe) {
  const Rig rig;
  const auto free = rig.free(1.0);
  const FitSource source = rig.source(rig.record(2), free);
  const Fit found = fit({source}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  expect_least_errors(found, least_covariance(source, Vec{{rig.truth.kC, rig.truth.mu}}, rig.start),
                      0.02);
}

// A rotor that bounces in its ring and never settles to a period: all revolutions together tell the
// ring's stiffness, and a gap of a hundredth of the noise between each two would keep a third of
// that back.
TEST(Fit, IsAsSureOfARotorThatBounces) {
  const test::TwoDiskRub truth{
      .k = 8e6,
      .mu = 0.01,
      .start = {{.mode = 1, .amplitude = 4e-3}, {.mode = 2, .amplitude = 3e-3}}};
  const auto with = [&](const Vec& values) {
    Model model = truth.model();
    std::get<Radial<>>(model.contacts[0].law).k = values(0);
    model.contacts[0].clearance = values(1);
    return model;
  };
  const Vec ring{{4e6, 5e-3}};
  const auto scene = std::make_shared<const Scene>(make_scene(with(ring)));
  MotionState start = test::start_of(truth.model(), *scene);
  test::run(*scene, start, 300, {});
  std::vector<double> times;
  for (int i = 0; i <= 10 * per_revolution; ++i) {
    times.push_back(scene->contacts.period() * i / per_revolution);
  }
  const Mat rows = scene->displacement_map();
  const MotionSlopes motion = motion_slopes(scene->contacts, start, times, {}, {.by_start = false});
  FitRecord record{.name = "rig",
                   .times = Vec::Map(times.data(), std::ssize(times)),
                   .readings = rows * motion.states.topRows(rows.cols()),
                   .noise = Vec::Constant(rows.rows(), noise),
                   .phase = start.phase};
  std::mt19937_64 random(1);
  for (double& reading : record.readings.reshaped()) reading += noise * random_normal(random);
  const std::vector<FreeParameter> free{{.path = "stiffness", .start = 4e6, .size = 4e6},
                                        {.path = "clearance", .start = 5e-3, .size = 5e-3}};
  const FitSource source = model_source(record, scene, rows, free, with);
  const Fit found = fit({source}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  EXPECT_LT(found.over_least_deviation, 1.02);
  expect_least_errors(found, least_covariance(source, ring, start), 0.05);
}

TEST(Fit, LeavesMissingSamplesOut) {
  const Rig rig;
  const auto free = rig.free(0.8);
  FitRecord record = rig.record(3);
  record.readings.middleCols(20, 30).setConstant(std::nan(""));
  record.readings(1, 100) = std::nan("");
  const Fit found = fit({rig.source(record, free)}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  EXPECT_EQ(found.readings, 4 * (8 * per_revolution + 1) - 4 * 30 - 1);
  EXPECT_NEAR(found.parameters[1].value, rig.truth.mu,
              chance * found.parameters[1].standard_deviation);
}

// Two records of one rotor tell more than each of them.
TEST(Fit, TakesSeveralRecords) {
  const Rig rig;
  const auto free = rig.free(0.9);
  const Fit one = fit({rig.source(rig.record(4), free)}, free);
  const Fit both = fit({rig.source(rig.record(4), free), rig.source(rig.record(5), free)}, free);
  ASSERT_TRUE(one.has_converged && both.has_converged);
  ASSERT_EQ(both.records.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(both.parameters[p].standard_deviation,
                one.parameters[p].standard_deviation / std::sqrt(2.0),
                0.05 * one.parameters[p].standard_deviation);
  }
}

// Gaps of probes add constants that nobody knows.
TEST(Fit, FindsOffsets) {
  const Rig rig;
  const auto free = rig.free(0.9);
  FitRecord record = rig.record(10);
  const Vec offset{{1e-3, -2e-3, 5e-4, 0.0}};
  record.readings.colwise() += offset;
  record.is_offset_known = false;
  const Fit found = fit({rig.source(record, free)}, free);
  ASSERT_TRUE(found.has_converged) << found.why_not;
  const FitResidual& left = found.records[0];
  EXPECT_NEAR(left.of_probe.norm(), 2.0 * noise, 0.1 * noise);
  for (Eigen::Index probe = 0; probe < offset.size(); ++probe) {
    EXPECT_NEAR(left.offset(probe), offset(probe), chance * left.offset_deviation(probe));
    EXPECT_LT(left.offset_deviation(probe), noise);
  }
  EXPECT_NEAR(found.parameters[0].value, rig.truth.kC,
              chance * found.parameters[0].standard_deviation);
}

// Of e_i = phi e_(i-1) + noise the integrated autocorrelation is (1 + phi) / (1 - phi).
TEST(FitSpread, CountsSamplesThatHangTogether) {
  for (const double phi : {0.0, 0.5, 0.8}) {
    std::mt19937_64 random(3);
    Vec e(40'000);
    double last = 0.0;
    for (double& value : e) value = last = phi * last + random_normal(random);
    const double time = (1.0 + phi) / (1.0 - phi);
    EXPECT_NEAR(correlation_time(e), time, 0.15 * time) << phi;
  }
  EXPECT_EQ(correlation_time(Vec(Vec::Ones(100))), 1.0);
}

TEST(Fit, SaysWhereAParameterIsHeldByItsBound) {
  Rig rig;
  rig.revolutions = 3;
  auto free = rig.free(0.8);
  free[1].upper = 0.9 * rig.truth.mu;
  const Fit found = fit({rig.source(rig.record(6), free)}, free);
  EXPECT_TRUE(found.parameters[1].is_at_bound);
  EXPECT_DOUBLE_EQ(found.parameters[1].value, free[1].upper);
  EXPECT_TRUE(std::isnan(found.parameters[1].standard_deviation));
  EXPECT_FALSE(found.parameters[0].is_at_bound);
  EXPECT_TRUE(std::isfinite(found.parameters[0].standard_deviation));
}

// Another mass is not what stiffness and friction make up for.
TEST(Fit, SaysThatAModelDoesNotExplainARecord) {
  Rig rig;
  const FitRecord record = rig.record(7);
  rig.truth.ms *= 1.5;
  rig.scene = std::make_shared<const Scene>(rig.truth.scene());
  const auto free = rig.free(1.0);
  const Fit found = fit({rig.source(record, free)}, free);
  EXPECT_FALSE(found.has_converged);
  EXPECT_GT(found.residual, 1.5);
  EXPECT_FALSE(found.why_not.empty());
}

TEST(Fit, SaysThatItWasStopped) {
  Rig rig;
  rig.revolutions = 3;
  const auto free = rig.free(0.8);
  int asked = 0;
  const Fit found = fit({rig.source(rig.record(6), free)}, free,
                        {.is_stopped = [&asked] { return ++asked > 12; }});
  EXPECT_FALSE(found.has_converged);
  EXPECT_TRUE(std::regex_match(found.why_not, std::regex("it was stopped after \\d+ iterations")))
      << found.why_not;
}

// A ring that is never touched says nothing of its friction.
TEST(Fit, SaysWhatARecordCannotTell) {
  Rig rig;
  rig.truth.gap = 1.0;
  rig.scene = std::make_shared<const Scene>(rig.truth.scene());
  rig.start = rig.settled();
  const auto free = rig.free(1.0);
  const Fit found = fit({rig.source(rig.record(8), free)}, free);
  for (const FittedParameter& parameter : found.parameters) {
    EXPECT_FALSE(parameter.is_told);
    EXPECT_GT(parameter.standard_deviation, 1e3 * parameter.value);
  }
}

TEST(Fit, RefusesWhatCannotBeFitted) {
  const Rig rig;
  const auto free = rig.free(1.0);
  const auto problem = [&](FitRecord record, std::vector<FreeParameter> parameters) -> std::string {
    try {
      fit({rig.source(std::move(record), free)}, parameters);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  FitRecord record = rig.record(9);
  auto outside = free;
  outside[0].lower = 2.0 * outside[0].start;
  EXPECT_NE(problem(record, outside).find("outside of"), std::string::npos);
  auto zero = free;
  zero[1].size = 0.0;
  EXPECT_NE(problem(record, zero).find("needs bounds"), std::string::npos);
  record.noise(0) = 0.0;
  EXPECT_NE(problem(record, free).find("noise of every probe"), std::string::npos);
  record.noise(0) = noise;
  record.readings.setConstant(std::nan(""));
  EXPECT_NE(problem(record, free).find("no readings"), std::string::npos);
}

// The speed is what a record was measured at.
TEST(Fit, RefusesToFitTheSpeed) {
  const Rig rig;
  const std::vector<FreeParameter> speed{
      {.path = "operation.speed", .start = rig.truth.Omega, .size = rig.truth.Omega}};
  EXPECT_THROW(model_source(rig.record(1), rig.scene, rig.rows, speed,
                            [rotor = rig.truth](const Vec& values) {
                              RotorStator other = rotor;
                              other.Omega = values(0);
                              return other.model();
                            }),
               ModelError);
}

}  // namespace whirl::fit_test
