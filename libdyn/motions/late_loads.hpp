#pragma once
/// Loads that begin while a motion is recorded, such as the unbalance of a blade that is lost.

#include <memory>
#include <utility>
#include <vector>

#include "libdyn/motions/simulate.hpp"

namespace whirl::inline dyn {

struct Model;

/// The rotor before each beginning of a load, in the coordinates of its scene.
class LateLoads {
 public:
  /// @param scene  of the model with all loads
  LateLoads(const Model& model, const Scene& scene);

  /// For SimulationOptions, valid as long as this lives; empty: no load is late.
  const std::vector<MotionStage>& stages() const { return stages_; }

 private:
  struct Before {
    Scene scene;
    SupportLoads supports;
    Before(Scene of, const Model& model) : scene(std::move(of)), supports(model, scene) {}
  };
  std::vector<std::unique_ptr<Before>> before_;
  std::vector<MotionStage> stages_;
};

}  // namespace whirl::inline dyn
