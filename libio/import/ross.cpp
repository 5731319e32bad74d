#include "libio/import/ross.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace whirl::inline io {

namespace {

/// Keys that nobody read, and how often: of a class of elements, or of the materials in it.
using UnreadKeys = std::map<std::pair<std::string, std::string>, std::vector<std::string>>;

/// Keys that say how things are drawn.
bool is_of_pictures(std::string_view key) {
  return key == "color" || key == "scale_factor";
}

/// An element of ROSS: a table "CLASS_tag" of the file. It knows which of its keys were read.
class Section {
 public:
  Section(const ConfigNode::Entry& entry, std::vector<Problem>& problems)
      : key_(entry.key), table_(entry.value), problems_(problems) {}
  /// A table in the element.
  Section(const Section& outer, std::string_view key, const ConfigNode& table)
      : key_(outer.key_),
        below_(std::string(key) + "."),
        table_(table),
        problems_(outer.problems_) {}

  std::string class_name() const { return key_.substr(0, key_.find('_')); }
  std::string tag() const {
    const ConfigNode* given = table_.find("tag");
    if (given && given->kind == ConfigNode::Kind::string && !given->text.empty()) {
      return given->text;
    }
    return key_.substr(std::min(key_.size(), key_.find('_') + 1));
  }
  const Where& where() const { return table_.key_where; }

  /// Whether there is a value, which is not read by asking.
  bool has(std::string_view key) const {
    const ConfigNode* value = table_.find(key);
    return value && value->kind != ConfigNode::Kind::other;
  }
  /// A value of a key; null: it is not there, or null.
  const ConfigNode* find(std::string_view key) const {
    read_.insert(std::string(key));
    return has(key) ? table_.find(key) : nullptr;
  }
  /// Adds the keys with values that nobody asked for.
  void add_unread(UnreadKeys& unread) const {
    for (const ConfigNode::Entry& entry : table_.entries) {
      if (entry.value.kind == ConfigNode::Kind::other || read_.contains(entry.key)) continue;
      unread[{class_name(), below_ + entry.key}].push_back(tag());
    }
  }
  double number(std::string_view key) const {
    if (const ConfigNode* value = find(key)) return number_of(*value, key);
    problem(where(), key, "is missing, expected a number");
    return 0.0;
  }
  double number_or(std::string_view key, double otherwise) const {
    const ConfigNode* value = find(key);
    return value ? number_of(*value, key) : otherwise;
  }
  int node(std::string_view key) const {
    const double value = number(key);
    if (value != std::floor(value) || value < 0.0 || value > 1e6) {
      problem(find(key) ? find(key)->where : where(), key, "expected a node, a number from 0");
      return 0;
    }
    return static_cast<int>(value);
  }
  bool flag(std::string_view key) const {
    const ConfigNode* value = find(key);
    if (!value) return true;
    if (value->kind != ConfigNode::Kind::boolean) {
      problem(value->where, key,
              fmt::format("found {}, expected true or false", value->as_written()));
    }
    return value->boolean;
  }
  double number_of(const ConfigNode& value, std::string_view key) const {
    const bool is_number =
        value.kind == ConfigNode::Kind::integer || value.kind == ConfigNode::Kind::real;
    if (!is_number || !std::isfinite(value.number)) {
      problem(value.where, key, fmt::format("found {}, expected a number", value.as_written()));
    }
    return is_number && std::isfinite(value.number) ? value.number : 0.0;
  }
  /// Numbers of a list, or one alone; none where the key is left out.
  std::vector<double> numbers(std::string_view key) const {
    std::vector<double> list;
    const ConfigNode* value = find(key);
    if (!value) return list;
    if (value->kind != ConfigNode::Kind::array) return {number_of(*value, key)};
    for (const ConfigNode& item : value->items) list.push_back(number_of(item, key));
    return list;
  }
  void problem(const Where& at, std::string_view key, std::string message) const {
    problems_.push_back({at, fmt::format("{}.{}{}", key_, below_, key), std::move(message)});
  }

