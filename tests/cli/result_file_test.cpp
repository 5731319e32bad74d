// Result files: what they hold, for other programs too; running them again; pictures of them.

#include <signal.h>

#include <random>
#include <regex>

#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/manual.hpp"

namespace whirl::test {
namespace result_file_test {

class Results : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rotor.toml", jeffcott);
    write("rub.toml", rubbing);
  }

  /// A short call of a verb.
  static std::vector<std::string> words(const std::string& verb) {
    std::vector<std::string> line{verb, "rub.toml"};
    if (verb == "campbell" || verb == "unbalance") {
      line.insert(line.end(), {"--speeds", "0:1500:100rpm"});
    }
    if (verb == "simulate" || verb == "identify") {
      line.insert(line.end(), {"--discard", "2", "--revolutions", "16", "--samples", "16"});
    }
    return briefly(line);
  }

  void make(const std::string& verb, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> line = words(verb);
    line.insert(line.end(), {"--out", verb + ".h5", "--quiet"});
    line.insert(line.end(), more.begin(), more.end());
    const Outcome outcome = whirl(line);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(Results, HoldTheModelAndTheCommand) {
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    make(verb);
    const ResultReader file(folder / (verb + ".h5"));
    EXPECT_TRUE(file.string_attribute("/", "whirl_version").starts_with("0."));
    EXPECT_EQ(file.number_attribute("/", "format"), 1.0);
    EXPECT_TRUE(has(file.string_attribute("/", "command"), " " + verb + " rub.toml "));
    EXPECT_TRUE(std::regex_match(file.string_attribute("/", "created"),
                                 std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ")));
    EXPECT_EQ(file.strings("/model"), std::vector<std::string>{rubbing});
  }
}

TEST_F(Results, HoldTheModelWithWhatWasSet) {
  make("modes", {"--set", "body.rotor.mass=3 kg", "--speed", "300rpm"});
  const std::string model = ResultReader(folder / "modes.h5").strings("/model").at(0);
  write("stored.toml", model);
  const json r = result({"check", "stored.toml"});
  EXPECT_EQ(r["mass_kg"], 3.0);
  EXPECT_DOUBLE_EQ(r["speed_rpm"].get<double>(), 300.0);
}

constexpr const char* inspect = R"(
import h5py, sys
datasets = []
with h5py.File(sys.argv[1], "r") as f:
    for name in ("whirl_version", "command", "created"):
        assert isinstance(f.attrs[name], str) and f.attrs[name], name
    assert f["model"].asstr()[0].startswith("format = 1")
    def visit(name, item):
        if not isinstance(item, h5py.Dataset): return
        datasets.append(name)
        assert isinstance(item.attrs["units"], str), name
        assert item.attrs["long_name"], name
        for axis in item.dims:
            for scale in axis.values():
                assert h5py.h5ds.is_scale(scale.id), name
                assert axis.label == scale.name.split("/")[-1], name
        item[()]
    f.visititems(visit)
    def axes(name): return [[s.name for s in d.values()] for d in f[name].dims]
    def has(name, *scales): assert axes(name) == [[s] if s else [] for s in scales], (name, axes(name))
    verb = sys.argv[2]
    if verb in ("modes", "identify"):
        has("modes/frequency", "/modes/number"); has("modes/shape", "", "/modes/number")
    if verb == "campbell": has("campbell/frequency", "/campbell/branch", "/campbell/speed")
    if verb == "unbalance": has("unbalance/x", "/unbalance/station", "/unbalance/speed")
    if verb == "static": has("static/bearing_load", "/static/bearing", "")
    if verb in ("simulate", "identify"):
        has("trajectory/x", "/trajectory/station", "/trajectory/time")
        has("trajectory/normal_force", "/contacts/name", "/trajectory/time")
        has("spectra/amplitude", "/trajectory/station", "/spectra/frequency")
        assert f["trajectory/x"].attrs["units"] == "m"
        assert f["trajectory/time"].attrs["units"] == "s"
        assert f["trajectory/normal_force"].attrs["units"] == "N"
        assert f["trajectory/x"].shape == (1, 256)
    if verb == "identify": has("mac/mac", "/mac/frequency", "/modes/number")
print("\n".join(datasets))
)";

TEST_F(Results, AreReadByH5pyAndListedInTheManual) {
  if (!has_h5py()) GTEST_SKIP() << "h5py is not installed";
  const std::string manual = command_line_manual();
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    make(verb);
    const Outcome outcome = wait(start(python, {"-c", inspect, verb + ".h5", verb}));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream datasets(outcome.out);
    for (std::string name; datasets >> name;) {
      EXPECT_TRUE(has(manual, "`/" + name + "`")) << name;
    }
  }
}

TEST_F(Results, AreReadByH5dump) {
  if (wait(start("h5dump", {"--version"})).status != 0) GTEST_SKIP() << "no h5dump";
  make("simulate");
  const Outcome dump = wait(start("h5dump", {"-H", "simulate.h5"}));
  EXPECT_EQ(dump.status, 0);
  for (const char* part : {"GROUP \"trajectory\"", "DATASET \"normal_force\"", "DIMENSION_LIST",
                           "\"whirl_version\"", "\"long_name\""}) {
    EXPECT_TRUE(has(dump.out, part)) << part;
  }
}

TEST_F(Results, AgreeWithTheJson) {
  make("modes");
  const json r = result(words("modes"));
  const Vec frequency = ResultReader(folder / "modes.h5").vector("/modes/frequency");
  ASSERT_EQ(frequency.size(), std::ssize(r["modes"]));
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    EXPECT_NEAR(frequency(i) / rpm, r["modes"][i]["frequency_rpm"], 1e-9);
  }
}

