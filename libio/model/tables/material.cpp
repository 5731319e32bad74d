#include <fmt/format.h>

#include <cmath>

#include "libio/model/model_reading.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_modulus = 1e-3;  ///< relative distance of moduli that are given twice

void read_materials(ModelReading& reading) {
  const ConfigNode* all = reading.root.find("material");
  if (!all) return;
  if (all->kind != ConfigNode::Kind::table) {
    reading.problems.push_back(
        {all->where, "material", "expected tables with names: write [material.steel]"});
    return;
  }
  for (const auto& [name, node] : all->entries) {
    TableReader table(&node, "material." + name, reading.problems, reading.asked);
    Material m{.name = name};
    table.read(m);
    const bool has_G = table.has("shear_modulus"), has_nu = table.has("poisson_ratio");
    if (!has_G && !has_nu) {
      table.missing("shear_modulus", "a shear modulus (Pa), or poisson_ratio", {"poisson_ratio"});
    } else if (has_G && has_nu) {
      const double G = m.E / (2.0 * (1.0 + m.nu));
      if (std::abs(G - m.G) > same_modulus * m.G) {
        table.problem("poisson_ratio",
                      "does not fit youngs_modulus and shear_modulus, "
                      "nu = E / (2 G) - 1; give one of the two");
      }
    } else if (has_nu) {
      m.G = m.E / (2.0 * (1.0 + m.nu));
    } else if (m.G > 0.0) {
      m.nu = m.E / (2.0 * m.G) - 1.0;
    }
    if ((has_G || has_nu) && m.E > 0.0 && (m.nu <= -1.0 || m.nu > 0.5)) {
      table.problem(has_nu ? "poisson_ratio" : "shear_modulus",
                    fmt::format("Poisson's ratio is {:.4g}, expected -1 to 0.5", m.nu));
    }
    table.finish();
    reading.materials[name] = m;
  }
}

}  // namespace

ModelTable material_table() {
  return {.name = "material",
          .meaning = "[material.NAME]: isotropic, linear elastic materials",
          .form = ModelTable::Form::named,
          .read = read_materials,
          .turn = ModelTable::Turn::early,
          .example =
              "density = 1\n"
              "youngs_modulus = 1\n"
              "poisson_ratio = 0\n"};
}

}  // namespace whirl::inline io
