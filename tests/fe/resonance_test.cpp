// Speeds at which two modes are in a ratio of small integers, seen from the rotor.

#include "libfe/analyses/resonance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/convergence.hpp"

namespace whirl::resonance_test {

/// A forward and a backward branch over evenly spaced speeds.
Campbell diagram(const std::function<double(double)>& forward,
                 const std::function<double(double)>& backward, double first, double last,
                 int steps) {
  Campbell d;
  d.branches = {{.whirl = Whirl::backward}, {.whirl = Whirl::forward}};
  for (int i = 0; i <= steps; ++i) {
    const double W = first + (last - first) * i / steps;
    d.speeds.push_back(W);
    d.branches[0].frequency.push_back(backward(W));
    d.branches[1].frequency.push_back(forward(W));
  }
  return d;
}

double hundred(double) {
  return 100.0;
}

// Without gyroscopics (W + w) : |W - w| = p : q at W = w (p + q) / (p - q), and as far below the
// critical speed, at W = w (p - q) / (p + q).
TEST(InternalResonance, ComesOutInClosedFormWithoutGyroscopics) {
  const auto found = internal_resonances(diagram(hundred, hundred, 10.0, 800.0, 79), 4);
  std::vector<double> expected;
  for (const auto& ratios : {std::pair{4, 3}, {3, 2}, {2, 1}, {3, 1}, {4, 1}}) {
    const int p = ratios.first, q = ratios.second;
    for (const double ratio : {double(p + q) / (p - q), double(p - q) / (p + q)}) {
      const double W = 100.0 * ratio;
      const auto at = std::find_if(found.begin(), found.end(), [&](const InternalResonance& r) {
        return r.p == p && r.q == q && std::abs(r.speed - W) < 1e-9 * W;
      });
      ASSERT_NE(at, found.end()) << p << ":" << q << " at " << W;
      EXPECT_EQ(at->fast, 0);
      EXPECT_EQ(at->slow, 1);
      EXPECT_NEAR(at->frequency * p, W + 100.0, 1e-6);
      expected.push_back(W);
    }
  }
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_TRUE(internal_resonances(diagram(hundred, hundred, 10.0, 800.0, 79), 1).empty());
}

// Between the speeds of the diagram branches are cubics: the error falls with the fourth power.
TEST(InternalResonance, IsInterpolatedByCubics) {
  const auto tilt = [](double sense) {
    return [sense](double W) { return 0.45 * sense * W + std::hypot(0.45 * W, 100.0); };
  };
  const auto speed = [&](int steps) {
    for (const auto& r :
         internal_resonances(diagram(tilt(0.5), tilt(-0.5), 20.0, 820.0, steps), 5)) {
      if (r.p == 5 && r.q == 1 && r.fast == 0 && r.speed > 200.0) return r.speed;
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<double> number, error;
  const double exact = speed(1 << 14);
  for (const int steps : {16, 32, 64, 128}) {
    number.push_back(steps);
    error.push_back(std::abs(speed(steps) - exact));
  }
  EXPECT_GT(test::order_of(number, error), 3.5) << testing::PrintToString(error);
}

// Where a branch does not oscillate there is nothing to be in resonance with.
TEST(InternalResonance, SkipsWhatDoesNotOscillate) {
  const auto gone = [](double) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_TRUE(internal_resonances(diagram(hundred, gone, 10.0, 800.0, 79), 4).empty());
}

}  // namespace whirl::resonance_test
