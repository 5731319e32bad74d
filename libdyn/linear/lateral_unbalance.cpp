#include "libdyn/linear/lateral_unbalance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double standard_gravity = 9.80665;  // [m/s^2]

/// Whether unbalances are at the same places.
bool is_like(const std::vector<UnbalancePlane>& a, const std::vector<UnbalancePlane>& b,
             const Mesh& mesh) {
  const auto [low, high] = std::minmax_element(mesh.z.begin(), mesh.z.end());
  const double near = 0.1 * (*high - *low);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const UnbalancePlane& p, const UnbalancePlane& q) {
                      return std::abs(mesh.z[p.node] - mesh.z[q.node]) <= near;
                    });
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

std::vector<UnbalanceCase> unbalance_cases(const Assembler& assembler,
                                           const std::vector<Critical>& criticals,
                                           const std::vector<Journal>& journals, double maximum,
                                           double limit) {
  std::vector<UnbalanceCase> cases;
  for (const Critical& critical : criticals) {
    if (critical.speed > limit && !cases.empty()) break;
    const DofMap dofs = assembler.at(critical.speed).dofs;
    std::vector<UnbalancePlane> planes = unbalance_planes(
        antinodes(assembler.mesh(), dofs, critical.shape), journals, assembler.mesh(), maximum);
    const bool is_known = std::any_of(cases.begin(), cases.end(), [&](const UnbalanceCase& c) {
      return is_like(c.planes, planes, assembler.mesh());
    });
    if (!planes.empty() && !is_known) cases.push_back({critical, std::move(planes)});
  }
  return cases;
}

}  // namespace whirl::inline dyn
