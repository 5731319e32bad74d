#include "libdyn/system/scene_beside.hpp"

#include <algorithm>
#include <utility>

#include "libdyn/system/model.hpp"
#include "libfe/assembly/excitations.hpp"

namespace whirl::inline dyn {

namespace {

/// Whether two structures have the same kinds of loads, which act at the same stations.
bool same_kinds_of_loads(const Structure& a, const Structure& b) {
  return a.unbalances.size() == b.unbalances.size() && a.probes.size() == b.probes.size() &&
         std::ranges::equal(a.forces, b.forces, {}, &Force::kind, &Force::kind);
}

/// Whether these have the same static shapes, too: an acceleration of the base has the shape of its
/// amplitude, other forces that of their stations.
bool same_shapes_of_loads(const Structure& a, const Structure& b) {
  const auto same_shape = [](const Force& x, const Force& y) { return x.has_station() || x == y; };
  return a.bow == b.bow && std::ranges::equal(a.forces, b.forces, same_shape);
}

bool same_shapes(const Scene& scene, const Model& model) {
  const Mat& Phi = scene.reduced.Phi;
  const Structure &here = scene.assembler.structure(), &there = model.structure;
  if (!same_kinds_of_loads(here, there)) return false;
  const bool is_whole = Phi.rows() == Phi.cols() && Phi.isIdentity(0.0);
  if (is_whole) return true;
  if (!same_shapes_of_loads(here, there)) return false;
  const bool follow_tolerance = model.reduction.modes == 0;
  if (scene.system.Omega != model.speed) {
    return model.reduction.method != ReductionMethod::damped && !follow_tolerance;
  }
  return !follow_tolerance ||
         highest_frequency(here, model.speed) == highest_frequency(there, model.speed);
}

}  // namespace

std::shared_ptr<const Scene> scene_beside(const Scene& scene, const Model& model) {
  const bool is_at_speed = scene.system.Omega == model.speed;
  if (!is_at_speed && scene.assembler.tables_depend_on_speed()) return nullptr;
  if (!same_shapes(scene, model)) return nullptr;
  const auto assembler = scene.assembler.with_loads_of(model.structure);
  if (!assembler) return nullptr;
  ReducedSystem reduced = scene.reduced;
  reduced.Omega = model.speed;
  ContactSystem contacts(*assembler, reduced, model.contacts, model.films);
  // moving sparse matrices copies them: those of the system are copied to where they stay
  const std::shared_ptr<Scene> beside(
      new Scene{*assembler, scene.system, std::move(reduced), {}, std::move(contacts)});
  beside->system.Omega = model.speed;
  return beside;
}

}  // namespace whirl::inline dyn
