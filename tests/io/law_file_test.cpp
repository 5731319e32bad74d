// Laws of supports in files of other programs: a pedestal as universal file, MATLAB and HDF5 file
// is the one that a table of text says.

#include "libio/measured/law_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/matlab_variables.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::law_file_test {

namespace fs = std::filesystem;

const std::string machine = R"(format = 1
[[body]]
name = "disk"
mass = 10
[[support]]
name = "pedestal"
body = "disk"
)";

// 4 kg on 4 MN/m and 500 N.s/m under a bearing of 1 MN/m
constexpr double mass = 4.0, damping = 500.0, held = 5e6, bearing = 1e6;
constexpr Complex pole{-62.5, 1116.28569372};  // (-500 +- sqrt(500^2 - 4 4 5e6)) / 8
constexpr double residue = 111978502.19117;    // bearing^2 / (2 mass Im pole), times i

Complex pedestal(Complex s) {
  return bearing - bearing * bearing / (mass * s * s + damping * s + held);
}

constexpr int samples = 200;

/// Frequencies with few digits [Hz], and what is told at each.
struct Sampled {
  explicit Sampled(const std::function<Complex(Complex)>& told) : hz(samples), H(samples) {
    for (int k = 0; k < samples; ++k) {
      hz(k) = 2.0 + 2.0 * k;
      H(k) = told(Complex(0.0, hz(k) * hertz));
    }
  }
  Vec hz;
  CVec H;
};

/// The law without conversion.
const Sampled& stiffness() {
  static const Sampled all(pedestal);
  return all;
}

void expect_near(Complex found, Complex expected, double within) {
  EXPECT_LT(std::abs(found - expected), within * std::abs(expected)) << found << expected;
}

/// Poles and residues of the law, to 1e-8.
void expect_pedestal(const StateSpace& law) {
  ASSERT_EQ(law.states(), 4);  // of x and of y
  const CVec poles = eigenvalues(law.A.topLeftCorner(2, 2));
  expect_near(poles(poles(0).imag() > 0.0 ? 0 : 1), pole, 1e-8);
  // (s - p) K(s) at p, by a circle around it
  Complex sum = 0.0;
  constexpr int points = 16;
  for (int i = 0; i < points; ++i) {
    const Complex turn = std::polar(100.0, 2.0 * M_PI * i / points);
    sum += turn * law.stiffness_at(pole + turn)(0, 0) / static_cast<double>(points);
  }
  expect_near(sum, Complex(0.0, residue), 1e-8);
  EXPECT_NEAR(law.D(0, 0), bearing, 1e-8 * bearing);
}

class LawFile : public test::InResultFolder {
 protected:
  Support support(const std::string& lines) const {
    return parse_model(machine + lines, "model.toml", {}, NamedFiles(folder).with(law_table))
        .structure.supports.at(0);
  }
  /// The only problem of the machine with these lines.
  std::string problem(const std::string& lines) const {
    try {
      support(lines);
    } catch (const ModelError& error) {
      EXPECT_EQ(error.problems().size(), 1u) << error.what();
      return error.problems().front().key + ": " + error.problems().front().message;
    }
    return "it is read";
  }
  void expect_problem(const std::string& lines, const char* words) const {
    const std::string found = problem(lines);
    EXPECT_NE(found.find(words), std::string::npos) << found;
    EXPECT_NE(found.find("support.pedestal."), std::string::npos) << found;
  }
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  void write_csv(const char* name, const Sampled& s) const {
    std::string text = "frequency [rad/s], real, imaginary\n";
    for (int k = 0; k < samples; ++k) {
      text += fmt::format("{}, {}, {}\n", s.hz(k) * hertz, s.H(k).real(), s.H(k).imag());
    }
    write(name, text);
  }
};

// Universal files ------------------------------------------------------------------------------

/// How a dataset 58 says a response.
struct Universal {
  long of = 9, by = 8;  ///< kinds of ordinate and denominator
  std::string of_unit = "N", by_unit = "m";
  std::string response = "        12   1", reference = "        12   1";
  bool is_even = true, is_double = true;
};

