#include "libdyn/linear/lateral_unbalance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <ranges>
#include <utility>

#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libfe/assembly/properties.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double standard_gravity = 9.80665;  // [m/s^2]

/// Whether unbalances are at the same places.
bool is_like(const std::vector<UnbalancePlane>& a, const std::vector<UnbalancePlane>& b,
             const Mesh& mesh, const TurningShaft& of) {
  double left = INFINITY, right = -INFINITY;
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (!of.has_node(node, mesh)) continue;
    const double z = mesh.z[static_cast<std::size_t>(node)];
    left = std::min(left, z), right = std::max(right, z);
  }
  const double near = 0.1 * (right - left);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const UnbalancePlane& p, const UnbalancePlane& q) {
                      return std::abs(mesh.z[p.node] - mesh.z[q.node]) <= near;
                    });
}

/// The case of an overhung end, with the mode that moves this end most.
UnbalanceCase case_of(const OverhungEnd& end, const std::vector<Critical>& excited,
                      const Assembler& assembler, double maximum, const TurningShaft& of) {
  const auto share = [&](const Critical& c) {
    return forward_share(assembler.mesh(), assembler.at(c.speed).dofs, c.shape, end.node, of);
  };
  const Critical* mode = &excited.front();
  double largest = share(*mode);
  for (const Critical& c : excited | std::views::drop(1)) {
    const double own = share(c);
    if (!(own > largest)) continue;
    mode = &c;
    largest = own;
  }
  return {*mode,
          UnbalancePlaces::overhung_end,
          {{end.node, analysis_unbalance(end.mass, maximum), 0.0}}};
}

}  // namespace

std::vector<Journal> journals_of(const Model& given, const Assembler& assembler, double Omega) {
  Model model = given;
  if (model.structure.gravity == 0.0) model.structure.gravity = standard_gravity;
  const Assembler weighed(model.structure);
  const std::vector<BearingLoad> loads = resting_rotor(model, weighed, Omega).journal_loads(model);
  std::vector<std::pair<Point, Point>> ends;
  const auto add = [&](const Station& from, const Station& to) {
    ends.emplace_back(assembler.point(from), assembler.point(to));
  };
  for (const Connection& b : model.structure.bearings) add(b.from, b.to);
  for (const OilFilm& film : model.films) {
    if (film.is_linearized) add(film.at, film.against);
  }
  for (const Contact& bearing : rolling_bearings(model.contacts)) add(bearing.at, bearing.against);
  std::vector<Journal> journals;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto& [from, to] = ends[i];
    const bool is_between = from.kind == to.kind;  // two shafts: the load points to the lower one
    const bool carries_other = is_between && loads[i].force(1) * model.structure.gravity > 0.0;
    const Point& point = carries_other ? to : from;
    if (from.kind != Point::Kind::node || point.kind != Point::Kind::node) continue;
    const auto node = static_cast<std::size_t>(point.index);
    journals.push_back({loads[i].name, point.index, assembler.mesh().z[node],
                        loads[i].force.norm() / std::abs(model.structure.gravity),
                        assembler.mesh().shaft_of[node]});
  }
  std::stable_sort(journals.begin(), journals.end(), [](const Journal& a, const Journal& b) {
    return std::pair(a.shaft, a.z) < std::pair(b.shaft, b.z);
  });
  return journals;
}

std::vector<UnbalancePlane> unbalance_planes(const std::vector<Antinode>& antinodes,
                                             const std::vector<Journal>& journals, const Mesh& mesh,
                                             double maximum) {
  std::vector<UnbalancePlane> planes;
  if (journals.empty()) return planes;
  double all = 0.0;
  for (const Journal& j : journals) all += j.mass;
  for (const Antinode& a : antinodes) {
    const double z = mesh.z[a.node];
    const bool is_between = z >= journals.front().z && z <= journals.back().z;
    const auto nearest = std::min_element(
        journals.begin(), journals.end(),
        [&](const Journal& p, const Journal& q) { return std::abs(p.z - z) < std::abs(q.z - z); });
    const double mass = antinodes.size() == 1 && is_between ? all : nearest->mass;
    const bool is_against = a.deflection * antinodes.front().deflection < 0.0;
    planes.push_back(
        {a.node, analysis_unbalance(mass, maximum), is_against ? std::numbers::pi : 0.0});
  }
  return planes;
}

std::vector<OverhungEnd> overhung_ends(const Structure& structure, const Mesh& mesh,
                                       const std::vector<Journal>& journals, int shaft) {
  std::vector<OverhungEnd> ends;
  if (journals.empty()) return ends;
  for (const bool is_right : {false, true}) {
    const double journal = is_right ? journals.back().z : journals.front().z;
    const auto reach = [&](int node) { return (is_right ? 1.0 : -1.0) * (mesh.z[node] - journal); };
    std::optional<int> outermost;
    for (const Disk& disk : structure.disks) {
      const Point point = resolve(disk.at, structure, mesh);
      if (shaft_of(point, structure, mesh) != shaft) continue;
      if (!(disk.m > 0.0) || !(reach(point.index) > 0.0)) continue;
      if (!outermost || reach(point.index) > reach(*outermost)) outermost = point.index;
    }
    if (outermost)
      ends.push_back({*outermost, mass_beyond(structure, mesh, journal, is_right, shaft)});
  }
  return ends;
}

std::vector<UnbalanceCase> unbalance_cases(const Assembler& assembler,
                                           const std::vector<Critical>& criticals,
                                           const std::vector<Journal>& journals, double maximum,
                                           double limit, const TurningShaft& of) {
  const double own_maximum = of.order() * maximum;
  std::vector<UnbalanceCase> cases;
  std::vector<Critical> excited;
  for (const Critical& critical : criticals) {
    if (critical.speed > limit && !cases.empty()) break;
    excited.push_back(critical);
    const DofMap dofs = assembler.at(critical.speed).dofs;
    std::vector<UnbalancePlane> planes =
        unbalance_planes(antinodes(assembler.mesh(), dofs, critical.shape, of), journals,
                         assembler.mesh(), own_maximum);
    const bool is_known = std::any_of(cases.begin(), cases.end(), [&](const UnbalanceCase& c) {
      return is_like(c.planes, planes, assembler.mesh(), of);
    });
    if (planes.empty() || is_known) continue;
    cases.push_back({critical, UnbalancePlaces::antinodes, std::move(planes)});
  }
  if (cases.empty()) return cases;
  for (const OverhungEnd& end :
       overhung_ends(assembler.structure(), assembler.mesh(), journals, of.number)) {
    UnbalanceCase own = case_of(end, excited, assembler, own_maximum, of);
    const bool is_known = std::any_of(cases.begin(), cases.end(), [&](const UnbalanceCase& c) {
      return is_like(c.planes, own.planes, assembler.mesh(), of) &&
             c.planes.front().moment >= own.planes.front().moment;
    });
    if (!is_known) cases.push_back(std::move(own));
  }
  return cases;
}

}  // namespace whirl::inline dyn
