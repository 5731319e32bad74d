#pragma once
/// What is drawn or exported of a model or a result: its motion, its modes.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libfe/analyses/modes.hpp"
#include "libfe/assembly/assemble.hpp"
#include "libio/export/vtk_scene.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/motion_window.hpp"

namespace whirl::inline io {

/// A model or a result, as a scene.
struct SceneSource {
  std::unique_ptr<ResultReader> result;  ///< none: a model
  Model model;
  Assembler assembler;  ///< of its linear_structure: with oil films as linear analyses have them
  VtkScene scene;

  /// @param of  the result that the model is of; none: the model alone
  explicit SceneSource(Model of_model, std::unique_ptr<ResultReader> of = nullptr);

  bool has_motion() const { return result && result->has("/trajectory/coordinates"); }
  bool has_modes() const { return !result || result->has("/modes"); }

  /// The samples of a stretch of the motion.
  /// @param usual        how many revolutions at the end are meant where the window leaves that
  ///                     open
  /// @throws ModelError  if these samples were not recorded
  MotionSamples samples(const MotionWindow& window, double usual) const;

  /// The motion at samples, evenly thinned to a number of frames.
  /// @throws ModelError  if the motion is of another rotor than the model as set
  std::vector<VtkFrame> motion(const MotionSamples& samples, long most) const;

  /// Calls `use` for every mode at the operating speed: with the mode's number from 1, the mode,
  /// and the frames of one cycle.
  void each_mode(
      long count, int frames,
      const std::function<void(int, const Mode&, const std::vector<VtkFrame>&)>& use) const;
};

/// "mode 1 at 1664.6 rpm, backward"
std::string told(int number, const Mode& mode);

}  // namespace whirl::inline io