std::string dataset(const Universal& how, const Sampled& s) {
  const auto n = s.hz.size();
  std::string text = fmt::format("    -1\n{:6}\nresponse\nNONE\nNONE\nNONE\nNONE\n", 58);
  text += fmt::format("{:5}{:10}{:5}{:10} {:<10}{} {:<10}{}\n", 4, 1, 0, 0, "NONE", how.response,
                      "NONE", how.reference);
  text += fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n", how.is_double ? 6 : 5, n,
                      how.is_even ? 1 : 0, how.is_even ? s.hz(0) : 0.0,
                      how.is_even ? s.hz(1) - s.hz(0) : 0.0, 0.0);
  const auto axis = [](long kind, const std::string& unit) {
    return fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", kind, 0, 0, 0, "NONE", unit);
  };
  text += axis(18, "Hz") + axis(how.of, how.of_unit) + axis(how.by, how.by_unit) + axis(0, "NONE");
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!how.is_even) text += fmt::format("{:13.5E}", s.hz(k));
    text += how.is_double ? fmt::format("{:20.12E}{:20.12E}", s.H(k).real(), s.H(k).imag())
                          : fmt::format("{:13.5E}{:13.5E}", s.H(k).real(), s.H(k).imag());
    if (!how.is_even || k % 2 == 1 || k + 1 == n) text += '\n';
  }
  return text + "    -1\n";
}

std::string units(double length, double force) {
  return fmt::format(
      "    -1\n   164\n{:10}{:<20}{:10}\n{:25.17E}{:25.17E}{:25.17E}\n{:25.17E}\n"
      "    -1\n",
      1, "some", 2, length, force, 1.0, 273.15);
}

TEST_F(LawFile, UniversalFilesSayThePedestal) {
  const auto stiff = [](Complex s) { return pedestal(s); };
  const auto receptance = [](Complex s) { return 1.0 / pedestal(s); };
  write("stiffness.uff", dataset({}, Sampled(stiff)));
  expect_pedestal(support("response = \"stiffness.uff\"\n").law);
  write("uneven.unv", dataset({.is_even = false}, Sampled(stiff)));
  expect_pedestal(support("response = \"uneven.unv\"\n").law);
  write("receptance.uff",
        dataset({8, 13, "mm", "kN"}, Sampled([&](Complex s) { return 1e6 * receptance(s); })));
  expect_pedestal(support("response = \"receptance.uff\"\n").law);
  write("mobility.uff",
        dataset({11, 13, "m/s", "N"}, Sampled([&](Complex s) { return s * receptance(s); })));
  expect_pedestal(support("response = \"mobility.uff\"\n").law);
  expect_pedestal(support("form = \"mobility\"\nresponse = \"mobility.uff\"\n").law);
  write("accelerance.uff", dataset({12, 13, "g", "N"}, Sampled([&](Complex s) {
                                     return s * s * receptance(s) / 9.80665;
                                   })));
  expect_pedestal(support("response = \"accelerance.uff\"\n").law);
  write("inches.uff", units(1.0 / 0.0254, 1.0 / 4.4482216152605) +
                          dataset({8, 13, "NONE", "NONE"}, Sampled([&](Complex s) {
                                    return receptance(s) / 0.0254 * 4.4482216152605;
                                  })));
  expect_pedestal(support("response = \"inches.uff\"\n").law);
}

TEST_F(LawFile, FunctionsOfAUniversalFileAreChosen) {
  const Sampled x([](Complex s) { return pedestal(s); }),
      xy([](Complex s) { return 0.1 * pedestal(s); }),
      y([](Complex s) { return 2.0 * pedestal(s); });
  const auto at = [](int response, int reference) {
    return Universal{.response = fmt::format("{:10}{:4}", 12, response),
                     .reference = fmt::format("{:10}{:4}", 12, reference)};
  };
  write("all.uff", units(1.0, 1.0) + dataset(at(2, 2), y) + dataset(at(1, 2), xy) +
                       dataset(at(2, 1), xy) + dataset(at(1, 1), x));
  const Complex s{-3.0, 400.0}, K = pedestal(s);
  const auto law_of = [&](const std::string& part) {
    return support(fmt::format("response = \"all.uff#{}\"\n", part)).law.stiffness_at(s)(0, 0);
  };
  expect_near(law_of("12+x"), K, 1e-7);
  expect_near(law_of("12+y"), 2.0 * K, 1e-7);
  expect_near(law_of("12+x/12+y"), 0.1 * K, 1e-7);
  expect_near(law_of("1"), 2.0 * K, 1e-7);
  std::string several = machine;
  several.erase(several.rfind("body = \"disk\""));
  const auto matrix = [&](const std::string& part) {
    return parse_model(several +
                           "interface = [{ body = \"disk\", angle = 0 }, { body = \"disk\", angle "
                           "= \"90 deg\" }]\nresponse = \"all.uff" +
                           part + "\"\n",
                       "model.toml", {}, NamedFiles(folder).with(law_table))
        .structure.supports.at(0)
        .law.stiffness_at(s);
  };
  const CMat found = matrix("#12+x, 12+y");
  expect_near(found(0, 0), K, 1e-7);
  expect_near(found(0, 1), 0.1 * K, 1e-7);
  expect_near(found(1, 1), 2.0 * K, 1e-7);
  expect_near(matrix("")(0, 0), 2.0 * K, 1e-7);  // in the order of the file
  expect_problem("response = \"all.uff\"\n", "2 responses and 2 references, expected 1");
  expect_problem("response = \"all.uff#7\"\n", "has no function 7. Its functions: 1: 12+y/12+y");
  expect_problem("response = \"all.uff#3+x\"\n", "has no function 3+x/3+x");
}

