#include "libdyn/system/scene_at_speed.hpp"

#include <utility>

namespace whirl::inline dyn {

namespace {

bool basis_depends_on_speed(const Scene& scene, const Reduction& how) {
  const Mat& Phi = scene.reduced.Phi;
  const bool is_whole = Phi.rows() == Phi.cols() && Phi.isIdentity(0.0);
  return !is_whole && (how.method == ReductionMethod::damped || how.modes == 0);
}

}  // namespace

std::optional<Scene> scene_at_speed(const Scene& scene, const Model& model) {
  if (scene.assembler.depends_on_speed()) return std::nullopt;
  if (basis_depends_on_speed(scene, model.reduction)) return std::nullopt;
  System system = scene.system;
  system.Omega = model.speed;
  ReducedSystem reduced = scene.reduced;
  reduced.Omega = model.speed;
  ContactSystem contacts(scene.assembler, reduced, model.contacts, model.films);
  return Scene{scene.assembler, std::move(system), std::move(reduced), scene.error,
               std::move(contacts)};
}

}  // namespace whirl::inline dyn
