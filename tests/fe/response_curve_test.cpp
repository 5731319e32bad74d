// The unbalance response as a curve: true peaks, whatever the speeds that were asked for.

#include "libfe/analyses/response_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libfe/analyses/critical.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::response_curve_test {

using test::at;

constexpr double refined = 1e-6;  // relative: what is promised of peaks and half-power points
constexpr double omega = 100.0, e = 1e-4, m = 2.0;

/// A mass on isotropic springs, w = Omega / omega: r = e w^2 / ((1 - w^2)^2 + (2 zeta w)^2)^(1/2).
Structure jeffcott(double zeta) {
  const Station rotor = test::body("rotor");
  return {.bodies = {{.name = "rotor", .m = m, .spins = true}},
          .bearings = {test::bearing(rotor,
                                     test::isotropic(m * omega * omega, 2.0 * zeta * m * omega))},
          .unbalances = {{.at = rotor, .moment = m * e}}};
}

ResponseCurve jeffcott_curve(double zeta, const std::vector<double>& speeds) {
  const Assembler assembler(jeffcott(zeta));
  return response_curve(assembler, speeds, {{Point::Kind::body, 0}});
}

// Highest at w = (1 - 2 zeta^2)^(-1/2) with e / (2 zeta (1 - zeta^2)^(1/2)); 0.707 of it where
// 1 / w^2 = 1 - 2 zeta^2 +- 2 zeta (1 - zeta^2)^(1/2). zeta = 1 / 350 has an amplification of 175.
// The width of the peak is a 30000th of the range for the sharpest; speeds that were asked for are
// two.
TEST(ResponseCurve, HasThePeaksOfAJeffcottRotorInClosedForm) {
  for (const double zeta : {1e-5, 1.0 / 350.0, 0.05, 0.2}) {
    const ResponseCurve curve = jeffcott_curve(zeta, {0.0, 300.0});
    ASSERT_EQ(curve.peaks.size(), 1u) << zeta;
    EXPECT_EQ(curve.failure, "");
    const ResponsePeak& peak = curve.peaks[0];
    const double root = std::sqrt(1.0 - zeta * zeta), middle = 1.0 - 2.0 * zeta * zeta;
    const double speed = omega / std::sqrt(middle);
    const double below = omega / std::sqrt(middle + 2.0 * zeta * root);
    const double above = omega / std::sqrt(middle - 2.0 * zeta * root);
    EXPECT_NEAR(peak.speed, speed, refined * speed) << zeta;
    EXPECT_NEAR(peak.amplitude, 0.5 * e / (zeta * root), refined * 0.5 * e / zeta) << zeta;
    EXPECT_NEAR(peak.below, below, refined * (above - below)) << zeta;
    EXPECT_NEAR(peak.above, above, refined * (above - below)) << zeta;
    const double sharpness = speed / (above - below);
    EXPECT_NEAR(peak.amplification(), sharpness, refined * sharpness) << zeta;
  }
}

// The speeds that were asked for and those of its own grid are often the same but for rounding.
TEST(ResponseCurve, HasNoSpeedTwice) {
  constexpr double last = 344.2449;
  const int steps = ResponseCurveOptions().steps;
  std::vector<double> speeds;
  for (int k = 0; k <= steps; ++k) speeds.push_back(k * (last / steps));
  const std::vector<double> found = jeffcott_curve(0.2, speeds).response.speeds;
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GT(found[i] - found[i - 1], 1e-12 * found[i]) << found[i];
  }
}

TEST(ResponseCurve, PeaksDoNotDependOnTheSpeedsThatWereAskedFor) {
  const auto steps = [](double step) {
    std::vector<double> speeds;
    for (double Omega = 0.0; Omega <= 300.0; Omega += step) speeds.push_back(Omega);
    return speeds;
  };
  const ResponsePeak fine = jeffcott_curve(1.0 / 350.0, steps(0.1)).peaks.at(0);
  const ResponsePeak coarse = jeffcott_curve(1.0 / 350.0, steps(20.0)).peaks.at(0);
  EXPECT_NEAR(coarse.speed, fine.speed, refined * fine.speed);
  EXPECT_NEAR(coarse.amplitude, fine.amplitude, refined * fine.amplitude);
  EXPECT_NEAR(coarse.amplification(), fine.amplification(), refined * fine.amplification());
}

