#include "libfe/analyses/static.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

BearingLoad load_of(const Connection& c, const Assembler& assembler, const System& system,
                    const Vec& full, const Vec& support) {
  const Point from = assembler.point(c.from), to = assembler.point(c.to);
  const Mat2 K = coefficients(c.coefficients, system.Omega, 0.0).K;
  Vec2 stretch = Vec2::Zero(), held = Vec2::Zero();
  for (int k = 0; k < 2; ++k) {
    const int a = system.dofs.full_index(from, k), b = system.dofs.full_index(to, k);
    if (a >= 0) stretch(k) += full(a);
    if (b >= 0) stretch(k) -= full(b);
    if (a >= 0 && (c.is_rigid || c.is_clamped)) held(k) = -support(a);
  }
  return {c.name, K * stretch + held};
}

}  // namespace

void require_supports(const Assembler& assembler, double Omega, std::string_view what) {
  if (is_supported(symmetric_part(assembler.uncondensed(Omega, 0.0).stiffness()))) return;
  throw ModelError({}, "",
                   fmt::format("{} supports, but the rotor or a body is free to move: "
                               "add a [[bearing]] or a [[link]] that holds it",
                               what));
}

StaticEquilibrium static_equilibrium(const Assembler& assembler, double Omega) {
  require_supports(assembler, Omega, "the static sag needs");
  const System system = assembler.uncondensed(Omega, 0.0);
  const Vec load = static_load(assembler, Omega);
  const SparseLu solver(system.stiffness());
  if (!solver.is_regular()) {
    throw NumericalError("the stiffness is singular at this speed");
  }
  return with_bearing_loads(assembler, system, solver.solve(Vec(system.dofs.T.transpose() * load)),
                            load);
}

StaticEquilibrium with_bearing_loads(const Assembler& assembler, const System& system, const Vec& q,
                                     const Vec& load) {
  const double Omega = system.Omega;
  StaticEquilibrium result{system.dofs.T * q, {}};
  const Vec support = assembler.support_forces(Omega, q, load);
  const Structure& s = assembler.structure();
  for (const auto* list : {&s.bearings, &s.seals}) {
    for (const Connection& c : *list) {
      result.bearings.push_back(load_of(c, assembler, system, result.displacement, support));
    }
  }
  return result;
}

}  // namespace whirl::inline fe
