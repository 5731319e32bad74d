#include "libio/import/ross_shafts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "libbase/error.hpp"
#include "libio/import/ross_gears.hpp"

namespace whirl::inline io {

namespace {

using Lengths = std::map<int, double>;  ///< of what joins a node to the next one [m]

/// Parts the innermost elements, which are the shafts, from those that lie on them.
Lengths sort_out_elements(const RossRotor& rotor, RossShafts& shafts,
                          std::vector<Problem>& problems) {
  Lengths lengths;
  for (const RossCoupling& c : rotor.couplings) lengths[c.node] = c.length;
  for (const RossElement& e : rotor.elements) {
    const auto [at, is_first] = lengths.try_emplace(e.node, e.length);
    (is_first ? shafts.elements : shafts.layers).push_back(&e);
    if (!is_first && std::abs(at->second - e.length) > 1e-9 * e.length) {
      problems.push_back(
          {e.where, "L",
           fmt::format("{} of a layer on {}: expected the same", e.length, at->second)});
    }
  }
  return lengths;
}

/// Nodes that are no part of a shaft: what bearings stand on.
std::set<int> supports_of(const RossRotor& rotor) {
  std::set<int> nodes;
  for (const RossBearing& b : rotor.bearings) nodes.insert({b.node, b.link});
  for (const RossPointMass& m : rotor.masses) nodes.insert(m.node);
  return nodes;
}

/// Shafts follow one another by their nodes, with nothing but supports between them.
void part_shafts(const RossRotor& rotor, const Lengths& lengths, RossShafts& all,
                 std::vector<Problem>& problems) {
  for (const auto& [node, length] : lengths) {
    if (all.shafts.empty() || all.shafts.back().last != node) {
      all.shafts.push_back({.first = node, .last = node});
    }
    all.shafts.back().last = node + 1;
  }
  const std::set<int> supports = supports_of(rotor);
  std::string which;
  int missing = -1, next = 0;
  for (const RossShaft& s : all.shafts) {
    which += fmt::format("{}{} to {}", which.empty() ? "" : ", ", s.first, s.last);
    for (int node = next; node < s.first && missing < 0; ++node) {
      if (next == 0 || !supports.contains(node)) missing = node;
    }
    next = s.last + 1;
  }
  if (missing < 0) return;
  problems.push_back(
      {rotor.elements.front().where, "n",
       all.shafts.size() == 1
           ? fmt::format("the shaft has the nodes {}, expected 0 to {}", which, lengths.size())
           : fmt::format("there are {} shafts, with the nodes {}, and neither an element nor a "
                         "support at node {}; expected shafts whose nodes follow one another",
                         all.shafts.size(), which, missing)});
}

/// The gears at the nodes that are told, or the only two on two shafts; null: there are none.
std::pair<const RossGear*, const RossGear*> gears_in_mesh(const RossRotor& rotor,
                                                          const RossShafts& all) {
  const std::vector<double>& nodes = rotor.mesh.nodes;
  const auto shaft = [&](const RossGear& gear) { return all.shaft_of(gear.node); };
  if (nodes.size() == 2) {
    for (const RossGear& a : rotor.gears) {
      if (a.node != nodes[0]) continue;
      for (const RossGear& b : rotor.gears) {  // the second one counts as in its rotor, or in both
        const bool is_it = shaft(b) && (b.node == nodes[1] || b.node - shaft(b)->first == nodes[1]);
        if (is_it && shaft(a) && shaft(a) < shaft(b)) return {&a, &b};
      }
    }
  }
  if (rotor.gears.size() != 2) return {nullptr, nullptr};
  const RossGear *a = &rotor.gears[0], *b = &rotor.gears[1];
  if (a->node > b->node) std::swap(a, b);
  if (!shaft(*a) || !shaft(*b) || shaft(*a) == shaft(*b)) return {nullptr, nullptr};
  return {a, b};
}

/// Place of a node from the left end of its shaft [m].
double along(const RossShaft& shaft, int node, const Lengths& lengths) {
  double z = 0.0;
  for (int n = shaft.first; n < node; ++n) z += lengths.at(n);
  return z;
}

/// Puts a shaft where a node of it is beside one of another shaft.
void place(RossShaft& shaft, int node, const RossShaft& other, int beside, const Lengths& lengths,
           RossShafts& all) {
  shaft.position = other.position + along(other, beside, lengths) - along(shaft, node, lengths);
  const double rounding = 1e-12 * (along(shaft, shaft.last, lengths) + std::abs(shaft.position));
  if (shaft.position < 0.0 && shaft.position < -rounding) {
    all.taken_differently.push_back(fmt::format(
        "the shaft \"{}\" begins {} m to the left of the first one: a model has it from "
        "the first one's left end on, which changes pictures alone",
        shaft.name, -shaft.position));
  }
  shaft.position = std::max(0.0, shaft.position);
}

/// A shaft within or around another one is where the bearings between them say.
void place_by_bearings(const RossRotor& rotor, const Lengths& lengths, RossShafts& all) {
  for (std::size_t i = 1; i < all.shafts.size(); ++i) {
    RossShaft& shaft = all.shafts[i];
    for (const RossBearing& b : rotor.bearings) {
      for (const auto& [node, link] : {std::pair(b.node, b.link), {b.link, b.node}}) {
        const RossShaft* other = all.shaft_of(link);
        const bool is_between = all.shaft_of(node) == &shaft && other && other < &shaft;
        if (!is_between || shaft.position > 0.0) continue;
        place(shaft, node, *other, link, lengths, all);
      }
    }
  }
}

/// Teeth between two shafts, or what the file lacks of them.
void add_teeth(const RossRotor& rotor, const RossGear& driving, const RossGear& driven,
               RossShafts& all) {
  const std::string both = fmt::format("\"{}\" and \"{}\"", driving.name, driven.name);
  const double by_teeth =
      driving.teeth > 0.0 && driven.teeth > 0.0 ? driving.teeth / driven.teeth : 0.0;
  const double radii = driving.pitch_radius * driven.pitch_radius;
  const double by_radii = radii > 0.0 ? driving.pitch_radius / driven.pitch_radius : 0.0;
  const double ratio = by_teeth > 0.0 ? by_teeth : by_radii;
  const auto leave_out = [&](std::string_view why) {
    all.left_out.push_back(fmt::format("the teeth of {}: {}", both, why));
  };
  if (ratio == 0.0) return leave_out("the file has neither how many there are nor a diameter");
  const auto shaft = [&](const RossGear& gear) {
    return static_cast<std::size_t>(all.shaft_of(gear.node) - all.shafts.data());
  };
  all.shafts[shaft(driven)].ratio = -ratio * all.shafts[shaft(driving)].ratio;
  constexpr double rounding = 0.01;  // as [[gear]] has it
  if (by_radii == 0.0 || std::abs(by_radii - ratio) > rounding * ratio) {
    return leave_out("their numbers are not in the ratio of the pitch diameters");
  }
  const double given = rotor.mesh.stiffness;
  const std::optional<double> k = given > 0.0 ? given : mesh_stiffness(driving, driven);
  if (!k) {
    return leave_out(
        "the file has neither gear_mesh_stiffness, in its parameters, nor widths; a [[gear]] with "
        "a "
        "stiffness would be between them");
  }
  all.teeth = RossTeeth{&driving, &driven, *k, rotor.mesh.centers.value_or(0.0)};
  all.taken_differently.push_back(fmt::format(
      "the teeth of {} hold shafts that have no torsion, which ROSS's have: see [[gear]]", both));
  if (!rotor.mesh.centers) {
    all.taken_differently.push_back(
        fmt::format("the centers of {} are along x: the file has no orientation_angle", both));
  }
  if (driving.helix_angle != 0.0) {
    all.taken_differently.push_back(
        fmt::format("the helical teeth of {} act along their normal, cos(pressure angle) sin(helix "
                    "angle) along "
                    "the axis, where ROSS has sin(pressure angle) sin(helix angle)",
                    both));
  }
}

/// Speeds and names of further shafts.
void set_speeds(const RossRotor& rotor, const Lengths& lengths, RossShafts& all) {
  const auto [driving, driven] = gears_in_mesh(rotor, all);
  const bool has_gears = driving && driven;
  for (std::size_t i = 1; i < all.shafts.size(); ++i) {
    const bool is_driven = has_gears && all.shaft_of(driven->node) == &all.shafts[i];
    all.shafts[i].name = all.shafts.size() > 2 ? fmt::format("shaft {}", i + 1)
                         : is_driven           ? "driven"
                                               : "outer";
  }
  if (rotor.speed_ratio && all.shafts.size() < 2) {
    all.left_out.push_back(fmt::format("speed_ratio = {}: there is one shaft", *rotor.speed_ratio));
  } else if (rotor.speed_ratio) {
    all.shafts[1].ratio = *rotor.speed_ratio;
  }
  if (has_gears) add_teeth(rotor, *driving, *driven, all);
  for (const RossGear& gear : rotor.gears) {
    if (has_gears && (&gear == driving || &gear == driven)) continue;
    all.taken_differently.push_back(
        fmt::format("the gear \"{}\" is a disk: the forces of its teeth are left out", gear.name));
  }
  place_by_bearings(rotor, lengths, all);
  if (has_gears) {
    const auto shaft = [&](const RossGear& gear) {
      return static_cast<std::size_t>(all.shaft_of(gear.node) - all.shafts.data());
    };
    place(all.shafts[shaft(*driven)], driven->node, all.shafts[shaft(*driving)], driving->node,
          lengths, all);
  }
  for (std::size_t i = 1; i < all.shafts.size(); ++i) {
    const bool is_told =
        (i == 1 && rotor.speed_ratio) ||
        (has_gears && all.shaft_of(driven->node) == &all.shafts[i] && all.shafts[i].ratio != 1.0);
    if (is_told) continue;
    all.taken_differently.push_back(fmt::format(
        "the shaft \"{0}\" turns as the first one: the file has no speed_ratio, in its parameters; "
        "it is the ratio of the [[rotor]] \"{0}\"",
        all.shafts[i].name));
  }
}

/// Says which speed tables of coefficients on further shafts go with, where ROSS takes another one.
void tell_tables(const RossRotor& rotor, RossShafts& all) {
  for (const RossBearing& b : rotor.bearings) {
    const RossShaft* shaft = all.shaft_of(b.node);
    const bool is_driven = shaft && all.teeth && all.shaft_of(all.teeth->driven->node) == shaft;
    if (!shaft || shaft->ratio == 1.0 || is_driven || !b.has_speed) continue;
    all.taken_differently.push_back(fmt::format(
        "the table of \"{}\" goes with the speed of its own shaft, in ROSS with that of "
        "the first one",
        b.name));
  }
}

}  // namespace

const RossShaft* RossShafts::shaft_of(int node) const {
  for (const RossShaft& s : shafts) {
    if (s.first <= node && node <= s.last) return &s;
  }
  return nullptr;
}

int RossShafts::number(int node) const {
  int before = 0;
  for (const RossShaft& s : shafts) {
    if (node <= s.last) return before + node - s.first + 1;
    before += s.last - s.first + 1;
  }
  return before;
}

RossShafts shafts_of(const RossRotor& rotor) {
  RossShafts all;
  std::vector<Problem> problems;
  const Lengths lengths = sort_out_elements(rotor, all, problems);
  part_shafts(rotor, lengths, all, problems);
  if (!problems.empty()) throw ModelError(std::move(problems));
  set_speeds(rotor, lengths, all);
  tell_tables(rotor, all);
  return all;
}

}  // namespace whirl::inline io
