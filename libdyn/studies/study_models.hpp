#pragma once
/// Where the motions of a study come from: models at its points, and how they begin there.

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
  /// @throws NumericalError  if it cannot be computed with: its point fails
  std::function<StudyMember(std::span<const double> values)> member;
  /// Where its motion begins.
  /// @param from  where another motion ended that this one goes on from; null: at the study's start
  /// @throws ModelError, NumericalError  likewise
  std::function<MotionState(const StudyMember& member, const FullState* from)> start;
};

/// Models that a function makes whole for every point; their motions begin at their [start].
StudyModels study_models(std::function<Model(std::span<const double> values)> model);

/// A motion at one point of a study.
struct StudyMotion {
  std::shared_ptr<const Scene> scene{};  ///< null if there is none
  ClassifyCandidate subject{};
  Failure failure{};  ///< why there is no scene, or no start

  bool is_good() const { return !failure && subject.found.is_good(); }
};

/// Makes the scene of a motion and puts it where it begins.
/// @param revolution  of the motion that this one goes on from, for forces that do not repeat with
///                    it
/// @throws ModelError  as StudyModels
StudyMotion begin_motion(const StudyModels& models, std::span<const double> values,
                         const FullState* from = nullptr, long revolution = 0);

/// Calls f with all good motions together, such as settle and average take them.
void together(std::span<StudyMotion> motions,
              const std::function<void(std::span<ClassifyCandidate>)>& f);

/// Classifies all good motions together, in the lanes of one batch.
void classify_together(std::span<StudyMotion> motions, const ClassifyOptions& options);

/// What there is to keep of a motion.
ClassifiedMotion classified(const StudyMotion& motion);

/// The same options with a watch that stops; empty: none.
ClassifyOptions stopped_by(const std::function<bool()>& is_stopped, ClassifyOptions options);

}  // namespace whirl::inline dyn
