// Rotors that ROSS saved become models whose eigenvalues are those of ROSS's own matrices.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "libfe/modes.hpp"
#include "libio/import/import_file.hpp"
#include "libio/import/parse_json.hpp"
#include "libio/import/ross_model.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::ross_import_test {

namespace fs = std::filesystem;
using nlohmann::json;

std::string content(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

fs::path saved(const std::string& name) {
  if (name == "layered.json") return fs::path(WHIRL_SOURCE_DIR) / "models/layered_ross.json";
  return fs::path(WHIRL_TEST_DATA) / "ross" / name;
}

// A key that stands twice would count once, the last one for Python; a number beyond all doubles would be
// infinite: both are refused in words. A byte-order mark counts for nothing.
TEST(OfRoss, JsonOfOtherWritersIsReadOrRefused) {
  const auto problem = [](const std::string& text) {
    try {
      parse_json(text, "a.json");
    } catch (const ModelError& error) {
      return describe(error.problems().at(0));
    }
    return std::string("none");
  };
  EXPECT_EQ(problem("{\"a\": {\"n\": 1,\n\"m\": 2,\n\"n\": 3}}"),
            "a.json:3:1: n: this key is there already, in line 1; expected it once");
  EXPECT_EQ(problem("{\"a\": {\"n\": 1}, \"b\": {\"n\": 1}}"), "none");
  EXPECT_EQ(problem("[1,\n1e400]"),
            "a.json:2:1: found '1e400', expected a number of less than 1.8e308");
  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_bom_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "bom.json") << "\xef\xbb\xbf" << content(saved("layered.json"));
  EXPECT_FALSE(
      import_file(folder / "bom.json", folder / "m.toml", Replaces::own_pictures).files.empty());
  fs::remove_all(folder);
}

ImportedModel imported(const std::string& text, const std::string& name) {
  const ConfigNode root = name.ends_with(".json") ? parse_json(text, name) : parse_toml(text, name);
  return model_of(read_ross(root), name, "rotor");
}

/// The model as it is read from its files.
Model model_in_files(const ImportedModel& written) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_ross_test_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "rotor.toml") << written.text;
  for (const ImportedTable& table : written.tables) {
    std::ofstream(folder / table.name) << table.text;
  }
  Model model = read_model(folder / "rotor.toml");
  fs::remove_all(folder);
  return model;
}

