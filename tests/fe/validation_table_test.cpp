// docs/validation.md says of every reference case what comes out: its tables are made here, and a
// table that is not the document's fails.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "tests/support/reference_cases.hpp"

namespace whirl::validation_table_test {

using test::Json;

/// Two digits; what is below the noise of eigensolvers is not told apart.
std::string difference(double relative) {
  return std::abs(relative) < 1e-7 ? "< 1e-7" : fmt::format("{:+.1e}", relative);
}

/// Speed, whirl, reference, found, difference of every number in print.
std::string table(const Json& c) {
  std::string rows;
  const Assembler assembler(test::structure_of(c));
  for (const Json& a : c.at("analyses")) {
    if (a.at("type") != "modal_lateral" || !a.contains("published")) continue;
    const double Omega = a.at("speed_rad_s");
    const Json& all = a.at("published");
    for (const Json& p : all.is_array() ? all : Json::array({all})) {
      const bool is_hertz = p.at("unit") == "Hz", is_undamped = p.at("quantity") == "wn";
      const double unit = is_hertz ? 2.0 * std::numbers::pi : 1.0;  // [rad/s]
      const auto values = p.at("values").get<std::vector<double>>();
      const auto index = p.at("lateral_mode_index").get<std::vector<std::size_t>>();
      const auto modes =
          complex_modes(assembler.at(Omega), static_cast<int>(index.back()) + 3).oscillatory;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Mode& mode = modes.at(index[i]);
        const double found = (is_undamped ? std::abs(mode.lambda) : mode.frequency()) / unit;
        rows += fmt::format("| {:.0f} | {} | {} | {} | {:.7g} | {:.7g} | {} |\n", Omega / test::rpm,
                            index[i] + 1, name_of(mode.whirl), is_undamped ? "wn" : "wd", values[i],
                            found, difference(found / values[i] - 1.0));
      }
    }
  }
  return rows;
}

/// Frequencies computed by other programs: how many, and the largest difference.
std::string summary(const Json& c) {
  int count = 0, analyses = 0;
  double largest = 0.0;
  const Assembler assembler(test::structure_of(c));
  for (const Json& a : c.at("analyses")) {
    if (a.at("type") != "modal_lateral") continue;
    const auto wd = a.at("expected").at("wd_rad_s").get<std::vector<double>>();
    const auto modes =
        complex_modes(assembler.at(a.at("speed_rad_s")), static_cast<int>(wd.size()) + 2)
            .oscillatory;
    for (std::size_t i = 0; i < wd.size(); ++i) {
      largest = std::max(largest, std::abs(modes.at(i).frequency() / wd[i] - 1.0));
    }
    count += static_cast<int>(wd.size());
    ++analyses;
  }
  if (count == 0) return "";
  return fmt::format("| {} | {} | {} | {} |\n", c.at("id").get<std::string>(), analyses, count,
                     largest < 1e-7 ? "< 1e-7" : fmt::format("{:.1e}", largest));
}

TEST(Validation, TablesOfTheDocumentAreWhatComesOut) {
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/validation.md");
  const std::string document(std::istreambuf_iterator<char>(file), {});
  for (const Json& c : test::reference_cases()) {
    for (const std::string& part : {table(c), summary(c)}) {
      EXPECT_TRUE(document.find(part) != std::string::npos)
          << "docs/validation.md should have for " << c.at("id") << ":\n"
          << part;
    }
  }
}

}  // namespace whirl::validation_table_test
