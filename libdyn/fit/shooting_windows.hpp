#pragma once
/// A record in windows, each with a motion of its own: multiple shooting.

#include <memory>
#include <vector>

#include "libdyn/fit/fit_problem.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Some successive samples of a record, and how a motion through them is compared with these.
///
/// Deviations of a motion grow: over a whole record so much that no search gets along. In a window they
/// have no time to. Each begins at a state of its own, and what is left between the end of one and the
/// beginning of the next is a residual like all others, of a weight that grows during the search.
///
/// @source [Bock1983]
class ShootingWindow {
 public:
  /// @param source  must live as long
  /// @param first   sample that it begins at
  /// @param last    sample that the next one begins at; with is_last the last sample
  ShootingWindow(const FitSource& source, Eigen::Index first, Eigen::Index last, bool is_last);

  Eigen::Index readings() const { return static_cast<Eigen::Index>(read_.size()); }
  /// Residuals: of its readings, then, unless it is the last one, of the state at its end.
  Eigen::Index residuals() const { return readings() + (is_last_ ? 0 : states()); }
  Eigen::Index states() const { return 2 * source_->rows.cols(); }
  bool is_last() const { return is_last_; }

  /// State at its beginning that its readings suggest: the motion nearest to zero that has them, and
  /// the rate at which they change.
  Vec guess() const;

  /// What is known of the motion from a state.
  struct Comparison {
    bool is_good = false;  ///< whether the motion gets through
    Vec readings;          ///< (reading - measured) / noise, as many as readings()
    Vec end;               ///< state where the next window begins
    Mat readings_by_start, readings_by_parameter, end_by_start, end_by_parameter;
    long grazes = 0;
  };
  /// @param slopes  whether derivatives are wanted
  Comparison compare(const FitSystem& system, const Vec& start, bool slopes) const;

  /// What the motion from a state reads, probes x its samples [m].
  Mat predict(const FitSystem& system, const Vec& start) const;

  Eigen::Index first_sample() const { return first_; }

 private:
  struct Reading {
    Eigen::Index probe, sample;  ///< sample within the window
  };
  MotionState state(const ContactSystem& system, const Vec& start) const;

  const FitSource* source_;
  Eigen::Index first_, last_;
  bool is_last_;
  std::vector<double> times_;  ///< of its samples, and of its end, since it begins [s]
  std::vector<Reading> read_;
};

/// Windows of a record of about a duration each [s], at least one.
std::vector<ShootingWindow> shooting_windows(const FitSource& source, double duration);

}  // namespace whirl::inline dyn
