#include "libio/model_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libfe/assemble.hpp"
#include "libfe/elements/disk.hpp"
#include "libio/nearest.hpp"
#include "libio/units.hpp"

namespace whirl {

namespace {

constexpr double same_modulus = 1e-3;  ///< relative distance of moduli that are given twice

/// Reads the law of the given name into the contact; false if there is none.
template <std::size_t... I>
bool read_law(const std::string& name, TableReader& table, AnyContactLaw<>& to,
              std::index_sequence<I...>) {
  bool found = false;
  const auto try_one = [&](auto law) {
    if (decltype(law)::name != name) return;
    found = true;
    table.read(law);
    to = law;
  };
  (try_one(std::variant_alternative_t<I, AnyContactLaw<>>{}), ...);
  return found;
}

template <std::size_t... I>
std::vector<std::string> law_names(std::index_sequence<I...>) {
  return {std::string(std::variant_alternative_t<I, AnyContactLaw<>>::name)...};
}
constexpr auto laws = std::make_index_sequence<std::variant_size_v<AnyContactLaw<>>>{};

}  // namespace

ModelBuilder::ModelBuilder(ConfigNode& root, std::filesystem::path directory)
    : root_(root), directory_(std::move(directory)) {}

Model ModelBuilder::build() {
  read_top();
  read_materials();
  read_bodies();
  read_shaft();
  read_disks();
  read_bearings();
  read_links();
  read_unbalances();
  read_contacts();
  read_settings();
  check_places();
  if (!problems_.empty()) {
    std::stable_sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
      return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
    });
    throw ModelError(problems_);
  }
  return std::move(model_);
}

void ModelBuilder::read_top() {
  TableReader top(&root_, "", problems_);
  const auto format = top.integer("format", Range::any, true);
  if (format && *format != 1) {
    top.problem("format", fmt::format("found {}, expected 1, the only format so far", *format));
  }
  if (const auto title = top.string("title")) model_.title = *title;
  if (const auto g = top.quantity("gravity", "m/s^2", Range::nonnegative)) model_.structure.gravity = *g;
  for (const char* table : {"operation", "material", "shaft", "disk", "unbalance", "body", "bearing",
                            "link", "contact", "damping", "reduction", "start"}) {
    top.node(table);
  }
  top.finish();
}

