#pragma once
/// A sweep: the motions along one parameter, up and down, each going on from the one before.

#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "libdyn/studies/portrait.hpp"
#include "libdyn/studies/study_models.hpp"

namespace whirl {

enum class SweepStart {
  carried,  ///< each value from the motion at the one before, up and then down
  fresh     ///< every value from the start of its model
};

struct SweepOptions {
  std::vector<double> values{};  ///< of the parameter [SI]
  SweepStart start = SweepStart::carried;
  ClassifyOptions classify{};  ///< its `sections` are those of the portraits
  PortraitOptions portrait{};
  int threads = 1;

  std::size_t ways() const { return start == SweepStart::fresh ? 1 : 2; }
};

struct SweepPoint {
  ClassifiedMotion motion{};
  FullState end{};  ///< where the next value starts; empty if it starts afresh
  Portrait portrait{};
};

struct SweepResult {
  StudySystem system{};
  /// Way after way, each in the order of the values.
  PointRows<SweepPoint> points{};
};

/// Classifies and portrays the motions along the values of one parameter.
///
/// Carried, a motion that is not proven goes on for the measured revolutions before the next value
/// takes it over; one thread goes ahead along the values, the others find out what the motions are.
/// Where a motion fails, the next one begins afresh.
///
/// @param earlier  what another call with the same models and options has found: its points stay as
///                 they are; empty: none
/// @return  with fewer points if the monitor stopped it
/// @throws ModelError      as models
/// @throws NumericalError  if the first point cannot be computed with, or nothing moves
SweepResult sweep(const StudyModels& models, const SweepOptions& options,
                  const Monitor<SweepResult>& monitor = {}, SweepResult earlier = {});

}  // namespace whirl
