#include "libfe/analyses/static.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/analyses/connection_forces.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libfe/assembly/states_apart.hpp"

namespace whirl::inline fe {

void require_supports(const Assembler& assembler, double Omega, std::string_view what) {
  if (is_held_at_rest(assembler.uncondensed(Omega, 0.0))) return;
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
  StaticEquilibrium result{system.dofs.T * q, {}, {}};
  const Vec forces =
      ConnectionForces(assembler, system.Omega, 0.0).at_rest(result.displacement, load);
  Eigen::Index row = 0;
  for (const CarryingPart& part : carrying_parts(assembler)) {
    const BearingLoad carried{part.name, forces.segment<2>(row)};
    row += 2;
    if (part.kind == "link" || part.kind == "gear") {
      result.links.push_back({carried});
    } else if (part.kind != "oil film") {
      result.bearings.push_back(carried);
    }
  }
  return result;
}

}  // namespace whirl::inline fe