void ModelBuilder::read_materials() {
  const ConfigNode* all = root_.find("material");
  if (!all) return;
  if (all->kind != ConfigNode::Kind::table) {
    problems_.push_back({all->where, "material", "expected tables with names: write [material.steel]"});
    return;
  }
  for (const auto& [name, node] : all->entries) {
    TableReader table(&node, "material." + name, problems_);
    Material m{.name = name};
    table.read(m);
    const bool has_G = table.has("shear_modulus"), has_nu = table.has("poisson_ratio");
    if (!has_G && !has_nu) {
      table.missing("shear_modulus", "a shear modulus (Pa), or poisson_ratio");
    } else if (has_G && has_nu) {
      const double G = m.E / (2.0 * (1.0 + m.nu));
      if (std::abs(G - m.G) > same_modulus * m.G) {
        table.problem("poisson_ratio", "does not fit youngs_modulus and shear_modulus, "
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
  std::vector<std::string> known;
  for (const auto& [key, value] : materials_) known.push_back(key);
  if (known.empty()) {
    table.problem("material", fmt::format("there is no [material.{}]", *name));
  } else {
    table.unknown_choice("material", *name, known);
  }
  return std::nullopt;
}

std::optional<std::pair<double, double>> ModelBuilder::diameters(TableReader& table,
                                                                 std::string_view key,
                                                                 bool is_required) {
  const Range range = is_required ? Range::positive : Range::nonnegative;
  const ConfigNode* node = table.node(key);
  if (!node || node->kind != ConfigNode::Kind::array) {
    const auto both = table.quantity(key, "m", range, is_required);
    if (!both) return std::nullopt;
    return std::pair(*both, *both);
  }
  if (node->items.size() != 2) {
    table.problem(key, fmt::format("found {} values, expected one, or [left, right]", node->items.size()));
    return std::nullopt;
  }
  const auto left = table.quantity(node->items[0], table.path(key), "m", range);
  const auto right = table.quantity(node->items[1], table.path(key), "m", range);
  if (!left || !right) return std::nullopt;
  return std::pair(*left, *right);
}

void ModelBuilder::read_shaft() {
  for_each("shaft", [&](TableReader& table, std::size_t) {
    table.string("name");
    Segment segment;
    segment.where = table.where();
    if (const auto m = material(table)) segment.material = *m;
    table.read(segment);
    const auto outer = diameters(table, "outer_diameter", true);
    const auto inner = diameters(table, "inner_diameter", false);
    if (outer) {
      segment.left.outer = outer->first;
      segment.right.outer = outer->second;
    }
    if (inner) {
      segment.left.inner = inner->first;
      segment.right.inner = inner->second;
    }
    for (const auto& [in, out] : {std::pair(segment.left.inner, segment.left.outer),
                                  std::pair(segment.right.inner, segment.right.outer)}) {
      if (!outer || !inner || in < out) continue;
      table.problem("inner_diameter", fmt::format("found {:g} mm, expected less than the outer diameter "
                                                  "of {:g} mm", 1e3 * in, 1e3 * out));
      break;
    }
    const ConfigNode* shear = table.node("shear_coefficient");
    if (shear && shear->kind == ConfigNode::Kind::string) {
      if (const auto formula = table.choice<ShearFormula>("shear_coefficient")) segment.shear.formula = *formula;
    } else if (shear) {
      segment.shear.formula = ShearFormula::given;
      if (const auto value = table.quantity("shear_coefficient", "", Range::positive)) segment.shear.value = *value;
    }
    constexpr int most_elements = 100'000;
    if (segment.elements > most_elements) {
      table.problem("elements", fmt::format("found {}, expected up to {}", segment.elements, most_elements));
      segment.elements = 1;
    }
    if (segment.internal_functions > 4) {
      table.problem("internal_functions", "expected 0 to 4");
    }
    model_.structure.shaft.push_back(segment);
  });
}

std::optional<Station> ModelBuilder::station(TableReader& table) {
  const bool has_at = table.has("at"), has_node = table.has("node"), has_body = table.has("body");
  Station s{.where = table.where(), .key = table.path("at")};
  const auto at = table.quantity("at", "m", Range::any);
  const auto node = table.integer("node", Range::positive);
  const auto body = table.string("body");
  if (!has_at && !has_node && !has_body) {
    table.missing("at", "a station: at = position, node = number, or body = name");
    return std::nullopt;
  }
  if (has_body && (has_at || has_node)) {
    table.problem("body", "found a body and a place on the shaft, expected one of them");
    return std::nullopt;
  }
  if (has_body) return body ? named_station(*body, table, "body") : std::nullopt;
  s.where = table.where(has_at ? "at" : "node");
  s.key = table.path(has_at ? "at" : "node");
  if (has_at) {
    if (!at || (has_node && !node)) return std::nullopt;
    s.kind = Station::Kind::position;
    s.z = *at;
    if (has_node) double_stations_.push_back({s, static_cast<int>(*node)});
    return s;
  }
  if (!node) return std::nullopt;
  s.kind = Station::Kind::node;
  s.node = static_cast<int>(*node);
  return s;
}

std::optional<Station> ModelBuilder::named_station(const std::string& name, TableReader& table,
                                                   std::string_view key) {
  Station s{.where = table.where(key), .key = table.path(key)};
  if (name == "ground") return s;
  std::vector<std::string> known{"ground"};
  for (const Body& body : model_.structure.bodies) known.push_back(body.name);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    table.unknown_choice(key, name, known);
    return std::nullopt;
  }
  s.kind = Station::Kind::body;
  s.body = name;
  return s;
}

std::optional<Unbalance> ModelBuilder::unbalance(TableReader& table, const Station& at,
                                                 std::optional<double> mass) {
  const auto offset = table.quantity("offset", "m", Range::nonnegative);
  const auto moment = table.quantity("moment", "kg.m", Range::nonnegative);
  const auto phase = table.quantity("phase", "rad", Range::any);
  Unbalance u{.at = at, .phase = phase.value_or(0.0)};
  if (table.has("offset") == table.has("moment")) {
    table.problem(table.has("offset") ? "offset" : "moment",
                  "expected one of moment (kg.m) and offset (m, of a disk or body with a mass)");
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
    if (at && at->kind == Station::Kind::body) table.problem("body", "a disk sits on the shaft; give the body its mass");
    if (at) disk.at = *at;
    table.read(disk);
    const bool has_mass = table.has("mass"), has_material = table.has("material");
    if (disk.outer_diameter > 0.0 && disk.inner_diameter >= disk.outer_diameter) {
      table.problem("inner_diameter", fmt::format("found {:g} mm, expected less than the outer diameter of "
                                                  "{:g} mm", 1e3 * disk.inner_diameter, 1e3 * disk.outer_diameter));
    }
    if (has_mass == has_material) {
      table.node("material");
      table.problem(has_mass ? "mass" : "material",
                    "expected a disk by its shape (material, outer_diameter, inner_diameter, width) or "
                    "by its mass (mass, diametral_inertia, polar_inertia), one of the two");
    } else if (has_material) {
      for (const char* key : {"outer_diameter", "width"}) {
        if (!table.has(key)) table.missing(key, "a length (m), since the disk is given by its shape");
      }
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key)) table.problem(key, "follows from the shape; give mass instead of material to set it");
      }
      if (const auto m = material(table)) set_inertia_from_shape(disk, m->rho);
    }
    if (const ConfigNode* inner = table.node("unbalance")) {
      TableReader reader(inner, table.path("unbalance"), problems_);
      if (const auto u = unbalance(reader, disk.at, disk.m)) model_.structure.unbalances.push_back(*u);
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
    if (body.name == "ground") table.problem("name", "\"ground\" is what does not move; choose another name");
    table.read(body);
    if (!body.tilts) {
      for (const char* key : {"diametral_inertia", "polar_inertia"}) {
        if (table.has(key)) table.problem(key, "only a body with tilts = true has moments of inertia");
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
        mass = body.m;
        if (!body.spins) table.problem("body", "this body does not spin and has no unbalance; give it spins = true");
      }
    }
    const auto u = unbalance(table, at.value_or(Station{}), mass);
    if (at && u) model_.structure.unbalances.push_back(*u);
  });
}

