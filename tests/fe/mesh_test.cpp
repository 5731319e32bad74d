// Nodes, their numbers, and the places that stations name.

#include "libfe/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/rotors.hpp"

namespace whirl::mesh_test {

using test::at;
using test::node;

constexpr double rounding = 1e-12;  // [m]; sums of a few lengths

Structure two_segments() {
  return {.shaft = {test::cylinder(0.2, 0.02, 2), test::cylinder(0.6, 0.03, 3)}};
}

void expect_positions(const Mesh& mesh, const std::vector<double>& z) {
  ASSERT_EQ(mesh.z.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i) EXPECT_NEAR(mesh.z[i], z[i], rounding) << "node " << i;
}

/// What a wrong structure says; fails if it says nothing.
ModelError error_of(const Structure& s) {
  try {
    const Mesh mesh = make_mesh(s);
    for (const Station* station : all_stations(s)) resolve(*station, s, mesh);
  } catch (const ModelError& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return ModelError({}, "", "");
}

// ---- numbers ------------------------------------------------------------------------------------

TEST(Mesh, GivenElementsAreEqualAndNumberedLeftToRight) {
  expect_positions(make_mesh(two_segments()), {0.0, 0.1, 0.2, 0.4, 0.6, 0.8});
}

TEST(Mesh, StationsBetweenNodesGetLaterNumbers) {
  Structure s = two_segments();
  s.disks.push_back({.at = at(0.5)});
  s.bearings.push_back(test::rigid(at(0.05)));
  const Mesh mesh = make_mesh(s);
  expect_positions(mesh, {0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.05, 0.5});
  EXPECT_EQ(mesh.left_to_right, (std::vector<int>{0, 6, 1, 2, 3, 7, 4, 5}));
  EXPECT_EQ(resolve(at(0.5), s, mesh), (Point{Point::Kind::node, 7}));
  EXPECT_EQ(resolve(node(4), s, mesh), (Point{Point::Kind::node, 3}));
}

TEST(Mesh, StationsAtNodesAddNone) {
  Structure s = two_segments();
  s.stations = {at(0.0), at(0.1), at(0.4), at(0.8), node(3)};
  const Mesh mesh = make_mesh(s);
  EXPECT_EQ(mesh.nodes(), 6);
  EXPECT_EQ(resolve(at(0.4), s, mesh), (Point{Point::Kind::node, 3}));
  EXPECT_EQ(resolve(at(0.8), s, mesh), (Point{Point::Kind::node, 5}));
}

// 0.1 + 0.2 is not 0.3: places that differ by less than 1e-9 of the length are one.
TEST(Mesh, PositionsThatDifferByRoundingAreOneNode) {
  Structure s{.shaft = {test::cylinder(1.0, 0.02, 0)}};
  s.stations = {at(0.1 + 0.2), at(0.3), at(1.0 + 1e-12)};
  const Mesh mesh = make_mesh(s);
  EXPECT_EQ(resolve(s.stations[0], s, mesh), resolve(s.stations[1], s, mesh));
  EXPECT_EQ(std::count_if(mesh.z.begin(), mesh.z.end(),
                          [](double z) { return std::abs(z - 0.3) < 1e-6; }),
            1);
}

// Two places are taken for a slip of the pen below 1e-5 of the length, for two places above it.
TEST(Mesh, PlacesThatAreTooCloseBeginAtAHundredThousandth) {
  Structure s{.shaft = {test::cylinder(1.0, 0.02, 0)}};
  s.stations = {at(0.3), at(0.3 + 0.9e-5)};
  EXPECT_NE(std::string(error_of(s).what()).find("the same place with different numbers"),
            std::string::npos);
  s.stations = {at(0.3), at(0.3 + 1.1e-5)};
  const Mesh mesh = make_mesh(s);
  EXPECT_FALSE(resolve(s.stations[0], s, mesh) == resolve(s.stations[1], s, mesh));
}

// The middles of elements lay beyond the last segment, and its neighbor in memory was read.
TEST(Mesh, SegmentsMustBePartsOfTheirShaft) {
  for (const double length : {1e308, 1e12}) {
    const Structure s{.shaft = {test::cylinder(length, 0.02, 0), test::cylinder(0.6, 0.02, 0)}};
    const ModelError error = error_of(s);
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].key, "shaft.2");
    EXPECT_NE(error.problems()[0].message.find("too different in length"), std::string::npos);
  }
  const Structure endless{
      .shaft = {test::cylinder(1e308, 0.02, 0), test::cylinder(1e308, 0.02, 0)}};
  EXPECT_EQ(error_of(endless).problems().size(), 2u);
  EXPECT_EQ(error_of({.shaft = {test::cylinder(1.0, 0.02, 2'000'000'000)}}).problems()[0].message,
            "more than 100000 elements in all");
}

// ---- elements -----------------------------------------------------------------------------------

TEST(Mesh, ElementsLieBetweenNeighborsAndKnowTheirPartOfTheSegment) {
  Structure s = two_segments();
  s.stations = {at(0.05), at(0.5)};
  const Mesh mesh = make_mesh(s);
  ASSERT_EQ(mesh.elements.size(), 7u);
  double reached = 0.0;
  for (const MeshElement& e : mesh.elements) {
    EXPECT_NEAR(mesh.z[e.left], reached, rounding);
    const double start = e.segment == 0 ? 0.0 : 0.2, L = e.segment == 0 ? 0.2 : 0.6;
    EXPECT_NEAR(start + e.from * L, mesh.z[e.left], rounding);
    EXPECT_NEAR(start + e.to * L, mesh.z[e.right], rounding);
    reached = mesh.z[e.right];
  }
  EXPECT_NEAR(reached, 0.8, rounding);
}

TEST(Mesh, RefinementKeepsPositions) {
  Structure s = two_segments();
  s.stations = {at(0.05), at(0.5), at(0.77)};
  const Mesh coarse = make_mesh(s);
  for (Segment& segment : s.shaft) segment.elements *= 3;
  const Mesh fine = make_mesh(s);
  for (const double z : coarse.z) {
    EXPECT_TRUE(std::any_of(fine.z.begin(), fine.z.end(), [&](double other) {
      return std::abs(other - z) < rounding;
    })) << z;
  }
}

TEST(Mesh, AnUndividedSegmentIsDividedAtItsStationsAndNumberedLeftToRight) {
  Structure s{.shaft = {test::cylinder(1.0, 0.3, 0)}};
  s.stations = {at(0.7), at(0.1)};
  const Mesh mesh = make_mesh(s);
  EXPECT_TRUE(std::is_sorted(mesh.z.begin(), mesh.z.end()));
  EXPECT_EQ(mesh.left_to_right[2], 2);
  EXPECT_NEAR(mesh.z[static_cast<std::size_t>(resolve(at(0.1), s, mesh).index)], 0.1, rounding);
  EXPECT_NEAR(mesh.z[static_cast<std::size_t>(resolve(at(0.7), s, mesh).index)], 0.7, rounding);
}

// No element is longer than the diameter, or than a 24th of the shaft where that is more.
TEST(Mesh, AnUndividedSegmentIsDividedFinelyEnough) {
  for (const double diameter : {0.01, 0.05, 0.4}) {
    const Mesh mesh = make_mesh({.shaft = {test::cylinder(1.0, diameter, 0)}});
    const double h = 1.0 / static_cast<double>(mesh.elements.size());
    EXPECT_LE(h, std::max(diameter, 1.0 / 24.0) + rounding);
    EXPECT_GT(2.0 * h, std::max(diameter, 1.0 / 24.0));  // and not much more finely
  }
}

// A massless cylinder is exact with one element between stations.
TEST(Mesh, AnUndividedMasslessCylinderHasOneElementBetweenStations) {
  Structure s{.shaft = {test::massless_cylinder(1.0, 0.02, 0)}};
  s.stations = {at(0.4)};
  expect_positions(make_mesh(s), {0.0, 0.4, 1.0});
}

TEST(Mesh, AModelWithoutShaftHasNoNodes) {
  const Structure s{.bodies = {{.name = "mass", .m = 1.0}}};
  EXPECT_EQ(make_mesh(s).nodes(), 0);
  EXPECT_EQ(resolve(test::body("mass"), s, make_mesh(s)), (Point{Point::Kind::body, 0}));
  EXPECT_EQ(resolve(test::ground(), s, make_mesh(s)).kind, Point::Kind::ground);
}

TEST(Mesh, StationsComeInTheOrderDisksBearingsLinksUnbalancesOthers) {
  Structure s = two_segments();
  s.stations = {at(0.6)};
  s.unbalances = {{.at = at(0.5)}};
  s.links = {test::connect(at(0.3), at(0.4), test::isotropic(1.0))};
  s.bearings = {test::rigid(at(0.2))};
  s.disks = {{.at = at(0.1)}};
  std::vector<double> order;
  for (const Station* station : all_stations(s)) {
    if (station->kind == Station::Kind::position) order.push_back(station->z);
  }
  EXPECT_EQ(order, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
}

// Diameters are linear along a cone; a step has the larger of its two; off the shaft there is none.
TEST(ShaftDiameter, IsThatOfTheSegmentAndTheLargerOneAtAStep) {
  const Structure s{.shaft = {test::cone(0.4, 0.02, 0.06, 2), test::cylinder(0.6, 0.05, 2)}};
  const Mesh mesh = make_mesh(s);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.0), 0.02, rounding);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.1), 0.03, rounding);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.4), 0.06, rounding);
  EXPECT_NEAR(shaft_diameter(s, mesh, 0.7), 0.05, rounding);
  EXPECT_NEAR(shaft_diameter(s, mesh, 1.0), 0.05, rounding);
  EXPECT_EQ(shaft_diameter(s, mesh, 1.1), 0.0);
}

