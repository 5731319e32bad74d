// Modes from responses to random forces: chains and rotors whose modes are known, with noise of
// sensors and harmonics of the speed.

#include "libdata/measured/running_modes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libdata/measured/speed_harmonics.hpp"
#include "libfe/analyses/modes.hpp"
#include "tests/support/random_response.hpp"

namespace whirl::running_modes_test {

constexpr double pi = std::numbers::pi;
constexpr double hertz = 2.0 * pi;

// Five masses m = 25.91 kg, springs k = 10 000 N/m, damping ratio 2 %, two hours at 16 samples per
// second with sensor noise of 5 %: closed form sqrt(k / m) / pi sin((2 j - 1) pi / 22).
class ChainOfFive : public testing::TestWithParam<unsigned> {};

TEST_P(ChainOfFive, IsFound) {
  constexpr double expected[] = {0.88995, 2.59776, 4.09510, 5.26069, 6.00009};  // [Hz]
  constexpr double frequency_error = 0.005, damping_error = 0.2;
  const double zeta = 0.02, spacing = 1.0 / 16.0;
  const auto chain = test::mass_chain(5, 25.91, 1e4, zeta);
  std::mt19937_64 random(GetParam());
  const Mat record = test::with_noise(
      test::random_response(chain.M, chain.C, chain.K, spacing, 2 * 3600 * 16, random), 0.05,
      random);
  const RunningModes found = running_modes(record, spacing, {});
  ASSERT_EQ(found.modes.size(), 5u);
  for (std::size_t j = 0; j < 5; ++j) {
    const RunningMode& mode = found.modes[j];
    EXPECT_NEAR(std::abs(mode.lambda) / hertz, expected[j], frequency_error * expected[j]);
    EXPECT_NEAR(mode.damping_ratio(), zeta, damping_error * zeta);
    EXPECT_GT(channel_mac(mode.shape, chain.shapes.col(static_cast<Eigen::Index>(j))), 0.99);
    EXPECT_NEAR(mode.shape.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    EXPECT_LT(std::abs(mode.frequency() / hertz - expected[j]),
              5.0 * mode.frequency_deviation / hertz);
    if (j == 4) continue;
    // the other method agrees where modes stand well above the noise
    const DecomposedMode* peak = found.peak_of(mode);
    ASSERT_NE(peak, nullptr) << j;
    EXPECT_NEAR(peak->frequency() / hertz, expected[j], 0.005 * expected[j]);
    EXPECT_NEAR(peak->damping_ratio(), zeta, 0.3 * zeta);
    EXPECT_GT(channel_mac(peak->shape, chain.shapes.col(static_cast<Eigen::Index>(j))), 0.95);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ChainOfFive, testing::Values(1u, 2u, 3u, 4u));

// The standard deviations told are those that results have from record to record.
TEST(RunningModes, KnowHowSureTheyAre) {
  const auto chain = test::mass_chain(2, 1.0, 400.0, 0.03);
  constexpr int records = 24;
  Mat frequency(records, 2), damping(records, 2), told(records, 2), told_damping(records, 2);
  for (int i = 0; i < records; ++i) {
    std::mt19937_64 random(static_cast<unsigned long>(100 + i));
    const Mat record = test::random_response(chain.M, chain.C, chain.K, 0.05, 24000, random);
    const RunningModes found = running_modes(test::with_noise(record, 0.05, random), 0.05,
                                             {.block_rows = 20, .most_order = 20});
    ASSERT_EQ(found.modes.size(), 2u);
    for (Eigen::Index j = 0; j < 2; ++j) {
      const RunningMode& mode = found.modes[static_cast<std::size_t>(j)];
      frequency(i, j) = mode.frequency();
      damping(i, j) = mode.damping_ratio();
      told(i, j) = mode.frequency_deviation;
      told_damping(i, j) = mode.damping_deviation;
    }
  }
  const auto deviation = [](const Mat& values) -> Eigen::RowVectorXd {
    return ((values.rowwise() - values.colwise().mean()).colwise().squaredNorm() / (records - 1))
        .cwiseSqrt();
  };
  // 24 records know their deviation to 15 % themselves
  for (Eigen::Index j = 0; j < 2; ++j) {
    EXPECT_NEAR(told.col(j).mean() / deviation(frequency)(j), 1.0, 0.4);
    EXPECT_NEAR(told_damping.col(j).mean() / deviation(damping)(j), 1.0, 0.4);
  }
}

/// An overhung disk on a shaft, (x, y, theta_x, theta_y), spinning.
struct Overhung {
  Mat M = Mat::Zero(4, 4), C = Mat::Zero(4, 4), K = Mat::Zero(4, 4);

  explicit Overhung(double Omega) {
    const double m = 4.0, Id = 0.02, Ip = 0.036, k = 6e5, kr = -5e4, kt = 7e3;
    M.diagonal() << m, m, Id, Id;
    K.diagonal() << k, 1.03 * k, kt, kt;
    K(0, 3) = K(3, 0) = kr;
    K(1, 2) = K(2, 1) = -kr;
    C = 3e-5 * K;
    C(2, 3) = Omega * Ip;
    C(3, 2) = -Omega * Ip;
  }

  /// Eigenvalues with Im > 0, ascending.
  std::vector<Complex> eigenvalues() const {
    Mat A = Mat::Zero(8, 8);
    A.topRightCorner(4, 4).setIdentity();
    A.bottomLeftCorner(4, 4) = -M.inverse() * K;
    A.bottomRightCorner(4, 4) = -M.inverse() * C;
    std::vector<Complex> found;
    for (const Complex lambda : base::eigenvalues(A)) {
      if (lambda.imag() > 0.0) found.push_back(lambda);
    }
    std::sort(found.begin(), found.end(), [](Complex a, Complex b) { return a.imag() < b.imag(); });
    return found;
  }
};

// Two probes at a spinning disk see its four modes, backward and forward in turn: shapes are
// complex, and their sense of whirl is that of the model.
TEST(RunningModes, TellForwardFromBackwardWhirl) {
  const Overhung rotor(900.0);
  const std::vector<Complex> expected = rotor.eigenvalues();
  ASSERT_EQ(expected.size(), 4u);
  std::mt19937_64 random(7);
  const double spacing = 1e-3;
  const Mat all = test::random_response(rotor.M, rotor.C, rotor.K, spacing, 120000, random);
  const Mat record = test::with_noise(all.leftCols(2), 0.02, random);
  const RunningModes found = running_modes(record, spacing, {.channels = {"x", "y"}});
  std::string list;
  for (const auto& m : found.modes) list += fmt::format(" {:.2f}", m.frequency() / hertz);
  ASSERT_EQ(found.modes.size(), 4u) << list;
  for (std::size_t j = 0; j < 4; ++j) {
    const RunningMode& mode = found.modes[j];
    EXPECT_NEAR(mode.frequency(), expected[j].imag(), 0.005 * expected[j].imag());
    const double zeta = -expected[j].real() / std::abs(expected[j]);
    EXPECT_NEAR(mode.damping_ratio(), zeta, 0.2 * zeta);
    const double kappa = Orbit(mode.shape(0), mode.shape(1)).kappa();
    if (j % 2 == 0) {
      EXPECT_LT(kappa, -0.5) << j;
    } else {
      EXPECT_GT(kappa, 0.5) << j;
    }
  }
}

/// Two oscillators across each other, seen by sensors at 45 degrees, with a harmonic of the speed.
struct TwoModes {
  double spacing = 0.02;
  Vec2 frequencies{6.0 * hertz, 6.06 * hertz};
  double zeta = 0.005;

  Mat record(int seed, Eigen::Index samples = 60000) const {
    std::mt19937_64 random(static_cast<unsigned long>(seed));
    const Mat K = frequencies.array().square().matrix().asDiagonal();
    const Mat C = (2.0 * zeta * frequencies).asDiagonal();
    Mat2 turn;
    turn << 1.0, 1.0, 1.0, -1.0;
    return test::with_noise(
        test::random_response(Mat2::Identity(), C, K, spacing, samples, random) * turn, 0.02,
        random);
  }
};

// Frequencies 1 % apart with damping ratios of 0.5 %, so that their peaks are one.
TEST(RunningModes, SeparateCloselySpacedModes) {
  const TwoModes two;
  const RunningModes found = running_modes(two.record(1), two.spacing, {});
  ASSERT_EQ(found.modes.size(), 2u);
  for (std::size_t j = 0; j < 2; ++j) {
    const double expected = two.frequencies(static_cast<Eigen::Index>(j));
    EXPECT_NEAR(found.modes[j].frequency(), expected, 0.002 * expected);
    EXPECT_NEAR(found.modes[j].damping_ratio(), two.zeta, 0.25 * two.zeta);
    EXPECT_NEAR(found.modes[j].shape(1).real() / found.modes[j].shape(0).real(),
                j == 0 ? 1.0 : -1.0, 0.15);
  }
}

/// A record of a mode at 6 Hz, another at 9 Hz, and 1X at 6.15 Hz and 2X as strong as these.
struct WithSpeed : TwoModes {
  WithSpeed() { frequencies = {6.0 * hertz, 9.0 * hertz}, zeta = 0.01; }
  double Omega = 6.15 * hertz;

  Mat turning(int seed) const {
    Mat y = record(seed);
    const double size = y.col(0).norm() / std::sqrt(static_cast<double>(y.rows()));
    for (Eigen::Index t = 0; t < y.rows(); ++t) {
      const double phase = Omega * spacing * static_cast<double>(t);
      y(t, 0) += size * (1.4 * std::cos(phase) + 0.5 * std::cos(2.0 * phase));
      y(t, 1) += size * (1.4 * std::sin(phase) + 0.2 * std::cos(2.0 * phase));
    }
    return y;
  }
};

TEST(RunningModes, DoNotTakeAHarmonicOfTheSpeedForAMode) {
  const WithSpeed rotor;
  const Mat record = rotor.turning(5);
  const auto is_right = [&](const RunningModes& found) {
    ASSERT_EQ(found.modes.size(), 2u);
    for (std::size_t j = 0; j < 2; ++j) {
      const double expected = rotor.frequencies(static_cast<Eigen::Index>(j));
      EXPECT_NEAR(found.modes[j].frequency(), expected, 0.005 * expected);
      EXPECT_NEAR(found.modes[j].damping_ratio(), rotor.zeta, 0.25 * rotor.zeta);
    }
  };
  const auto harmonics = [](const RunningModes& found, int number) {
    return std::count_if(found.poles.begin(), found.poles.end(),
                         [&](const OrderPole& p) { return p.harmonic == number; });
  };
  // not known to be a harmonic, it is a pole without damping of nearly all orders
  const auto lines = [&](const RunningModes& found) {
    return std::count_if(found.poles.begin(), found.poles.end(), [&](const OrderPole& p) {
      return std::abs(p.damping_ratio()) < 1e-3 &&
             std::abs(p.frequency() - rotor.Omega) < 0.001 * rotor.Omega;
    });
  };
  EXPECT_GT(lines(running_modes(record, rotor.spacing, {})), 20);
  {
    SCOPED_TRACE("removed, with a speed that is a little wrong");
    const RunningModes found = running_modes(record, rotor.spacing, {.speed = 1.002 * rotor.Omega});
    is_right(found);
    EXPECT_NEAR(found.speed, rotor.Omega, 1e-6 * rotor.Omega);
    EXPECT_TRUE(found.are_harmonics_removed);
    EXPECT_EQ(lines(found), 0);
  }
  {
    SCOPED_TRACE("marked");
    const RunningModes found =
        running_modes(record, rotor.spacing, {.speed = rotor.Omega, .removes_harmonics = false});
    is_right(found);
    EXPECT_GT(harmonics(found, 1), 20);
    EXPECT_GT(harmonics(found, 2), 10);
  }
}

// A mode at the very speed stays one: a line has no damping.
TEST(RunningModes, KeepAModeAtTheSpeed) {
  WithSpeed rotor;
  rotor.Omega = rotor.frequencies(0);
  const RunningModes found = running_modes(rotor.turning(6), rotor.spacing, {.speed = rotor.Omega});
  ASSERT_EQ(found.modes.size(), 2u);
  EXPECT_NEAR(found.modes[0].frequency(), rotor.Omega, 0.005 * rotor.Omega);
  EXPECT_NEAR(found.modes[0].damping_ratio(), rotor.zeta, 0.25 * rotor.zeta);
}

// Harmonics of a speed that changes go to rounding if the phase of the rotor is known, and nothing
// else does.
TEST(SpeedHarmonics, AreTakenOutByThePhase) {
  constexpr Eigen::Index n = 20000;
  const double spacing = 1e-3;
  Vec phase(n);
  Mat tones(n, 1), other(n, 1);
  for (Eigen::Index t = 0; t < n; ++t) {
    const double time = spacing * static_cast<double>(t);
    phase(t) = 160.0 * time + 4.0 * std::sin(0.7 * time);
    tones(t, 0) = 3.0 + 2.0 * std::cos(phase(t) + 0.4) + 0.3 * std::sin(3.0 * phase(t));
    other(t, 0) = std::sin(2.0 * pi * 17.3 * time);
  }
  EXPECT_LT(without_harmonics(tones, phase, 5).norm(), 1e-9);
  const Mat rest = without_harmonics(tones + other, phase, 5);
  EXPECT_LT((rest - other).norm(), 0.02 * other.norm());
  EXPECT_NEAR(mean_speed(phase, spacing), 160.0, 0.5);
}

// Thinning out a record for low frequencies leaves the low modes as they are.
TEST(RunningModes, ThinOutFastRecords) {
  WithSpeed two;
  two.spacing = 0.002;
  const RunningModes found =
      running_modes(two.record(8, 300000), two.spacing, {.most_frequency = 12.0 * hertz});
  EXPECT_NEAR(found.rate, 500.0 / 16.0, 1.0);
  ASSERT_EQ(found.modes.size(), 2u);
  EXPECT_NEAR(found.modes[0].frequency(), 6.0 * hertz, 0.005 * 6.0 * hertz);
  EXPECT_NEAR(found.modes[1].frequency(), 9.0 * hertz, 0.005 * 9.0 * hertz);
}

/// What an error says of a record; empty: there was none.
std::string problem_with(const Mat& record, double spacing, const RunningModesOptions& options) {
  try {
    running_modes(record, spacing, options);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(RunningModes, SayWhatIsWrongWithARecord) {
  const TwoModes two;
  const Mat good = two.record(1, 20000);
  const auto expect = [&](const std::string& said, const Mat& record,
                          const RunningModesOptions& options, double spacing = 0.02) {
    const std::string found = problem_with(record, spacing, options);
    EXPECT_NE(found.find(said), std::string::npos) << found;
  };
  EXPECT_EQ(problem_with(good, 0.02, {}), "");
  Mat holes = good;
  holes(700, 1) = std::nan("");
  holes(701, 1) = std::numeric_limits<double>::infinity();
  holes.col(0).setConstant(2.5);
  expect("seal x: is 2.5 all the time", holes, {.channels = {"seal x", "seal y"}});
  expect("seal y: 2 of 20000 samples are no number, the first is sample 701 at 14 s", holes,
         {.channels = {"seal x", "seal y"}});
  expect("the record is too short: 300 samples", good.topRows(300), {});
  expect("models of order 60 from 2 channels: 20 block rows allow 38 at most, 31 would do", good,
         {.block_rows = 20, .most_order = 60});
  expect("models up to order 2", good, {.most_order = 2});
  expect("3 names for 2 channels", good, {.channels = {"a", "b", "c"}});
  expect("known at 5 of 20000 samples", good, {.phase = Vec::Zero(5)});
  expect("the rotor does not turn", good, {.phase = Vec::Zero(20000)});
  expect("expected one above 0", good, {}, 0.0);
  expect("the record is empty", Mat(0, 2), {});
  expect("show those below 25 Hz only", good, {.most_frequency = 30.0 * hertz});
  expect("a share of 1.5", good, {.share = 1.5});
  expect("1 stretches, expected none (0) or 3", good, {.stretches = 1});
  Mat tones(20000, 1);
  for (Eigen::Index t = 0; t < tones.rows(); ++t)
    tones(t, 0) = std::cos(0.3 * static_cast<double>(t));
  expect("has nothing but harmonics of the speed", tones,
         {.phase = Vec::LinSpaced(20000, 0.0, 5999.7)});
}

}  // namespace whirl::running_modes_test
