#include "libio/model/model_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "libbase/constants.hpp"
#include "libbase/names.hpp"
#include "libfe/mesh.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

namespace {

// Beyond these a number was most likely meant in another unit. The longest shafts of machines, of
// turbine sets coupled, are made of rotors of some 15 m; their diameters stay below 3 m.
constexpr double longest = 30.0, thickest = 3.0;  ///< [m]
constexpr double slimmest =
    500.0;  ///< lengths of a shaft in its diameters; of line shafts some 100
constexpr double same_diameter = 1e-6;  ///< relative: rounding of units

using NumbersByPath = std::map<std::string, const ConfigNode*>;

/// Adds numbers without a unit that are more than a turn, by the paths that messages may have for
/// them: what is in a list has its name or its number.
void add_bare_turns(const ConfigNode& node, const std::string& path, NumbersByPath& found) {
  using enum ConfigNode::Kind;
  const bool is_bare = node.kind == integer || node.kind == real;
  if (is_bare && std::abs(node.number) > 2.0 * std::numbers::pi) found.emplace(path, &node);
  const auto inside = [&](const ConfigNode& value, const std::string& label) {
    add_bare_turns(value, path.empty() ? label : path + '.' + label, found);
  };
  for (const auto& [key, value] : node.entries) inside(value, key);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const ConfigNode* name = node.items[i].find("name");
    if (name && name->kind == string) inside(node.items[i], name->text);
    inside(node.items[i], std::to_string(i + 1));
  }
}

/// Angles without a unit that are more than a turn.
void doubt_angles(const ConfigNode& root, const std::vector<AskedKey>& asked,
                  std::vector<Problem>& doubts) {
  NumbersByPath turns;
  add_bare_turns(root, "", turns);
  for (const AskedKey& key : asked) {
    if (key.form != AskedKey::Form::quantity || key.unit != "rad") continue;
    const auto found = turns.find(key.path);
    if (found == turns.end()) continue;
    const ConfigNode* value = found->second;
    doubts.push_back({value->where, key.path,
                      fmt::format("{0:g} without a unit is {0:g} rad = {1:.4g} deg; did you mean "
                                  "\"{0:g} deg\"?",
                                  value->number, value->number / degree)});
  }
}

std::string as_meters(double length) {
  return fmt::format(
      "{0:.4g} m; lengths without a unit are meters: did you mean {0:.4g} mm, or in?", length);
}

/// Shafts that are too long, too thick or too slim for machines.
void doubt_sizes(const Structure& s, std::vector<Problem>& doubts) {
  if (s.shaft.empty()) return;
  const auto longer = [](const Segment& a, const Segment& b) { return a.length < b.length; };
  const Segment& longest_one = *std::max_element(s.shaft.begin(), s.shaft.end(), longer);
  const double length = s.length();
  double largest = 0.0;
  std::vector<Problem> found;
  const auto look_at = [&](const auto& part, const char* what) {
    const double outer = std::max(part.left.outer, part.right.outer);
    largest = std::max(largest, outer);
    if (outer <= thickest) return;
    found.push_back({part.where, what, "the outer diameter is " + as_meters(outer)});
  };
  for (const Segment& segment : s.shaft) look_at(segment, "shaft");
  for (const Layer& layer : s.layers) look_at(layer, "layer");
  if (length > longest) {
    found.insert(found.begin(),
                 {longest_one.where, "shaft", "the shaft is as long as " + as_meters(length)});
  }
  if (found.empty() && length > slimmest * largest) {
    found.push_back(
        {longest_one.where, "shaft",
         fmt::format("the shaft is {:.4g} times as long as it is thick ({:.4g} m, {:.4g} "
                     "mm at most): is one of them in another unit?",
                     length / largest, length, 1e3 * largest)});
  }
  tell_once(found, 0);
  doubts.insert(doubts.end(), found.begin(), found.end());
}

/// A ring of material along the shaft: a segment or a layer.
struct Ring {
  std::string name;  ///< "the shaft", "layer sleeve"
  double from = 0.0, to = 0.0;
  Section left, right;
  bool has_mass = true, has_stiffness = true;

  Section at(double z) const { return between(left, right, (z - from) / (to - from)); }
};

Ring ring_of(const Layer& layer, const LayerSpan& span) {
  return {.name = named("layer", layer.name),
          .from = span.from,
          .to = span.to,
          .left = layer.left,
          .right = layer.right,
          .has_mass = layer.carries != Carries::stiffness,
          .has_stiffness = layer.carries != Carries::mass};
}

/// Where two rings are at one place: the ends of that, and there the inner diameter of the outer one
/// and the outer one of the inner.
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
  double z = 0.0;
  for (const Segment& segment : s.shaft) {
    rings.push_back({"the shaft", z, z + segment.length, segment.left, segment.right});
    z += segment.length;
  }
  std::vector<Problem> found;
  for (const Layer& layer : s.layers) {
    const Ring ring = ring_of(layer, span_of(layer, s, mesh));
    for (const Ring& other : rings) {
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
  doubt_sizes(model.structure, doubts);
  doubt_layers(model.structure, doubts);
  for (const Problem& doubt : builder.doubts()) {  // two bearings may have one table
    const bool is_known = std::any_of(doubts.begin(), doubts.end(), [&](const Problem& d) {
      return d.where == doubt.where && d.key == doubt.key;
    });
    if (!is_known) doubts.push_back(doubt);
  }
  doubt_angles(root, asked, doubts);
  return doubts;
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
