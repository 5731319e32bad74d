#include "libio/model/model_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/names.hpp"
#include "libfe/mesh/mesh.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/model/size_doubts.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/format.hpp"
#include "libio/text/units.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

namespace {

constexpr double same_diameter = 1e-6;  ///< relative: rounding of units

/// What numbers of a key are like in machines. One without a unit that is not like this was most
/// likely meant in another unit; with a unit it is taken as it stands.
struct UsualNumbers {
  std::string_view key;  ///< last part of its path
  std::string_view unit;
  double least, most;                      ///< that nobody is asked about; nor about zero
  std::string_view example;                ///< with the unit, for comparison
  std::array<std::string_view, 3> others;  ///< units that it may be meant in; empty: no more
  double likely_least = least, likely_most = most;  ///< of what is meant in one of those
};
constexpr std::string_view steel_weighs = "steel has 7850 kg/m^3";
constexpr std::string_view fast = "10 000 rpm are 1047 rad/s";
constexpr UsualNumbers usual_numbers[] = {
    {"density", "kg/m^3", 500.0, 25e3, steel_weighs, {"lb/in^3", "g/cm^3", "lb/ft^3"}},
    {"youngs_modulus", "Pa", 1e9, 1e16, "steel has 2.1e11 Pa", {"GPa", "MPa", "psi"}, 1e9, 2e12},
    {"shear_modulus", "Pa", 1e8, 1e16, "steel has 8e10 Pa", {"GPa", "MPa", "psi"}, 1e8, 1e12},
    {"friction", "", 0.0, 2.0, "dry steel has some 0.3, and 15 % are 0.15", {}},
    {"viscosity", "Pa.s", 1e-6, 2.0, "oils have some 0.01 Pa.s", {"cP", "ureyn"}, 1e-4, 2.0},
    {"clearance", "m", 0.0, 0.02, "those of machines are below 20 mm", {"mm", "um", "mil"}, 1e-6},
    {"moment",
     "kg.m",
     0.0,
     10.0,
     "a blade lost at 1 m makes some 5 kg.m",
     {"g.mm", "g.cm", "oz.in"}},
    {"speed", "rad/s", 0.0, 5000.0, fast, {"rpm"}},
    {"minimum_speed", "rad/s", 0.0, 5000.0, fast, {"rpm"}},
    {"maximum_speed", "rad/s", 0.0, 5000.0, fast, {"rpm"}},
    {"trip_speed", "rad/s", 0.0, 5000.0, fast, {"rpm"}}};

const UsualNumbers* usual_numbers_of(std::string_view key) {
  const auto* found = std::find_if(std::begin(usual_numbers), std::end(usual_numbers),
                                   [&](const UsualNumbers& usual) { return usual.key == key; });
  return found == std::end(usual_numbers) ? nullptr : found;
}

bool is_unusual(double number, const UsualNumbers& usual) {
  const double size = std::abs(number);
  return size > 0.0 && (size < usual.least || size > usual.most);
}

bool is_more_than_a_turn(double number) {
  return std::abs(number) > 2.0 * std::numbers::pi;
}

using NumbersByPath = std::map<std::string, const ConfigNode*>;

/// Adds numbers without a unit that may be doubted, by the paths that messages may have for them:
/// what is in a list has its name or its number.
void add_bare_numbers(const ConfigNode& node, const std::string& key, const std::string& path,
                      NumbersByPath& found) {
  using enum ConfigNode::Kind;
  if (node.kind == integer || node.kind == real) {
    const UsualNumbers* usual = usual_numbers_of(key);
    if (is_more_than_a_turn(node.number) || (usual && is_unusual(node.number, *usual))) {
      found.emplace(path, &node);
    }
  }
  const auto inside = [&](const ConfigNode& value, const std::string& label) {
    add_bare_numbers(value, label, path.empty() ? label : path + '.' + label, found);
  };
  for (const auto& [label, value] : node.entries) inside(value, label);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const ConfigNode* name = node.items[i].find("name");
    if (name && name->kind == string) inside(node.items[i], name->text);
    inside(node.items[i], std::to_string(i + 1));
  }
}

