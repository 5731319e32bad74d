// Universal files of frequency responses, read back by the columns that the format lays down.

#include "libio/export/universal_file.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::universal_file_test {

/// What stands in columns first to last of a record, counted from 1.
std::string columns(const std::string& record, std::size_t first, std::size_t last) {
  return record.substr(first - 1, last - first + 1);
}
long integer(const std::string& record, std::size_t first, std::size_t last) {
  return std::stol(columns(record, first, last));
}
double number(const std::string& record, std::size_t first, std::size_t last) {
  return std::stod(columns(record, first, last));
}

/// The records of every dataset between its delimiters, its number first.
std::vector<std::vector<std::string>> datasets(const std::string& text) {
  std::vector<std::vector<std::string>> all;
  std::istringstream lines(text);
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "    -1") {
      is_inside = !is_inside;
      if (is_inside) all.emplace_back();
    } else {
      EXPECT_TRUE(is_inside) << line;
      all.back().push_back(line);
    }
  }
  EXPECT_FALSE(is_inside);
  return all;
}

/// A dataset 58 of complex numbers in double precision.
struct Function {
  explicit Function(const std::vector<std::string>& r) : records(r) {
    for (std::size_t i = 1; i < r.size(); ++i) {
      if (i < 12 || i + 1 < r.size()) {
        EXPECT_EQ(r[i].size(), 80u) << r[i];
      }
    }
    EXPECT_EQ(integer(r[0], 1, 6), 58);
    EXPECT_EQ(integer(r[6], 1, 5), 4);     // frequency response function
    EXPECT_EQ(integer(r[7], 1, 10), 6);    // complex, double precision
    EXPECT_EQ(integer(r[8], 1, 10), 18);   // over frequency
    EXPECT_EQ(integer(r[10], 1, 10), 13);  // by an excitation force
    const long count = integer(r[7], 11, 20);
    const bool is_even = integer(r[7], 21, 30) == 1;
    std::size_t record = 12, at = 1;
    for (long i = 0; i < count; ++i) {
      if (at > 80) {
        ++record;
        at = 1;
      }
      if (is_even) {
        hz.push_back(number(r[7], 31, 43) + static_cast<double>(i) * number(r[7], 44, 56));
        H.emplace_back(number(r[record], at, at + 19), number(r[record], at + 20, at + 39));
        at += 40;
      } else {
        hz.push_back(number(r[record], 1, 13));
        H.emplace_back(number(r[record], 14, 33), number(r[record], 34, 53));
        at = 81;
      }
    }
    EXPECT_EQ(record + 1, r.size());
  }
  std::vector<std::string> records;
  std::vector<double> hz;
  std::vector<Complex> H;
};

class Universal : public ::testing::Test {
 protected:
  Universal() {
    model.structure = test::two_disk(test::isotropic(2e7, 1e3));
    model.structure.bodies.push_back({.name = "big stator", .m = 5.0});
    model.structure.bearings.push_back(
        test::bearing(test::body("big stator"), test::isotropic(1e6, 10.0)));
  }
  std::vector<Function> functions(const FrequencyResponse& found) {
    const Assembler assembler(model.structure);
    const auto all = datasets(universal_text(found, model, assembler));
    EXPECT_EQ(integer(all[0][0], 1, 6), 164);  // units
    EXPECT_EQ(integer(all[0][1], 1, 10), 1);   // SI
    EXPECT_EQ(integer(all[0][1], 31, 40), 2);
    std::vector<Function> found_functions;
    for (std::size_t i = 1; i < all.size(); ++i) found_functions.emplace_back(all[i]);
    return found_functions;
  }
  FrequencyResponse response(const std::vector<double>& frequencies, const char* from,
                             const char* to) {
    const Assembler assembler(model.structure);
    return frequency_response(assembler, 300.0, frequencies, select_ends(model, assembler, from),
                              select_ends(model, assembler, to));
  }
  Model model;
};

constexpr double digits = 1e-12;  ///< of E20.12, relative

