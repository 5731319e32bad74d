// Rotors that ROSS saved become models whose eigenvalues are those of ROSS's own matrices.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "libfe/analyses/modes.hpp"
#include "libio/import/import_file.hpp"
#include "libio/import/parse_json.hpp"
#include "libio/import/ross_model.hpp"
#include "libio/model/model_file.hpp"
#include "tests/io/ross_files.hpp"

namespace whirl::ross_import_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::has_part;
using test::imported;
using test::model_in_files;
using test::refusal;

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

// A key that stands twice would count once, the last one for Python; a number beyond all doubles
// would be infinite: both are refused in words. A byte-order mark counts for nothing.
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
            "speed [rad/s], whirl [rad/s], kxx [N/m], kyy [N/m]\n"
            "10, 1, 1, 1\n10, 2, 2, 2\n10, 3, 3, 3\n20, 1, 4, 4\n20, 2, 5, 5\n20, 3, 6, 6\n");
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
  EXPECT_NE(refusal(small + link).find("two nodes of shafts"), std::string::npos);
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

/// A shaft of six elements with a disk in the middle, as ROSS saves it; `rest` is what else the
/// file has.
std::string wheel(const std::string& version, const std::string& rest) {
  std::string text = fmt::format("ross_version = \"{}\"\n", version);
  for (int n = 0; n < 6; ++n) {
    text += fmt::format(
        "[ShaftElement_S{0}]\nn = {0}\nL = 0.2\nidl = 0.0\nodl = 0.05\nshear_method_calc = "
        "\"cowper\"\n[ShaftElement_S{0}.material]\nname = \"Steel\"\nrho = 7850.0\nE = 2.05e11\n"
        "G_s = 78846153846.15384\n",
        n);
  }
  return text + "[DiskElement_wheel]\nn = 3\nm = 20.0\nId = 0.1\nIp = 0.18\n" + rest;
}

/// Two bearings at the ends of the wheel's shaft.
std::string two_bearings(const std::string& keys, const std::string& kind = "BearingElement") {
  return fmt::format("[{1}_A]\nn = 0\n{0}[{1}_B]\nn = 6\n{0}", keys, kind);
}

/// Damped frequencies in rpm and damping ratios of the lowest modes.
std::vector<std::pair<double, double>> lowest_modes(const ImportedModel& written, double Omega) {
  const Model model = model_in_files(written);
  std::vector<std::pair<double, double>> found;
  for (const Mode& mode : complex_modes(Assembler(model.structure).at(Omega), 2).oscillatory) {
    found.emplace_back(mode.lambda.imag() * 30.0 / 3.14159265358979, mode.damping_ratio());
  }
  return found;
}

// Damping of the whole rotor was dropped without a word: decrements of zero. The reference is ROSS
// 3.0's, 2224.83 rpm and 0.019496, which C = 8 M + 2e-5 K gives, too.
TEST(RossImport, HasTheDampingOfTheWholeRotor) {
  const std::string bearings = two_bearings("kxx = 1e7\nkyy = 1e7\n");
  const ImportedModel written =
      imported(wheel("3.0.0", bearings + "[parameters]\nalpha = 8.0\nbeta = 2e-5\n"), "r.toml");
  const auto [rpm, zeta] = lowest_modes(written, 0.0).at(0);
  EXPECT_NEAR(rpm, 2224.83, 0.005);
  EXPECT_NEAR(zeta, 0.019496, 5e-7);

  const ImportedModel one =
      imported(wheel("3.0.0", bearings + "[parameters]\ndefault_damping_ratio = 0.03\n"), "r.toml");
  EXPECT_NEAR(lowest_modes(one, 0.0).at(0).second, 0.03, 1e-9);
  EXPECT_TRUE(has_part(one.taken_differently, "damping ratios of modes"));
  const ImportedModel list = imported(
      wheel("3.0.0", bearings + "[parameters]\nmodal_damping_ratio = [0.01, 0.02]\n"), "r.toml");
  const auto listed = lowest_modes(list, 0.0);  // two of one frequency, in either order
  EXPECT_NEAR(std::min(listed.at(0).second, listed.at(1).second), 0.01, 1e-9);
  EXPECT_NEAR(std::max(listed.at(0).second, listed.at(1).second), 0.02, 1e-9);
  EXPECT_NE(list.text.find("modal    = [0.01, 0.02]"), std::string::npos) << list.text;
  const ImportedModel wrong = imported(
      wheel("3.0.0", bearings + "[parameters]\nalpha = -1.0\nmodal_damping_ratio = [2.0]\n"),
      "r.toml");
  EXPECT_EQ(wrong.text.find("[damping]"), std::string::npos);
  EXPECT_TRUE(has_part(wrong.left_out, "alpha = -1: below zero"));
  EXPECT_TRUE(has_part(wrong.left_out, "damping ratios of modes"));
}