/// The units, of those that a number may be meant in, with which it is a usual one:
/// ", did you mean \"0.283 lb/in^3\"?"
std::string meant_units(double number, const UsualNumbers& usual) {
  std::vector<std::string> meant;
  for (const std::string_view unit : usual.others) {
    if (unit.empty()) break;
    const std::string text = fmt::format("{:g} {}", number, unit);
    const auto value = parse_as(text, usual.unit);
    if (!value) continue;
    const double size = std::abs(*value);
    if (size >= usual.likely_least && size <= usual.likely_most) meant.push_back('"' + text + '"');
  }
  if (meant.empty()) return "";
  return fmt::format("; did you mean {}?", fmt::join(meant, " or "));
}

/// What is doubted of a number without a unit; empty: nothing.
std::string doubt_of(double number, const AskedKey& key) {
  if (key.unit == "rad" && is_more_than_a_turn(number)) {
    return fmt::format(
        "{0:g} without a unit is {0:g} rad = {1:.4g} deg; did you mean \"{0:g} deg\"?", number,
        number / degree);
  }
  const UsualNumbers* usual =
      usual_numbers_of(std::string_view(key.path).substr(key.path.rfind('.') + 1));
  if (!usual || usual->unit != key.unit || !is_unusual(number, *usual)) return "";
  const std::string value =
      usual->unit.empty() ? fmt::format("{:g}", number)
      : usual->unit == "rad/s"
          ? fmt::format("{0:g} without a unit is {0:g} rad/s = {1} rpm", number,
                        format_grouped(number / rpm))
          : fmt::format("{0:g} without a unit is {0:g} {1}", number, usual->unit);
  return fmt::format("{}: {}{}", value, usual->example, meant_units(number, *usual));
}

/// Numbers without a unit that are another thing in that unit than in SI.
void doubt_bare_numbers(const ConfigNode& root, const std::vector<AskedKey>& asked,
                        std::vector<Problem>& doubts) {
  NumbersByPath bare;
  add_bare_numbers(root, "", "", bare);
  for (const AskedKey& key : asked) {
    if (key.form != AskedKey::Form::quantity) continue;
    const auto found = bare.find(key.path);
    if (found == bare.end()) continue;
    const std::string doubt = doubt_of(found->second->number, key);
    if (!doubt.empty()) doubts.push_back({found->second->where, key.path, doubt});
  }
}

/// A speed that the machine is not run at, by what its own model says.
void doubt_speed(const ConfigNode& root, const Model& model, std::vector<Problem>& doubts) {
  const std::string doubt = speed_doubt(model);
  if (doubt.empty()) return;
  const ConfigNode* operation = root.find("operation");
  const ConfigNode* speed = operation ? operation->find("speed") : nullptr;
  doubts.push_back({speed ? speed->where : Where{}, "operation.speed", doubt});
}

/// A ring of material along the shaft: a segment or a layer.
struct Ring {
  std::string name;  ///< "the shaft", "layer sleeve"
  int shaft = 0;     ///< on which it is
  double from = 0.0, to = 0.0;
  Section left, right;
  bool has_mass = true, has_stiffness = true;

  Section at(double z) const { return between(left, right, (z - from) / (to - from)); }
};

Ring ring_of(const Layer& layer, const LayerSpan& span) {
  return {.name = named("layer", layer.name),
          .shaft = span.shaft,
          .from = span.from,
          .to = span.to,
          .left = layer.left,
          .right = layer.right,
          .has_mass = layer.carries != Carries::stiffness,
          .has_stiffness = layer.carries != Carries::mass};
}

/// Where two rings are at one place: the ends of that, and there the inner diameter of the outer
/// one and the outer one of the inner.
struct Overlap {
  double from = 0.0, to = 0.0;
  double inner = 0.0, outer = 0.0;
};

std::optional<Overlap> overlap_of(const Ring& a, const Ring& b) {
  if (!(a.has_mass && b.has_mass) && !(a.has_stiffness && b.has_stiffness)) return std::nullopt;
  const double from = std::max(a.from, b.from), to = std::min(a.to, b.to);
  if (!(to - from > same_diameter * (a.to - a.from))) return std::nullopt;
  std::optional<Overlap> worst;
  for (const double z : {from, 0.5 * (from + to), to}) {
    const Section one = a.at(z), other = b.at(z);
    const double inner = std::max(one.inner, other.inner), outer = std::min(one.outer, other.outer);
    if (!(outer - inner > same_diameter * outer)) continue;
    if (!worst || outer - inner > worst->outer - worst->inner) worst = {from, to, inner, outer};
  }
  return worst;
}

