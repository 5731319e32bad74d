// Second derivatives of motions: slopes of deviations, against differences of exact tangents, in
// quadruple precision unless that takes seconds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/bladed_disk.hpp"
#include "tests/support/oil_films.hpp"
#include "tests/support/overhung_disk.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::deviation_slopes_test {

using test::RotorStator;

constexpr double nine_digits = 1e-9, eight_digits = 1e-8;  ///< relative errors of slopes
constexpr double fine = 0x1p-18, coarse = 0x1p-14;         ///< steps of differences of order eight

struct Case {
  std::string name;
  std::function<Model(double)> at;  ///< the model at a value of its parameter
  double value = 1.0;
  int settle = 50;      ///< revolutions before
  bool is_quad = true;  ///< whether differences are of quadruple precision, or of a larger step
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

/// Two deviations, and a direction of the start, that have something of every state.
Mat deviations_of(const Vec& scale) {
  Mat v(scale.size(), 2);
  for (int i = 0; i < v.rows(); ++i) v.row(i) << std::sin(1.0 + 2.0 * i), std::cos(3.0 * i);
  return scale.asDiagonal() * v;
}
Vec direction_of(const Vec& scale) {
  return scale.cwiseProduct(Vec::LinSpaced(scale.size(), 0.2, 4.0).array().sin().matrix());
}

/// The tangent of a revolution times deviations.
Mat carried(const ContactSystem& system, const MotionState& start, const Mat& deviations,
            bool is_quad) {
  Trajectory t{.system = &system, .state = start, .revolutions = 1};
  if (is_quad) {
    integrate_quad(t, {.tolerance = 1e-19, .order = 22, .tangent = true});
  } else {
    integrate_single(t, {.tolerance = 1e-15, .tangent = true});
  }
  EXPECT_EQ(t.outcome, Outcome::reached_end) << t.failure;
  return t.tangent * deviations;
}

class DeviationSlopes : public ::testing::TestWithParam<Case> {};

TEST_P(DeviationSlopes, AreTheLimitOfDifferencesOfTangents) {
  const Case& c = GetParam();
  const Scene scene = make_scene(c.at(c.value));
  const ContactSystem& system = scene.contacts;
  MotionState start = test::start_of(c.at(c.value), scene);
  test::run(scene, start, c.settle, {.tolerance = 1e-12});
  const Vec& scale = system.state_scale();
  const Mat v = deviations_of(scale);
  const Vec along = direction_of(scale);

  const std::vector<SystemSlope> parameters{
      slope_of("p", scene, c.value, 0.0, [&](double p) { return c.at(p); })};
  const double end = system.period();
  const MotionSlopes found =
      motion_slopes(system, start, {{end}}, parameters,
                    {.tolerance = 1e-15, .held = HeldSample::phase, .deviations = v});
  ASSERT_EQ(found.outcome, Outcome::reached_end) << found.failure;
  ASSERT_EQ(found.deviations_by_start.size(), 2u);

  // the start and the parameter are moved together
  const double step = c.is_quad ? fine : coarse;
  Mat known = Mat::Zero(v.rows(), 2), told = known;
  for (std::size_t j = 0; j < neighbor_places.size(); ++j) {
    const double by = neighbor_places[j] * step;
    MotionState moved = start;
    moved.y += by * along;
    const Scene beside = make_scene(c.at(c.value * (1.0 + by)));
    known += neighbor_weights[j] / step * carried(beside.contacts, moved, v, c.is_quad);
  }
  for (int d = 0; d < 2; ++d) {
    const auto k = static_cast<std::size_t>(d);
    told.col(d) = found.deviations_by_start[k] * along + c.value * found.deviations_by_parameter[k];
  }
  const auto error = [&](const Mat& a, const Mat& b) {
    const Mat difference = scale.cwiseInverse().asDiagonal() * (a - b);
    return difference.norm() / (scale.cwiseInverse().asDiagonal() * b).norm();
  };
  EXPECT_LT(error(found.deviations, found.by_start[0] * v), nine_digits);
  EXPECT_LT(error(told, known), eight_digits);
}

/// A rotor in its stator, one number of which changes.
std::function<Model(double)> rotor(RotorStator r, double RotorStator::*number) {
  return [=](double p) mutable {
    r.*number = p;
    return r.model();
  };
}

RotorStator changed(RotorStator r, const std::function<void(RotorStator&)>& change) {
  change(r);
  return r;
}

const RotorStator damped = changed(test::P1, [](auto& r) { r.cC = 2e4; });
const RotorStator smoothed = changed(test::P1, [](auto& r) { r.slip_tolerance = 1.0; });
const RotorStator hertz = changed(test::P1, [](auto& r) { r.kH = 1.5e8; });
const RotorStator hunt = changed(hertz, [](auto& r) { r.alpha = 0.5; });
const RotorStator slipping{.Omega = 151.8462, .kC = 3.07445e6, .mu = 0.5, .R = 0.005};

Model at_a_stop(double k) {
  Model model = changed(damped, [&](auto& r) { r.kC = k; }).model();
  model.contacts[0].geometry = geometry::Stop{.angle = 2.2};
  return model;
}
/// A ring that gets more and more out of round.
Model in_an_ellipse(double aspect) {
  Model model = changed(smoothed, [](auto& r) { r.cC = 2e4; }).model();
  model.contacts[0].geometry = geometry::Ellipse{.angle = 0.4, .aspect = aspect};
  return model;
}
Model at_a_face(double speed) {
  Model m = test::overhung_disk_with_smooth_face();
  m.speed = speed;
  return m;
}
Model on_films(double viscosity) {
  return test::TwoDisksOnFilms{.viscosity = viscosity}.model();
}

INSTANTIATE_TEST_SUITE_P(
    Motions, DeviationSlopes,
    ::testing::Values(Case{"impacts_by_stiffness", rotor(test::P1, &RotorStator::kC), 150e6},
                      Case{"impacts_by_speed", rotor(test::P1, &RotorStator::Omega), 136.0},
                      Case{"impacts_by_clearance", rotor(test::P1, &RotorStator::gap), 6e-3},
                      Case{"permanent_contact_by_friction", rotor(test::P3, &RotorStator::mu),
                           0.05},
                      Case{"damped_impacts_by_damping", rotor(damped, &RotorStator::cC), 2e4},
                      Case{"damped_impacts_by_speed", rotor(damped, &RotorStator::Omega), 136.0},
                      Case{"smoothed_friction", rotor(smoothed, &RotorStator::mu), 0.1},
                      Case{"hertz", rotor(hertz, &RotorStator::kH), 1.5e8, 50, false},
                      Case{"damped_hertz", rotor(hunt, &RotorStator::alpha), 0.5, 50, false},
                      Case{"sticking_by_friction", rotor(slipping, &RotorStator::mu), 0.5, 10},
                      Case{"sticking_by_speed", rotor(slipping, &RotorStator::Omega), 151.8462, 10},
                      Case{"stop", at_a_stop, 150e6, 20}, Case{"ellipse", in_an_ellipse, 1.2, 20},
                      Case{"face", at_a_face, test::overhung_disk().speed, 20},
                      Case{"blades", test::bladed_disk, 450.0, 5, false},
                      Case{"films", on_films, 0.018, 20, false}),
    [](const auto& member) { return member.param.name; });

}  // namespace whirl::deviation_slopes_test
