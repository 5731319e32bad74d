#pragma once
/// Where the motions of a study come from: models at its points, and how motions begin there.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// The model at a point, made ready for computing.
struct StudyMember {
  Model model;
  std::shared_ptr<const Scene> scene;
};

/// What makes the models of a study; several threads ask at once.
struct StudyModels {
  /// The model with these values of the parameters.
  /// @throws ModelError      for values that make no model: this ends the study
  /// @throws NumericalError  if the model cannot be computed: its point fails
  std::function<StudyMember(std::span<const double> values)> member;
  /// Where the motion of a member begins.
  /// @param from  end of another motion that this one goes on from; null: the study's start
  /// @throws ModelError, NumericalError  as of member
  std::function<MotionState(const StudyMember& member, const FullState* from)> start;
};

/// Models that a function makes anew for every point; motions begin at the [start] of their model.
StudyModels study_models(std::function<Model(std::span<const double> values)> model);

/// A motion at one point of a study.
struct StudyMotion {
  std::shared_ptr<const Model> model{};  ///< null if there is no scene
  std::shared_ptr<const Scene> scene{};  ///< null if there is no scene
  ClassifyCandidate subject{};
  Failure failure{};  ///< why there is no scene, or no start

  bool is_good() const { return !failure && subject.found.is_good(); }
};

/// Makes the scene of a motion, and the state in which the motion begins.
/// @param revolution  in which the motion before ended, for forces that do not repeat every
///                    revolution
/// @throws ModelError  as StudyModels
StudyMotion begin_motion(const StudyModels& models, std::span<const double> values,
                         const FullState* from = nullptr, long revolution = 0);

/// Calls f with all good motions together, as settle and average take them.
void together(std::span<StudyMotion> motions,
              const std::function<void(std::span<ClassifyCandidate>)>& f);

/// Classifies all good motions together, in the lanes of one batch.
void classify_together(std::span<StudyMotion> motions, const ClassifyOptions& options);

/// What is kept of a motion.
ClassifiedMotion classified(const StudyMotion& motion);

/// The same options with a watch that stops when asked; without a watch if is_stopped is empty.
ClassifyOptions stopped_by(const std::function<bool()>& is_stopped, ClassifyOptions options);

}  // namespace whirl::inline dyn