TEST_F(LawFile, WrongUniversalFilesAreTold) {
  const std::string good = dataset({}, stiffness());
  const auto told = [&](const std::string& text, const char* words, const char* form = "") {
    write("bad.uff", text);
    expect_problem(fmt::format("{}response = \"bad.uff\"\n", form), words);
  };
  told("nothing", "has no dataset 58 of a complex frequency response; it has none at all");
  told(good.substr(0, 300), "cut off");
  told(good.substr(0, good.size() / 2), "cut off within its values");
  std::string huge = good;
  huge.replace(huge.find("       200"), 10, "9999999999");
  told(huge, "do not fit into");
  std::string nan = good;
  nan.replace(nan.rfind("E+0") - 16, 20, "                 NaN");
  told(nan, "is not finite");
  told(dataset({0, 0, "NONE", "NONE"}, stiffness()), "does not say of what its values are");
  told(dataset({9, 9, "N", "N"}, stiffness()), "is of kind 9 over 9");
  told(dataset({8, 13, "furlong", "N"}, stiffness()), "its unit");
  told(good, "no receptance: leave form out", "form = \"receptance\"\n");
  told(good + good, "several functions 12+x/12+x");
  told(dataset({.response = "        12   4"}, stiffness()), "of rotations");
  expect_problem("response = \"none.uff\"\n", "No such file");
}

// MATLAB and HDF5 ------------------------------------------------------------------------------

MatlabVariable complex_array(const char* name, std::vector<std::size_t> sizes, const CMat& values) {
  Mat re = values.real(), im = values.imag();
  mat_complex_split_t parts{re.data(), im.data()};
  return {Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(sizes.size()),
                        sizes.data(), &parts, MAT_F_COMPLEX),
          &Mat_VarFree};
}

MatlabVariable real_array(const char* name, const Mat& values) {
  return matlab_numbers(name, {values.data(), values.data() + values.size()},
                        static_cast<std::size_t>(values.rows()),
                        static_cast<std::size_t>(values.cols()));
}

void write_matlab(const fs::path& path, mat_ft level, const std::vector<MatlabVariable>& all) {
  const MatlabFile file(Mat_CreateVer(path.c_str(), nullptr, level), &Mat_Close);
  for (const MatlabVariable& v : all) {
    ASSERT_EQ(Mat_VarWrite(file.get(), v.get(), MAT_COMPRESSION_NONE), 0);
  }
}

const mat_ft levels[] = {MAT_FT_MAT4, MAT_FT_MAT5, MAT_FT_MAT73};

TEST_F(LawFile, ResponsesOfMatlabAndHdf5AreThoseOfText) {
  const Sampled& s = stiffness();
  write_csv("text.csv", s);
  const StateSpace expected = support("response = \"text.csv\"\n").law;
  expect_pedestal(expected);
  for (const mat_ft level : levels) {
    std::vector<MatlabVariable> all;
    all.push_back(real_array("frequency", s.hz));
    all.push_back(complex_array("response", {samples, 1}, s.H));
    write_matlab(folder / "file.mat", level, all);
    EXPECT_EQ(support("response = \"file.mat\"\n").law, expected) << level;
  }
  std::vector<MatlabVariable> pages;  // as frd objects have them
  pages.push_back(real_array("omega", Mat(hertz * s.hz.transpose())));
  pages.push_back(complex_array("H", {1, 1, samples}, s.H));
  write_matlab(folder / "pages.mat", MAT_FT_MAT5, pages);
  EXPECT_EQ(support("response = \"pages.mat\"\n").law, expected);

  ResultWriter file(folder / "file.h5", Replaces::anything);
  file.dataset("/omega", Vec(hertz * s.hz), {"rad/s", "", {""}});
  file.dataset("/response", s.H, {"", "", {""}});
  file.dataset("/stand/frequency", s.hz, {"Hz", "", {""}});
  file.dataset("/stand/response", CMat(s.H), {"", "", {"", ""}});
  file.commit();
  EXPECT_EQ(support("response = \"file.h5\"\n").law, expected);
  EXPECT_EQ(support("response = \"file.h5#stand\"\n").law, expected);
  // a form is that of the numbers
  const Complex at{-3.0, 400.0};
  expect_near(support("response = \"file.h5\"\nform = \"impedance\"\norder = 2\n")
                  .law.stiffness_at(Complex(0.0, 300.0))(0, 0),
              Complex(0.0, 300.0) * pedestal(Complex(0.0, 300.0)), 1e-6);
  expect_near(expected.stiffness_at(at)(0, 0), pedestal(at), 1e-8);
}