void ModelBuilder::read_contacts() {
  for_each("contact", [&](TableReader& table, std::size_t i) {
    Contact contact;
    contact.where = table.where();
    contact.name = table.string("name").value_or(fmt::format("contact {}", i + 1));
    const auto at = station(table);
    if (at) contact.at = *at;
    if (const auto against = table.string("against")) {
      if (const auto s = named_station(*against, table, "against")) contact.against = *s;
      if (at && at->kind == Station::Kind::body && at->body == *against) {
        table.problem("against", "the body would touch itself");
      }
    }
    table.read(contact);
    table.read(contact.friction);
    const std::string law = table.string("law").value_or("radial");
    if (!read_law(law, table, contact.law, laws)) table.unknown_choice("law", law, law_names(laws));
    if (const ConfigNode* offset = table.node("offset")) {
      if (offset->kind != ConfigNode::Kind::array || offset->items.size() != 2) {
        table.problem("offset", fmt::format("found {}, expected [x, y]", offset->as_written()));
      } else {
        for (const int k : {0, 1}) {
          const auto v = table.quantity(offset->items[static_cast<std::size_t>(k)], table.path("offset"),
                                        "m", Range::any);
          if (v) contact.offset(k) = *v;
        }
      }
    }
    const bool needs_radius = contact.friction.mu > 0.0 && contact.friction.slip == Slip::actual;
    if (!table.has("radius") && needs_radius) {
      missing_radii_.push_back({model_.contacts.size(), table.where(), table.path("radius")});
    }
    if (at) model_.structure.stations.push_back(*at);
    model_.contacts.push_back(contact);
  });
}

