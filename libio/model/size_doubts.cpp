#include "libio/model/size_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "libbase/structs/names.hpp"
#include "libfe/mesh/mesh.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

// Beyond these a number was most likely meant in another unit. The longest shafts of machines, of
// turbine sets coupled, are made of rotors of some 15 m; their diameters stay below 3 m.
constexpr double longest = 30.0, thickest = 3.0;  ///< [m]
constexpr double slimmest =
    500.0;  ///< lengths of a shaft in its diameters; of line shafts some 100

std::string as_meters(double length) {
  return fmt::format(
      "{0:.4g} m; lengths without a unit are meters: did you mean {0:.4g} mm, or in?", length);
}

/// Shafts that are too long, too thick or too slim for machines.
void doubt_shaft(const Structure& s, std::vector<Problem>& doubts) {
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
  for (const Structure::Shaft& shaft : s.shafts()) {
    for (const Segment& segment : shaft.segments) look_at(segment, "shaft");
  }
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

/// The place of a key of an element of an array, by its number from 0; else of the element.
Where where_of(const ConfigNode& root, const char* array, std::size_t item, const char* key) {
  const ConfigNode* list = root.find(array);
  if (!list || item >= list->items.size()) return {};
  const ConfigNode* value = list->items[item].find(key);
  return value ? value->where : list->items[item].where;
}

/// Its name there, else its number from 1: "contact.ring", "contact.1".
std::string path_of(const ConfigNode& root, const std::string& array, std::size_t item) {
  const ConfigNode* list = root.find(array);
  const ConfigNode* name =
      list && item < list->items.size() ? list->items[item].find("name") : nullptr;
  return array + '.' + (name ? name->text : std::to_string(item + 1));
}

/// Position of a station on the shaft; nothing: it is on a body or the ground.
std::optional<double> position_of(const Station& station, const Structure& s, const Mesh& mesh) {
  return mesh.position_of(resolve(station, s, mesh));
}

void doubt_disks(const ConfigNode& root, const Structure& s, const Mesh& mesh,
                 std::vector<Problem>& doubts) {
  for (std::size_t i = 0; i < s.disks.size(); ++i) {
    const Disk& disk = s.disks[i];
    const auto at = position_of(disk.at, s, mesh);
    if (!at || !(disk.width > 0.0)) continue;
    const Where where = where_of(root, "disk", i, "width");
    const std::string key = path_of(root, "disk", i) + ".width";
    if (disk.width > s.length()) {
      doubts.push_back({where, key,
                        fmt::format("the disk is {} wide, the shaft {} long",
                                    format_length(disk.width), format_length(s.length()))});
      continue;
    }
    for (const Connection& bearing : s.bearings) {
      const auto z = position_of(bearing.from, s, mesh);
      const double distance = z ? std::abs(*z - *at) : 0.0;
      // a bearing below the middle of a disk is a way to write a hub
      if (distance < 1e-9 || distance > 0.5 * disk.width) continue;
      doubts.push_back({where, key,
                        fmt::format("the disk is {} wide and reaches over {}, {} beside its middle",
                                    format_length(disk.width), named("bearing", bearing.name),
                                    format_length(distance))});
      break;
    }
  }
}

/// The largest radius of what turns at a station; nothing: it is not on the shaft, or a disk there
/// does not say its diameter.
std::optional<double> radius_at(const Station& station, const Structure& s, const Mesh& mesh) {
  const Point at = resolve(station, s, mesh);
  if (at.kind != Point::Kind::node) return std::nullopt;
  double largest = diameter_at(s, mesh, at.index);
  for (const Disk& disk : s.disks) {
    if (resolve(disk.at, s, mesh) != at) continue;
    if (disk.m > 0.0 && disk.outer_diameter == 0.0) return std::nullopt;
    largest = std::max(largest, disk.outer_diameter);
  }
  return 0.5 * largest;
}

}  // namespace

void doubt_sizes(const ConfigNode& root, const Model& model, std::vector<Problem>& doubts) {
  if (model.structure.shaft.empty()) return;
  doubt_shaft(model.structure, doubts);
  doubt_disks(root, model.structure, make_mesh(model.structure), doubts);
}

void doubt_clearances(const ConfigNode& root, const Model& model, std::vector<Problem>& doubts) {
  const Structure& s = model.structure;
  if (s.shaft.empty()) return;
  const Mesh mesh = make_mesh(s);
  const auto look_at = [&](const char* kind, std::size_t i, const Station& at, double clearance) {
    const auto radius = radius_at(at, s, mesh);
    const Where where = where_of(root, kind, i, "clearance");
    const bool is_told =
        std::ranges::any_of(doubts, [&](const Problem& d) { return d.where == where; });
    if (is_told || !radius || !(clearance > *radius)) return;
    doubts.push_back({where, path_of(root, kind, i) + ".clearance",
                      fmt::format("{} is more than the radius of the shaft there, {}",
                                  format_length(clearance), format_length(*radius))});
  };
  const std::vector<Contact> contacts = stator_contacts(model.contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    look_at("contact", i, contacts[i].at, contacts[i].clearance);
  }
  for (std::size_t i = 0; i < s.bearings.size(); ++i) {
    look_at("bearing", i, s.bearings[i].from, s.bearings[i].clearance);
  }
  for (std::size_t i = 0; i < s.seals.size(); ++i) {
    look_at("seal", i, s.seals[i].from, s.seals[i].clearance);
  }
}

}  // namespace whirl::inline io