// ROSS 3 has PCHIP between the rows of a table; straight lines give 1958.4 rpm at 150 rad/s where
// ROSS gives 1931.8 and 1932.3. Earlier ones lay splines through them, which is said.
TEST(RossImport, InterpolatesTablesAsItsVersionDoesOrSaysSo) {
  const std::string bearings = two_bearings(
      "kxx = [2e6, 3e6, 8e6, 9e6, 9.5e6]\nkyy = [2e6, 3e6, 8e6, 9e6, 9.5e6]\n"
      "cxx = [1e3, 1e3, 1e3, 1e3, 1e3]\ncyy = [1e3, 1e3, 1e3, 1e3, 1e3]\n"
      "speed = [100.0, 200.0, 300.0, 400.0, 600.0]\n");
  const ImportedModel written = imported(wheel("3.0.0", bearings), "rotor.toml");
  const auto modes = lowest_modes(written, 150.0);
  EXPECT_NEAR(modes.at(0).first, 1931.8, 0.05);
  EXPECT_NEAR(modes.at(1).first, 1932.3, 0.05);
  EXPECT_FALSE(has_part(written.taken_differently, "splines"));
  EXPECT_TRUE(has_part(written.taken_differently, "beyond the ends of a table"));
  EXPECT_TRUE(has_part(imported(wheel("2.3.0", bearings), "rotor.toml").taken_differently,
                       "ROSS before 3.0 lays smoothing splines"));
}

// What is left out along y is as along x in ROSS, and was zero here without a word.
TEST(RossImport, TakesWhatIsLeftOutAlongYAsAlongX) {
  const std::string text =
      imported(wheel("3.0.0", two_bearings("kxx = 1e7\ncxx = 50.0\nkyy = 2e7\nmxx = 0.5\n")),
               "r.toml")
          .text;
  EXPECT_NE(text.find("stiffness  = { xx = 1e7, yy = 2e7 }"), std::string::npos) << text;
  EXPECT_NE(text.find("damping    = 50"), std::string::npos);
  EXPECT_NE(text.find("added_mass = 0.5"), std::string::npos);
}

// Before 3.0 `frequency` was the speed, but of what is made for a frequency of the whirl.
TEST(RossImport, TakesFrequenciesOfDampersForThoseOfTheWhirl) {
  const std::string table = "kxx = [1e7, 2e7]\ncxx = [1e3, 1e3]\nfrequency = [100.0, 200.0]\n";
  for (const char* kind : {"SqueezeFilmDamper", "MagneticBearingElement"}) {
    const ImportedModel written = imported(wheel("2.3.0", two_bearings(table, kind)), "rotor.toml");
    EXPECT_EQ(written.tables.at(0).text.substr(0, 13), "whirl [rad/s]") << kind;
  }
}

TEST(RossImport, SaysThatANodeIsMissing) {
  std::string coaxial = wheel("3.0.0", two_bearings("kxx = 1e7\n"));
  for (const char* key : {"n = 5\n", "n = 4\n"}) {  // 0 to 4 and 6 to 8
    const auto at = coaxial.find(key);
    coaxial.replace(at, 6, key[4] == '5' ? "n = 7\n" : "n = 6\n");
  }
  EXPECT_NE(refusal(coaxial).find(
                "there are 2 shafts, with the nodes 0 to 4, 6 to 8, and neither an element "
                "nor a support at node 5"),
            std::string::npos)
      << refusal(coaxial);
}

// Whatever nobody reads is said, by a comparison of keys and no list: in elements, in their
// materials, in the parameters and beside them.
TEST(RossImport, SaysEveryKeyThatItDoesNotRead) {
  std::string text = wheel("3.0.0", two_bearings("kxx = 1e7\nhumidity = 0.3\ncolor = \"red\"\n") +
                                        "[parameters]\nspeed_ratio = 1.5\nrated_w = 10.0\n");
  text.insert(text.find("[ShaftElement_S0.material]") + 27, "specific_heat = 434.0\n");
  text.insert(text.find("[ShaftElement_S0]"), "magic = 3\n");
  const std::vector<std::string> left_out = imported(text, "rotor.toml").left_out;
  EXPECT_TRUE(has_part(left_out, "humidity of 2 elements BearingElement: not known"));
  EXPECT_TRUE(has_part(left_out, "material.specific_heat of \"S0\": not known"));
  EXPECT_TRUE(has_part(left_out, "speed_ratio = 1.5: there is one shaft"));
  EXPECT_TRUE(has_part(left_out, "magic: not known"));
  EXPECT_TRUE(has_part(left_out, "colors and sizes of pictures"));
  EXPECT_EQ(left_out.size(), 5u);
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
