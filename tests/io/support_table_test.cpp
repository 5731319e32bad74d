// [[support]] in model files.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::support_table_test {

const std::string machine = R"(format = 1
[[body]]
name = "disk"
mass = 10
spins = true
[[body]]
name = "casing"
mass = 100
[[link]]
from = "casing"
to = "ground"
stiffness = 1e8
[[support]]
name = "pedestal"
)";

constexpr Complex s{-3.0, 400.0};

Support support_of(const std::string& lines) {
  const Model model = parse_model(machine + lines);
  return model.structure.supports.at(0);
}

/// The first entry of a law at s.
Complex at_s(const Support& support) {
  return support.law.stiffness_at(s)(0, 0);
}

TEST(SupportTable, FormsSayTheSame) {
  const Complex mass_on_spring = 4.0 * s * s + 500.0 * s + 4e6;
  for (const char* lines :
       {"numerator = [4, 500, 4e6]\ndenominator = [1]\n",
        "form = \"receptance\"\nnumerator = [1]\ndenominator = [4, 500, 4e6]\n",
        "form = \"mobility\"\nnumerator = [1, 0]\ndenominator = [4, 500, 4e6]\n",
        "form = \"impedance\"\nnumerator = [4, 500, 4e6]\ndenominator = [1, 0]\n",
        "numerator = [500, 0]\ndenominator = [1]\nmass = 4\nstiffness = \"4 MN/m\"\n",
        // i / (2 m w_d) is the residue of 1 / (m s^2 + c s + k)
        "form = \"receptance\"\npoles = [[-62.5, 998.044963916957]]\n"
        "residues = [[0, -0.00012524485821702988]]\n"}) {
    const Support support = support_of("body = \"disk\"\n" + std::string(lines));
    EXPECT_LT(std::abs(at_s(support) - mass_on_spring), 1e-7 * std::abs(mass_on_spring)) << lines;
    ASSERT_EQ(support.sees.size(), 2u);
    EXPECT_EQ(support.law.stiffness_at(s)(1, 1), at_s(support));
    EXPECT_EQ(support.law.stiffness_at(s)(0, 1), 0.0);
  }
}

TEST(SupportTable, CoordinatesHaveStationsAndDirections) {
  const Support one = support_of(
      "body = \"disk\"\nto = \"casing\"\nangle = \"90 deg\"\n"
      "numerator = [1e6]\ndenominator = [1, 3]\n");
  ASSERT_EQ(one.sees.size(), 1u);
  EXPECT_EQ(one.sees[0].to.body, "casing");
  EXPECT_EQ(one.sees[0].x, 0.0);
  EXPECT_EQ(one.sees[0].y, 1.0);
  EXPECT_EQ(one.sees, one.acts_on);

  const Support two = support_of(
      "interface = [{ body = \"disk\", angle = 0 }, { body = \"casing\", angle = \"45 deg\" }]\n"
      "A = [[-1, 2], [0, -3]]\nB = [[1, 0], [0, 1]]\nC = [[1, 2], [3, 4]]\n"
      "D = [[5, 6], [7, 8]]\nstiffness = 100\n");
  ASSERT_EQ(two.sees.size(), 2u);
  EXPECT_EQ(two.sees[1].at.body, "casing");
  EXPECT_EQ(two.sees[1].to.kind, Station::Kind::ground);
  EXPECT_DOUBLE_EQ(two.sees[1].x, std::sqrt(0.5));
  EXPECT_EQ(two.law.A(0, 1), 2.0);
  EXPECT_EQ(two.law.D(0, 0), 105.0);
  EXPECT_EQ(two.law.D(1, 0), 7.0);
}

void expect_near(Complex found, Complex expected) {
  EXPECT_LT(std::abs(found - expected), 1e-12 * std::abs(expected)) << found << expected;
}

