// The reference cases of tests/data/rotors.json: frequencies, damping, whirl, unbalance response.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "libfe/modes.hpp"

namespace whirl {
namespace {

using Json = nlohmann::json;

const Json& cases() {
  static const Json all = Json::parse(std::ifstream(WHIRL_TEST_DATA "/rotors.json"));
  return all.at("cases");
}

Station node(int from_zero) {
  return {.kind = Station::Kind::node, .node = from_zero + 1};
}

Structure structure_of(const Json& c) {
  Structure s;
  const Json& beam = c.at("beam");
  Theory theory = Theory::timoshenko;
  if (!beam.at("shear")) theory = beam.at("rotary_inertia") ? Theory::rayleigh : Theory::euler_bernoulli;
  for (const Json& e : c.at("shaft")) {
    const Json& m = c.at("materials").at(e.at("material").get<std::size_t>());
    const double E = m.at("E"), G = m.at("G");
    s.shaft.push_back({.material = {.name = "m", .rho = m.at("rho"), .E = E, .G = G,
                                    .nu = E / (2.0 * G) - 1.0},
                       .length = e.at("L"),
                       .left = {e.at("od_l"), e.at("id_l")},
                       .right = {e.at("od_r"), e.at("id_r")},
                       .elements = 1,
                       .theory = theory});
  }
  for (const Json& d : c.at("disks")) {
    s.disks.push_back({.at = node(d.at("node")), .m = d.at("m"), .Id = d.at("Id"), .Ip = d.at("Ip")});
  }
  for (const Json& b : c.at("bearings")) {
    BearingCoefficients k;
    k.K << b.at("kxx"), b.at("kxy"), b.at("kyx"), b.at("kyy");
    k.C << b.at("cxx"), b.at("cxy"), b.at("cyx"), b.at("cyy");
    s.bearings.push_back({.from = node(b.at("node")), .coefficients = ConstantBearing{k}});
  }
  return s;
}

TEST(Acceptance, Modes) {
  for (const Json& c : cases()) {
    const Structure structure = structure_of(c);
    const Assembler assembler(structure);
    for (const Json& a : c.at("analyses")) {
      if (a.at("type") != "modal_lateral") continue;
      const double Omega = a.at("speed_rad_s");
      SCOPED_TRACE(c.at("id").get<std::string>() + " at " + std::to_string(Omega));
      const Json& x = a.at("expected");
      const auto wd = x.at("wd_rad_s").get<std::vector<double>>();
      const Modes modes = complex_modes(assembler.at(Omega), static_cast<int>(wd.size()) + 2);
      ASSERT_GE(modes.oscillatory.size(), wd.size());
      for (std::size_t i = 0; i < wd.size(); ++i) {
        const Mode& mode = modes.oscillatory[i];
        EXPECT_NEAR(mode.frequency(), wd[i], x.at("rtol").get<double>() * wd[i]);
        if (x.contains("eigenvalue_re")) {
          const double zeta = x.at("damping_ratio")[i];
          EXPECT_NEAR(mode.damping_ratio(), zeta,
                      std::max(x.at("atol_damping_ratio").get<double>(), 1e-6 * zeta));
        }
        if (x.contains("whirl")) {
          EXPECT_EQ(name_of(mode.whirl), x.at("whirl")[i].get<std::string>()) << "mode " << i + 1;
        }
      }
    }
  }
}

}  // namespace
}  // namespace whirl
