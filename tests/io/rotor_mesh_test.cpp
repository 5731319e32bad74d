// What meshes of a rotor say of its nodes.

#include "libio/export/rotor_mesh.hpp"

#include <gtest/gtest.h>

#include "libio/model/model_file.hpp"

namespace whirl::rotor_mesh_test {

// Two disks at one node: their masses add up, and the node has the number of the first.
TEST(RotorMesh, AddsTheDisksOfANode) {
  const Model model = parse_model(R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "200 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "50 mm"
elements = 4
[[disk]]
at = 0.5
mass = 3
diametral_inertia = 0.1
[[disk]]
at = 0.5
mass = 4
diametral_inertia = 0.1
[[bearing]]
at = 0
rigid = true
[[bearing]]
at = 1
rigid = true
[[seal]]
at = 0.25
stiffness = 1
)");
  const RotorMesh mesh = line_mesh(model, Assembler(model.structure), {}, "");
  const auto values = [&](const std::string& name) {
    for (const MeshArray& a : mesh.point_data) {
      if (a.name == name) return a.values;
    }
    return std::vector<double>{};
  };
  EXPECT_EQ(values("disk_mass_kg"), (std::vector<double>{0.0, 0.0, 7.0, 0.0, 0.0}));
  EXPECT_EQ(values("disk"), (std::vector<double>{0.0, 0.0, 1.0, 0.0, 0.0}));
  EXPECT_EQ(values("seal"), (std::vector<double>{0.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(values("bearing"), (std::vector<double>{1.0, 0.0, 0.0, 0.0, 2.0}));
}

}  // namespace whirl::rotor_mesh_test
