// export to other programs: meshes by meshio, tables, XDMF.

#include <set>

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
    const json r =
        result({"export", disks, "--format", format, "--out", "rotor", "--modes", "1", "--force"});
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
  make({"export", disks, "--format", "stl", "--out", "rotor", "--force"});
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
    if (std::set<std::string>{"vtk", "xdmf", "csv", "uff", "mtx", "mat"}.contains(name)) continue;
    const json r =
        result({"export", "run.h5", "--format", name, "--out", "x", "--modes", "1", "--force"});
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

// A row per moment, a column per station and contact, units in the head; numbers are those of the
// result file, bit by bit.
TEST_F(Export, ATimeHistoryIsATable) {
  if (!has_h5py()) GTEST_SKIP() << "there is no h5py";
  write("rub.toml", rubbing);
  make({"simulate", "rub.toml", "--revolutions", "8", "--discard", "4", "--out", "run.h5",
        "--quiet"});
  const std::vector<std::string> written =
      result({"export", "run.h5", "--format", "csv", "--out", "t"})["files"];
  EXPECT_EQ(written,
            (std::vector<std::string>{"t_contacts_name.csv", "t_points_body_name.csv",
                                      "t_spectra_frequency.csv", "t_trajectory_time.csv",
                                      "t_trajectory_support_name.csv"}));
  EXPECT_EQ(python_says("import csv, h5py, numpy as np\n"
                        "rows = list(csv.reader(open('t_trajectory_time.csv')))\n"
                        "print(','.join(rows[0]))\n"
                        "a = np.array([[float(v) for v in r] for r in rows[1:]])\n"
                        "t = h5py.File('run.h5')['trajectory']\n"
                        "b = np.vstack([t['time'], t['friction_force'], t['normal_force'], "
                        "t['support_force_x'], t['support_force_y'], t['x'], t['y']]).T\n"
                        "print(a.shape == b.shape and (a == b).all())"),
            "time [s],friction_force ring [N],normal_force ring [N],support_force_x shaft [N],"
            "support_force_y shaft [N],x rotor [m],y rotor [m]\n"
            "True\n");
}

// Values of a study are rows; ways and stations columns; what has two axes has a row per pair.
// Complex numbers have two columns.
TEST_F(Export, StudiesAndBranchesAreTables) {
  write("rub.toml", rubbing);
  make(briefly({"sweep", "rub.toml", "--out", "s.h5", "--quiet"}));
  make({"campbell", disks, "--speeds", "0:1000:500rpm", "--out", "c.h5", "--quiet"});
  make({"unbalance", disks, "--speeds", "0:1000:500rpm", "--out", "u.h5", "--quiet"});
  make({"orbit", "rub.toml", "--out", "o.h5", "--quiet"});
  for (const char* file : {"s.h5", "c.h5", "u.h5", "o.h5"}) {
    make({"export", file, "--format", "csv", "--quiet"});
  }
  const std::string sweep = content(folder / "s_sweep_axis_1.csv");
  EXPECT_EQ(sweep.rfind("gravity [m/s^2],", 0), 0u) << sweep;
  EXPECT_TRUE(has(sweep, ",motion up,motion down,")) << sweep;
  EXPECT_EQ(std::count(sweep.begin(), sweep.end(), '\n'), 3);
  EXPECT_EQ(content(folder / "s_sweep_axis_1_order.csv").rfind("gravity [m/s^2],order,", 0), 0u);
  const std::string branches = content(folder / "c_campbell_speed.csv");
  EXPECT_EQ(branches.rfind("speed [rad/s],frequency 1 [rad/s],frequency 2 [rad/s],", 0), 0u);
  EXPECT_EQ(std::count(branches.begin(), branches.end(), '\n'), 4);
  EXPECT_TRUE(has(content(folder / "u_unbalance_speed.csv"), ",x 4 left disk im [m],"));
  const std::string orbit = content(folder / "o_orbit_exponent.csv");  // against the multipliers
  EXPECT_EQ(
      orbit.rfind("number,exponent re [1/s],exponent im [1/s],multiplier re,multiplier im\n", 0),
      0u)
      << orbit;
  EXPECT_TRUE(has(problem({"export", "rub.toml", "--format", "csv"}), "a model holds no tables"));
}

// meshio reads the motion back: all moments, the shaft's lines, and what moves.
TEST_F(Export, ALongMotionIsXdmfBesideHdf5) {
  make({"simulate", disks, "--revolutions", "8", "--discard", "1", "--out", "run.h5", "--quiet"});
  const json r = result({"export", "run.h5", "--format", "xdmf", "--out", "x"});
  EXPECT_EQ(r["files"], (json::array({"x.xdmf", "x_xdmf.h5"})));
  if (!has_meshio()) GTEST_SKIP() << "there is no meshio (Debian package meshio-tools)";
  EXPECT_EQ(python_says("import meshio, h5py, numpy as np\n"
                        "r = meshio.xdmf.TimeSeriesReader('x.xdmf').__enter__()\n"
                        "p, c = r.read_points_cells()\n"
                        "t, d, _ = r.read_data(511)\n"
                        "f = h5py.File('run.h5')['trajectory']\n"
                        "q = np.array(f['basis']) @ np.array(f['coordinates'])[:, -1]\n"
                        "print(len(p), c[0].type, len(c[0].data), r.num_steps, "
                        "t == f['time'][-1], abs(d['displacement [m]'][6, 0] - q[4*6]) < 1e-15)"),
            "13 line 12 512 True True\n");
}

}  // namespace export_test
}  // namespace whirl::test