 private:
  const std::string& key_;
  std::string below_;
  const ConfigNode& table_;
  std::vector<Problem>& problems_;
  mutable std::set<std::string, std::less<>> read_{"tag"};
};

/// Name of a material in the model; the same one for equal values.
std::string material_of(const Section& element, RossRotor& rotor, double& nu, UnreadKeys& unread) {
  const ConfigNode* table = element.find("material");
  if (!table || table->kind != ConfigNode::Kind::table) {
    element.problem(element.where(), "material", "is missing, expected a table of rho, E and G_s");
    return "";
  }
  const Section section(element, "material", *table);
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

void read_element(const Section& s, RossRotor& rotor, UnreadKeys& unread) {
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

/// How ROSS says at what its coefficients hold: since 3.0 `speed` and `frequency`, before that
/// `frequency` is the speed, but of squeeze film dampers and magnetic bearings, whose coefficients
/// are those at a frequency of the whirl in every version.
struct Axes {
  std::vector<double> speed, whirl;
};

Axes axes_of(const Section& s, bool is_before_3) {
  Axes axes{.speed = s.numbers("speed"), .whirl = s.numbers("frequency")};
  const std::string kind = s.class_name();
  const bool is_of_whirl =
      kind.find("Damper") != std::string::npos || kind.find("Magnetic") != std::string::npos;
  if (is_before_3 && !is_of_whirl && axes.speed.empty()) std::swap(axes.speed, axes.whirl);
  return axes;
}

/// Coefficients of one key, row after row: a list over the rows, or a list of lists, over the
/// frequencies of each speed.
std::vector<double> coefficients_of(const Section& s, std::string_view key) {
  const ConfigNode* value = s.find(key);
  const bool is_grid = value && value->kind == ConfigNode::Kind::array && !value->items.empty() &&
                       value->items.front().kind == ConfigNode::Kind::array;
  if (!is_grid) return s.numbers(key);
  std::vector<double> all;
  for (const ConfigNode& line : value->items) {
    if (line.kind != ConfigNode::Kind::array) {
      s.problem(line.where, key, "expected a list for every speed, as the first one is");
    }
    for (const ConfigNode& item : line.items) all.push_back(s.number_of(item, key));
  }
  return all;
}

/// Tells that coefficients are left out, where any of them is not zero.
void leave_out(const Section& s, std::string_view key, std::string_view why, RossRotor& rotor) {
  const std::vector<double> values = coefficients_of(s, key);
  if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; })) {
    rotor.left_out.push_back(fmt::format("{} of \"{}\": {}", key, s.tag(), why));
  }
}

void read_bearing(const Section& s, RossRotor& rotor, bool is_before_3) {
  RossBearing b{.where = s.where(),
                .name = s.tag(),
                .is_seal = s.class_name().find("Seal") != std::string::npos,
                .node = s.node("n")};
  if (s.find("n_link")) b.link = s.node("n_link");
  const Axes axes = axes_of(s, is_before_3);
  b.has_speed = !axes.speed.empty();
  b.has_whirl = !axes.whirl.empty();
  const std::vector<double> kxx = coefficients_of(s, "kxx");
  const std::size_t rows = kxx.size();
  const std::size_t speeds = std::max<std::size_t>(1, axes.speed.size()),
                    frequencies = std::max<std::size_t>(1, axes.whirl.size());
  const bool is_grid = rows == speeds * frequencies,
             is_list = speeds == frequencies && rows == speeds;
  if (!is_grid && !is_list) {
    s.problem(s.where(), "kxx",
              fmt::format("has {} values for {} speeds and {} frequencies", rows, axes.speed.size(),
                          axes.whirl.size()));
    return;
  }
  b.rows.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    if (b.has_speed) b.rows[i].speed = axes.speed[is_grid ? i / frequencies : i];
    if (b.has_whirl) b.rows[i].whirl = axes.whirl[is_grid ? i % frequencies : i];
  }
  for (std::size_t k = 0; k < ross_coefficients.size(); ++k) {
    const std::vector<double> values = k == 0 ? kxx : coefficients_of(s, ross_coefficients[k]);
    if (values.empty()) {  // along y: as along x
      for (RossBearing::Row& row : b.rows) row.values[k] = k % 4 == 3 ? row.values[k - 3] : 0.0;
      continue;
    }
    if (values.size() != rows && values.size() != 1) {
      s.problem(s.where(), ross_coefficients[k],
                fmt::format("has {} values, kxx has {}", values.size(), rows));
      continue;
    }
    for (std::size_t i = 0; i < rows; ++i) {
      b.rows[i].values[k] = values[std::min(i, values.size() - 1)];
    }
  }
  for (const std::string_view axial : {"kzz", "czz", "mzz"}) {
    leave_out(s, axial, "motion along the axis", rotor);
  }
  rotor.bearings.push_back(std::move(b));
}

