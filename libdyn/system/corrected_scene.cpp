#include "libdyn/system/corrected_scene.hpp"

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
    for (const auto matrix : {&System::M, &System::C, &System::G, &System::K}) {
      const Sparse change = changed.*matrix - system.*matrix;
      if (!(change.norm() > rounding * (system.*matrix).norm())) continue;
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
