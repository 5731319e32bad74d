// The modes of tests/data/rotors.json: frequencies, damping and whirl, computed and published.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "tests/support/reference_cases.hpp"

namespace whirl::acceptance_test {

using test::Json;

/// Calls f(case, analysis, modes) for every modal analysis of the file.
template <class Function>
void for_every_modal_analysis(const Function& f) {
  int analyses = 0;
  for (const Json& c : test::reference_cases()) {
    const Assembler assembler(test::structure_of(c));
    for (const Json& a : c.at("analyses")) {
      if (a.at("type") != "modal_lateral") continue;
      const double Omega = a.at("speed_rad_s");
      SCOPED_TRACE(c.at("id").get<std::string>() + " at " + std::to_string(Omega));
      const int count = static_cast<int>(a.at("expected").at("wd_rad_s").size()) + 2;
      f(a, complex_modes(assembler.at(Omega), count).oscillatory);
      ++analyses;
    }
  }
  EXPECT_GT(analyses, 15);
}

TEST(Acceptance, Modes) {
  for_every_modal_analysis([](const Json& a, const std::vector<Mode>& modes) {
    const Json& x = a.at("expected");
    const auto wd = x.at("wd_rad_s").get<std::vector<double>>();
    ASSERT_GE(modes.size(), wd.size());
    for (std::size_t i = 0; i < wd.size(); ++i) {
      EXPECT_NEAR(modes[i].frequency(), wd[i], x.at("rtol").get<double>() * wd[i]);
      if (x.contains("eigenvalue_re")) {
        const double zeta = x.at("damping_ratio")[i];
        EXPECT_NEAR(modes[i].damping_ratio(), zeta,
                    std::max(x.at("atol_damping_ratio").get<double>(), 1e-6 * zeta));
      }
      if (x.contains("whirl")) {
        EXPECT_EQ(name_of(modes[i].whirl), x.at("whirl")[i].get<std::string>()) << "mode " << i + 1;
      }
    }
  });
}

// Numbers as printed in the sources that the file names; the tolerance is their digits. wn is
// |lambda|, wd is Im lambda.
TEST(Acceptance, ModesAsPublished) {
  int compared = 0;
  for_every_modal_analysis([&](const Json& a, const std::vector<Mode>& modes) {
    if (!a.contains("published")) return;
    const Json& all = a.at("published");
    for (const Json& p : all.is_array() ? all : Json::array({all})) {
      const double unit = p.at("unit") == "Hz" ? 2.0 * std::numbers::pi : 1.0;  // [rad/s]
      const auto values = p.at("values").get<std::vector<double>>();
      const auto index = p.at("lateral_mode_index").get<std::vector<std::size_t>>();
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Json& rtol = p.at("rtol");
        const double tolerance = rtol.is_array() ? rtol[i] : rtol;
        const Mode& mode = modes.at(index[i]);
        const double found = p.at("quantity") == "wn" ? std::abs(mode.lambda) : mode.frequency();
        EXPECT_NEAR(found / unit, values[i], tolerance * values[i]) << "mode " << index[i] + 1;
        if (p.contains("whirl")) {
          EXPECT_EQ(name_of(mode.whirl), p.at("whirl")[i].get<std::string>());
        }
        ++compared;
      }
    }
  });
  EXPECT_GT(compared, 60);
}

}  // namespace whirl::acceptance_test