TEST_F(LawFile, StateSpacesOfFilesAreThoseOfTheModel) {
  const Mat A = (Mat(2, 2) << -damping / mass, -held / mass, 1.0, 0.0).finished();
  const Mat B = (Mat(2, 1) << 1.0, 0.0).finished();
  const Mat C = (Mat(1, 2) << 0.0, -bearing * bearing / mass).finished();
  const Mat D = Mat::Constant(1, 1, bearing);
  const StateSpace expected =
      support("A = [[-125, -1.25e6], [1, 0]]\nB = [1, 0]\nC = [0, -2.5e11]\nD = [[1e6]]\n").law;
  expect_pedestal(expected);
  const auto matrices = [&] {
    std::vector<MatlabVariable> all;
    all.push_back(real_array("A", A));
    all.push_back(real_array("B", B));
    all.push_back(real_array("C", C));
    all.push_back(real_array("D", D));
    return all;
  };
  for (const mat_ft level : levels) {
    write_matlab(folder / "file.mat", level, matrices());
    EXPECT_EQ(support("state_space = \"file.mat\"\n").law, expected) << level;
  }
  for (const mat_ft level : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const char* names[] = {"A", "B", "C", "D"};
    std::size_t one[] = {1, 1};
    std::vector<MatlabVariable> all;
    all.emplace_back(Mat_VarCreateStruct("sys", 2, one, names, 4), &Mat_VarFree);
    std::vector<MatlabVariable> fields = matrices();
    for (std::size_t k = 0; k < 4; ++k) {
      Mat_VarSetStructFieldByName(all[0].get(), names[k], 0, fields[k].release());
    }
    write_matlab(folder / "struct.mat", level, all);
    EXPECT_EQ(support("state_space = \"struct.mat#sys\"\n").law, expected) << level;
  }
  ResultWriter file(folder / "file.h5", Replaces::anything);
  const std::vector<std::pair<const char*, Mat>> named{{"A", A}, {"B", B}, {"C", C}, {"D", D}};
  for (const auto& [name, M] : named) {
    file.dataset(fmt::format("/law/{}", name), M, {"", "", {"", ""}});
  }
  file.commit();
  EXPECT_EQ(support("state_space = \"file.h5#law\"\n").law, expected);
  write("file.csv", "# by hand\nA, -125, -1.25e6\nA, 1, 0\nB, 1\nB, 0\nC, 0, -2.5e11\nD, 1e6\n");
  EXPECT_EQ(support("state_space = \"file.csv\"\n").law, expected);
  write("file.mtx",
        "%%MatrixMarket matrix array real general\n% states 2\n3 3\n-125\n1\n0\n-1.25e6\n0\n"
        "-2.5e11\n1\n0\n1e6\n");
  EXPECT_EQ(support("state_space = \"file.mtx\"\n").law, expected);

  // what is stored says the same without the file
  const Model model = parse_model(machine + "state_space = \"file.mat\"\n", "model.toml", {},
                                  NamedFiles(folder).with(law_table));
  const Model stored = parse_model(model.source);
  EXPECT_EQ(stored.structure.supports.at(0).law, expected);
  EXPECT_EQ(stored.source, model.source);
}

TEST_F(LawFile, ControllersOfMagneticBearingsAreReadFromFiles) {
  const std::string head =
      "format = 1\n[[body]]\nname = \"disk\"\nmass = 10\n[[magnetic_bearing]]\nname = \"left\"\n"
      "body = \"disk\"\ncurrent_stiffness = 200\nnegative_stiffness = 1e6\n";
  const auto law = [&](const std::string& lines) {
    return parse_model(head + lines, "model.toml", {}, NamedFiles(folder).with(law_table))
        .structure.supports.at(0)
        .law;
  };
  std::vector<MatlabVariable> all;
  all.push_back(real_array("A", Mat::Constant(1, 1, -2000.0)));
  all.push_back(real_array("B", Mat::Constant(1, 1, 1.0)));
  all.push_back(real_array("C", Mat::Constant(1, 1, -4e7)));
  all.push_back(real_array("D", Mat::Constant(1, 1, 3e4)));
  write_matlab(folder / "file.mat", MAT_FT_MAT5, all);
  EXPECT_EQ(law("state_space = \"file.mat\"\n"),
            law("A = [[-2000]]\nB = [[1]]\nC = [[-4e7]]\nD = [[3e4]]\n"));
}