/// Layers that lie where the shaft or another layer is.
void doubt_layers(const Structure& s, std::vector<Problem>& doubts) {
  if (s.layers.empty()) return;
  const Mesh mesh = make_mesh(s);
  std::vector<Ring> rings;
  int number = 0;
  for (const Structure::Shaft& shaft : s.shafts()) {
    double z = shaft.start;
    for (const Segment& segment : shaft.segments) {
      rings.push_back({shaft.name.empty() ? "the shaft" : "the shaft of rotor " + shaft.name,
                       number, z, z + segment.length, segment.left, segment.right});
      z += segment.length;
    }
    ++number;
  }
  std::vector<Problem> found;
  for (const Layer& layer : s.layers) {
    const Ring ring = ring_of(layer, span_of(layer, s, mesh));
    for (const Ring& other : rings) {
      if (other.shaft != ring.shaft) continue;
      const auto shared = overlap_of(ring, other);
      if (!shared) continue;
      // rows of tables have the names of columns
      const bool is_row = layer.from.key == "layer";
      found.push_back(
          {layer.where, is_row ? "inner_diameter" : "layer." + layer.name,
           fmt::format("lies in {} from {:.6g} to {:.6g} mm: what is between the diameters {:.6g} "
                       "and {:.6g} mm counts twice; a layer begins at the outer diameter of what "
                       "it lies on",
                       other.name, 1e3 * shared->from, 1e3 * shared->to, 1e3 * shared->inner,
                       1e3 * shared->outer)});
      break;
    }
    rings.push_back(ring);
  }
  tell_once(found, 0);
  doubts.insert(doubts.end(), found.begin(), found.end());
}

}  // namespace

std::vector<Problem> model_doubts(const std::string& text, const std::string& name,
                                  const std::vector<std::string>& sets, const NamedFiles& files) {
  ConfigNode root = parse_toml(text, name);
  for (const std::string& set : sets) set_value(root, set);
  std::vector<AskedKey> asked;
  ModelBuilder builder(root, files, &asked);
  const Model model = builder.build();
  std::vector<Problem> doubts;
  doubt_sizes(root, model, doubts);
  doubt_layers(model.structure, doubts);
  for (const Problem& doubt : builder.doubts()) {  // two bearings may have one table
    const bool is_known = std::any_of(doubts.begin(), doubts.end(), [&](const Problem& d) {
      return d.where == doubt.where && d.key == doubt.key;
    });
    if (!is_known) doubts.push_back(doubt);
  }
  doubt_bare_numbers(root, asked, doubts);
  doubt_clearances(root, model, doubts);
  doubt_speed(root, model, doubts);
  for (Problem& doubt : doubts) doubt.where = with_cell_name(doubt.where);
  return doubts;
}

std::string speed_doubt(const Model& model) {
  // machines are tried somewhat beyond the range that they are run in, and turned slowly below it
  constexpr double far_above = 1.5, far_below = 1.0 / 20.0;
  const MachineSpeeds& m = model.machine;
  const double most = std::max(m.maximum, m.trip), speed = std::abs(model.speed);
  if (!model.has_speed || speed == 0.0) return "";
  if (most > 0.0 && speed > far_above * most) {
    return fmt::format(
        "the speed is {} rpm, {:.3g} times the largest of [operation], {} rpm; speeds "
        "without a unit are rad/s",
        format_grouped(speed / rpm), speed / most, format_grouped(most / rpm));
  }
  if (m.minimum > 0.0 && speed < far_below * m.minimum) {
    return fmt::format("the speed is {} rpm, {:.2g} times the least of [operation], {} rpm",
                       format_grouped(speed / rpm), speed / m.minimum,
                       format_grouped(m.minimum / rpm));
  }
  return "";
}

std::vector<Problem> rest_doubts(const ModelFacts& facts, const Model& model) {
  std::vector<Problem> doubts;
  for (const RunningClearance& c : facts.clearances) {
    if (!(c.left() < 0.0)) continue;
    const auto contact =
        std::find_if(model.contacts.begin(), model.contacts.end(),
                     [&](const Contact& one) { return named("contact", one.name) == c.name; });
    const Where where = contact == model.contacts.end() ? Where{} : contact->where;
    doubts.push_back({where, c.name,
                      fmt::format("touches at rest: the rotor is {:.4g} mm from the middle, the "
                                  "clearance is {:.4g} mm, {:.4g} mm are left",
                                  1e3 * c.distance, 1e3 * c.clearance, 1e3 * c.left())});
  }
  return doubts;
}

}  // namespace whirl::inline io
