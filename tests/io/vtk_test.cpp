// Series for ParaView: read back by VTK, with true displacements at true places.

#include "libio/export/vtk.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "libio/export/vtk_scene.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::vtk_test {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double single = 1e-6;  // relative; arrays are in single precision

class VtkSeries : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  /// Writes and reads back the file of one frame.
  vtkSmartPointer<vtkPolyData> written(const VtkScene& scene, const VtkFrame& frame,
                                       const VtkOptions& options = {}) const {
    return read(write_vtk_series(path, scene, {frame}, options).at(1));
  }

  static vtkSmartPointer<vtkPolyData> read(const fs::path& file) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_vtk_test_" + std::to_string(::getpid()));
  const fs::path path = folder / "run.pvd";
};

Vector3d point(vtkPolyData* data, vtkIdType i) {
  return Vector3d(data->GetPoint(i));
}

Vector3d vector(vtkPolyData* data, const char* name, vtkIdType i) {
  return Vector3d(data->GetPointData()->GetArray(name)->GetTuple3(i));
}

double number(vtkPolyData* data, const char* name) {
  return vtkDataArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name))->GetTuple1(0);
}

/// Cells of a part, in the order of the file.
std::vector<vtkIdType> cells(vtkPolyData* data, int part) {
  std::vector<vtkIdType> found;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    if (data->GetCellData()->GetArray("part")->GetTuple1(i) == part) found.push_back(i);
  }
  return found;
}

