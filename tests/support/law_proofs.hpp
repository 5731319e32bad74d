#pragma once
// What every law of a contact or film has to show through its events: accuracy, orders of
// tolerance, equal bits in a batch, tangents.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libdyn/methods/methods.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// A stretch of motion.
struct Stretch {
  const Scene& scene;
  MotionState start;
  long revolutions;
  long least_events;  ///< that it must have, or it proves nothing
};

/// Its end in quadruple precision.
inline Vec exact_end(const Stretch& s, double tolerance) {
  Trajectory exact{.system = &s.scene.contacts, .state = s.start, .revolutions = s.revolutions};
  integrate_quad(exact, {.tolerance = tolerance});
  EXPECT_EQ(exact.outcome, Outcome::reached_end) << exact.failure;
  EXPECT_GE(exact.cost.events, s.least_events);
  return exact.state.y;
}

/// Its end by the engine alone.
inline Trajectory end_of(const Stretch& s, const MotionState& from, const BatchOptions& options) {
  Trajectory t{.system = &s.scene.contacts, .state = from, .revolutions = s.revolutions};
  integrate_single(t, options);
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return t;
}

/// A method, with _ for - as in names of tests, at a tolerance of 1e-11 against an exact end.
inline void expect_end_by(std::string method, const Stretch& s, const Vec& exact, double accuracy) {
  std::replace(method.begin(), method.end(), '_', '-');
  MotionState state = s.start;
  const Integration run = test::run(s.scene, state, s.revolutions,
                                    {.tolerance = 1e-11, .method = method_named(method)});
  ASSERT_EQ(run.outcome, Outcome::reached_end) << run.failure;
  EXPECT_LT(distance(s.scene.contacts, state.y, exact), accuracy) << method;
}

/// The error of the engine stays below a thousand tolerances, from 1e-7 to 1e-13.
inline void expect_error_follows_tolerance(const Stretch& s, const Vec& exact) {
  for (const double tolerance : {1e-7, 1e-9, 1e-11, 1e-13}) {
    const Trajectory t = end_of(s, s.start, {.tolerance = tolerance});
    EXPECT_GE(t.cost.events, s.least_events);
    EXPECT_LT(distance(s.scene.contacts, t.state.y, exact), 1e3 * tolerance) << tolerance;
  }
}

/// Motions that differ in everything but their shape, of five to eleven revolutions, end in a batch
/// as each alone, bit by bit: states, contact measures, tangents.
inline void expect_same_alone(const std::vector<Scene>& scenes,
                              const std::vector<MotionState>& starts, double tolerance,
                              long least_events) {
  std::vector<Trajectory> batch;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    batch.push_back({.system = &scenes[i].contacts,
                     .state = starts[i],
                     .revolutions = 5 + static_cast<long>(i % 7)});
  }
  std::vector<Trajectory> alone = batch;
  for (const bool tangent : {false, true}) {
    const BatchOptions options{
        .tolerance = tolerance, .threads = 2, .measures = true, .tangent = tangent};
    integrate_batch(batch, options);
    long events = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      integrate_single(alone[i], options);
      EXPECT_EQ(batch[i].state.y, alone[i].state.y) << i;
      for (std::size_t c = 0; c < alone[i].contacts.size(); ++c) {
        EXPECT_EQ(batch[i].contacts[c].in_touch, alone[i].contacts[c].in_touch) << i;
        EXPECT_EQ(batch[i].contacts[c].max_normal, alone[i].contacts[c].max_normal) << i;
      }
      if (tangent) {
        EXPECT_EQ(batch[i].tangent, alone[i].tangent) << i;
      }
      events += batch[i].cost.events;
    }
    EXPECT_GE(events, least_events);
  }
}

/// The tangent of a stretch is that of central differences, to a share of its columns (or of 1).
/// @param h  of a scale
inline void expect_tangent_of_differences(const Stretch& s, double accuracy, double h = 1e-7) {
  const Trajectory t = end_of(s, s.start, {.tolerance = 1e-13, .tangent = true});
  EXPECT_GE(t.cost.events, s.least_events);
  const Vec& scale = s.scene.contacts.state_scale();
  for (int i = 0; i < s.scene.contacts.size(); ++i) {
    MotionState up = s.start, down = s.start;
    up.y(i) += h * scale(i);
    down.y(i) -= h * scale(i);
    const Vec change =
        end_of(s, up, {.tolerance = 1e-14}).state.y - end_of(s, down, {.tolerance = 1e-14}).state.y;
    const Vec column = (t.tangent.col(i) * scale(i)).cwiseQuotient(scale);
    const Vec left = (change / (2.0 * h)).cwiseQuotient(scale) - column;
    EXPECT_LT(left.cwiseAbs().maxCoeff(), accuracy * std::max(1.0, column.norm())) << i;
  }
}

/// The tangent's determinant is what the divergence of the flow says.
inline void expect_divergence(const Stretch& s) {
  const Trajectory t = end_of(s, s.start, {.tolerance = 1e-13, .tangent = true});
  const Vec& scale = s.scene.contacts.state_scale();
  const Mat scaled = scale.asDiagonal().inverse() * t.tangent * scale.asDiagonal();
  const double growth = std::log(std::abs(scaled.determinant()));
  const double time = static_cast<double>(s.revolutions) * s.scene.contacts.period();
  EXPECT_NEAR(t.divergence * time, growth, 1e-7 * std::abs(growth));
}

}  // namespace whirl::test
