#pragma once
/// One pass of the engine over a motion with eight of its derivatives.

#include <span>
#include <vector>

#include "libdyn/taylor/motion_slopes.hpp"
#include "libdyn/taylor/pattern.hpp"

namespace whirl::inline dyn {

/// Order of steps that are short for slopes alone. Slopes move as exponential functions do: series
/// of order 20 reach 2.5 times as far as those of order 12. Such a step costs 1.7 times as much,
/// and 2.3 times where the series of contacts are most of the work.
inline constexpr int order_of_slopes = 20;

/// What a column is the derivative by.
struct SlopeColumn {
  int start = -1;                          ///< number of a state at the start
  const SystemSlope* parameter = nullptr;  ///< or else a parameter
};

/// What a pass is asked for, and what it finds.
struct SlopeRun {
  std::vector<SlopeColumn> columns;  ///< eight or fewer
  std::span<const double> times;     ///< as motion_slopes
  HeldSample held = HeldSample::time;
  double near = 0.0;
  double fastest = 0.0;  ///< fastest_mode of the system [rad/s]
  Mat deviations;        ///< 2 n x any even number: of the start, carried to the last sample

  std::vector<Vec> states;  ///< of the samples so far
  std::vector<Mat> slopes;  ///< per sample, 2 n x columns [per step of its parameter]
  std::vector<MotionEvent> events;
  std::vector<Graze> grazes;
  MotionState end;
  std::vector<Mat> deviation_slopes;  ///< per deviation, 2 n x columns [per step of its parameter]

  bool is_done() const { return states.size() == times.size(); }
};

/// Moves a trajectory until all samples are taken, by the best instruction set of the processor.
/// @param pattern  of its system and all neighbors of it
void run_slopes(const Pattern& pattern, const BatchOptions& options, Trajectory& trajectory,
                SlopeRun& run);

}  // namespace whirl::inline dyn
