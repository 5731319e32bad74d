#pragma once
/// Models that differ in the values of a few parameters, as the points of a study do.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libdyn/motions/start.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

/// The text is read once, and for a value only those parts are made again that the value changes: a
/// contact's stiffness, a film's viscosity or an unbalance needs no new mesh and no new reduction,
/// a speed no new mesh, and no new reduction where neither matrices nor shapes depend on the speed.
/// Members are to the last bit what parse_model and make_scene make of the same values. Several
/// threads may ask a family at once.
class ModelFamily {
 public:
  /// @param base  as it was read: its `source` is the text that values are set in
  /// @param axes  paths and units of the parameters; their values do not count here
  ModelFamily(const Model& base, std::vector<ParameterAxis> axes);
  ~ModelFamily();
  ModelFamily(ModelFamily&&) noexcept;
  ModelFamily& operator=(ModelFamily&&) noexcept;

  /// The model with these values, one per axis [SI]. Its `source` is that of the base.
  ///
  /// @throws ModelError  for values that make no model
  Model model(std::span<const double> values) const;

  /// A member made ready for computing, without an estimate of the error of its reduction.
  ///
  /// @throws ModelError, NumericalError  as make_scene
  std::shared_ptr<const Scene> scene(const Model& member) const;
  /// The scene of the member with these values; the last few scenes are remembered.
  std::shared_ptr<const Scene> scene(std::span<const double> values) const;

  /// Where the motion of a member begins, as start_state.
  MotionState start(const Model& member, const Scene& scene, const FullState* end) const;

 private:
  struct State;
  class Tree;
  std::unique_ptr<State> state_;
};

}  // namespace whirl::inline io
