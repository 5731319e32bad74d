#pragma once
/// Which stretch of a recorded motion is drawn or exported.

#include <optional>
#include <string>
#include <utility>

#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// What was asked for; nothing: the end of the motion.
struct MotionWindow {
  std::optional<double> from_revolution;  ///< since the start of the simulation
  std::optional<double> revolutions;      ///< how many; the last ones if from_revolution is open
  std::optional<std::pair<double, double>> times;  ///< first and last [s], instead of revolutions

  bool is_given() const { return from_revolution || revolutions || times; }
};

/// The error of a window where there is nothing that a window could be of.
/// @param problem  what windows are of, and what there is
ModelError wrong_window(std::string problem);

/// Reads two times, first:last [s].
Parsed<std::pair<double, double>> parse_times(std::string_view text);

/// A motion as it was recorded, at equal spacings.
struct RecordedMotion {
  Vec time;                         ///< of the samples since the start of the simulation [s]
  double period = 1.0;              ///< of a revolution [s]
  Eigen::Index per_revolution = 1;  ///< samples
  bool spins = false;               ///< if not, a second counts as a revolution
};

/// The motion of a result that has one.
/// @throws FileError  if a part of the motion is not there
RecordedMotion recorded_motion(const ResultReader& file);

/// The samples of a window.
struct MotionSamples {
  Eigen::Index first = 0, last = 0;  ///< both belong to it
  std::string text;                  ///< "revolutions 0 to 20 of 120, 0 to 0.27 s"

  Eigen::Index size() const { return last - first + 1; }
};

/// The samples of a motion within a window.
///
/// @param motion       of one sample or more
/// @param usual        how many revolutions are meant where the window leaves their number open
/// @throws ModelError  if the window holds what was not recorded; says what was
MotionSamples samples_of(const MotionWindow& window, const RecordedMotion& motion, double usual);

}  // namespace whirl::inline io
