#pragma once
/// A record in windows, each with a motion of its own: multiple shooting.

#include <memory>
#include <optional>
#include <vector>

#include "libdata/fit/fit_problem.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline data {

/// Some successive samples of a record, and how a motion through them is compared with these.
///
/// Deviations of a motion grow, over a whole record so much that no search succeeds; within a
/// window they have no time to grow. Each window begins at a state of its own, and the gap between
/// the end of a window and the beginning of the next one is a residual like all others, of a weight
/// that grows during the search. In a steady motion the first window follows the last one.
///
/// @source [Bock1983]
class ShootingWindow {
 public:
  /// @param source   must live as long
  /// @param first    sample that the window begins at
  /// @param samples  that the window has, at least 1
  /// @param end      time at which the next window begins [s]; nothing: there is none
  ShootingWindow(const FitSource& source, Eigen::Index first, Eigen::Index samples,
                 std::optional<double> end);

  Eigen::Index readings() const { return static_cast<Eigen::Index>(read_.size()); }
  /// How many residuals there are: of the readings, then, if a window follows, of the state at the
  /// end.
  Eigen::Index residuals() const { return readings() + (has_next_ ? states() : 0); }
  Eigen::Index states() const { return 2 * source_->rows.cols(); }
  bool has_next() const { return has_next_; }

  /// State at the beginning that the readings suggest: the smallest coordinates that have these
  /// readings, and the smallest rates of coordinates that change the readings as measured.
  /// @param offset  that readings have, per probe [m]
  Vec guess(const Vec& offset) const;

  /// What is known of the motion from a state.
  struct Comparison {
    bool is_good = false;  ///< whether the motion reaches the end
    Vec readings;          ///< (reading - measured) / noise, as many as readings()
    Vec end;               ///< state where the next window begins
    Mat readings_by_start, end_by_start;
    Mat readings_by_parameter, end_by_parameter;  ///< by the parameters, then by the runout
    long grazes = 0;
  };
  /// @param offset  as in guess()
  /// @param slopes  whether derivatives are wanted
  Comparison compare(const FitSystem& system, const Vec& start, const Vec& offset,
                     bool slopes) const;
  /// Derivatives of Comparison::readings by the offsets.
  Mat readings_by_offset() const;

  /// What the motion from a state reads with runout, without offsets, probes x its samples [m].
  Mat predict(const FitSystem& system, const Vec& start) const;

  Eigen::Index first_sample() const { return first_; }
  /// The beginning of the motion from a state, with the angle of the rotor there.
  MotionState state(const ContactSystem& system, const Vec& start) const;

 private:
  struct Reading {
    Eigen::Index probe, sample;  ///< sample within the window
  };
  /// Angle of the rotor at a sample of the window [rad].
  double angle(const ContactSystem& system, Eigen::Index sample) const;

  const FitSource* source_;
  Eigen::Index first_, samples_;
  bool has_next_;
  std::vector<double>
      times_;  ///< of the samples, and of the end if a window follows, since the beginning [s]
  std::vector<Reading> read_;
};

/// Windows of a record of about a duration each [s], at least one, of a steady motion at least two.
/// @param system  that is compared, for its speed and loads
/// @throws ModelError  for a steady motion whose readings are not within its period and in both
///                     halves of it, or whose loads do not repeat with it
std::vector<ShootingWindow> shooting_windows(const FitSource& source, double duration,
                                             const ContactSystem& system);

}  // namespace whirl::inline data
