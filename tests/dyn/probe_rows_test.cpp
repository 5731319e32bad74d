// What probes read of reduced coordinates, row by row, and their labels.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/scene.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::probe_rows_test {

using test::pi;

constexpr double rounding = 1e-13;

/// A rotor that tilts, with a probe across it and one along it.
Model tilting() {
  Model m;
  m.speed = 100.0;
  m.has_speed = true;
  m.structure = test::cantilever(test::cylinder(0.2, 0.02, 2));
  m.structure.disks = {{.name = "disk", .at = test::node(3), .m = 2.0, .Id = 1e-3, .Ip = 2e-3}};
  m.structure.probes = {
      {.name = "across", .at = test::node(2), .angle = 0.7},
      {.name = "along", .at = test::node(3), .angle = 2.0, .face_radius = 0.05, .unit = "mil"}};
  return m;
}

// x cos a + y sin a across, r (theta_x sin a - theta_y cos a) along the shaft, of any motion.
TEST(ProbeRows, ReadDisplacementsAndTilts) {
  const Scene scene = make_scene(tilting());
  const Mat map = scene.displacement_map();
  const Mat rows = probe_rows(scene, map);
  ASSERT_EQ(rows.rows(), 2);
  ASSERT_EQ(rows.cols(), scene.contacts.coordinates());
  const Vec eta = Vec::LinSpaced(rows.cols(), -1e-4, 2e-4), full = map * eta;
  // nodes stand in the full vector one after the other: x, y, theta_x, theta_y
  const double size = full.cwiseAbs().maxCoeff();
  EXPECT_NEAR((rows * eta)(0), full(4) * std::cos(0.7) + full(5) * std::sin(0.7), rounding * size);
  EXPECT_NEAR((rows * eta)(1), 0.05 * (full(10) * std::sin(2.0) - full(11) * std::cos(2.0)),
              rounding * size);
  EXPECT_GT(std::abs((rows * eta)(1)), 0.0);
}

TEST(ProbeRows, AreThoseOfTheProbesThatAreGiven) {
  const Scene scene = make_scene(tilting());
  const Mat map = scene.displacement_map();
  EXPECT_EQ(probes_of(scene).size(), 2u);
  const std::vector<Probe> one{{.name = "x", .at = test::node(3)}};
  const Mat rows = probe_rows(one, scene, map);
  ASSERT_EQ(rows.rows(), 1);
  EXPECT_LT((rows.row(0) - map.row(8)).norm(), rounding * map.row(8).norm());
  EXPECT_EQ(probe_rows({}, scene, map).rows(), 0);
}

TEST(ProbeRows, AreRefusedWhereThereIsNothing) {
  const Scene scene = make_scene(tilting());
  const std::vector<Probe> nowhere{{.name = "x", .at = test::body("nobody")}};
  EXPECT_THROW(probe_rows(nowhere, scene, scene.displacement_map()), ModelError);
}

TEST(ProbeLabels, AreThoseOfTheProbes) {
  const std::vector<Probe> probes = tilting().structure.probes;
  const ProbeLabels labels(probes);
  ASSERT_EQ(labels.size(), 2u);
  const auto list = labels.list();
  ASSERT_EQ(list.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const ProbeLabel& label : {list[i], labels[i], ProbeLabel(probes[i])}) {
      EXPECT_EQ(label.name, probes[i].name);
      EXPECT_EQ(label.unit, probes[i].unit);
      EXPECT_EQ(label.angle, probes[i].angle);
      EXPECT_EQ(label.face_radius, probes[i].face_radius);
      EXPECT_NEAR(label.angle_deg(), probes[i].angle * 180.0 / pi, 1e-12);
      EXPECT_EQ(label.is_axial(), i == 1);
      EXPECT_EQ(label.radius_if_axial().has_value(), i == 1);
    }
  }
}

// Results of older files know less of their probes: they looked across the shaft, in um.
TEST(ProbeLabels, MayBeOfNamesAlone) {
  ProbeLabels labels;
  labels.names = {"a", "b"};
  labels.angles = {1.0};
  EXPECT_EQ(labels[0].angle, 1.0);
  EXPECT_EQ(labels[1].angle, 0.0);
  EXPECT_EQ(labels[1].unit, "um");
  EXPECT_FALSE(labels[1].is_axial());
  EXPECT_EQ(labels.list().size(), 2u);
}

}  // namespace whirl::probe_rows_test