// ---- wrong models -------------------------------------------------------------------------------

TEST(Mesh, EveryStationOffTheShaftIsReportedWithItsPlaceAndLength) {
  Structure s = two_segments();
  s.stations = {at(0.9), at(0.4), at(-0.1)};
  s.stations[0].where = {.file = "rotor.toml", .line = 12, .column = 6};
  s.stations[0].key = "probe.first.at";
  const ModelError error = error_of(s);
  ASSERT_EQ(error.problems().size(), 2u);
  EXPECT_EQ(describe(error.problems()[0]),
            "rotor.toml:12:6: probe.first.at: 900 mm is off the shaft; "
            "the shaft reaches from 0 to 800 mm");
  EXPECT_NE(error.problems()[1].message.find("-100 mm"), std::string::npos);
}

TEST(Mesh, APositionNeedsAShaft) {
  const ModelError error =
      error_of({.bodies = {{.name = "mass", .m = 1.0}}, .stations = {at(0.1)}});
  EXPECT_NE(std::string(error.what()).find("no shaft"), std::string::npos);
}

TEST(Mesh, TheSamePlaceWithDifferentNumbersIsASlip) {
  Structure s = two_segments();
  for (const double apart : {1e-6, 1e-8}) {  // of 0.8 m: between 1e-9 and 1e-5 of the length
    s.stations = {at(0.3), at(0.3 + apart)};
    const ModelError error = error_of(s);
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_NE(error.problems()[0].message.find("same place"), std::string::npos);
  }
}

// An element of a millionth of the shaft would leave nothing of the others' stiffness.
TEST(Mesh, AStationBesideANodeIsASlipToo) {
  for (const double z : {0.2 - 1e-6, 0.4 + 1e-6, 1e-6}) {  // a border, a node inside, an end
    Structure s = two_segments();
    s.stations = {at(z)};
    EXPECT_NE(std::string(error_of(s).what()).find("same place"), std::string::npos) << z;
  }
}

TEST(Mesh, UnknownNodesAndBodiesAreNamed) {
  Structure s = two_segments();
  s.stations = {node(7)};
  EXPECT_NE(std::string(error_of(s).what()).find("found node 7, expected a node from 1 to 6"),
            std::string::npos);
  s.stations = {node(0)};
  EXPECT_NE(std::string(error_of(s).what()).find("found node 0"), std::string::npos);
  s.stations = {test::body("stator")};
  EXPECT_NE(std::string(error_of(s).what()).find("\"stator\""), std::string::npos);
}

}  // namespace whirl::mesh_test
