#include "libdyn/linear/lateral_unbalance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <ranges>

#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libfe/assembly/properties.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double standard_gravity = 9.80665;  // [m/s^2]

/// Whether unbalances are at the same places.
bool is_like(const std::vector<UnbalancePlane>& a, const std::vector<UnbalancePlane>& b,
             const Mesh& mesh) {
  const double near = 0.1 * (mesh.z[mesh.left_to_right.back()] - mesh.z[mesh.left_to_right[0]]);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const UnbalancePlane& p, const UnbalancePlane& q) {
                      return std::abs(mesh.z[p.node] - mesh.z[q.node]) <= near;
                    });
}

/// The case of an overhung end, with the mode that moves this end most.
UnbalanceCase case_of(const OverhungEnd& end, const std::vector<Critical>& excited,
                      const Assembler& assembler, double maximum) {
  const auto share = [&](const Critical& c) {
    return forward_share(assembler.mesh(), assembler.at(c.speed).dofs, c.shape, end.node);
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
  std::vector<Point> points;
  for (const Connection& b : model.structure.bearings) points.push_back(assembler.point(b.from));
  for (const OilFilm& film : model.films) {
    if (film.is_linearized) points.push_back(assembler.point(film.at));
  }
  for (const Contact& bearing : rolling_bearings(model.contacts)) {
    points.push_back(assembler.point(bearing.at));
  }
  std::vector<Journal> journals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].kind != Point::Kind::node) continue;
    const int node = points[i].index;
    journals.push_back({loads[i].name, node, assembler.mesh().z[node],
                        loads[i].force.norm() / std::abs(model.structure.gravity)});
  }
  std::stable_sort(journals.begin(), journals.end(),
                   [](const Journal& a, const Journal& b) { return a.z < b.z; });
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
                                       const std::vector<Journal>& journals) {
  std::vector<OverhungEnd> ends;
  if (journals.empty()) return ends;
  for (const bool is_right : {false, true}) {
    const double journal = is_right ? journals.back().z : journals.front().z;
    const auto reach = [&](int node) { return (is_right ? 1.0 : -1.0) * (mesh.z[node] - journal); };
    std::optional<int> outermost;
    for (const Disk& disk : structure.disks) {
      const Point point = resolve(disk.at, structure, mesh);
      if (!(disk.m > 0.0) || !(reach(point.index) > 0.0)) continue;
      if (!outermost || reach(point.index) > reach(*outermost)) outermost = point.index;
    }
    if (outermost) ends.push_back({*outermost, mass_beyond(structure, mesh, journal, is_right)});
  }
  return ends;
}

std::vector<UnbalanceCase> unbalance_cases(const Assembler& assembler,
                                           const std::vector<Critical>& criticals,
                                           const std::vector<Journal>& journals, double maximum,
                                           double limit) {
  std::vector<UnbalanceCase> cases;
  std::vector<Critical> excited;
  for (const Critical& critical : criticals) {
    if (critical.speed > limit && !cases.empty()) break;
    excited.push_back(critical);
    const DofMap dofs = assembler.at(critical.speed).dofs;
    std::vector<UnbalancePlane> planes = unbalance_planes(
        antinodes(assembler.mesh(), dofs, critical.shape), journals, assembler.mesh(), maximum);
    const bool is_known = std::any_of(cases.begin(), cases.end(), [&](const UnbalanceCase& c) {
      return is_like(c.planes, planes, assembler.mesh());
    });
    if (planes.empty() || is_known) continue;
    cases.push_back({critical, UnbalancePlaces::antinodes, std::move(planes)});
  }
  if (cases.empty()) return cases;
  for (const OverhungEnd& end : overhung_ends(assembler.structure(), assembler.mesh(), journals)) {
    UnbalanceCase own = case_of(end, excited, assembler, maximum);
    const bool is_known = std::any_of(cases.begin(), cases.end(), [&](const UnbalanceCase& c) {
      return is_like(c.planes, own.planes, assembler.mesh()) &&
             c.planes.front().moment >= own.planes.front().moment;
    });
    if (!is_known) cases.push_back(std::move(own));
  }
  return cases;
}

}  // namespace whirl::inline dyn
