#include "libdyn/system/corrected_scene.hpp"

#include <array>
#include <utility>

#include "libdyn/system/model.hpp"
#include "libdyn/system/system_slope.hpp"
#include "libfe/analyses/static_shapes.hpp"

namespace whirl::inline dyn {

Scene corrected_scene(const Scene& scene, const Model& model, std::span<const Model> others) {
  constexpr double rounding = 1e-13;  // of a matrix, that no parameter changes
  const System& system = scene.system;
  const Mat& Phi = scene.reduced.Phi;
  Mat loads(Phi.rows(), 0);
  for (const Model& other : others) {
    const System changed = system_beside(scene, Assembler(other.structure), other);
    const Sparse K = system.stiffness(), changed_K = changed.stiffness();
    const Sparse G = system.G(), changed_G = changed.G();
    const std::array pairs{std::pair(&changed.M, &system.M), std::pair(&changed.C, &system.C),
                           std::pair(&changed_G, &G), std::pair(&changed_K, &K)};
    for (const auto& [there, here] : pairs) {
      const Sparse change = *there - *here;
      if (!(change.norm() > rounding * here->norm())) continue;
      loads.conservativeResize(Phi.rows(), loads.cols() + Phi.cols());
      loads.rightCols(Phi.cols()) = change * Phi;
    }
  }
  if (loads.cols() == 0 || Phi.cols() == Phi.rows()) return scene;
  Scene corrected = scene;
  corrected.reduced = with_static_shapes(system, scene.reduced, loads);
  return with_contacts(corrected, model);
}

}  // namespace whirl::inline dyn