/// Points of a part's cells, each once.
std::vector<vtkIdType> points(vtkPolyData* data, int part) {
  std::vector<vtkIdType> found;
  for (const vtkIdType cell : cells(data, part)) {
    for (int i = 0; i < data->GetCell(cell)->GetNumberOfPoints(); ++i) {
      found.push_back(data->GetCell(cell)->GetPointId(i));
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Volume inside closed cells with outward normals: sum of a . (b x c) / 6 over triangles.
double volume(vtkPolyData* data, int part) {
  double sum = 0.0;
  for (const vtkIdType id : cells(data, part)) {
    vtkCell* cell = data->GetCell(id);
    const Vector3d a = point(data, cell->GetPointId(0));
    for (int i = 1; i + 1 < cell->GetNumberOfPoints(); ++i) {
      const Vector3d b = point(data, cell->GetPointId(i)), c = point(data, cell->GetPointId(i + 1));
      sum += a.dot(b.cross(c)) / 6.0;
    }
  }
  return sum;
}

/// Area of a regular polygon whose corners lie on a circle.
double polygon_area(int corners, double radius) {
  return 0.5 * corners * radius * radius * std::sin(2.0 * pi / corners);
}

/// Three nodes 0.5 m apart and a stator body (point 3) in the middle.
VtkScene example() {
  return {.z = {0.0, 0.5, 1.0, 0.5},
          .shaft = {{0, 1, 0.02, 0.02}, {1, 2, 0.02, 0.02}},
          .disks = {{"middle", 1, 0.1, 0.02, 0.04}},
          .stators = {{"seal", 3, 0.5, Vec2(1e-3, 0.0), 0.1, 5e-3, 0.02},
                      {"guard", -1, 0.9, Vec2::Zero(), 0.02, 1e-3, 0.01}},
          .contacts = {{"seal", 1}, {"guard", 2}}};
}

VtkFrame at_rest(const VtkScene& scene) {
  return {.motion = Mat::Zero(std::ssize(scene.z), 4),
          .forces = std::vector<VtkForce>(scene.contacts.size())};
}

TEST_F(VtkSeries, HasAllSurfacesAndArrays) {
  const VtkOptions options{.facets = 12, .sections = 3};
  const auto data = written(example(), at_rest(example()), options);
  // two pieces of 4 rings, a disk of 4 rings, two stators of 2 rings, two lines of 2 points
  EXPECT_EQ(data->GetNumberOfPoints(), (2 * 4 + 4 + 2 * 2) * 12 + 2 * 2);
  EXPECT_EQ(data->GetNumberOfLines(), 2);
  // the shaft is closed at its ends, not where its pieces meet
  EXPECT_EQ(cells(data, 0).size(), 2u * 3u * 12u + 2u);
  EXPECT_EQ(cells(data, 1).size(), 4u * 12u);
  EXPECT_EQ(cells(data, 2).size(), 2u * 12u);
  EXPECT_EQ(cells(data, 3).size(), 2u);

  for (const char* name :
       {"displacement [m]", "rotation [rad]", "undeformed position [m]", "contact force [N]"}) {
    ASSERT_NE(data->GetPointData()->GetArray(name), nullptr) << name;
    EXPECT_EQ(data->GetPointData()->GetArray(name)->GetNumberOfComponents(), 3);
  }
  for (const char* name : {"part", "member", "in touch"}) {
    ASSERT_NE(data->GetCellData()->GetArray(name), nullptr) << name;
  }
  auto* names =
      vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("stator names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(1), "guard");
}

// The clearance away from the rotor's surface, as wide as the rotor.
TEST_F(VtkSeries, AStopIsAPlateAcrossItsDirection) {
  VtkScene scene = example();
  const Vec2 n(0.6, 0.8), t(-0.8, 0.6);
  scene.stators[1].geometry = geometry::Stop{.angle = std::atan2(n(1), n(0))};
  const auto data = written(scene, at_rest(scene), {.deflection_scale = 1.0, .facets = 12});
  int corners = 0;
  for (const vtkIdType i : points(data, 2)) {
    const Vector3d p = point(data, i);
    if (p(2) < 0.8) continue;  // of the ring
    ++corners;
    EXPECT_NEAR(n.dot(p.head<2>()), 0.021, single);
    EXPECT_NEAR(std::abs(t.dot(p.head<2>())), 0.02, single);
    EXPECT_NEAR(std::abs(p(2) - 0.9), 0.005, single);
  }
  EXPECT_EQ(corners, 4);
}

TEST_F(VtkSeries, SurfacesAreClosedWithTheirTrueDiameters) {
  const VtkOptions options{.facets = 12};
  const auto data = written(example(), at_rest(example()), options);
  for (const vtkIdType i : points(data, 0)) {
    EXPECT_NEAR(point(data, i).head<2>().norm(), 0.02, single * 0.02);
  }
  EXPECT_NEAR(volume(data, 0), polygon_area(12, 0.02) * 1.0, 1e-5 * polygon_area(12, 0.02));
  const double ring = polygon_area(12, 0.1) - polygon_area(12, 0.02);
  EXPECT_NEAR(volume(data, 1), ring * 0.04, 1e-5 * ring * 0.04);
}

TEST_F(VtkSeries, StepsAndConesAndFullDisksAreClosed) {
  // frustum: h / 3 (A1 + A2 + sqrt(A1 A2))
  const VtkScene scene{.z = {0.0, 1.0, 2.0},
                       .shaft = {{0, 1, 0.1, 0.2}, {1, 2, 0.3, 0.3}},
                       .disks = {{"full", 2, 0.5, 0.0, 0.1}}};
  const auto data = written(scene, at_rest(scene), {.facets = 16});
  const double A1 = polygon_area(16, 0.1), A2 = polygon_area(16, 0.2);
  const double expected = (A1 + A2 + std::sqrt(A1 * A2)) / 3.0 + polygon_area(16, 0.3);
  EXPECT_NEAR(volume(data, 0), expected, 1e-5 * expected);
  EXPECT_NEAR(volume(data, 1), 0.1 * polygon_area(16, 0.5), 1e-6);
}

TEST_F(VtkSeries, DisplacementsAreTrueAndPositionsScaled) {
  const VtkScene scene = example();
  VtkFrame frame = at_rest(scene);
  frame.motion.row(1) << 2e-3, -1e-3, 4e-3, 3e-3;
  frame.motion.row(3) << 5e-4, 0.0, 0.0, 0.0;
  const auto data = written(scene, frame, {.deflection_scale = 20.0});
  EXPECT_EQ(number(data, "deflection scale"), 20.0);
  for (const int part : {0, 1}) {
    for (const vtkIdType i : points(data, part)) {
      const Vector3d warped =
          vector(data, "undeformed position [m]", i) + 20.0 * vector(data, "displacement [m]", i);
      EXPECT_LT((warped - point(data, i)).norm(), single);
    }
  }
  // u + theta x r, at every point of the disk
  const Vector3d u(2e-3, -1e-3, 0.0), theta(4e-3, 3e-3, 0.0), center(0.0, 0.0, 0.5);
  for (const vtkIdType i : points(data, 1)) {
    const Vector3d arm = vector(data, "undeformed position [m]", i) - center;
    const Vector3d expected = u + theta.cross(arm);
    EXPECT_LT((vector(data, "displacement [m]", i) - expected).norm(), single * 3e-3);
    EXPECT_LT((vector(data, "rotation [rad]", i) - theta).norm(), single * 5e-3);
  }
}

// theta_y turns z towards x: of a disk's rim the side at +x goes to -z, the right face to +x.
TEST_F(VtkSeries, DisksTiltRightHanded) {
  const VtkScene scene{.z = {0.0, 1.0}, .disks = {{"disk", 0, 0.1, 0.0, 0.02}}};
  VtkFrame frame = at_rest(scene);
  frame.motion(0, 3) = 0.01;
  const auto data = written(scene, frame, {.deflection_scale = 1.0, .facets = 4});
  for (const vtkIdType i : points(data, 1)) {
    const Vector3d rest = vector(data, "undeformed position [m]", i);
    const Vector3d moved = vector(data, "displacement [m]", i);
    EXPECT_NEAR(moved.x(), 0.01 * rest.z(), 1e-9);
    EXPECT_NEAR(moved.z(), -0.01 * rest.x(), 1e-9);
    EXPECT_NEAR(point(data, i).z(), rest.z() - 0.01 * rest.x(), 1e-8);
  }

  // theta_x turns y towards z
  frame = at_rest(scene);
  frame.motion(0, 2) = 0.01;
  const auto other = written(scene, frame, {.deflection_scale = 1.0, .facets = 4});
  for (const vtkIdType i : points(other, 1)) {
    const double y = vector(other, "undeformed position [m]", i).y();
    EXPECT_NEAR(vector(other, "displacement [m]", i).z(), 0.01 * y, 1e-9);
  }
}

// Cantilever with an end force: x = z^2 (3 L - z) / 2 for L = 1, deflection 1 and slope 3/2 at the
// end.
TEST_F(VtkSeries, ShaftIsACubicBetweenItsNodes) {
  const VtkScene scene{.z = {0.0, 1.0}, .shaft = {{0, 1, 0.01, 0.01}}};
  VtkFrame frame = at_rest(scene);
  frame.motion.row(1) << 1e-3, -2e-3, 2.0 * 1.5e-3, 1.5e-3;  // theta_x = -dy/dz
  const auto data = written(scene, frame, {.facets = 4, .sections = 10});
  // opposite points of a ring: their mean is the axis
  for (vtkIdType ring = 0; ring <= 10; ++ring) {
    const Vector3d u = 0.5 * (vector(data, "displacement [m]", 4 * ring) +
                              vector(data, "displacement [m]", 4 * ring + 2));
    const double z = ring / 10.0, shape = z * z * (3.0 - z) / 2.0;
    EXPECT_NEAR(u.x(), 1e-3 * shape, single * 1e-3);
    EXPECT_NEAR(u.y(), -2e-3 * shape, single * 1e-3);
  }
}

TEST_F(VtkSeries, TouchingLooksLikeTouching) {
  // the rotor of 0.1 m has crossed the clearance of 5 mm about a center at 1 mm
  const VtkScene scene = example();
  VtkFrame frame = at_rest(scene);
  frame.motion(1, 0) = 6e-3;
  const auto data = written(scene, frame, {.deflection_scale = 7.0});
  double rotor = 0.0, ring = 0.0;
  for (const vtkIdType i : points(data, 1)) rotor = std::max(rotor, point(data, i).x());
  for (const vtkIdType i : points(data, 2)) ring = std::max(ring, point(data, i).x());
  EXPECT_NEAR(rotor, 0.1 + 7.0 * 6e-3, 1e-7);
  EXPECT_NEAR(ring, rotor, 1e-7);
  // at rest it is where it is
  for (const vtkIdType i : points(data, 2)) {
    const Vector3d rest = vector(data, "undeformed position [m]", i);
    const bool is_seal = rest.z() < 0.7;
    const Vector3d center(is_seal ? 1e-3 : 0.0, 0.0, 0.0);
    EXPECT_NEAR((rest - center).head<2>().norm(), is_seal ? 0.105 : 0.021, 1e-7);
    EXPECT_NEAR(rest.z(), is_seal ? 0.5 : 0.9, 0.011);
  }
}

TEST_F(VtkSeries, StatorsMoveWithTheirBodies) {
  const VtkScene scene = example();
  VtkFrame frame = at_rest(scene);
  frame.motion.row(3) << 0.0, 1e-3, 0.0, 0.0;
  const auto data = written(scene, frame, {.deflection_scale = 2.0});
  for (const vtkIdType i : points(data, 2)) {
    const bool is_seal = vector(data, "undeformed position [m]", i).z() < 0.7;
    EXPECT_NEAR(vector(data, "displacement [m]", i).y(), is_seal ? 1e-3 : 0.0, 1e-9);
  }
}

TEST(VtkFrames, HaveTheForcesOnTheRotor) {
  const Model model = parse_model(R"(format = 1
[operation]
speed = "100 rad/s"
[[body]]
name = "rotor"
mass = 2
spins = true
[[bearing]]
body = "rotor"
stiffness = 2e4
[[contact]]
name = "ring"
body = "rotor"
radius = "50 mm"
clearance = "1 mm"
stiffness = 1e6
friction = 0.2
)");
  const Assembler assembler(model.structure);
  // displaced along y: n = (0, 1), t = (-1, 0); pressed back by N, and T acts against +t
  const VtkFrame frame =
      vtk_frame(model, assembler, 0.5, Vec{{0.0, 2e-3}}, Vec{{1000.0}}, Vec{{200.0}});
  ASSERT_EQ(frame.forces.size(), 1u);
  EXPECT_TRUE(frame.forces[0].is_touching);
  EXPECT_EQ(frame.forces[0].force, Vec2(200.0, -1000.0));
  EXPECT_EQ(frame.forces[0].arm, Vector3d(0.0, 0.05, 0.0));
}

TEST_F(VtkSeries, ForcesAreLinesFromWhereTheyAct) {
  const VtkScene scene = example();
  VtkFrame frame = at_rest(scene);
  frame.motion(1, 0) = 2e-3;
  frame.forces[0] = {Vector3d(0.1, 0.0, 0.0), Vec2(-300.0, 400.0), true};
  const auto data = written(scene, frame, {.deflection_scale = 10.0, .force_scale = 1e-3});
  const auto lines = cells(data, 3);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(data->GetCellData()->GetArray("in touch")->GetTuple1(lines[0]), 1.0);
  EXPECT_EQ(data->GetCellData()->GetArray("in touch")->GetTuple1(lines[1]), 0.0);
  EXPECT_EQ(data->GetCellData()->GetArray("member")->GetTuple1(lines[1]), 2.0);
  const vtkIdType foot = data->GetCell(lines[0])->GetPointId(0);
  const vtkIdType tip = data->GetCell(lines[0])->GetPointId(1);
  EXPECT_LT((point(data, foot) - Vector3d(0.12, 0.0, 0.5)).norm(), single);
  EXPECT_LT((point(data, tip) - Vector3d(0.12 - 0.3, 0.4, 0.5)).norm(), single);
  EXPECT_EQ(vector(data, "contact force [N]", foot), Vector3d(-300.0, 400.0, 0.0));
  EXPECT_EQ(vector(data, "contact force [N]", 0), Vector3d::Zero());
  // of its own choice the largest force is as long as 15 % of the rotor
  const auto chosen = written(scene, frame);
  EXPECT_NEAR(number(chosen, "force scale [m/N]"), 0.15 / 500.0, 1e-12);
}

TEST_F(VtkSeries, ChosenScaleShowsTwelvePercent) {
  const VtkScene scene = example();
  VtkFrame small = at_rest(scene), large = at_rest(scene);
  small.motion(0, 1) = 1e-5;
  large.motion.row(2) << 3e-5, 4e-5, 0.0, 0.0;
  EXPECT_NEAR(vtk_deflection_scale(scene, {small, large}), 0.12 / 5e-5, 1e-9);
  large.motion(2, 0) = std::nan("");
  EXPECT_NEAR(vtk_deflection_scale(scene, {small, large}), 0.12 / 1e-5, 1e-9);
  // large motions are not made smaller, and rest is no division by zero
  large.motion(2, 0) = 2.0;
  EXPECT_EQ(vtk_deflection_scale(scene, {small, large}), 1.0);
  EXPECT_EQ(vtk_deflection_scale(scene, {at_rest(scene)}), 1.0);
  EXPECT_EQ(vtk_deflection_scale({}, {}), 1.0);
}

// Displacements are drawn linearly, theta x r: a disk that tilts by 0.35 rad looks 6 % too large.
TEST_F(VtkSeries, ChosenScaleKeepsDisksInShape) {
  const VtkScene scene = example();
  VtkFrame frame = at_rest(scene);
  frame.motion.row(1) << 1e-6, 0.0, 0.0, 7e-3;
  EXPECT_NEAR(vtk_deflection_scale(scene, {frame}), 50.0, 1e-9);
  // what has no size of its own, such as a mode, may be drawn smaller
  frame.motion.row(1) << 1.0, 0.0, 0.0, 0.0;
  EXPECT_NEAR(vtk_fitting_scale(scene, {frame}), 0.12, 1e-12);
}

// A shape comes with any amplitude: a mode of unit radius on a rotor of 1 m would be a caricature.
TEST_F(VtkSeries, ModesAreDrawnToFitTheRotor) {
  const Model model = parse_model(R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "20 mm"
elements = 4
[[disk]]
node = 3
mass = 5
outer_diameter = "0.3 m"
[[bearing]]
node = 1
rigid = true
[[bearing]]
node = 5
rigid = true
)",
                                  "rotor.toml");
  const Assembler assembler(model.structure);
  const VtkScene scene = vtk_scene(model, assembler);
  const System system = assembler.at(0.0);
  for (const Mode& mode : complex_modes(system, 4).oscillatory) {
    const auto frames = vtk_mode_frames(mode, system.dofs, scene, 36);
    EXPECT_NEAR(vtk_deflection_scale(scene, frames), 1.0, 1e-12);
    double radius = 0.0, tilt = 0.0;
    for (const VtkFrame& frame : frames) {
      radius = std::max(radius, frame.motion.leftCols<2>().rowwise().norm().maxCoeff());
      tilt = std::max(tilt, frame.motion.rightCols<2>().rowwise().norm().maxCoeff());
    }
    EXPECT_NEAR(std::max(radius / 0.12, tilt / 0.35), 1.0, 1e-12);
  }
}

TEST_F(VtkSeries, ARotorMayBeBodiesOnly) {
  const VtkScene scene{.z = {0.0}, .disks = {{"rotor", 0, 0.1, 0.0, 0.02}}};
  VtkFrame frame = at_rest(scene);
  frame.motion(0, 0) = 1e-3;
  const auto data = written(scene, frame);
  EXPECT_NEAR(number(data, "deflection scale"), 0.12 * 0.2 / 1e-3, 1e-9);
  EXPECT_EQ(data->GetNumberOfPoints(), 2 * 48);
  EXPECT_EQ(data->GetNumberOfCells(), 48 + 2);
}

/// Two disks by mass, one of them with its size, and a seal ring that one runs in.
const char* masses = R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "80 mm"
elements = 4
[[disk]]
name = "wheel"
node = 3
mass = 5
[[disk]]
name = "hub"
node = 4
mass = 5
outer_diameter = "0.3 m"
width = "60 mm"
[[contact]]
name = "ring"
node = 2
clearance = "1 mm"
stiffness = 1e6
)";

// A wheel by its mass has no size, and none is invented: what stands for it is thin, ends near the
// shaft, leaves every other sector open, and is named as what it is. A size that is given stays.
TEST_F(VtkSeries, ADiskByItsMassIsAThinBrokenSymbol) {
  const Model model = parse_model(masses, "rotor.toml");
  const VtkScene scene = vtk_scene(model, Assembler(model.structure));
  ASSERT_EQ(scene.disks.size(), 2u);
  const VtkDisk &wheel = scene.disks[0], &hub = scene.disks[1];
  EXPECT_EQ(wheel.not_given, "size");
  EXPECT_LE(wheel.width, 0.01);
  EXPECT_LE(wheel.outer_radius, 0.04 + 0.05);
  EXPECT_GT(wheel.outer_radius, 0.04);
  EXPECT_EQ(hub.not_given, "");
  EXPECT_EQ(hub.outer_radius, 0.15);
  EXPECT_EQ(hub.width, 0.06);
  EXPECT_EQ(symbols_told(scene),
            "Thin, broken and not to scale, as the model does not give the size of wheel");
  const auto data = written(scene, at_rest(scene), {.facets = 48});
  EXPECT_EQ(cells(data, 1).size(), 48u + 2u);       // the hub, whole
  EXPECT_EQ(cells(data, 4).size(), 4u * 48u / 2u);  // the wheel, half of its sectors
}

// A diameter without a width is drawn true; where a contact says at which radius it touches the
// disk, the symbol is as large.
TEST_F(VtkSeries, OnlyWhatIsNotGivenIsASymbol) {
  std::string text = masses;
  text.replace(text.find("width = \"60 mm\""), 15, "# none");
  text.replace(text.find("stiffness = 1e6"), 15, "stiffness = 1e6\nfriction = 0.1\nradius = 0.2");
  text.replace(text.find("node = 2\nclearance"), 8, "node = 3");
  const Model model = parse_model(text, "rotor.toml");
  const VtkScene scene = vtk_scene(model, Assembler(model.structure));
  EXPECT_EQ(scene.disks[1].not_given, "width");
  EXPECT_EQ(scene.disks[1].outer_radius, 0.15);
  EXPECT_LE(scene.disks[1].width, 0.01);
  EXPECT_EQ(scene.disks[0].outer_radius, 0.2);
}

// A bearing is a pyramid that ends on the ground, or on what carries it, which stands on the ground
// one floor below: tips move with the shaft, feet with the pedestal, the ground stays.
TEST_F(VtkSeries, BearingsAndSupportsStandBelowTheRotor) {
  const Model model = parse_model(std::string(masses) + R"([[body]]
name = "pedestal"
mass = 20
[[bearing]]
name = "free end"
node = 1
stiffness = 1e7
[[bearing]]
name = "drive end"
node = 5
to = "pedestal"
stiffness = 1e7
[[link]]
name = "foundation"
from = { body = "pedestal" }
to = "ground"
stiffness = 1e8
)",
                                  "rotor.toml");
  const VtkScene scene = vtk_scene(model, Assembler(model.structure));
  ASSERT_EQ(scene.supports.size(), 3u);
  const VtkSupport &free = scene.supports[0], &drive = scene.supports[1],
                   &foundation = scene.supports[2];
  constexpr double radius = 0.04, floor = 0.06, z = 1.0;  // 6 % of the length of 1 m
  EXPECT_EQ(free.to, -1);
  EXPECT_EQ(free.tip, radius);
  EXPECT_NEAR(free.foot, radius + floor, 1e-12);
  EXPECT_EQ(drive.from, 4);
  EXPECT_EQ(drive.to, 5);
  EXPECT_EQ(foundation.from, 5);
  EXPECT_EQ(foundation.to, -1);
  EXPECT_NEAR(foundation.z, z, 1e-12);
  EXPECT_NEAR(foundation.tip, radius + floor, 1e-12);
  EXPECT_NEAR(foundation.foot, radius + 2.0 * floor, 1e-12);

  VtkFrame frame = at_rest(scene);
  frame.motion.row(4) << 1e-3, 2e-3, 0.0, 0.0;  // the shaft's end
  frame.motion.row(5) << 0.0, -5e-4, 0.0, 0.0;  // the pedestal
  const auto data = written(scene, frame, {.deflection_scale = 1.0, .facets = 8});
  EXPECT_EQ(cells(data, 5).size(), 3u * 4u);
  EXPECT_EQ(cells(data, 6).size(), 3u);
  std::map<double, int> heights;  // of the points, in mm
  for (const vtkIdType i : points(data, 5)) {
    ++heights[std::round(1e6 * point(data, i).y()) / 1e3];
  }
  const std::map<double, int> expected{
      {-40.0, 1}, {-100.0, 4}, {-38.0, 1}, {-100.5, 5}, {-160.0, 4}};
  EXPECT_EQ(heights, expected);
}

TEST_F(VtkSeries, CollectionListsTimesAndFiles) {
  const VtkScene scene = example();
  VtkFrame first = at_rest(scene), second = at_rest(scene);
  first.time = 0.1;
  second.time = 0.1 + 1e-12;
  const fs::path odd = folder / "a & b.pvd";
  const auto paths = write_vtk_series(odd, scene, {first, second});
  EXPECT_EQ(paths, (std::vector<fs::path>{odd, folder / "a & b" / "a & b_0001.vtp",
                                          folder / "a & b" / "a & b_0002.vtp"}));
  for (const fs::path& file : paths) EXPECT_TRUE(fs::is_regular_file(file)) << file;
  std::ostringstream text;
  text << std::ifstream(odd).rdbuf();
  EXPECT_EQ(text.str(),
            "<?xml version=\"1.0\"?>\n"
            "<!-- written by whirl -->\n"
            "<VTKFile type=\"Collection\" version=\"0.1\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0.10000000000000001\" part=\"0\" "
            "file=\"a &amp; b/a &amp; b_0001.vtp\"/>\n"
            "    <DataSet timestep=\"0.10000000000100001\" part=\"0\" "
            "file=\"a &amp; b/a &amp; b_0002.vtp\"/>\n"
            "  </Collection>\n"
            "</VTKFile>\n");
  EXPECT_EQ(number(read(paths[2]), "time [s]"), 0.1 + 1e-12);
}

TEST_F(VtkSeries, FilesThatCannotBeWrittenAreExplained) {
  const auto problem = [&](const fs::path& file) -> std::string {
    try {
      write_vtk_series(file, example(), {at_rest(example())});
    } catch (const FileError& error) {
      return error.what();
    }
    return "none";
  };
  testing::internal::CaptureStderr();
  EXPECT_EQ(problem(folder / "run.vtp"),
            "cannot write " + (folder / "run.vtp").string() + ": the name must end in .pvd");
  EXPECT_EQ(problem(folder / "none/run.pvd"), "cannot write " + (folder / "none/run.pvd").string() +
                                                  ": there is no directory " +
                                                  (folder / "none").string());
  std::ofstream(folder / "run") << "a file where the folder would be";
  EXPECT_EQ(problem(path).substr(0, 12), "cannot make ");
  fs::remove(folder / "run");
  fs::create_directories(folder / "run" / "run_0001.vtp");  // a folder where the file would be
  const std::string place = (folder / "run/run_0001.vtp").string();
  EXPECT_EQ(problem(path).substr(0, 14 + place.size()), "cannot write " + place + ":");
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace whirl::vtk_test
