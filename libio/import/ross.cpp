#include "libio/import/ross.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "libio/import/ross_bearings.hpp"
#include "libio/import/ross_gears.hpp"
#include "libio/import/ross_section.hpp"

namespace whirl::inline io {

namespace {

/// Keys that say how things are drawn.
bool is_of_pictures(std::string_view key) {
  return key == "color" || key == "scale_factor";
}

/// Name of a material in the model; the same one for equal values.
std::string material_of(const RossSection& element, RossRotor& rotor, double& nu,
                        UnreadKeys& unread) {
  const ConfigNode* table = element.find("material");
  if (!table || table->kind != ConfigNode::Kind::table) {
    element.problem(element.where(), "material", "is missing, expected a table of rho, E and G_s");
    return "";
  }
  const RossSection section(element, "material", *table);
  RossMaterial material{.name = "material"};
  const auto value = [&](std::string_view key) {
    if (const ConfigNode* found = section.find(key)) return section.number_of(*found, key);
    section.problem(table->where, key, "is missing, expected a number");
    return 1.0;
  };
  material.rho = value("rho");
  material.E = value("E");
  material.G = value("G_s");
  if (material.G > 0.0) nu = material.E / (2.0 * material.G) - 1.0;
  const ConfigNode* name = section.find("name");
  section.add_unread(unread);
  if (name && name->kind == ConfigNode::Kind::string && !name->text.empty()) {
    material.name = name->text;
  }
  const auto is_same = [&](const RossMaterial& m) {
    return m.rho == material.rho && m.E == material.E && m.G == material.G;
  };
  const std::string wanted = material.name;
  for (int copy = 2;; ++copy) {
    const auto known = std::find_if(rotor.materials.begin(), rotor.materials.end(),
                                    [&](const auto& m) { return m.name == material.name; });
    if (known == rotor.materials.end()) break;
    if (is_same(*known)) return material.name;
    material.name = fmt::format("{} {}", wanted, copy);
  }
  rotor.materials.push_back(material);
  return material.name;
}

void read_element(const RossSection& s, RossRotor& rotor, UnreadKeys& unread) {
  RossElement e{.where = s.where()};
  e.material = material_of(s, rotor, e.nu, unread);
  e.node = s.node("n");
  e.length = s.number("L");
  const double outer = s.number("odl"), inner = s.number("idl");
  e.outer = {outer, s.number_or("odr", outer)};
  e.inner = {inner, s.number_or("idr", inner)};
  e.axial_force = s.number_or("axial_force", 0.0);
  e.torque = s.number_or("torque", 0.0);
  e.shears = s.flag("shear_effects");
  e.tilts = s.flag("rotary_inertia");
  e.turns = s.flag("gyroscopic");
  const ConfigNode* method = s.find("shear_method_calc");
  e.is_hutchinson = method && method->text == "hutchinson";
  if (method && !e.is_hutchinson && method->text != "cowper") {
    rotor.taken_differently.push_back(
        fmt::format("the shear coefficient {} of \"{}\" is not known: Cowper's is taken",
                    method->as_written(), s.tag()));
  }
  e.mass_damping = s.number_or("alpha", 0.0);
  e.stiffness_damping = s.number_or("beta", 0.0);
  rotor.elements.push_back(std::move(e));
}

void read_disk(const RossSection& s, RossRotor& rotor) {
  rotor.disks.push_back(
      {s.where(), s.tag(), s.node("n"), s.number("m"), s.number("Id"), s.number("Ip")});
}

void read_mass(const RossSection& s, RossRotor& rotor) {
  const double m = s.number_or("m", 0.0);
  rotor.masses.push_back({s.tag(), s.node("n"), s.number_or("mx", m), s.number_or("my", m)});
}

void read_coupling(const RossSection& s, RossRotor& rotor) {
  const auto pair = [&](std::string_view a, std::string_view b) {
    return std::array{s.number_or(a, 0.0), s.number_or(b, 0.0)};
  };
  rotor.couplings.push_back({.name = s.tag(),
                             .node = s.node("n"),
                             .length = s.number("L"),
                             .outer = s.number_or("o_d", 0.0),
                             .m = pair("m_l", "m_r"),
                             .Id = pair("Id_l", "Id_r"),
                             .Ip = pair("Ip_l", "Ip_r"),
                             .k = pair("kt_x", "kt_y"),
                             .c = pair("ct_x", "ct_y"),
                             .k_tilt = pair("kr_x", "kr_y"),
                             .c_tilt = pair("cr_x", "cr_y")});
  for (const std::string_view key : {"kt_z", "ct_z"}) {
    leave_out(s, key, "motion along the axis", rotor);
  }
  for (const std::string_view key : {"kr_z", "cr_z"}) {
    leave_out(s, key, "turning about the axis", rotor);
  }
}

/// A number from 0 on, which one that is missing is; one below is left out.
double positive_of(const RossSection& s, std::string_view key, RossRotor& rotor) {
  const double value = s.number_or(key, 0.0);
  if (value < 0.0) rotor.left_out.push_back(fmt::format("{} = {}: below zero", key, value));
  return std::max(0.0, value);
}

/// Speeds that the rotor is made for; one that is none is left out.
void read_speeds(const RossSection& s, RossRotor& rotor) {
  rotor.rated_speed = positive_of(s, "rated_w", rotor);
  rotor.minimum_speed = positive_of(s, "min_w", rotor);
  rotor.maximum_speed = positive_of(s, "max_w", rotor);
  if (rotor.maximum_speed > 0.0 && rotor.minimum_speed > rotor.maximum_speed) {
    rotor.left_out.emplace_back("min_w and max_w: the first one is above the other");
    rotor.minimum_speed = rotor.maximum_speed = 0.0;
  }
}

/// Damping of the whole rotor.
void read_damping(const RossSection& s, RossRotor& rotor) {
  rotor.mass_damping = positive_of(s, "alpha", rotor);
  rotor.stiffness_damping = positive_of(s, "beta", rotor);
  rotor.damping_ratios = s.numbers("modal_damping_ratio");
  rotor.default_ratio = s.number_or("default_damping_ratio", 0.0);
  const auto is_wrong = [](double ratio) { return ratio < 0.0 || ratio >= 1.0; };
  std::vector<double>& ratios = rotor.damping_ratios;
  if (is_wrong(rotor.default_ratio) || std::any_of(ratios.begin(), ratios.end(), is_wrong)) {
    rotor.left_out.emplace_back("damping ratios of modes: one is below zero, or 1 and more");
    ratios.clear();
    rotor.default_ratio = 0.0;
  }
}

void read_section(const RossSection& s, RossRotor& rotor, bool is_before_3, UnreadKeys& unread) {
  const std::string kind = s.class_name();
  if (kind.starts_with("ShaftElement")) {
    read_element(s, rotor, unread);
  } else if (kind.starts_with("CouplingElement")) {
    read_coupling(s, rotor);
  } else if (s.has("kxx")) {
    read_ross_bearing(s, rotor, is_before_3, unread);
  } else if (kind.starts_with("PointMass")) {
    read_mass(s, rotor);
  } else if (kind.starts_with("Gear")) {
    read_ross_gear(s, rotor, unread);
  } else if (s.has("m") && s.has("Id") && s.has("Ip")) {
    read_disk(s, rotor);
  } else {
    rotor.left_out.push_back(fmt::format("\"{}\": a {} is not known", s.tag(), kind));
    return;  // with all its keys
  }
  s.add_unread(unread);
}

/// Says what nobody read, once for each class and key; of classes whose coefficients were computed
/// from their keys all of them at once.
void tell_unread(const UnreadKeys& unread, RossRotor& rotor) {
  bool has_pictures = false;
  std::map<std::string, std::string> computed;
  for (const auto& [what, tags] : unread.tags) {
    const auto& [kind, key] = what;
    if (is_of_pictures(key.substr(key.rfind('.') + 1))) {
      has_pictures = true;
    } else if (kind.empty()) {
      rotor.left_out.push_back(fmt::format("{}: not known", key));
    } else if (unread.computed.contains(kind)) {
      computed[kind] += (computed[kind].empty() ? "" : ", ") + key;
    } else {
      rotor.left_out.push_back(fmt::format("{} of {}: not known", key,
                                           tags.size() == 1
                                               ? fmt::format("\"{}\"", tags.front())
                                               : fmt::format("{} elements {}", tags.size(), kind)));
    }
  }
  for (const auto& [kind, keys] : computed) {
    rotor.left_out.push_back(
        fmt::format("of {}: what its coefficients come from ({})", kind, keys));
  }
  if (has_pictures) rotor.left_out.emplace_back("colors and sizes of pictures");
}

}  // namespace

bool RossElement::is_like(const RossElement& other) const {
  const bool is_cone = outer[0] != outer[1] || inner[0] != inner[1];
  return !is_cone && material == other.material && length == other.length && outer == other.outer &&
         inner == other.inner && axial_force == other.axial_force && torque == other.torque &&
         shears == other.shears && tilts == other.tilts && turns == other.turns &&
         is_hutchinson == other.is_hutchinson && mass_damping == other.mass_damping &&
         stiffness_damping == other.stiffness_damping;
}

RossRotor read_ross(const ConfigNode& root) {
  RossRotor rotor;
  std::vector<Problem> problems;
  const ConfigNode* version = root.find("ross_version");
  if (version) rotor.version = version->text;
  const bool is_before_3 = !version || version->text.starts_with("2.") ||
                           version->text.starts_with("1.") || version->text.starts_with("0.");
  rotor.tables = is_before_3 ? RossTables::smoothing_spline : RossTables::pchip;
  UnreadKeys unread;
  for (const ConfigNode::Entry& entry : root.entries) {
    const bool is_table = entry.value.kind == ConfigNode::Kind::table;
    if (entry.key == "parameters" && is_table) {
      const RossSection parameters(entry, problems);
      read_speeds(parameters, rotor);
      read_damping(parameters, rotor);
      read_ross_shafts(parameters, rotor);
      parameters.add_unread(unread);
    } else if (is_table && entry.key.find('_') != std::string::npos) {
      read_section(RossSection(entry, problems), rotor, is_before_3, unread);
    } else if (entry.key != "ross_version" && entry.key != "_note") {
      unread.tags[{"", entry.key}].emplace_back();
    }
  }
  if (rotor.elements.empty() && problems.empty()) {
    problems.push_back(
        {root.where, "",
         "no shaft elements of ROSS in it; expected a file that rotor.save of ROSS 2 "
         "or 3 wrote"});
  }
  std::stable_sort(rotor.elements.begin(), rotor.elements.end(),
                   [](const RossElement& a, const RossElement& b) {
                     return std::pair(a.node, a.inner[0]) < std::pair(b.node, b.inner[0]);
                   });
  if (!problems.empty()) throw ModelError(std::move(problems));
  tell_unread(unread, rotor);
  return rotor;
}

}  // namespace whirl::inline io
