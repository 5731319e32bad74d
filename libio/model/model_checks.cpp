#include "libio/model/model_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libcontact/contact.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/assembly/states_apart.hpp"

namespace whirl::inline io {

namespace {

/// Whether anything has a mass.
bool has_any_mass(const Structure& s) {
  const auto any = [](const auto& parts, auto mass) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const auto& part) { return mass(part) > 0.0; });
  };
  const auto of_layer = [](const Layer& layer) {
    return layer.carries == Carries::stiffness ? 0.0 : layer.material.rho;
  };
  const auto is_heavy = [&](const Structure::Shaft& shaft) {
    return any(shaft.segments, [](const Segment& segment) { return segment.material.rho; });
  };
  return std::ranges::any_of(s.shafts(), is_heavy) || any(s.layers, of_layer) ||
         any(s.disks, [](const Disk& disk) { return disk.m; }) ||
         any(s.bodies, [](const Body& body) { return std::max(body.m.x, body.m.y); });
}

void check_stations(ModelReading& reading, const Mesh& mesh) {
  const Structure& s = reading.model.structure;
  for (const Station* station : all_stations(s)) {
    try {
      resolve(*station, s, mesh);
    } catch (const ModelError& error) {
      reading.add_problems(error.problems());
    }
  }
  for (const auto& d : reading.double_stations) {
    if (d.node > mesh.nodes()) {
      reading.problems.push_back(
          {d.position.where, d.position.key,
           fmt::format("found node {}, expected a node from 1 to {}", d.node, mesh.nodes())});
    } else if (resolve(d.position, s, mesh).index != d.node - 1) {
      reading.problems.push_back(
          {d.position.where, d.position.key,
           fmt::format("{:g} mm and node {}, which is at {:g} mm, are different places; give one",
                       1e3 * d.position.z, d.node,
                       1e3 * mesh.z[static_cast<std::size_t>(d.node - 1)])});
    }
  }
}

/// Gives contacts without a radius that of the shaft at their station.
void set_radii(ModelReading& reading, const Mesh& mesh) {
  const Structure& s = reading.model.structure;
  for (const auto& m : reading.missing_radii) {
    Contact& contact = reading.model.contacts[m.contact];
    const Point point = resolve(contact.at, s, mesh);
    if (point.kind != Point::Kind::node) {
      if (contact.friction.mu == 0.0 || contact.friction.slip != Slip::actual) continue;
      reading.problems.push_back({m.where, m.key,
                                  "missing, expected a length (m): friction on a body needs the "
                                  "radius of the contact for its slip velocity"});
      continue;
    }
    contact.friction.radius = 0.5 * diameter_at(s, mesh, point.index);
  }
}

/// Friction that always has the sense of the spin needs a rotor that turns faster than what it
/// touches.
void check_rotors(ModelReading& reading, const Mesh& mesh) {
  const Structure& s = reading.model.structure;
  if (s.rotors.empty()) return;
  for (const Contact& c : reading.model.contacts) {
    if (c.limits) continue;
    const double leading = reading.model.speed > 0.0 ? reading.model.speed : 1.0;
    const double at = shaft_speed(resolve(c.at, s, mesh), s, mesh, leading) / leading;
    const double against = spin_speed(resolve(c.against, s, mesh), s, mesh, leading) / leading;
    const std::string key = "contact." + c.name;
    const AnyGeometry geometry = geometry_of(c);
    if ((c.friction.slip == Slip::forward || rubs_apart(geometry)) && !(at > against)) {
      reading.problems.push_back(
          {c.where, key,
           fmt::format("its friction always has the sense of the spin, but the speed of what "
                       "touches is {:g} and that of what it touches {:g} times that of the first "
                       "shaft; expected the first of them to be larger",
                       at, against)});
    }
  }
}

void check_movable(ModelReading& reading) {
  const Structure& s = reading.model.structure;
  try {
    const System movable = Assembler{s}.uncondensed(0.0);
    const StatesApart parts(movable.dofs);
    const Sparse M = parts.has_states() ? Sparse(movable.M * parts.structure) : movable.M;
    if (M.norm() == 0.0) {
      throw ModelError({}, "", "all that has a mass is held: nothing that can move has one");
    }
  } catch (const ModelError& error) {
    // these speak of a bearing, seal, link or gear by its name; here its path is known
    for (Problem problem : error.problems()) {
      const auto complete = [&](const char* kind, const auto& part) {
        if (problem.where == part.where && problem.key == part.name)
          problem.key = fmt::format("{}.{}", kind, part.name);
      };
      for (const auto& [kind, list] : s.connections()) {
        for (const Connection& c : list) complete(kind, c);
      }
      for (const GearPair& gears : s.gears) complete("gear", gears);
      for (const Support& support : s.supports) complete("support", support);
      if (problem.where.file.empty()) problem.where = reading.root.where;
      reading.problems.push_back(problem);
    }
  }
}

}  // namespace

void check_places(ModelReading& reading) {
  const Structure& s = reading.model.structure;
  const ConfigNode* segments = reading.root.find("shaft");
  if (segments && segments->kind != ConfigNode::Kind::array) return;  // that is said
  if (s.shaft.empty() && s.bodies.empty() && reading.problems.empty()) {
    reading.problems.push_back(
        {reading.root.where, "shaft",
         s.rotors.empty() ? "missing: a model needs a [[shaft]] or a [[body]]"
                          : "all segments are of rotors: the first shaft, whose speed counts, is "
                            "made of those without a rotor"});
  }
  const auto is_whole = [](const Segment& segment) {
    return segment.length > 0.0 && segment.left.outer > 0.0 && segment.right.outer > 0.0;
  };
  for (const Rotor& rotor : s.rotors) {
    if (!rotor.bow.z.empty() && rotor.shaft.empty()) {
      reading.problems.push_back(
          {rotor.where, "rotor." + rotor.name + ".bow", "a bow is one of a shaft: there is none"});
    }
    const bool is_used = !rotor.shaft.empty() || std::ranges::any_of(s.bodies, [&](const Body& b) {
      return b.rotor == rotor.name;
    });
    if (is_used) continue;
    reading.doubts.push_back(
        {rotor.where, "rotor." + rotor.name,
         fmt::format("has no shaft: write rotor = \"{}\" in a [[shaft]], or in a [[body]] that "
                     "spins",
                     rotor.name)});
  }
  for (const Structure::Shaft& shaft : s.shafts()) {
    if (!std::ranges::all_of(shaft.segments, is_whole)) return;
  }
  Mesh mesh;
  try {
    mesh = make_mesh(s);
  } catch (const ModelError& error) {
    reading.add_problems(error.problems());
    return;
  }
  check_stations(reading, mesh);
  if (!reading.problems.empty()) return;
  if (!has_any_mass(s)) {
    reading.problems.push_back({reading.root.where, "",
                                "nothing in this model has a mass: give a material its density, "
                                "or add a disk or a body that has one"});
    return;
  }
  set_radii(reading, mesh);
  check_rotors(reading, mesh);
  check_movable(reading);
}

}  // namespace whirl::inline io
