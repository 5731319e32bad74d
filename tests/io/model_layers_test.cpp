// Layers in model files: what is read, what is said of mistakes, where they are seen.

#include <gtest/gtest.h>

#include "libio/drawing/terminal_layout.hpp"
#include "libio/export/rotor_mesh.hpp"
#include "libio/export/vtk_scene.hpp"
#include "tests/io/problems.hpp"
#include "tests/io/shaft_model.hpp"

namespace whirl::model_layers_test {

using test::problems;

constexpr const char* head = R"(format = 1
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = "600 mm"
outer_diameter = "20 mm"
elements = 12
)";

TEST(ModelLayers, AreReadWithEveryKey) {
  const Structure s = test::rotor(R"(
[material.bronze]
density = 8800
youngs_modulus = "100 GPa"
poisson_ratio = 0.34
internal_damping = "2 us"
[[layer]]
name = "sleeve"
from = "100 mm"
to = { node = 7 }
material = "bronze"
outer_diameter = ["30 mm", "40 mm"]
inner_diameter = "20 mm"
carries = "mass"
theory = "rayleigh"
shear_coefficient = 0.8
rayleigh = { mass = 2, stiffness = "3 us" }
[[layer]]
from = { at = 0.4 }
to = 0.425
material = "steel"
outer_diameter = 0.05
inner_diameter = 0
)")
                          .structure;
  ASSERT_EQ(s.layers.size(), 2u);
  const Layer& l = s.layers[0];
  EXPECT_EQ(l.name, "sleeve");
  EXPECT_EQ(l.from.z, 0.1);
  EXPECT_EQ(l.to.node, 7);
  EXPECT_EQ(l.material.eta, 2e-6);
  EXPECT_EQ(l.left.outer, 0.03);
  EXPECT_EQ(l.right.outer, 0.04);
  EXPECT_EQ(l.right.inner, 0.02);
  EXPECT_EQ(l.carries, Carries::mass);
  EXPECT_EQ(l.theory, Theory::rayleigh);
  EXPECT_EQ(l.shear.value, 0.8);
  EXPECT_EQ(l.damping.stiffness, 3e-6);
  EXPECT_EQ(s.layers[1].name, "layer 2");
  EXPECT_EQ(s.layers[1].carries, Carries::both);
  EXPECT_EQ(make_mesh(s).nodes(), 14);  // one between those of the shaft
}

TEST(ModelLayers, WhatIsWrongIsSaidWithItsLine) {
  const auto problem_of = [](const std::string& keys) {
    return test::joined(problems(std::string(head) + "[[layer]]\n" + keys));
  };
  const std::string place = "from = 0.1\nto = 0.2\n", steel = "material = \"steel\"\n",
                    diameters = "outer_diameter = 0.03\ninner_diameter = 0.02\n";
  EXPECT_EQ(problem_of(place + steel + diameters), "");
  EXPECT_EQ(problem_of(place + steel + "outer_diameter = 0.03\n"),
            "m:11:1: layer.1.inner_diameter: missing, expected a length (m): the outer diameter of "
            "what it lies on, or 0\n");
  EXPECT_EQ(
      problem_of(steel + diameters),
      "m:11:1: layer.1.from: missing, expected a place on the shaft: a position (m), { at = ... "
      "} or { node = ... }\n"
      "m:11:1: layer.1.to: missing, expected a place on the shaft: a position (m), { at = ... } "
      "or { node = ... }\n");
  EXPECT_EQ(
      problem_of("from = 0.2\nto = 0.1\n" + steel + diameters),
      "m:13:6: layer.1.to: the layer ends at 100 mm, expected a place to the right of 200 mm, "
      "where it begins\n");
  EXPECT_EQ(problem_of("from = 0.2\nto = \"700 mm\"\n" + steel + diameters),
            "m:13:6: layer.1.to: 700 mm is off the shaft; the shaft reaches from 0 to 600 mm\n");
  EXPECT_EQ(
      problem_of(place + steel + "outer_diameter = 0.03\ninner_diameter = 0.03\n"),
      "m:16:18: layer.1.inner_diameter: found 30 mm, expected less than the outer diameter of 30 "
      "mm\n");
  EXPECT_EQ(
      problem_of(place + "material = \"steal\"\n" + diameters),
      "m:14:12: layer.1.material: found \"steal\", expected steel; did you mean \"steel\"?\n");
  EXPECT_EQ(
      problem_of(place + steel + diameters + "carries = \"masses\"\n"),
      "m:17:11: layer.1.carries: found \"masses\", expected one of both, stiffness, mass; did "
      "you mean \"mass\"?\n");
  EXPECT_EQ(problem_of("from = 0.1\nto = \"9 kg\"\n" + steel + diameters),
            "m:13:6: layer.1.to: found \"9 kg\", expected a length (m)\n");
  const std::string on_body = problem_of("from = { body = \"b\" }\nto = 0.2\n" + steel + diameters +
                                         "[[body]]\nname = \"b\"\nmass = 1\n");
  EXPECT_EQ(
      on_body,
      "m:12:17: layer.1.from.body: a layer lies on the shaft, expected a position or a node\n");
}

// A sleeve of 60 mm on a shaft of 20 mm, where a bearing runs on it and contacts take its radius.
TEST(ModelLayers, AreSeenInEveryPicture) {
  const Model model = test::rotor(R"(
[[layer]]
from = "200 mm"
to = "300 mm"
material = "steel"
outer_diameter = ["60 mm", "40 mm"]
inner_diameter = "20 mm"
[[contact]]
at = "200 mm"
clearance = 1e-3
stiffness = 1e6
friction = 0.1
)");
  const Assembler assembler(model.structure);
  EXPECT_DOUBLE_EQ(model.contacts[0].friction.radius, 0.03);

  const VtkScene scene = vtk_scene(model, assembler);
  ASSERT_EQ(scene.shaft.size(), 14u);  // twelve elements, two of them under the layer
  EXPECT_DOUBLE_EQ(scene.shaft[12].left_radius, 0.03);
  EXPECT_DOUBLE_EQ(scene.shaft[13].right_radius, 0.02);
  EXPECT_EQ(scene.shaft[12].left, 4);

  const RotorMesh lines = line_mesh(model, assembler, {}, "");
  ASSERT_EQ(lines.cells.size(), 14u);
  ASSERT_EQ(lines.cell_data.back().name, "layer");
  EXPECT_EQ(lines.cell_data.back().values[11], 0.0);
  EXPECT_EQ(lines.cell_data.back().values[12], 1.0);

  // the drawing has 4 rows above the axis for the largest radius: the shaft alone fills them all, a
  // sleeve of three times its size leaves it one, and covers 12 of 72 columns above
  const std::string picture = draw_layout(model, assembler, 72);
  const std::string top = picture.substr(0, picture.find('\n'));
  EXPECT_EQ(top.find_first_not_of(' '), 26u) << picture;  // two of the margin, a third of 72
}

// Nothing of the shaft has a density but a layer that carries mass.
TEST(ModelLayers, MayBeAllThatHasAMass) {
  const std::string light = R"(format = 1
[material.light]
density = 0
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[material.steel]
density = 7800
youngs_modulus = "211 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "light"
length = 0.6
outer_diameter = 0.02
[[layer]]
from = 0.2
to = 0.4
material = "steel"
outer_diameter = 0.04
inner_diameter = 0.02
)";
  EXPECT_EQ(test::joined(problems(light)), "");
  EXPECT_NE(test::joined(problems(light + "carries = \"stiffness\"\n")).find("has a mass"),
            std::string::npos);
}

}  // namespace whirl::model_layers_test