TEST_F(LawFile, WrongFilesOfMatlabAndHdf5AreTold) {
  const auto told = [&](const std::vector<MatlabVariable>& all, const char* words,
                        const char* key = "state_space") {
    write_matlab(folder / "bad.mat", MAT_FT_MAT5, all);
    expect_problem(fmt::format("{} = \"bad.mat\"\n", key), words);
  };
  const auto with = [](MatlabVariable a, MatlabVariable b) {
    std::vector<MatlabVariable> all;
    all.push_back(std::move(a));
    all.push_back(std::move(b));
    return all;
  };
  const Mat two = Mat::Identity(2, 2);
  told(with(real_array("x", two), real_array("y", two)), "has no matrices A, B, C and D");
  told(with(real_array("A", two), real_array("B", two)), "C: missing, expected a matrix");
  told(with(real_array("D", two), real_array("A", Mat::Constant(1, 1, NAN))),
       "A: number 1 of row 1 is not finite");
  told(with(complex_array("D", {2, 2}, Complex(0.0, 1.0) * two), real_array("y", two)),
       "D: has complex numbers, expected real ones");
  told(with(real_array("D", Mat::Zero(100'001, 1)), real_array("y", two)), "too many numbers");
  told(with(real_array("omega", Vec::LinSpaced(5, 1.0, 5.0)), real_array("H", Vec::Ones(5))),
       "H: has real numbers, expected complex ones", "response");
  told(with(real_array("omega", Vec::LinSpaced(5, 1.0, 5.0)),
            complex_array("H", {4, 1}, CVec::Ones(4))),
       "found 4 x 1, expected numbers for each of 5 frequencies", "response");
  told(with(real_array("omega", Vec::LinSpaced(5, 5.0, 1.0)),
            complex_array("H", {5, 1}, CVec::Ones(5))),
       "frequencies must ascend", "response");
  told(with(real_array("omega", Vec::LinSpaced(5, 1.0, 5.0)),
            complex_array("H", {5, 4}, CMat::Ones(5, 4))),
       "has 4 entries at each frequency, expected 1", "response");

  expect_problem("state_space = \"bad.mat#sys\"\n", "sys: is no variable of the file");
  const std::string whole = test::content(folder / "bad.mat");
  write("cut.mat", whole.substr(0, whole.size() - 40));
  expect_problem("response = \"cut.mat\"\n", "cut off");
  write("text.mat", "no MATLAB file");
  expect_problem("response = \"text.mat\"\n", "is no MATLAB file");
  write("text.h5", "no HDF5 file");
  expect_problem("response = \"text.h5\"\n", "not an HDF5 file");
  expect_problem("state_space = \"text.uff\"\n", "a universal file has no state space");
  expect_problem("state_space = \"bad.mat\"\nD = [[1]]\n", "found two laws");
  write("bad.mtx", "%%MatrixMarket matrix array real general\n1 1\n5\n");
  EXPECT_NE(problem("state_space = \"bad.mtx\"\n").find("% states 2"), std::string::npos);
  write("bad.csv", "A, 1, 2\nA, 1\nx, 3\n");
  EXPECT_THROW(support("state_space = \"bad.csv\"\n"), ModelError);
}

// A text of a stranger opens none of these files, and a program without the libraries says so.
TEST_F(LawFile, NothingIsOpenedThatNobodyAskedFor) {
  for (const char* line : {"response = \"file.uff\"\n", "state_space = \"file.mat\"\n"}) {
    for (const NamedFiles& none : {NamedFiles(), NamedFiles::of_sets_in(folder)}) {
      try {
        parse_model(machine + line, "stored.toml", {}, none.with(law_table));
        ADD_FAILURE() << line;
      } catch (const ModelError& error) {
        EXPECT_NE(std::string(error.what()).find("no file is opened"), std::string::npos);
      }
    }
    try {
      parse_model(machine + line, "model.toml", {}, folder);
      ADD_FAILURE() << line;
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("need a program"), std::string::npos);
    }
  }
}

}  // namespace whirl::law_file_test
