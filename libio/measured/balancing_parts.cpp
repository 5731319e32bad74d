#include "libio/measured/balancing_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io::balancing {

namespace {

constexpr std::array station_keys{"at", "node", "body"};

bool has_station(const ConfigNode& table) {
  return std::any_of(station_keys.begin(), station_keys.end(),
                     [&](const char* key) { return table.find(key); });
}

ConfigNode text_node(std::string text, const Where& where) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::string;
  node.text = std::move(text);
  node.where = node.key_where = where;
  return node;
}

/// Angles of holes: a list, or a number of equal steps.
Vec hole_angles(TableReader& table, const BalancingConvention& convention) {
  std::vector<double> told;
  if (table.has("count")) {
    constexpr long most = 360;
    const long count = table.integer("count", Range::positive).value_or(1);
    table.at_most("count", count, most);
    const double first = read_angle(table, "first").value_or(0.0);
    for (long i = 0; i < std::min(count, most); ++i) {
      told.push_back(first + turn * static_cast<double>(i) / static_cast<double>(count));
    }
    if (table.has("angles"))
      table.problem("angles", "found both, expected one of count and angles");
  } else if (table.has("angles")) {
    told = table.list("angles", "rad", Range::any);
  } else {
    table.missing("angles", "angles of the holes, or their count", {"count"});
  }
  Vec angles(std::ssize(told));
  for (std::size_t i = 0; i < told.size(); ++i) {
    angles(static_cast<Eigen::Index>(i)) = std::arg(convention.direction(told[i]));
  }
  return angles;
}

std::optional<BalancingHoles> read_holes(TableReader& plane, const BalancingConvention& convention,
                                         std::vector<Problem>& problems) {
  const ConfigNode* node = plane.node("holes");
  if (!node) return std::nullopt;
  TableReader table(node, plane.path("holes"), problems);
  BalancingHoles holes;
  holes.angles = hole_angles(table, convention);
  if (const auto most = table.quantity("most", "kg", Range::positive)) holes.most = *most;
  if (table.has("pieces")) holes.pieces = table.list("pieces", "kg", Range::positive);
  constexpr long most_pieces = 20;
  const long count = table.integer("pieces_per_hole", Range::positive).value_or(1);
  table.at_most("pieces_per_hole", count, most_pieces);
  holes.pieces_per_hole = static_cast<int>(std::min(count, most_pieces));
  table.finish();
  return holes;
}

/// The unit of a probe: of length, velocity or acceleration.
void read_unit(TableReader& table, BalancingProbe& probe) {
  const std::string unit = table.string("unit").value_or(probe.unit);
  for (const char* si : {"m", "m/s", "m/s^2"}) {
    const auto one = parse_as("1 " + unit, si);
    if (!one || unit.empty()) continue;
    probe.unit = unit;
    probe.si_unit = si;
    probe.per_unit = *one;
    return;
  }
  table.problem("unit", fmt::format("found {}, expected a unit of displacement, velocity or "
                                    "acceleration, such as \"um\" or \"mm/s\"",
                                    in_quotes(unit)));
}

/// What balancing asks of a probe beside what it is.
void read_demands(TableReader& table, const BalancingConvention& convention,
                  BalancingProbe& probe) {
  if (const auto weight = table.quantity("weight", "", Range::positive)) probe.weight = *weight;
  if (const auto size = read_amplitude(table, "allowed", probe, convention)) probe.allowed = *size;
  if (const auto size = read_amplitude(table, "uncertainty", probe, convention)) {
    probe.uncertainty = *size;
  }
}

template <class List>
void require_different(const List& list, const ConfigNode& tables, const char* what,
                       std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (list[i].name != list[j].name) continue;
      problems.push_back(
          {tables.items[i].where, fmt::format("{}.{}.name", what, i + 1),
           fmt::format("there are two {}s \"{}\", expected different names", what, list[i].name)});
      break;
    }
  }
}

const ConfigNode* list_of(const ConfigNode& root, const char* name,
                          std::vector<Problem>& problems) {
  const ConfigNode* list = root.find(name);
  if (!list || (list->kind == ConfigNode::Kind::array && !list->items.empty())) return list;
  problems.push_back({list->where, name, fmt::format("expected one [[{}]] or more", name)});
  return nullptr;
}