// All three forms of each pair, values to the digits of the format, nodes and directions.
TEST_F(Universal, HasTheValuesAndThePlaces) {
  std::vector<double> frequencies;
  for (int i = 0; i < 7; ++i) frequencies.push_back(hertz * (10.0 + 2.5 * i));
  const FrequencyResponse found = response(frequencies, "3:x", "5:theta_y,big stator:y");
  const auto all = functions(found);
  ASSERT_EQ(all.size(), 6u);
  const CVec ResponsePair::*forms[] = {&ResponsePair::receptance, &ResponsePair::mobility,
                                       &ResponsePair::accelerance};
  const long data[] = {8, 11, 12};  // displacement, velocity, acceleration
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Function& f = all[i];
    EXPECT_EQ(integer(f.records[9], 1, 10), data[i % 3]);
    EXPECT_EQ(integer(f.records[7], 21, 30), 1);
    EXPECT_NEAR(number(f.records[7], 57, 69), 300.0 / rpm, 1e-2);  // E13.5
    EXPECT_EQ(integer(f.records[6], 6, 15), static_cast<long>(i) + 1);
    EXPECT_EQ(integer(f.records[6], 42, 51), i < 3 ? 5 : 8);  // the body behind seven nodes
    EXPECT_EQ(integer(f.records[6], 52, 55), i < 3 ? 5 : 2);
    EXPECT_EQ(columns(f.records[6], 57, 66), "NONE      ");
    EXPECT_EQ(integer(f.records[6], 67, 76), 3);
    EXPECT_EQ(integer(f.records[6], 77, 80), 1);
    ASSERT_EQ(f.H.size(), frequencies.size());
    for (std::size_t k = 0; k < f.H.size(); ++k) {
      EXPECT_NEAR(f.hz[k], frequencies[k] / hertz, 1e-12);
      const Complex H = (found.pairs[i / 3].*forms[i % 3])(static_cast<Eigen::Index>(k));
      EXPECT_LE(std::abs(f.H[k].real() - H.real()), digits * std::abs(H.real()));
      EXPECT_LE(std::abs(f.H[k].imag() - H.imag()), digits * std::abs(H.imag()));
    }
  }
  EXPECT_EQ(columns(all[3].records[6], 32, 41), "big_stator");
}

// A motion is a displacement or a tilt, by its direction.
TEST_F(Universal, TellsUnits) {
  const auto all = functions(response({hertz, 2.0 * hertz}, "3:theta_x", "5:theta_y,3:y"));
  ASSERT_EQ(all.size(), 6u);
  const char* units[] = {"rad", "rad/s", "rad/s^2", "m", "m/s", "m/s^2"};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string unit = columns(all[i].records[9], 48, 67);
    EXPECT_EQ(unit.substr(0, unit.find(' ')), units[i]);
    EXPECT_EQ(columns(all[i].records[10], 48, 51), "N.m ");
  }
}

// A probe has a node and its name; the format knows no angles.
TEST_F(Universal, HasProbesWhereTheyAre) {
  model.structure.probes = {{.name = "DE 1X", .at = test::node(4), .angle = 0.7}};
  const auto all = functions(response({hertz, 2.0 * hertz}, "3:x", "DE 1X"));
  EXPECT_EQ(columns(all[0].records[6], 32, 41), "DE_1X     ");
  EXPECT_EQ(integer(all[0].records[6], 42, 51), 4);
  EXPECT_EQ(integer(all[0].records[6], 52, 55), 0);
}

// Frequencies that are not even stand beside the values, with the six digits of the format.
TEST_F(Universal, WritesUnevenFrequenciesOneByOne) {
  const std::vector<double> frequencies{hertz * 1.0, hertz * 20.0, hertz * 123.456789};
  const auto all = functions(response(frequencies, "3:forward", "3:forward"));
  EXPECT_EQ(integer(all[0].records[7], 21, 30), 0);
  ASSERT_EQ(all[0].hz.size(), 3u);
  EXPECT_NEAR(all[0].hz[2], 123.456789, 1e-3);
  EXPECT_EQ(integer(all[0].records[6], 52, 55), 0);  // a sense of whirl is no direction
  EXPECT_EQ(columns(all[0].records[6], 32, 41), "forward   ");
}

// Where a response is unbounded there is no number to write.
TEST_F(Universal, LeavesOutUndampedResonances) {
  FrequencyResponse found = response({hertz, 2.0 * hertz, 3.0 * hertz, 4.0 * hertz}, "3:x", "3:x");
  for (CVec ResponsePair::*form :
       {&ResponsePair::receptance, &ResponsePair::mobility, &ResponsePair::accelerance}) {
    (found.pairs[0].*form)(1) = Complex(nan, nan);
  }
  const auto all = functions(found);
  EXPECT_EQ(all[0].hz, (std::vector<double>{1.0, 3.0, 4.0}));
}

}  // namespace whirl::universal_file_test
