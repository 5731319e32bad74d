// Matrices of a rotor for other programs: what is written is what is assembled, to the last digit.

#include "libio/export/matrices.hpp"

#include <gtest/gtest.h>
#include <matio.h>
#include <unistd.h>

#include <fstream>

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/export/scene_export.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::matrices_test {

namespace fs = std::filesystem;

constexpr double Omega = 300.0;

/// A clamped shaft with a disk, a stator that a link holds, and rotating damping.
const char* const text = R"(format = 1
[material.steel]
density = 7800
youngs_modulus = 211e9
poisson_ratio = 0.3
internal_damping = 1e-6
[[shaft]]
material = "steel"
length = 0.7
outer_diameter = 0.05
elements = 2
[[disk]]
node = 3
mass = 7
polar_inertia = 0.1
diametral_inertia = 0.06
[[body]]
name = "stator"
mass = 3
[[bearing]]
node = 1
clamped = true
[[link]]
from = { node = 3 }
to = "stator"
rigid = true
)";

struct Matrices : testing::Test {
  fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_matrices_test_" + std::to_string(::getpid()));
  Model model = parse_model(text);
  Assembler assembler{model.structure};
  System system = assembler.uncondensed(Omega);

  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
};

/// A matrix of Matrix Market, by its definition.
Mat market(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
  while (in.peek() == '%') std::getline(in, line);
  int rows = 0, columns = 0, entries = 0;
  in >> rows >> columns >> entries;
  Mat A = Mat::Zero(rows, columns);
  for (int k = 0; k < entries; ++k) {
    int i = 0, j = 0;
    double value = 0.0;
    in >> i >> j >> value;
    A(i - 1, j - 1) = value;
  }
  EXPECT_TRUE(in);
  return A;
}

/// A sparse matrix of an open MATLAB file.
Mat matlab(mat_t* file, const char* name) {
  matvar_t* variable = Mat_VarRead(file, name);
  EXPECT_NE(variable, nullptr) << name;
  if (!variable) return {};
  const auto* data = static_cast<const mat_sparse_t*>(variable->data);
  Mat A = Mat::Zero(static_cast<int>(variable->dims[0]), static_cast<int>(variable->dims[1]));
  for (int j = 0; j < A.cols(); ++j) {
    for (mat_uint32_t k = data->jc[j]; k < data->jc[j + 1]; ++k) {
      A(data->ir[k], j) = static_cast<const double*>(data->data)[k];
    }
  }
  Mat_VarFree(variable);
  return A;
}

TEST_F(Matrices, OfMatrixMarketAreThoseOfTheRotor) {
  const auto files =
      write_matrix_market(folder / "rotor", model, assembler, Omega, Replaces::own_pictures);
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(market(folder / "rotor_M.mtx"), Mat(system.M));
  EXPECT_EQ(market(folder / "rotor_C.mtx"), Mat(system.C));
  EXPECT_EQ(market(folder / "rotor_G.mtx"), Mat(system.G()));
  EXPECT_EQ(market(folder / "rotor_K.mtx"), Mat(system.stiffness()));
  std::ifstream table(folder / "rotor_dofs.csv");
  std::string head, first;
  std::getline(table, head);
  std::getline(table, first);
  EXPECT_EQ(head, "coordinate,what,z [m]");
  EXPECT_EQ(first, "1,\"node 2 x\",0.35");
  // its own files are replaced, those of others are not
  write_matrix_market(folder / "rotor", model, assembler, Omega, Replaces::own_pictures);
  std::ofstream(folder / "rotor_M.mtx") << "mine";
  EXPECT_THROW(
      write_matrix_market(folder / "rotor", model, assembler, Omega, Replaces::own_pictures),
      TakenPlace);
}