/// The tree that files of probes have, of a file of balancing or of one of probes alone.
ConfigNode probe_tree(const ConfigNode& root) {
  const bool is_of_balancing = root.find("plane");
  ConfigNode tree;
  tree.where = root.where;
  for (const ConfigNode::Entry& entry : root.entries) {
    const bool is_of_probes =
        entry.key == "probe" || entry.key == "keyphasor" || entry.key == "full_scale";
    if (is_of_balancing && !is_of_probes) continue;
    tree.entries.push_back(entry);
    if (entry.key != "probe") continue;
    for (ConfigNode& item : tree.entries.back().value.items) {
      std::erase_if(item.entries, [](const ConfigNode::Entry& e) {
        return e.key == "weight" || e.key == "allowed" || e.key == "uncertainty";
      });
    }
  }
  return tree;
}

}  // namespace

std::optional<double> read_angle(TableReader& table, std::string_view key, bool is_required) {
  const auto angle = table.quantity(key, "rad", Range::any, is_required);
  const ConfigNode* node = table.node(key);
  const bool is_number =
      node && (node->kind == ConfigNode::Kind::integer || node->kind == ConfigNode::Kind::real);
  if (angle && is_number && std::abs(*angle) > turn) {
    table.problem(key, fmt::format("found {}, which are radians without a unit, expected an angle "
                                   "such as \"112 deg\"",
                                   node->as_written()));
    return std::nullopt;
  }
  return angle;
}

std::optional<double> read_amplitude(TableReader& table, std::string_view key,
                                     const BalancingProbe& probe,
                                     const BalancingConvention& convention) {
  const ConfigNode* node = table.node(key);
  if (!node) return std::nullopt;
  const bool is_number =
      node->kind == ConfigNode::Kind::integer || node->kind == ConfigNode::Kind::real;
  if (is_number && node->number >= 0.0 && std::isfinite(node->number)) {
    return node->number * probe.per_unit / convention.per_peak();
  }
  const auto size = table.quantity(key, probe.si_unit, Range::nonnegative);
  return size ? std::optional(*size / convention.per_peak()) : std::nullopt;
}

Planes read_planes(const ConfigNode& root, const BalancingConvention& convention,
                   std::vector<Problem>& problems) {
  Planes found;
  const ConfigNode* list = list_of(root, "plane", problems);
  if (!list) {
    if (!root.find("plane")) {
      problems.push_back({root.where, "plane", "missing, expected one [[plane]] or more"});
    }
    return found;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const ConfigNode& item = list->items[i];
    TableReader table(&item, fmt::format("plane.{}", i + 1), problems);
    BalancingPlane plane;
    plane.name = table.string("name").value_or(fmt::format("plane {}", i + 1));
    plane.radius = table.quantity("radius", "m", Range::positive).value_or(0.0);
    if (const auto limit = table.quantity("limit", "kg", Range::positive)) plane.limit = *limit;
    plane.holes = read_holes(table, convention, problems);
    ConfigNode station;
    station.where = item.where;
    for (const char* key : station_keys) {
      if (const ConfigNode* node = table.node(key)) station.entries.push_back({key, *node});
    }
    table.finish();
    station.entries.push_back({"moment", text_node("0 kg.m", item.where)});
    station.entries.push_back({"name", text_node(plane.name, item.where)});
    found.stations.push_back(has_station(item) ? std::optional(station) : std::nullopt);
    found.planes.push_back(std::move(plane));
  }
  require_different(found.planes, *list, "plane", problems);
  return found;
}

Probes read_probes(const ConfigNode& root, const Model& model,
                   const BalancingConvention& convention, std::vector<Problem>& problems) {
  Probes found;
  const ConfigNode* list = root.find("probe") ? list_of(root, "probe", problems) : nullptr;
  if (!list) {
    if (model.structure.probes.empty() && !root.find("probe")) {
      problems.push_back(
          {root.where, "probe", "missing, expected one [[probe]] or more, here or in the model"});
    }
    found.setup = model_probes(model);
    for (const MeasuredProbe& p : found.setup->probes) {
      found.probes.push_back(
          {.name = p.probe.name, .unit = p.probe.unit, .per_unit = p.unit_length});
    }
    return found;
  }
  const bool have_stations = std::all_of(list->items.begin(), list->items.end(), has_station);
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    TableReader table(&list->items[i], fmt::format("probe.{}", i + 1), problems);
    BalancingProbe probe{.name = table.string("name").value_or(fmt::format("probe {}", i + 1))};
    read_unit(table, probe);
    read_demands(table, convention, probe);
    if (!have_stations) {
      read_angle(table, "angle");  // which says nothing here, and may stand there
      table.finish();
    }
    found.probes.push_back(std::move(probe));
  }
  require_different(found.probes, *list, "probe", problems);
  if (!have_stations) return found;
  try {
    found.setup = probes_in(probe_tree(root), model);
  } catch (const ModelError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
  }
  return found;
}

}  // namespace whirl::inline io::balancing
