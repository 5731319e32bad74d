#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "libdyn/orbits/contact_flow.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// Columns of the flow over a revolution, by differences.
inline Mat tangent_by_differences(const Scene& scene, const Vec& y) {
  Mat columns(y.size(), y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double h = 1e-5 * scene.contacts.state_scale()(i);
    Vec ends[2];
    for (const int side : {0, 1}) {
      Vec at = y;
      at(i) += side == 0 ? h : -h;
      MotionState state = state_of(at);
      EXPECT_EQ(run(scene, state, 1, {.tolerance = 1e-14}).outcome, Outcome::reached_end);
      ends[side] = state.y;
    }
    columns.col(i) = (ends[0] - ends[1]) / (2.0 * h);
  }
  return columns;
}

/// The tangent of the flow over a revolution, in which the contact touches, is what differences
/// tend to.
inline void expect_tangent_of_differences(const Scene& scene, const Vec& y) {
  const Mat expected = tangent_by_differences(scene, y);
  const auto passages = flow_of(scene.contacts).go(std::vector{y}, 1, WithTangent::yes);
  ASSERT_FALSE(passages[0].failure) << passages[0].failure;
  ASSERT_GE(passages[0].contacts.at(0).impacts, 1.0);
  const Vec scale = scene.contacts.state_scale();
  const auto scaled = [&](const Mat& tangent) -> Mat {
    return scale.cwiseInverse().asDiagonal() * tangent * scale.asDiagonal();
  };
  EXPECT_LT(scaled(passages[0].tangent - expected).norm(), 1e-5 * scaled(expected).norm())
      << passages[0].tangent << "\n\n"
      << expected;
}

}  // namespace whirl::test