TEST(ResponseCurve, KeepsTheSpeedsThatWereAskedForAndTurnsInSmallSteps) {
  const std::vector<double> asked{0.0, 33.3, 99.99, 300.0};
  const ResponseCurve curve = jeffcott_curve(1e-3, asked);
  const auto& speeds = curve.response.speeds;
  EXPECT_TRUE(std::is_sorted(speeds.begin(), speeds.end()));
  for (const double Omega : asked) {
    EXPECT_TRUE(std::binary_search(speeds.begin(), speeds.end(), Omega)) << Omega;
  }
  constexpr double step = 4.0 * std::numbers::pi / 180.0;
  for (Eigen::Index i = 2; i < curve.response.x.cols(); ++i) {
    EXPECT_LE(std::abs(std::arg(curve.response.x(0, i) / curve.response.x(0, i - 1))),
              1.0001 * step);
  }
  EXPECT_LT(speeds.size(),
            400u);  // 45 steps of phase, 100 across, and what leads from these to those
}

// The response at the speeds of the curve is that of unbalance_response.
TEST(ResponseCurve, IsTheResponse) {
  const Assembler assembler(jeffcott(0.02));
  const std::vector<Point> points{{Point::Kind::body, 0}};
  const ResponseCurve curve = response_curve(assembler, {10.0, 200.0}, points);
  const UnbalanceResponse exact = unbalance_response(assembler, curve.response.speeds, points);
  EXPECT_EQ(curve.response.x, exact.x);
  EXPECT_EQ(curve.response.y, exact.y);
}

// Without damping r grows beyond all bounds at omega: no peak, and no speed beside it.
TEST(ResponseCurve, TellsOfAnUnboundedResponse) {
  const ResponseCurve curve = jeffcott_curve(0.0, {0.0, 300.0});
  EXPECT_TRUE(curve.peaks.empty());
  ASSERT_EQ(curve.unbounded.size(), 1u);
  EXPECT_NEAR(curve.unbounded[0], omega, refined * omega);
  const double largest = curve.response.x.cwiseAbs().maxCoeff();
  EXPECT_LT(largest, 1e4 * e);
}

// A shaft on bearings: peaks are where the damped modes are, resonances of all of them between the
// speeds; those of isotropic bearings are forward, since unbalance does not move backward modes.
TEST(ResponseCurve, FindsEveryNarrowPeakOfAShaft) {
  Structure s = test::two_disk(test::isotropic(1e6, 20.0));
  s.unbalances = {{.at = at(0.5), .moment = 1e-4}, {.at = at(1.0), .moment = 2e-4, .phase = 1.0}};
  const Assembler assembler(s);
  std::vector<Point> points;
  for (int i = 0; i < assembler.mesh().nodes(); ++i) points.push_back({Point::Kind::node, i});
  const double last = 1000.0;
  const ResponseCurve curve = response_curve(assembler, {0.0, last}, points);
  std::vector<double> forward;
  for (const Critical& c : critical_speeds(assembler, {.count = 12})) {
    if (c.whirl == Whirl::forward && c.damped_speed < last) forward.push_back(c.damped_speed);
  }
  ASSERT_GE(forward.size(), 2u);
  ASSERT_EQ(curve.peaks.size(), forward.size());
  for (std::size_t i = 0; i < forward.size(); ++i) {
    const ResponsePeak& peak = curve.peaks[i];
    EXPECT_NEAR(peak.speed, forward[i], 0.5 * (peak.above - peak.below));
  }
}

}  // namespace whirl::response_curve_test