TEST_F(Matrices, OfMatlabAreThoseOfTheRotor) {
  write_matlab(folder / "rotor", model, assembler, Omega, Replaces::own_pictures);
  write_matlab(folder / "rotor", model, assembler, Omega, Replaces::own_pictures);
  mat_t* file = Mat_Open((folder / "rotor.mat").c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(file, nullptr);
  const Sparse G = system.G(), K = system.stiffness();
  const std::pair<const char*, const Sparse*> matrices[] = {
      {"M", &system.M}, {"C", &system.C}, {"G", &G}, {"K", &K}};
  for (const auto& [name, expected] : matrices) EXPECT_EQ(matlab(file, name), Mat(*expected));
  matvar_t* speed = Mat_VarRead(file, "Omega");
  EXPECT_EQ(*static_cast<const double*>(speed->data), Omega);
  Mat_VarFree(speed);
  matvar_t* names = Mat_VarRead(file, "dofs");
  EXPECT_EQ(names->dims[0], static_cast<std::size_t>(system.size()));
  Mat_VarFree(names);
  Mat_Close(file);
}

// Exported are those of linear analyses: oil films add the coefficients that they have about the
// equilibrium of their journals to K and C, and nothing else; it is told, and what is left out.
TEST_F(Matrices, OfAModelHaveItsOilFilms) {
  const std::string film = R"([operation]
speed = "300 rad/s"
[[oil_film]]
name = "journal"
node = 3
radius = "25 mm"
length = "12 mm"
clearance = "0.1 mm"
viscosity = 0.02
[[contact]]
name = "ring"
node = 2
clearance = "1 mm"
stiffness = 1e7
)";
  const Model on_film = parse_model("gravity = 9.81\n" + std::string(text) + film);
  const System linear = Assembler(linear_structure(on_film)).uncondensed(Omega);
  const SceneSource source(on_film);
  const Exported market_files =
      export_scene(source, {.format = export_format("mtx"), .stem = folder / "film"});
  export_scene(source, {.format = export_format("mat"), .stem = folder / "film"});
  mat_t* file = Mat_Open((folder / "film.mat").c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(file, nullptr);
  const Sparse G = linear.G(), K = linear.stiffness();
  const std::pair<const char*, const Sparse*> matrices[] = {
      {"M", &linear.M}, {"C", &linear.C}, {"G", &G}, {"K", &K}};
  for (const auto& [name, expected] : matrices) {
    EXPECT_EQ(market(folder / ("film_" + std::string(name) + ".mtx")), Mat(*expected)) << name;
    EXPECT_EQ(matlab(file, name), Mat(*expected)) << name;
  }
  Mat_Close(file);
  EXPECT_EQ(Mat(linear.M), Mat(system.M));
  const RunningFilm journal = FilmEquilibrium(on_film).at(Omega)->films.at(0);
  // node 1 is clamped, node 2 has the first four coordinates
  const Mat added = Mat(linear.K - system.K).block(4, 4, 2, 2) - journal.stiffness;
  const Mat C = Mat(linear.C - system.C).block(4, 4, 2, 2) - journal.damping;
  constexpr double rounding = 1e-14;
  EXPECT_LE(added.norm(), rounding * linear.K.norm());
  EXPECT_LE(C.norm(), rounding * linear.C.norm());
  EXPECT_GT(journal.stiffness.norm(), 1e6 * rounding * linear.K.norm());
  EXPECT_GT(journal.damping.norm(), 1e6 * rounding * linear.C.norm());
  EXPECT_EQ(market_files.notes,
            (std::vector<std::string>{
                "linearized about the static equilibrium at each speed: oil film journal",
                "left out: contact ring"}));
}

TEST_F(Matrices, NameTheCoordinates) {
  const auto names = coordinate_names(system.dofs, model);
  EXPECT_EQ(names.size(), 8U);
  EXPECT_EQ(names.at(4), "node 3 x = stator x");
  EXPECT_EQ(names.at(7), "node 3 theta_y");
}

}  // namespace whirl::matrices_test