/// The only problem of the machine with these lines.
Problem problem_of(const std::string& lines) {
  try {
    parse_model(machine + lines);
  } catch (const ModelError& error) {
    EXPECT_EQ(error.problems().size(), 1u) << error.what();
    return error.problems().front();
  }
  ADD_FAILURE() << "it is read: " << lines;
  return {};
}

/// A pedestal of two masses as matrices, the first row of which is where the bearing stands.
std::string matrices(const std::string& mass) {
  const auto text = [](const std::string& entries) {
    return "\"\"\"\n%%MatrixMarket matrix coordinate real symmetric\n" + entries + "\"\"\"\n";
  };
  return "mass_matrix = " + text("2 2 1\n" + mass) +
         "stiffness_matrix = " + text("2 2 3\n1 1 1e6\n2 1 -1e6\n2 2 5e6\n") +
         "damping_matrix = " + text("2 2 1\n2 2 500\n");
}

TEST(SupportTable, MatricesOfACasingAreReducedOnce) {
  const std::string lines =
      "interface = [{ body = \"disk\", angle = 0, row = 1 }]\n" + matrices("2 2 4\n");
  const Model model = parse_model(machine + lines);
  const Support& support = model.structure.supports.at(0);
  const Complex expected = 1e6 - 1e12 / (4.0 * s * s + 500.0 * s + 5e6);
  expect_near(at_s(support), expected);
  const Support stiffer = support_of(lines + "stiffness = 100\ndamping = 7\n");
  expect_near(at_s(stiffer), expected + 100.0 + 7.0 * s);
  EXPECT_EQ(stiffer.coordinates->D(0, 0) - support.coordinates->D(0, 0), 100.0);
  // what is stored has the reduced matrices, and says the same to the last bit
  EXPECT_NE(model.source.find("interface of rows 1"), std::string::npos);
  const Model again = parse_model(model.source);
  EXPECT_EQ(again.structure.supports.at(0).law.A, support.law.A);
  EXPECT_EQ(again.structure.supports.at(0).law.D, support.law.D);
  EXPECT_EQ(again.source, model.source);
}

TEST(SupportTable, MatricesThatAreNoCasingAreRefused) {
  const std::string interface = "interface = [{ body = \"disk\", angle = 0, row = 1 }]\n";
  const auto told = [](const std::string& lines, const char* key, const char* words) {
    const Problem problem = problem_of(lines);
    EXPECT_EQ(problem.key, std::string("support.pedestal.") + key) << lines;
    EXPECT_NE(problem.message.find(words), std::string::npos) << problem.message;
  };
  const auto replaced = [](std::string text, const std::string& what, const char* with) {
    return text.replace(text.find(what), what.size(), with);
  };
  const std::string skew =
      replaced(matrices("2 2 4\n"), "symmetric\n2 2 1\n2 2 500", "general\n2 2 1\n2 1 500");
  told(interface + skew, "damping_matrix", "symmetric");
  told("interface = [{ body = \"disk\", angle = 0, row = 3 }]\n" + matrices("2 2 4\n"), "interface",
       "from 1 to 2");
  const std::string loose = replaced(matrices("2 2 4\n"), "2 2 5e6", "2 2 0");
  told(interface + loose, "stiffness_matrix", "moves where its interface is held");
  told(interface + matrices("2 2 4\n") + "form = \"impedance\"\n", "form", "belongs to");
}

std::string response(const std::string& head, const auto& values) {
  std::string text = "\"\"\"\n" + head + "\n";
  for (int k = 1; k <= 80; ++k) {
    const Complex at{0.0, 40.0 * k};
    const Complex H = values(1e6 - 1e12 / (4.0 * at * at + 500.0 * at + 5e6));
    text += fmt::format("{}, {}, {}\n", at.imag(), H.real(), H.imag());
  }
  return text + "\"\"\"\n";
}

