// export to other programs: meshes by meshio.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace export_test {

const std::string disks = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";

class Export : public Program {
 protected:
  bool has_meshio() const {
    return wait(start("sh", {"-c", "command -v meshio && /usr/bin/python3 -c 'import meshio'"}))
               .status == 0;
  }
  std::string python_says(const std::string& code) const {
    const Outcome outcome = wait(start(python, {"-c", code}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }
  void make(const std::vector<std::string>& words) const {
    const Outcome outcome = whirl(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  std::string problem(const std::vector<std::string>& words) const {
    const auto before = files();
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), before);
    return outcome.err;
  }
};

// What meshio reads back of a format with lines are the nodes and elements of the model, with its
// disks and sections; of one without, a surface.
TEST_F(Export, MeshesAreReadByMeshio) {
  if (!has_meshio()) GTEST_SKIP() << "there is no meshio (Debian package meshio-tools)";
  for (const char* format : {"abaqus", "nastran", "gmsh", "exodus", "med", "vtu"}) {
    SCOPED_TRACE(format);
    const json r = result({"export", disks, "--format", format, "--out", "rotor", "--modes", "1"});
    ASSERT_EQ(r["files"].size(), 1u);
    const std::string file = r["files"][0];
    const std::string reader = std::string(format) == "gmsh" ? ", 'gmsh'" : "";
    EXPECT_EQ(python_says("import meshio; m = meshio.read('" + file + "'" + reader +
                          "); print(len(m.points), m.cells[0].type, len(m.cells[0].data), "
                          "round(m.points[:,2].max(), 9))"),
              "13 line 12 0.6\n");
  }
  EXPECT_EQ(python_says("import meshio; m = meshio.read('rotor.med'); p = m.point_data\n"
                        "print(max(p['disk']), p['disk_mass_kg'].sum() > 1, "
                        "p['mode1_0deg'].shape, m.cell_data['outer_diameter_left_m'][0][0] > 0)"),
            "2.0 True (13, 3) True\n");
  make({"export", disks, "--format", "stl", "--out", "rotor"});
  EXPECT_EQ(python_says("import meshio; m = meshio.read('rotor.stl')\n"
                        "print(m.cells[0].type, round(m.points[:,2].max(), 6))"),
            "triangle 0.6\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"rotor.bdf", "rotor.e", "rotor.inp", "rotor.med",
                                               "rotor.msh", "rotor.stl", "rotor.vtu"}));
}

// Every format of the list is written, from a result with a motion and modes.
TEST_F(Export, EveryFormatOfMeshioIsWritten) {
  if (!has_meshio()) GTEST_SKIP() << "there is no meshio (Debian package meshio-tools)";
  make({"identify", disks, "--revolutions", "8", "--discard", "1", "--out", "run.h5", "--quiet"});
  const std::string list = problem({"export", "run.h5", "--format", "?"});
  std::istringstream names(list.substr(list.find("there are") + 9));
  int count = 0;
  for (std::string name; names >> name; ++count) {
    if (name.back() == ',') name.pop_back();
    if (name == "vtk" || name == "xdmf" || name == "csv") continue;
    const json r = result({"export", "run.h5", "--format", name, "--out", "x", "--modes", "1"});
    ASSERT_EQ(r["files"].size(), 1u) << name;
    EXPECT_GT(std::filesystem::file_size(folder / r["files"][0].get<std::string>()), 100u) << name;
  }
  EXPECT_GT(count, 15);
}

TEST_F(Export, TellsWhatIsMissing) {
  write("rotor.toml", jeffcott);
  EXPECT_TRUE(has(problem({"export", "rotor.toml", "--format", "abacus"}),
                  "unknown format, did you mean \"abaqus\"?; there are vtk, "));
  EXPECT_TRUE(has(problem({"export", "rotor.toml", "--format", "vtu"}), "has no shaft"));
  const Outcome without =
      wait(start("sh", {"-c", "PATH=/nowhere " + std::string(WHIRL_PROGRAM) + " export " + disks +
                                  " --format abaqus --out x"}));
  EXPECT_EQ(without.status, 2);
  EXPECT_TRUE(has(without.err, "meshio-tools")) << without.err;
  EXPECT_EQ(files(), std::vector<std::string>{"rotor.toml"});
}

// What meshio says when it fails is passed on, and nothing is left behind.
TEST_F(Export, PassesOnWhatMeshioSays) {
  write("meshio", "#!/bin/sh\necho 'ValueError: no such day' >&2\nexit 1\n");
  std::filesystem::permissions(folder / "meshio", std::filesystem::perms::owner_all);
  const Outcome outcome =
      wait(start("sh", {"-c", "PATH=.:$PATH " + std::string(WHIRL_PROGRAM) + " export " + disks +
                                  " --format abaqus --out x"}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.err, "cannot write x.inp: meshio says: ValueError: no such day"))
      << outcome.err;
  EXPECT_EQ(files(), std::vector<std::string>{"meshio"});
}

}  // namespace export_test
}  // namespace whirl::test
