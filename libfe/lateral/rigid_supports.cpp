#include "libfe/lateral/rigid_supports.hpp"

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libfe/mesh/mesh.hpp"

namespace whirl::inline fe {

namespace {

bool is_same_station(const Station& a, const Station& b) {
  return a.kind == b.kind && a.z == b.z && a.node == b.node && a.body == b.body &&
         a.rotor == b.rotor;
}

Structure on_rigid_supports(Structure s) {
  const Mesh mesh = make_mesh(s);
  const std::vector<Connection> bearings = std::move(s.bearings);
  s.bearings.clear();
  const auto pin = [&](const std::string& name, const Station& at, const Station& to,
                       bool is_clamped) {
    const Station other = resolve(to, s, mesh).kind == Point::Kind::node ? to : Station{};
    const auto known = std::find_if(s.bearings.begin(), s.bearings.end(), [&](const Connection& b) {
      return is_same_station(b.from, at) && is_same_station(b.to, other);
    });
    if (known != s.bearings.end()) return;
    s.bearings.push_back(
        {.name = name, .from = at, .to = other, .is_rigid = true, .is_clamped = is_clamped});
  };
  for (const Connection& b : bearings) pin(b.name, b.from, b.to, b.is_clamped);
  for (const LinearizedConnection& film : s.linearized) pin(film.name, film.from, film.to, false);
  s.linearized.clear();
  s.seals.clear();
  return s;
}

}  // namespace

double critical_on_rigid_supports(const Structure& structure, const TurningShaft& of) {
  constexpr int looked_at = 4;  // of each shaft
  const Whirl against = of.turns_against() ? Whirl::forward : Whirl::backward;
  try {
    const Assembler assembler(on_rigid_supports(structure));
    const Mesh& mesh = assembler.mesh();
    const auto shafts = static_cast<int>(mesh.lines().size());
    for (const Critical& c : critical_speeds(
             assembler, {.count = looked_at * shafts, .order = of.order(), .has_damped = false})) {
      if (c.whirl == against) continue;
      if (shafts == 1 || shaft_moved_most(mesh, assembler.at(c.speed).dofs, c.shape) == of.number)
        return c.speed;
    }
  } catch (const ModelError&) {
    return nan;  // held by nothing, or by a rigid link already
  }
  return nan;
}

}  // namespace whirl::inline fe
