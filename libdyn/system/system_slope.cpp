#include "libdyn/system/system_slope.hpp"

#include <cmath>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

System system_beside(const Scene& scene, const Assembler& assembler, const Model& model) {
  System system = assembler.at(model.speed);
  if (system.M.rows() == scene.reduced.Phi.rows()) return system;
  throw NumericalError("the parameter changes the number of degrees of freedom");
}

Scene scene_in_shapes_of(const Scene& scene, const Model& model) {
  Assembler assembler(model.structure);
  System system = system_beside(scene, assembler, model);
  ReducedSystem reduced = in_shapes(system, scene.reduced.Phi);
  ContactSystem contacts(assembler, reduced, model.contacts, model.films);
  return {std::move(assembler), std::move(system), std::move(reduced), {}, std::move(contacts)};
}

ContactSystem in_shapes_of(const Scene& scene, const Model& model) {
  if (scene.system.Omega == model.speed) {
    if (const auto assembler = scene.assembler.with_loads_of(model.structure)) {
      return ContactSystem(*assembler, scene.reduced, model.contacts, model.films);
    }
  }
  return scene_in_shapes_of(scene, model).contacts;
}

SystemSlope slope_of(std::string name, double value, double size,
                     const std::function<ContactSystem(double)>& at) {
  const double compared = size > 0.0 ? size : std::abs(value);
  if (!(compared > 0.0) || !std::isfinite(compared)) {
    throw ModelError({}, name, "a parameter that is zero needs a size to be compared with");
  }
  // a power of two, so that the places of the neighbors are hardly rounded
  const double step = std::ldexp(1.0, std::ilogb(largest_step * compared));
  SystemSlope slope{std::move(name), step, {}};
  for (const double place : neighbor_places) slope.neighbors.push_back(at(value + place * step));
  return slope;
}

SystemSlope slope_of(std::string name, const Scene& scene, double value, double size,
                     const std::function<Model(double)>& model_at) {
  return slope_of(std::move(name), value, size,
                  [&](double p) { return in_shapes_of(scene, model_at(p)); });
}

}  // namespace whirl::inline dyn