// kill -9 at 20 random moments of a run, the last ones after its end: the file of the place is the
// old one, byte by byte, or the new one with all that a run writes.
TEST_F(Results, AreWholeWheneverTheProgramIsKilled) {
  const auto line = [](int speed) {
    return std::vector<std::string>{
        "simulate",      "rub.toml", "--speed",   std::to_string(speed) + "rad/s",
        "--discard",     "50",       "--samples", "64",
        "--revolutions", "300",      "--quiet",   "--out",
        "run.h5"};
  };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(whirl(line(100)).status, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  const std::filesystem::path place = folder / "run.h5";
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double latest = 1.2e6 * whole.count();  // [us]
  int killed = 0, replaced = 0;
  for (int i = 0; i < 100 && (i < 20 || killed == 0 || replaced == 0); ++i) {
    const std::string before = content(place);
    const pid_t child = start(WHIRL_PROGRAM, line(101 + i));
    usleep(static_cast<useconds_t>(share(random) * latest));
    kill(child, SIGKILL);
    const bool was_killed = wait(child).status == 128 + SIGKILL;
    if (was_killed) ++killed;
    latest *= was_killed ? 1.15 : 0.85;  // follows the load of the machine
    if (content(place) == before) continue;
    ++replaced;
    const ResultReader file(place);
    EXPECT_DOUBLE_EQ(file.number_attribute("/", "speed"), 101.0 + i);
    EXPECT_EQ(file.matrix("/trajectory/x").cols(), 300 * 64);
    EXPECT_EQ(file.matrix("/spectra/amplitude").rows(), 1);
    EXPECT_TRUE(file.matrix("/trajectory/coordinates").allFinite());
  }
  EXPECT_GT(killed, 0);
  EXPECT_GT(replaced, 0);
}

// ---- again ----

TEST_F(Results, RunAgainToTheSameNumbers) {
  for (const std::string& verb : model_verbs) {
    SCOPED_TRACE(verb);
    std::vector<std::string> line = words(verb);
    line.insert(line.end(),
                {"--set", "body.rotor.mass=2.5 kg", "--speed=90rad/s", "--out", verb + ".h5"});
    json first = result(line);
    std::filesystem::remove(folder / "rub.toml");  // all that is needed is in the result
    json second = result({"rerun", verb + ".h5"});
    write("rub.toml", rubbing);
    for (json* r : {&first, &second}) {
      if (r->contains("cost")) (*r)["cost"].erase("wall_s");
      if (!r->contains("runs")) continue;
      for (json& run : (*r)["runs"]) run.erase("ns_per_revolution");
    }
    EXPECT_EQ(first, second);
  }
}

TEST_F(Results, RunAgainWithFurtherOptions) {
  make("modes", {"--modes", "1"});
  const std::string before = content(folder / "modes.h5");
  const json r = result({"rerun", "modes.h5", "--modes", "2", "--set", "body.rotor.mass=8 kg"});
  EXPECT_EQ(r["modes"].size(), 2u);
  EXPECT_NEAR(r["modes"][0]["eigenvalue"][0], -200.0 / 16.0, 1e-9);
  EXPECT_NE(whirl({"rerun", "modes.h5"}).out, "");  // the first run was quiet
  EXPECT_EQ(content(folder / "modes.h5"), before);  // nothing is written over it

  EXPECT_EQ(whirl({"rerun", "modes.h5", "--out", "new.h5", "--quiet"}).status, 0);
  EXPECT_EQ(ResultReader(folder / "new.h5").strings("/model"),
            ResultReader(folder / "modes.h5").strings("/model"));
  EXPECT_EQ(result({"rerun", "new.h5"})["modes"].size(), 1u);
}

TEST_F(Results, RunAgainWithABearingTableThatIsGone) {
  write("bearing.csv", "speed [rpm],kxx,kyy\n0,1e4,1e4\n1000,2e4,3e4\n");
  write("table.toml", R"(format = 1
[operation]
speed = "500 rpm"
[[body]]
name = "rotor"
mass = 1
[[bearing]]
body = "rotor"
table = "bearing.csv"
)");
  const json first = result({"modes", "table.toml", "--out", "a.h5"});
  std::filesystem::remove(folder / "bearing.csv");
  EXPECT_EQ(result({"rerun", "a.h5"}), first);
  EXPECT_NEAR(first["modes"][0]["eigenvalue"][1], std::sqrt(1.5e4), 1e-6);
}

// ---- pictures ----

constexpr const char* read_collection = R"(
import sys, os, xml.etree.ElementTree as ET
root = ET.parse(sys.argv[1]).getroot()
assert root.tag == "VTKFile" and root.attrib["type"] == "Collection"
frames = root.findall("Collection/DataSet")
times = [float(f.attrib["timestep"]) for f in frames]
assert times == sorted(times) and len(set(times)) == len(times), times
for f in frames: assert os.path.getsize(os.path.join(os.path.dirname(sys.argv[1]), f.attrib["file"])) > 0
print(len(frames))
)";

