// What orbits do at stations, and the work of the unbalance: a circle in closed form.

#include "libdyn/orbits/orbit_measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/taylor/batch.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::orbit_measure_test {

// Off its stator the rotor turns in a circle of radius r = e W^2 / |w^2 - W^2 + 2 i d W| around its
// sag; a revolution takes the work 2 pi c W r^2 of its damper.
TEST(OrbitMeasure, GivesTheWorkOfACircle) {
  test::RotorStator p = test::P1;
  p.Omega = 110.0;
  const Scene scene = p.scene();
  const Flow flow = flow_of(scene.contacts);
  const PeriodicOrbit orbit = find_orbit(flow, Vec::Zero(8), {});
  ASSERT_TRUE(orbit.is_good()) << orbit.failure;
  const double r = p.e * p.mr * p.Omega * p.Omega /
                   std::abs(std::complex<double>(p.kr - p.mr * p.Omega * p.Omega, p.cr * p.Omega));
  const double work = 2.0 * std::numbers::pi * p.cr * p.Omega * r * r;
  const std::vector<Point> stations = {scene.assembler.point(test::body("rotor"))};
  for (const double revolutions : {1.0, 3.0}) {
    const OrbitMeasure found = measure_orbit(scene, stations, orbit.states[0], revolutions);
    EXPECT_NEAR(found.work, work, 1e-9 * work);
    EXPECT_NEAR(found.radii[0], r + p.mr * p.gravity / p.kr, 1e-3 * r);  // seen at some instants
  }
  // over parts of revolutions: of a circle without sag, whose power is constant
  p.gravity = 0.0;
  const Scene light = p.scene();
  const PeriodicOrbit around = find_orbit(flow_of(light.contacts), Vec::Zero(8), {});
  const OrbitMeasure part = measure_orbit(light, {}, around.states[0], 1.37);
  EXPECT_NEAR(part.work, work, 1e-9 * work);
  // the same as a series of one harmonic
  const Eigen::Index n = light.contacts.coordinates();
  Periodic series{.coefficients = Mat::Zero(n, 3), .rate = light.contacts.phase_rate()};
  series.coefficients.col(1) = around.states[0].head(n);
  series.coefficients.col(2) = around.states[0].tail(n) / series.rate;
  EXPECT_NEAR(measure_orbit(light, stations, series).work, work, 1e-9 * work);
}

}  // namespace whirl::orbit_measure_test
