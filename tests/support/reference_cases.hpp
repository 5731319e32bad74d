#pragma once
/// The reference cases of tests/data/rotors.json as structures.

#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/rotors.hpp"

namespace whirl::test {

using Json = nlohmann::json;

inline const Json& reference_cases() {
  static const Json all = Json::parse(std::ifstream(WHIRL_TEST_DATA "/rotors.json"));
  return all.at("cases");
}

/// Nodes of the file count from 0.
inline Station node_from_zero(int number) {
  return node(number + 1);
}

/// Rotor of a case; every element of its shaft is a segment.
inline Structure structure_of(const Json& c) {
  Structure s;
  const Json& beam = c.at("beam");
  Theory theory = Theory::timoshenko;
  if (!beam.at("shear")) {
    theory = beam.at("rotary_inertia") ? Theory::rayleigh : Theory::euler_bernoulli;
  }
  for (const Json& e : c.at("shaft")) {
    const Json& m = c.at("materials").at(e.at("material").get<std::size_t>());
    const double E = m.at("E"), G = m.at("G");
    s.shaft.push_back(
        {.material = {.name = "m", .rho = m.at("rho"), .E = E, .G = G, .nu = E / (2.0 * G) - 1.0},
         .length = e.at("L"),
         .left = {e.at("od_l"), e.at("id_l")},
         .right = {e.at("od_r"), e.at("id_r")},
         .elements = 1,
         .theory = theory});
  }
  for (const Json& d : c.at("disks")) {
    s.disks.push_back(
        {.at = node_from_zero(d.at("node")), .m = d.at("m"), .Id = d.at("Id"), .Ip = d.at("Ip")});
  }
  for (const Json& b : c.at("bearings")) {
    BearingCoefficients k;
    k.K << b.at("kxx"), b.at("kxy"), b.at("kyx"), b.at("kyy");
    k.C << b.at("cxx"), b.at("cxy"), b.at("cyx"), b.at("cyy");
    s.bearings.push_back(bearing(node_from_zero(b.at("node")), k));
  }
  return s;
}

}  // namespace whirl::test