TEST_F(Results, AreExportedForParaView) {
  make("identify");
  const json r = result({"export", "identify.h5", "--format", "vtk", "--out", "run_1.5mm",
                         "--revolutions", "2", "--frames", "8", "--modes", "1"});
  EXPECT_EQ(r["model"], "identify.h5");
  const std::vector<std::string> files = r["files"];
  ASSERT_GE(files.size(), 9u);
  for (const std::string& file : files) {
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  }
  EXPECT_EQ(files[0], "run_1.5mm.pvd");
  const Outcome read = wait(start(python, {"-c", read_collection, "run_1.5mm.pvd"}));
  EXPECT_EQ(read.status, 0) << read.err;
  EXPECT_EQ(read.out, "8\n");
}

TEST_F(Results, ModelsAreExportedAsModes) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  const json r = result({"export", model, "--out", "rotor", "--modes", "2"});
  EXPECT_EQ(wait(start(python, {"-c", read_collection, "rotor_mode2.pvd"})).status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "rotor_mode3.pvd"));
  const Outcome text = whirl({"export", "rub.toml"});
  EXPECT_EQ(text.status, 0);
  EXPECT_TRUE(has(text.out, "rub_mode")) << text.out;
}

TEST_F(Results, AMotionIsNotExportedOnAnotherRotor) {
  const std::string model = WHIRL_SOURCE_DIR "/models/two_disk_mac.toml";
  ASSERT_EQ(whirl({"simulate", model, "--discard", "0", "--revolutions", "2", "--out", "run.h5",
                   "--quiet"})
                .status,
            0);
  const Outcome outcome = whirl({"export", "run.h5", "--set", "shaft.1.elements=24"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.err, "leave out --set")) << outcome.err;
}

}  // namespace result_file_test
}  // namespace whirl::test
