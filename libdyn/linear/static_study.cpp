#include "libdyn/linear/static_study.hpp"

#include <utility>

#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libdyn/system/stations.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

StaticStudy static_study(const Model& model, const Assembler& assembler) {
  StaticStudy study{.speed = model.speed,
                    .has_gravity = model.structure.gravity != 0.0,
                    .has_forces = has_constant_force(model.structure)};
  RestingRotor rotor = resting_rotor(model, assembler, model.speed);
  study.at_rest = std::move(rotor.at_rest);
  study.on_films = {std::move(rotor.films)};
  study.on_elements = {std::move(rotor.rolling)};
  const Vec& displacement = study.at_rest.displacement;
  study.line = bending_line(assembler, model.speed, displacement);
  const DofMap& dofs = assembler.dofs();
  for (const NamedPoint& p : named_points(model, assembler)) {
    RestingStation at{.name = p.name, .label = p.label()};
    at.x = displacement(dofs.full_index(p.point, X));
    at.y = displacement(dofs.full_index(p.point, Y));
    if (p.node() > 0) {
      at.node = p.node();
      at.z = assembler.mesh().z.at(p.node() - 1);
    }
    study.stations.push_back(std::move(at));
  }
  for (const Probe& probe : assembler.structure().probes) {
    const Point point = assembler.point(probe.at);
    const auto of = [&](int c) { return displacement(dofs.full_index(point, c)); };
    study.probes.push_back({probe, probe.reading(of)});
  }
  return study;
}

}  // namespace whirl::inline dyn