TEST(SupportTable, ResponsesAreFitted) {
  const Complex expected = 1e6 - 1e12 / (4.0 * s * s + 500.0 * s + 5e6);
  for (const auto& [form, lines] :
       {std::pair("dynamic stiffness", response("frequency [rad/s], real [N/m], imag [N/m]",
                                                [](Complex K) { return K; })),
        std::pair("receptance", response("frequency [rad/s], re [m/N], im [m/N]",
                                         [](Complex K) { return 1.0 / K; }))}) {
    const Support support =
        support_of(fmt::format("body = \"disk\"\nform = \"{}\"\nresponse = {}", form, lines));
    ASSERT_TRUE(support.fit.has_value());
    EXPECT_EQ(support.fit->poles, 2);
    EXPECT_LT(support.fit->error, 1e-9);
    EXPECT_GE(support.fit->least_damping, -1e-9);
    EXPECT_LT(std::abs(at_s(support) - expected), 1e-6 * std::abs(expected)) << form;
  }
}

TEST(SupportTable, ControllersTakeSensorsElsewhere) {
  const Support support = support_of(
      "sensors = [{ body = \"casing\", angle = 0 }, { body = \"disk\", angle = 0 }]\n"
      "interface = [{ body = \"disk\", angle = \"90 deg\" }]\nD = [[2, 3]]\n");
  EXPECT_EQ(support.sensors, 2);
  ASSERT_EQ(support.sees.size(), 2u);
  EXPECT_EQ(support.sees[0].at.body, "casing");
  ASSERT_EQ(support.acts_on.size(), 1u);
  EXPECT_EQ(support.acts_on[0].y, 1.0);
  EXPECT_EQ(support.law.states(), 0);
  EXPECT_EQ(support.law.D(0, 1), 3.0);
}

TEST(SupportTable, WrongLawsAreToldWithTheirPlace) {
  const auto told = [](const std::string& lines, const char* key, const char* words) {
    const Problem problem = problem_of("body = \"disk\"\n" + lines);
    EXPECT_EQ(problem.key, std::string("support.pedestal.") + key) << lines;
    EXPECT_NE(problem.message.find(words), std::string::npos) << problem.message;
  };
  told("", "numerator", "missing, expected a law");
  told("numerator = [1]\n", "denominator", "missing");
  told("numerator = [1, 0, 0, 0]\ndenominator = [1]\n", "numerator", "square of the frequency");
  told("numerator = [1]\ndenominator = [0]\n", "numerator", "denominator is zero");
  told("poles = [[-1, 2]]\n", "residues", "missing");
  told("poles = [[-1, 2], [-3, 0]]\nresidues = [[1, 2]]\n", "residues", "found 1 rows of 2");
  told("poles = [-1, 2]\nresidues = [1, 2]\nnumerator = [1]\ndenominator = [1]\n", "poles",
       "found two laws");
  told("A = [[1, 2], [3]]\nB = [1, 2]\nC = [1, 2]\n", "A", "all of one length");
  told("A = [[1, 2], [3, 4]]\nB = [1, 2]\nC = [1, 2, 3]\n", "C", "found 1 x 3, expected 1 x 2");
  told("A = [[1, 2], [3, 4]]\nB = [[1, 2, 3], [4, 5, 6]]\nC = [1, 2]\n", "A",
       "3 displacements and 1 forces, expected 2");
  told("response = \"\"\"\nreal, imag\n1, 2\n\"\"\"\nnumerator = [1]\ndenominator = [1, 1]\n",
       "response", "found two laws");
  told("form = \"receptance\"\nD = [[1]]\nangle = 0\n", "form", "belongs to numerator");
  told("to = \"disk\"\nnumerator = [1]\ndenominator = [1, 1]\n", "to", "on itself");
  told("order = 4\nnumerator = [1]\ndenominator = [1, 1]\n", "order", "belongs to a response");
  told("to = \"foundation\"\nnumerator = [1]\ndenominator = [1, 1]\n", "to", "casing");
}

}  // namespace whirl::support_table_test