void read_disk(const Section& s, RossRotor& rotor) {
  if (s.class_name().starts_with("Gear")) {
    rotor.taken_differently.push_back(
        fmt::format("the gear \"{}\" is a disk: the forces of its teeth are left out", s.tag()));
  }
  rotor.disks.push_back({s.tag(), s.node("n"), s.number("m"), s.number("Id"), s.number("Ip")});
}

void read_mass(const Section& s, RossRotor& rotor) {
  const double m = s.number_or("m", 0.0);
  rotor.masses.push_back({s.tag(), s.node("n"), s.number_or("mx", m), s.number_or("my", m)});
}

void read_coupling(const Section& s, RossRotor& rotor) {
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
double positive_of(const Section& s, std::string_view key, RossRotor& rotor) {
  const double value = s.number_or(key, 0.0);
  if (value < 0.0) rotor.left_out.push_back(fmt::format("{} = {}: below zero", key, value));
  return std::max(0.0, value);
}

/// Speeds that the rotor is made for; one that is none is left out.
void read_speeds(const Section& s, RossRotor& rotor) {
  rotor.rated_speed = positive_of(s, "rated_w", rotor);
  rotor.minimum_speed = positive_of(s, "min_w", rotor);
  rotor.maximum_speed = positive_of(s, "max_w", rotor);
  if (rotor.maximum_speed > 0.0 && rotor.minimum_speed > rotor.maximum_speed) {
    rotor.left_out.emplace_back("min_w and max_w: the first one is above the other");
    rotor.minimum_speed = rotor.maximum_speed = 0.0;
  }
}

/// Damping of the whole rotor.
void read_damping(const Section& s, RossRotor& rotor) {
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

void read_section(const Section& s, RossRotor& rotor, bool is_before_3, UnreadKeys& unread) {
  const std::string kind = s.class_name();
  if (kind.starts_with("ShaftElement")) {
    read_element(s, rotor, unread);
  } else if (kind.starts_with("CouplingElement")) {
    read_coupling(s, rotor);
  } else if (s.has("kxx")) {
    read_bearing(s, rotor, is_before_3);
  } else if (kind.starts_with("PointMass")) {
    read_mass(s, rotor);
  } else if (s.has("m") && s.has("Id") && s.has("Ip")) {
    read_disk(s, rotor);
  } else {
    rotor.left_out.push_back(fmt::format("\"{}\": a {} is not known", s.tag(), kind));
    return;  // with all its keys
  }
  s.add_unread(unread);
}

/// Says what nobody read, once for each class and key.
void tell_unread(const UnreadKeys& unread, RossRotor& rotor) {
  bool has_pictures = false;
  for (const auto& [what, tags] : unread) {
    const auto& [kind, key] = what;
    if (is_of_pictures(key.substr(key.rfind('.') + 1))) {
      has_pictures = true;
    } else if (kind.empty()) {
      rotor.left_out.push_back(fmt::format("{}: not known", key));
    } else {
      rotor.left_out.push_back(fmt::format("{} of {}: not known", key,
                                           tags.size() == 1
                                               ? fmt::format("\"{}\"", tags.front())
                                               : fmt::format("{} elements {}", tags.size(), kind)));
    }
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
      const Section parameters(entry, problems);
      read_speeds(parameters, rotor);
      read_damping(parameters, rotor);
      parameters.add_unread(unread);
    } else if (is_table && entry.key.find('_') != std::string::npos) {
      read_section(Section(entry, problems), rotor, is_before_3, unread);
    } else if (entry.key != "ross_version" && entry.key != "_note") {
      unread[{"", entry.key}].emplace_back();
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
