#include "libfe/lateral/rigid_supports.hpp"

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

namespace {

bool is_same_station(const Station& a, const Station& b) {
  return a.kind == b.kind && a.z == b.z && a.node == b.node && a.body == b.body;
}

Structure on_rigid_supports(Structure s) {
  const std::vector<Connection> bearings = std::move(s.bearings);
  s.bearings.clear();
  const auto pin = [&](const std::string& name, const Station& at, bool is_clamped) {
    const auto known = std::find_if(s.bearings.begin(), s.bearings.end(), [&](const Connection& b) {
      return is_same_station(b.from, at);
    });
    if (known != s.bearings.end()) return;
    s.bearings.push_back({.name = name, .from = at, .is_rigid = true, .is_clamped = is_clamped});
  };
  for (const Connection& b : bearings) pin(b.name, b.from, b.is_clamped);
  for (const LinearizedConnection& film : s.linearized) pin(film.name, film.from, false);
  s.linearized.clear();
  s.seals.clear();
  return s;
}

}  // namespace

double critical_on_rigid_supports(const Structure& structure) {
  try {
    const Assembler assembler(on_rigid_supports(structure));
    for (const Critical& c : critical_speeds(assembler, {.count = 4, .has_damped = false})) {
      if (c.whirl != Whirl::backward) return c.speed;
    }
  } catch (const ModelError&) {
    return nan;  // held by nothing, or by a rigid link already
  }
  return nan;
}

}  // namespace whirl::inline fe
