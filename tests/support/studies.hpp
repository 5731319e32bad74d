#pragma once
/// Small studies of the rotor in its stator, and whether two found the same.

#include <gtest/gtest.h>

#include <cstring>

#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/sweep.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::test {

/// The rotor in its stator, by its speed and the stiffness of the contact.
inline StudyModels rotor_stator() {
  return study_models([](std::span<const double> values) {
    RotorStator p;
    if (!values.empty()) p.Omega = values[0];
    if (values.size() > 1) p.kC = values[1];
    return p.model();
  });
}

inline const ClassifyOptions brief{
    .discard = 60, .revolutions = 20, .exponents = 20, .sections = 4};

inline MapOptions plane(int threads) {
  MapOptions options{.grid = {.axes = {{}, {50e6, 100e6, 150e6}}}, .classify = brief};
  for (int i = 0; i < 12; ++i) options.grid.axes[0].push_back(130.0 + i);
  options.threads = threads;
  return options;
}

inline SweepOptions along_speed(SweepStart start) {
  const RotorStator p;
  const Model model = p.model();
  SweepOptions options{.start = start, .classify = brief};
  for (int i = 0; i < 40; ++i) options.values.push_back(130.0 + 0.25 * i);
  options.portrait.stations = select_points(model, p.scene().assembler, "");
  options.portrait.spectrum_revolutions = 2;
  return options;
}

/// More than are computed in one piece by one thread.
inline BasinsOptions around_the_start() {
  return {.starts = 40, .size = 1.0, .classify = brief};
}

/// Bit by bit, NaN too.
inline void expect_same(double a, double b) {
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << a << " " << b;
}
template <class Numbers>
void expect_same(const Numbers& a, const Numbers& b) {
  ASSERT_EQ(a.size(), b.size());
  const auto bytes = static_cast<std::size_t>(a.size()) * sizeof(double);
  EXPECT_TRUE(bytes == 0 || std::memcmp(a.data(), b.data(), bytes) == 0);
}
inline void expect_same(const ClassifiedMotion& a, const ClassifiedMotion& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.is_proven, b.is_proven);
  EXPECT_EQ(a.transient, b.transient);
  EXPECT_EQ(a.revolutions, b.revolutions);
  EXPECT_EQ(a.settles_after, b.settles_after);
  expect_same(a.resolution, b.resolution);
  expect_same(a.section_dimension, b.section_dimension);
  expect_same(a.exponents, b.exponents);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    EXPECT_EQ(a.contacts[i].regime, b.contacts[i].regime);
    expect_same(a.contacts[i].duty, b.contacts[i].duty);
    expect_same(a.contacts[i].max_tangential, b.contacts[i].max_tangential);
  }
}
inline void expect_same(const SweepPoint& a, const SweepPoint& b) {
  expect_same(a.motion, b.motion);
  expect_same(a.end.displacement, b.end.displacement);
  expect_same(a.end.velocity, b.end.velocity);
  expect_same(a.portrait.poincare_x, b.portrait.poincare_x);
  expect_same(a.portrait.spectrum, b.portrait.spectrum);
  expect_same(a.portrait.contact_angle, b.portrait.contact_angle);
}
inline void expect_same(const BasinsPoint& a, const BasinsPoint& b) {
  expect_same(a.motion, b.motion);
  expect_same(a.start.displacement, b.start.displacement);
  expect_same(a.sections, b.sections);
}
template <class Row>
void expect_same_points(const PointRows<Row>& a, const PointRows<Row>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(a[i] && b[i]) << i;
    expect_same(*a[i], *b[i]);
  }
}

}  // namespace whirl::test
