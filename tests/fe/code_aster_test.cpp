// code_aster's test SDLL129: a stepped shaft, hollow at one end, on two bearings with
// cross-coupling and damping; docs/validation.md has what comes out.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "libfe/analyses/modes.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::code_aster_test {

using namespace test;

constexpr double speed = 20000.0 * rpm;
constexpr std::array reference{123.645, 200.629, 286.795, 310.105,
                               369.171, 413.384, 826.70,  1008.15};  ///< [Hz]
constexpr std::array reference_damping{0.12450, 0.21726};
constexpr double frequency_tolerance = 3e-3, damping_tolerance = 1e-2;  ///< of the published test

Structure rotor() {
  const double E = 2e11, nu = 0.3;
  const Material steel{
      .name = "steel", .rho = 7800.0, .E = E, .G = E / (2.0 * (1.0 + nu)), .nu = nu};
  Structure s;
  const auto add = [&](double length, double outer, double inner, int elements) {
    s.shaft.push_back({.material = steel,
                       .length = length,
                       .left = {outer, inner},
                       .right = {outer, inner},
                       .elements = elements,
                       .internal_functions = 2});
  };
  add(0.14, 0.16, 0.12, 4);
  add(0.03, 0.16, 0.0, 1);
  add(0.43, 0.09, 0.0, 12);
  add(0.20, 0.06, 0.0, 8);
  s.disks = {{.at = at(0.02), .m = 20.0, .Id = 0.2, .Ip = 0.4},
             {.at = at(0.09), .m = 17.0, .Id = 0.17, .Ip = 0.34},
             {.at = at(0.75), .m = 10.0, .Id = 0.015, .Ip = 0.03}};
  BearingCoefficients left, right;
  left.K << 3e8, 7e5, -7e5, 1.2e8;
  left.C << 1.5e5, -400.0, 300.0, 0.7e5;
  right.K << 1.4e8, 6e5, -6e5, 1e8;
  right.C << 0.8e5, -300.0, 300.0, 0.6e5;
  s.bearings = {bearing(at(0.2), left), bearing(at(0.63), right)};
  return s;
}

std::vector<Mode> modes() {
  return complex_modes(assemble(rotor(), speed), static_cast<int>(reference.size())).oscillatory;
}

double hertz(const Mode& mode) {
  return mode.frequency() / (2.0 * pi);
}

TEST(CodeAster, Sdll129HasItsFrequenciesAndDamping) {
  const auto found = modes();
  ASSERT_GE(found.size(), reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    EXPECT_NEAR(hertz(found[i]), reference[i], frequency_tolerance * reference[i]) << i + 1;
  }
  for (std::size_t i = 0; i < reference_damping.size(); ++i) {
    EXPECT_NEAR(found[i].damping_ratio(), reference_damping[i],
                damping_tolerance * reference_damping[i])
        << i + 1;
  }
}

TEST(CodeAster, Sdll129StandsInTheDocumentAsItComesOut) {
  const auto found = modes();
  ASSERT_GE(found.size(), reference.size());
  std::string rows;
  const auto add = [&](std::size_t i, const char* what, double published, double value) {
    rows += fmt::format("| {} | {} | {} | {:.7g} | {:+.2f} % |\n", i + 1, what, published, value,
                        100.0 * (value / published - 1.0));
  };
  for (std::size_t i = 0; i < reference.size(); ++i) {
    add(i, "frequency [Hz]", reference[i], hertz(found[i]));
  }
  for (std::size_t i = 0; i < reference_damping.size(); ++i) {
    add(i, "damping ratio", reference_damping[i], found[i].damping_ratio());
  }
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/validation.md");
  const std::string document(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(document.find(rows), std::string::npos) << "docs/validation.md should have:\n" << rows;
}

}  // namespace whirl::code_aster_test