/// What is wrong with a file, or "nothing".
std::string refusal(const std::string& text, const std::string& name = "rotor.toml") {
  try {
    imported(text, name);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "nothing";
}

struct SavedRotor : testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(SavedRotor, HasTheEigenvaluesOfRoss) {
  const auto [rotor, ending] = GetParam();
  const std::string name = fmt::format("{}.{}", rotor, ending);
  const Model model = model_in_files(imported(content(saved(name)), name));
  const Assembler assembler(model.structure);
  const json expected = json::parse(content(saved("expected.json"))).at("rotors").at(rotor);
  for (const json& state : expected) {
    const json& values = state.at("eigenvalues_1_s");
    const double Omega = state.at("speed_rad_s");
    SCOPED_TRACE(Omega);
    std::vector<Complex> found;
    const Modes modes = complex_modes(assembler.at(Omega), static_cast<int>(values.size()) + 4);
    for (const Mode& mode : modes.oscillatory) found.push_back(mode.lambda);
    for (const Complex& lambda : modes.overdamped) found.push_back(lambda);  // ROSS lists some
    for (const json& value : values) {
      const Complex lambda(value.at(0), value.at(1));
      const auto nearest = std::min_element(found.begin(), found.end(), [&](auto a, auto b) {
        return std::abs(a - lambda) < std::abs(b - lambda);
      });
      ASSERT_NE(nearest, found.end());
      EXPECT_LT(std::abs(*nearest - lambda), 1e-7 * std::abs(lambda)) << lambda;
      found.erase(nearest);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfRoss, SavedRotor,
                         testing::Combine(testing::Values("layered", "supports", "tables"),
                                          testing::Values("toml", "json")));

// Equal elements become one segment, equal layers one layer; names stay.
TEST(RossImport, IsAModelThatAPersonCanRead) {
  const Model model = model_in_files(imported(content(saved("layered.toml")), "layered.toml"));
  EXPECT_EQ(model.structure.shaft.size(), 1U);
  EXPECT_EQ(model.structure.shaft.front().elements, 8);
  EXPECT_EQ(model.structure.layers.size(), 2U);
  EXPECT_EQ(model.structure.disks.at(1).name, "wheel 2");
  EXPECT_EQ(model.structure.bearings.at(0).name, "left");
  const Model tables = model_in_files(imported(content(saved("tables.json")), "tables.json"));
  EXPECT_EQ(tables.structure.seals.at(0).name, "balance piston");
  const Model supports = model_in_files(imported(content(saved("supports.json")), "supports.json"));
  EXPECT_EQ(supports.structure.bodies.at(1).name, "pedestal right");
}

/// A shaft of one element on two bearings, as ROSS saves it.
const std::string small = R"(
ross_version = "3.0.0"
["ShaftElement_a"]
L = 0.5
idl = 0.0
odl = 0.05
idr = 0.0
odr = 0.05
n = 0
shear_method_calc = "hutchinson"
["ShaftElement_a".material]
name = "steel"
rho = 7800.0
E = 2e11
G_s = 8e10
)";

// Solid section, nu = 0.25: 6 (1 + nu) / (7 + 12 nu + 4 nu^2) without the square of 1 + nu.
TEST(RossImport, WritesTheShearCoefficientThatRossHas) {
  const ImportedModel model = imported(small, "rotor.toml");
  const double kappa = 6.0 * 1.25 / (7.0 + 3.0 + 0.25);
  EXPECT_NE(model.text.find(fmt::format("shear_coefficient = {}", kappa)), std::string::npos)
      << model.text;
  EXPECT_NE(model.taken_differently.at(0).find("Hutchinson"), std::string::npos);
}

// Since 3.0 `frequency` is that of the whirl; before, it was the speed.
TEST(RossImport, TakesFrequenciesAsTheirVersionMeansThem) {
  const std::string bearing =
      "[BearingElement_left]\nn = 0\nkxx = [1e7, 2e7]\ncxx = [1e3, 1e3]\n"
      "frequency = [100.0, 200.0]\n";
  const auto head = [&](const std::string& text) {
    return imported(text, "rotor.toml").tables.at(0).text.substr(0, 13);
  };
  EXPECT_EQ(head(small + bearing), "whirl [rad/s]");
  std::string earlier = small;
  earlier.replace(earlier.find("3.0.0"), 5, "2.3.0");
  EXPECT_EQ(head(earlier + bearing), "speed [rad/s]");
}

// A list of lists: over the frequencies of each speed.
TEST(RossImport, ReadsCoefficientsOverSpeedAndFrequency) {
  const std::string bearing =
      "[BearingElement_left]\nn = 0\nspeed = [10.0, 20.0]\nfrequency = [1.0, 2.0, 3.0]\n"
      "kxx = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]\n";
  EXPECT_EQ(imported(small + bearing, "rotor.toml").tables.at(0).text,
            "speed [rad/s], whirl [rad/s], kxx [N/m]\n"
            "10, 1, 1\n10, 2, 2\n10, 3, 3\n20, 1, 4\n20, 2, 5\n20, 3, 6\n");
}

// Seals push their rotors off; two things of one name have a table each; a version of two lines is
// a comment of one; a coupling without a diameter takes one.
TEST(RossImport, TakesWhatIsUnusual) {
  std::string text = small;
  text.replace(text.find("3.0.0"), 5, "3.0\\nnonsense");
  text +=
      "[SealElement_1]\nn = 0\nkxx = -1e5\nkyy = -1e5\ntag = \"A B\"\nfrequency = [1.0]\n"
      "[SealElement_2]\nn = 1\nkxx = -1e5\nkyy = -1e5\n"
      "[BearingElement_3]\nn = 1\nkxx = [1e7, 2e7]\ntag = \"A B\"\nspeed = [1.0, 2.0]\n"
      "[CouplingElement_4]\nn = 1\nL = 0.1\nm_l = 1.0\nm_r = 2.0\nkt_x = 1e6\nkt_y = 1e6\n";
  const ImportedModel written = imported(text, "rotor.toml");
  ASSERT_EQ(written.tables.size(), 2U);
  EXPECT_NE(written.tables[0].name, written.tables[1].name);
  const Model model = model_in_files(written);
  EXPECT_EQ(model.structure.seals.size(), 2U);
  EXPECT_EQ(model.structure.links.size(), 1U);
  EXPECT_EQ(model.structure.shaft.at(1).left.outer, 0.05);
}

TEST(RossImport, RefusesWhatAModelCannotSay) {
  const std::string link =
      "[BearingElement_a]\nn = 0\nn_link = 1\nkxx = [1e7, 2e7]\nspeed = [1.0, 2.0]\n";
  EXPECT_NE(refusal(small + link).find("two nodes of the shaft"), std::string::npos);
  const std::string ragged = "[BearingElement_a]\nn = 0\nkxx = [[1e7], 2e7]\nspeed = [1.0, 2.0]\n";
  EXPECT_NE(refusal(small + ragged).find("expected a list for every speed"), std::string::npos);
  const std::string unequal =
      "[BearingElement_a]\nn = 0\nkxx = [1.0, 2.0, 3.0]\n"
      "speed = [1.0, 2.0, 3.0]\nfrequency = [1.0, 2.0]\n";
  EXPECT_NE(refusal(small + unequal).find("3 values for 3 speeds"), std::string::npos);
}

// Speeds are those of the model; what has no place in it is said.
TEST(RossImport, TellsWhatItTakesAndWhatNot) {
  const ImportedModel written = imported(
      small +
          "[parameters]\nrated_w = 500.0\nmin_w = 400.0\nmax_w = 550.0\n"
          "[CouplingElement_c]\nn = 1\nL = 0.1\nm_l = 1.0\nkt_x = 1e6\nkt_y = 1e6\nkt_z = 1e5\n"
          "kr_z = 2e5\n"
          "[GearElement_g]\nn = 0\nm = 3.0\nId = 0.01\nIp = 0.02\npitch_diameter = 0.2\n",
      "rotor.toml");
  const Model model = model_in_files(written);
  EXPECT_TRUE(model.has_speed);
  EXPECT_EQ(model.speed, 500.0);
  EXPECT_EQ(model.machine.minimum, 400.0);
  EXPECT_EQ(model.machine.maximum, 550.0);
  const auto has = [](const std::vector<std::string>& all, const std::string& sentence) {
    return std::find(all.begin(), all.end(), sentence) != all.end();
  };
  EXPECT_TRUE(has(written.left_out, "kt_z of \"c\": motion along the axis"));
  EXPECT_TRUE(has(written.left_out, "kr_z of \"c\": turning about the axis"));
  EXPECT_TRUE(has(written.taken_differently,
                  "the gear \"g\" is a disk: the forces of its teeth are left out"));
  const ImportedModel odd =
      imported(small + "[parameters]\nrated_w = -5.0\nmin_w = 9.0\nmax_w = 8.0\n", "rotor.toml");
  EXPECT_EQ(odd.text.find("[operation]"), std::string::npos);
  EXPECT_TRUE(has(odd.left_out, "rated_w = -5: below zero"));
  EXPECT_TRUE(has(odd.left_out, "min_w and max_w: the first one is above the other"));
}

TEST(RossImport, SaysAMistakeOnce) {
  std::string text = small;
  text.replace(text.find("odl = 0.05"), 10, "odl = \"x\"");
  for (const std::string& wrong : {text, small + "[BearingElement_a]\nn = 0\nkxx = \"x\"\n",
                                   small + "[X_a]\nn = inf\nkxx = 1.0\n"}) {
    const std::string told = refusal(wrong);
    EXPECT_NE(told.find("expected a number"), std::string::npos) << told;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
  }
}

// "[" begins a table of TOML, too: the name tells.
TEST(RossImport, AListIsNoRotor) {
  const fs::path file =
      fs::path(testing::TempDir()) / ("whirl_ross_list_" + std::to_string(::getpid()) + ".json");
  std::ofstream(file) << "[1, 2]\n";
  std::string told;
  try {
    import_file(file, file.string() + ".toml", Replaces::anything);
  } catch (const ModelError& error) {
    told = error.what();
  }
  fs::remove(file);
  EXPECT_NE(told.find("no shaft elements of ROSS"), std::string::npos) << told;
}

TEST(RossImport, SaysWhereAFileIsWrong) {
  EXPECT_NE(refusal("a = 1\n").find("no shaft elements of ROSS"), std::string::npos);
  std::string text = small;
  text.replace(text.find("0.5"), 3, "\"x\"");
  EXPECT_NE(refusal(text).find("rotor.toml:4:"), std::string::npos) << refusal(text);
  EXPECT_NE(refusal(text).find("expected a number"), std::string::npos) << refusal(text);
  EXPECT_NE(refusal("{\n\"a\": [1,\n}", "rotor.json").find("rotor.json:3"), std::string::npos)
      << refusal("{\n\"a\": [1,\n}", "rotor.json");
  const std::string unequal = small + "[BearingElement_left]\nn = 0\nkxx = [1.0, 2.0]\n";
  EXPECT_NE(refusal(unequal).find("2 values for 0 speeds"), std::string::npos) << refusal(unequal);
}

}  // namespace whirl::ross_import_test
