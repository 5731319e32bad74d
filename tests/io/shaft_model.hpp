#pragma once
// A small model file for tests of single tables.

#include <string>
#include <vector>

#include "libio/model/model_file.hpp"

namespace whirl::test {

/// A shaft of 600 mm with 13 nodes, and what a test adds to it.
inline Model rotor(const std::string& parts = "", const std::vector<std::string>& sets = {}) {
  return parse_model(R"(
format = 1
[material.steel]
density = "7800 kg/m^3"
youngs_modulus = "211 GPa"
shear_modulus = "81.2 GPa"
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
)" + parts,
                     "model.toml", sets);
}

}  // namespace whirl::test