void ModelBuilder::read_settings() {
  {
    TableReader table(root_.find("operation"), "operation", problems_);
    if (const auto speed = table.quantity("speed", "rad/s", Range::nonnegative)) {
      model_.speed = *speed;
      model_.has_speed = true;
    }
    table.finish();
  }
  {
    TableReader table(root_.find("damping"), "damping", problems_);
    TableReader rayleigh(table.node("rayleigh"), "damping.rayleigh", problems_);
    rayleigh.read(model_.structure.damping);
    rayleigh.finish();
    table.finish();
  }
  {
    TableReader table(root_.find("reduction"), "reduction", problems_);
    table.read(model_.reduction);
    table.finish();
  }
  TableReader table(root_.find("start"), "start", problems_);
  if (const auto from = table.choice<StartFrom>("from")) model_.start.from = *from;
  if (const auto file = table.string("file")) model_.start.file = *file;
  if (model_.start.from == StartFrom::file && model_.start.file.empty()) {
    table.missing("file", "the name of a result file to start from");
  }
  if (const ConfigNode* whirl = table.node("whirl")) {
    if (whirl->kind != ConfigNode::Kind::array) {
      table.problem("whirl", fmt::format("found {}, expected [ {{ mode = 1, amplitude = \"2 mm\" }} ]", whirl->as_written()));
    }
    for (std::size_t i = 0; i < whirl->items.size(); ++i) {
      TableReader item(&whirl->items[i], fmt::format("start.whirl.{}", i + 1), problems_);
      WhirlStart w;
      if (const auto mode = item.integer("mode", Range::positive, true)) w.mode = static_cast<int>(*mode);
      if (const auto a = item.quantity("amplitude", "m", Range::nonnegative, true)) w.amplitude = *a;
      if (const auto p = item.quantity("phase", "rad", Range::any)) w.phase = *p;
      item.finish();
      model_.start.whirl.push_back(w);
    }
  }
  table.finish();
}

void ModelBuilder::check_places() {
  const Structure& s = model_.structure;
  if (s.shaft.empty() && s.bodies.empty() && problems_.empty()) {
    problems_.push_back({root_.where, "shaft", "missing: a model needs a [[shaft]] or a [[body]]"});
  }
  const bool has_shape = std::all_of(s.shaft.begin(), s.shaft.end(), [](const Segment& segment) {
    return segment.length > 0.0 && segment.left.outer > 0.0 && segment.right.outer > 0.0;
  });
  if (!has_shape) return;
  const auto collect = [&](const ModelError& error) {
    problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
  };
  Mesh mesh;
  try {
    mesh = make_mesh(s);
  } catch (const ModelError& error) {
    return collect(error);
  }
  for (const Station* station : all_stations(s)) {
    try {
      resolve(*station, s, mesh);
    } catch (const ModelError& error) {
      collect(error);
    }
  }
  for (const DoubleStation& d : double_stations_) {
    if (d.node > mesh.nodes()) {
      problems_.push_back({d.position.where, d.position.key,
                           fmt::format("found node {}, expected a node from 1 to {}", d.node, mesh.nodes())});
    } else if (resolve(d.position, s, mesh).index != d.node - 1) {
      problems_.push_back({d.position.where, d.position.key,
                           fmt::format("{:g} mm and node {}, which is at {:g} mm, are different places; give one",
                                       1e3 * d.position.z, d.node, 1e3 * mesh.z[static_cast<std::size_t>(d.node - 1)])});
    }
  }
  if (!problems_.empty()) return;
  for (const MissingRadius& m : missing_radii_) {
    Contact& contact = model_.contacts[m.contact];
    const Point point = resolve(contact.at, s, mesh);
    if (point.kind != Point::Kind::node) {
      problems_.push_back({m.where, m.key, "missing, expected a length (m): friction on a body needs the "
                                           "radius of the contact for its slip velocity"});
      continue;
    }
    contact.friction.radius = 0.5 * shaft_diameter(s, mesh.z[static_cast<std::size_t>(point.index)]);
  }
  try {
    Assembler{s};
  } catch (const ModelError& error) {
    collect(error);
  }
}

}  // namespace whirl
