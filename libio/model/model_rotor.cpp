#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfe/mesh/elements/disk.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_modulus = 1e-3;  ///< relative distance of moduli that are given twice

/// A mass, or [along x, along y].
void read_mass(TableReader& table, const auto& field, PlanarMass& to) {
  const ConfigNode* node = table.node(field.name);
  if (node && node->kind == ConfigNode::Kind::array) {
    const auto both =
        table.pair(field.name, field.unit, field.range, "one mass, or [along x, along y]");
    if (both) to = {both->front(), both->back()};
  } else if (const auto mass = table.quantity(field.name, field.unit, field.range, true)) {
    to = *mass;
  }
}

}  // namespace

void ModelBuilder::read_materials() {
  const ConfigNode* all = root_.find("material");
  if (!all) return;
  if (all->kind != ConfigNode::Kind::table) {
    problems_.push_back(
        {all->where, "material", "expected tables with names: write [material.steel]"});
    return;
  }
  for (const auto& [name, node] : all->entries) {
    TableReader table(&node, "material." + name, problems_, asked_);
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
    materials_[name] = m;
  }
}

std::optional<Material> ModelBuilder::material(TableReader& table) {
  const auto name = table.string("material", true);
  if (!name) return std::nullopt;
  const auto found = materials_.find(*name);
  if (found != materials_.end()) return found->second;
  if (materials_.empty()) {
    table.problem("material", fmt::format("there is no [material.{}]", *name));
  } else {
    table.unknown_choice("material", *name, material_names());
  }
  return std::nullopt;
}

std::vector<std::string> ModelBuilder::material_names() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : materials_) names.push_back(name);
  return names;
}

std::optional<Unbalance> ModelBuilder::unbalance(TableReader& table, const Station& at,
                                                 std::optional<double> mass) {
  const auto offset = table.quantity("offset", "m", Range::nonnegative);
  const auto moment = table.quantity("moment", "kg.m", Range::nonnegative);
  const auto phase = table.quantity("phase", "rad", Range::any);
  Unbalance u{.at = at, .phase = phase.value_or(0.0)};
  const char* expected = "one of moment (kg.m) and offset (m, of a disk or body with a mass)";
  if (!table.has("offset") && !table.has("moment")) {
    table.missing("moment", expected, {"offset"});
    return std::nullopt;
  }
  if (table.has("offset") && table.has("moment")) {
    table.problem("offset", fmt::format("found both, expected {}", expected));
    return std::nullopt;
  }
  if (moment) u.moment = *moment;
  if (offset && !mass) {
    table.problem("offset", "an offset needs a mass: give moment (kg.m) instead");
    return std::nullopt;
  }
  if (offset) u.moment = *offset * *mass;
  return u;
}

void ModelBuilder::read_disks() {
  for_each("disk", [&](TableReader& table, std::size_t i) {
    Disk disk{.name = table.string("name").value_or(fmt::format("disk {}", i + 1))};
    const auto at = station(table);
    if (at && at->kind == Station::Kind::body)
      table.problem("body", "a disk sits on the shaft; give the body its mass");
    if (at) disk.at = *at;
    table.read(disk);
    const bool has_mass = table.has("mass"), has_material = table.has("material");
    if (disk.outer_diameter > 0.0 && disk.inner_diameter >= disk.outer_diameter) {
      table.problem("inner_diameter",
                    fmt::format("found {:g} mm, expected less than the outer diameter of "
                                "{:g} mm",
                                1e3 * disk.inner_diameter, 1e3 * disk.outer_diameter));
    }
    table.node("material");
    const char* expected =
        "a disk by its shape (material, outer_diameter, inner_diameter, width) or "
        "by its mass (mass, diametral_inertia, polar_inertia), one of the two";
    if (!has_mass && !has_material) {
      table.missing("material", expected, {"mass"});
    } else if (has_mass && has_material) {
      table.problem("mass", fmt::format("found both, expected {}", expected));
    } else if (has_material) {
      for (const char* key : {"outer_diameter", "width"}) {
        if (!table.has(key))
          table.missing(key, "a length (m), since the disk is given by its shape");
      }
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key))
          table.problem(key, "follows from the shape; give mass instead of material to set it");
      }
      if (const auto m = material(table)) set_inertia_from_shape(disk, m->rho);
    }
    if (const ConfigNode* inner = table.node("unbalance")) {
      TableReader reader(inner, table.path("unbalance"), problems_, asked_);
      if (const auto u = unbalance(reader, disk.at, disk.m))
        model_.structure.unbalances.push_back(*u);
      reader.finish();
    }
    model_.structure.disks.push_back(disk);
  });
}

void ModelBuilder::read_bodies() {
  for_each("body", [&](TableReader& table, std::size_t) {
    Body body;
    body.where = table.where();
    if (const auto name = table.string("name", true)) body.name = *name;
    if (table.has("name") && body.name.empty())
      table.problem("name", "a body needs a name that is not empty");
    if (body.name == "ground")
      table.problem("name", "\"ground\" is what does not move; choose another name");
    table.read(body, [&](const auto& field, PlanarMass& to) { read_mass(table, field, to); });
    if (body.spins && body.m.x != body.m.y) {
      table.problem("mass",
                    "a body that spins has the same mass along x and y, expected one value");
    }
    if (!body.tilts) {
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key))
          table.problem(key, "only a body with tilts = true has moments of inertia");
      }
    }
    model_.structure.bodies.push_back(body);
  });
}

void ModelBuilder::read_unbalances() {
  for_each("unbalance", [&](TableReader& table, std::size_t) {
    table.string("name");
    const auto at = station(table);
    std::optional<double> mass;
    if (at && at->kind == Station::Kind::body) {
      for (const Body& body : model_.structure.bodies) {
        if (body.name != at->body) continue;
        mass = body.m.x;
        if (!body.spins)
          table.problem("body",
                        "this body does not spin and has no unbalance; give it spins = true");
      }
    }
    const auto u = unbalance(table, at.value_or(Station{}), mass);
    if (at && u) model_.structure.unbalances.push_back(*u);
  });
}

void ModelBuilder::need_tilts(TableReader& table, const char* key, const Station& at) const {
  if (at.kind != Station::Kind::body) return;
  for (const Body& body : model_.structure.bodies) {
    if (body.name != at.body || body.tilts) continue;
    table.problem(key, "this body does not tilt; give it tilts = true");
  }
}

void ModelBuilder::read_probes() {
  for_each("probe", [&](TableReader& table, std::size_t i) {
    Probe probe{.name = table.string("name").value_or(fmt::format("probe {}", i + 1))};
    if (table.has("name") && probe.name.empty()) {
      table.problem("name", "a probe needs a name that is not empty");
    }
    if (const auto at = station(table)) probe.at = *at;
    table.read(probe);
    const auto unit = parse_as("1 " + probe.unit, "m");
    if (!unit || probe.unit.empty()) {
      table.problem("unit", fmt::format("found {}, expected a unit of length, such as \"um\", "
                                        "\"mil\" or \"mm\"",
                                        in_quotes(probe.unit)));
    }
    if (probe.is_axial()) need_tilts(table, "face_radius", probe.at);
    model_.structure.probes.push_back(probe);
  });
}

}  // namespace whirl::inline io
