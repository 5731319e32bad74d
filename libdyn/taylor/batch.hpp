#pragma once
/// The engine: event-exact Taylor integration of many trajectories at once.

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libbase/failure.hpp"
#include "libdyn/system/contact_measures.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// One trajectory: its equations, where it is, how far it shall go, and what became of it.
struct Trajectory {
  const ContactSystem* system = nullptr;
  MotionState state;     ///< in and out; at a failure where it was
  long revolutions = 0;  ///< counted from state.revolution; the end is at phase 0

  Outcome outcome = Outcome::reached_end;
  Failure failure;
  Cost cost;
  std::vector<double> sections;        ///< states at the ends of revolutions, if asked for
  std::vector<ContactTimes> contacts;  ///< of all revolutions, if asked for
  Vec exponents;                       ///< Lyapunov exponents, descending, if asked for [1/s]
  /// Logarithms of what the columns of tangents have grown by at the ends of revolutions, one for
  /// each exponent, if asked for; the last ones over the time are the exponents, not sorted yet.
  std::vector<double> growths;
  Mat tangent;  ///< derivative of the end by the start, if asked for
  /// Mean divergence of the flow, with exponents or tangent [1/s]: the sum of all 2 n exponents, and
  /// over the time the logarithm of the tangent's determinant. Not with sticking, which has none.
  double divergence = 0.0;
  Vec lower_digits;  ///< of integrate_quad, in and out: the state is state.y + lower_digits
};

/// Lyapunov exponents of a motion with so many states, where so many are wanted at most; 0: all.
inline Eigen::Index exponents_of(Eigen::Index states, int most) {
  return most > 0 ? std::min<Eigen::Index>(states, most) : states;
}

/// What is wanted beside the end of a trajectory; what is not wanted costs nothing.
struct BatchOptions {
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  double fixed_step = 0.0;   ///< [s]; not 0: no error control, steps of this size between events
  int order = 0;    ///< of the series, 8 to 20, of integrate_quad to 30; 0: by the tolerance
  int threads = 0;  ///< 0: one per processor that this process may use
  bool sections = false;
  bool measures = false;
  /// Lyapunov exponents; their tangents start as the unit vectors. Sticking takes a direction away,
  /// whose exponent, minus infinity, comes out as a number far below all others.
  bool exponents = false;
  int most_exponents = 0;  ///< the largest ones, which do not depend on the others; 0: all 2 n
  bool growths = false;  ///< with the exponents, how they come about
  bool tangent = false;  ///< instead of the exponents
  /// With growths, called with a trajectory at the ends of its revolutions, in its thread: true ends
  /// it there. May be empty.
  std::function<bool(const Trajectory&)> is_enough;
  /// Called every few hundred steps with the revolutions done by this call, in each of its threads
  /// with its own; false: stop, all trajectories of the thread as they are. May be empty.
  std::function<bool(long)> watch;
};

/// Integrates trajectories whose systems have the same shape (coordinates, contacts, laws).
///
/// Lanes of SIMD registers are trajectories with their own parameters, phase, step and events,
/// refilled as they finish; threads take chunks that are laid down beforehand. A trajectory's
/// numbers depend neither on its neighbors nor on lanes or threads: they are those that it has
/// alone, bit by bit.
///
/// @throws NumericalError  if the systems differ in shape
void integrate_batch(std::span<Trajectory> trajectories, const BatchOptions& options);

/// Order of the series for a tolerance: 8 from 1e-7, 12 from 1e-11, 16 from 1e-14, 20 from 1e-17,
/// and below, where only integrate_quad gets, 30.
int order_for(double tolerance);

/// Integrates one trajectory in one lane; the observer, if any, sees every step.
void integrate_single(Trajectory& trajectory, const BatchOptions& options,
                      const Observer& observer = {});

/// The same in quadruple precision (113 bits), with tolerances down to 1e-31: a reference for
/// everything else, a thousand times slower. Meant for one trajectory, whatever the threads.
///
/// The coefficients of the system are taken as the doubles that they are, but a revolution is 2 pi
/// to the last digit. Decisions at events that are rare (does it stick, which way does it slide,
/// does it part or recede) are made in double from a state that is rounded for it, but for those
/// that are too close for that; the motion itself stays in full precision. Jumps of tangents are
/// double.
///
/// @param trajectory  starts from state.y + lower_digits, if these are given, and ends there
void integrate_quad(Trajectory& trajectory, const BatchOptions& options);

/// The same by the method of methods/rk4.hpp, in this thread, for comparison: lanes go in lock
/// step, so that all take as many steps in a revolution as the one that needs most.
void integrate_batch_rk4(std::span<Trajectory> trajectories, const IntegrationOptions& options);

/// Name of the instruction set that lanes are computed with: "avx512", "avx2", "baseline", which
/// every processor has, or on other processors Highway's name.
std::string instruction_set();

constexpr std::string_view baseline_set = "baseline";

/// Those that lanes are compiled for and this processor has, the best first.
std::vector<std::string> instruction_sets();

/// From now on lanes are computed with one of them; empty: with the best. Nothing may be integrated
/// meanwhile.
void use_instruction_set(std::string_view name);

/// Whether motions are the same with both, bit by bit: they are where products are fused with sums
/// in both or in neither.
bool rounds_alike(std::string_view set, std::string_view other);

}  // namespace whirl::inline dyn
