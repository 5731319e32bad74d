#pragma once
/// Motions with their exact derivatives by the state that they start from and by parameters.

#include <span>
#include <vector>

#include "libdyn/system/events.hpp"
#include "libdyn/system/system_slope.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// What a sample stands at while a parameter changes the speed; without such it is the same.
enum class HeldSample {
  time,  ///< the time since the start, as where a signal was measured at given instants
  phase  ///< the angle of the rotor, as where orbits close: samples are at time times phase rate
};

struct SlopeOptions {
  double tolerance = 1e-12;  ///< of a step, displacements by the length scale; slopes likewise
  int order = 0;             ///< of the series, 8 to 20; 0: by the tolerance
  bool by_start = true;      ///< whether derivatives by the start are wanted
  HeldSample held = HeldSample::time;
  double near = 1e-6;  ///< distance to a surface up to which a motion grazes it, see Graze
  /// Of the start, 2 n x any number: carried to the last sample, see MotionSlopes.
  Mat deviations{};
};

/// An event of a motion.
struct MotionEvent {
  double time = 0.0;  ///< since the start [s]
  int contact = 0;    ///< of ContactSystem::contacts()
  EventKind kind = EventKind::touch;
  bool jumps = false;  ///< whether the acceleration does, and derivatives with it
};

/// Where a motion all but touches, or all but stops to slip: beside it are motions that do and
/// motions that do not, whose derivatives differ.
///
/// Of a contact whose force jumps at a touch, derivatives are one-sided: right for changes towards
/// the side that the motion is on. Of slip that comes to rest, those of the motions that get there
/// grow without bound. Contacts whose force grows from nothing may be grazed: they have a
/// derivative.
struct Graze {
  double time = 0.0;                  ///< since the start [s]
  int contact = 0;                    ///< of ContactSystem::contacts()
  EventKind kind = EventKind::touch;  ///< touch or slip_stop
  bool is_passed = false;             ///< whether the event happens; else it is just missed
  /// How far beyond the surface the motion gets, or stays before it: of the clearance, for slip of
  /// the rim speed or of clearance times phase rate, whichever is larger.
  double margin = 0.0;
};

/// Samples of a motion, their derivatives, and what happened on the way.
struct MotionSlopes {
  Mat states;                     ///< 2 n x times
  std::vector<Mat> by_start;      ///< per time, 2 n x 2 n, if wanted
  std::vector<Mat> by_parameter;  ///< per time, 2 n x parameters [state per unit of p]
  /// What small deviations of the start have become at the last sample: the derivative by the start
  /// times them. Their own derivatives are second ones of the motion.
  Mat deviations;
  std::vector<Mat> deviations_by_start;      ///< per deviation, 2 n x 2 n, if wanted
  std::vector<Mat> deviations_by_parameter;  ///< per deviation, 2 n x parameters
  std::vector<MotionEvent> events;
  std::vector<Graze> grazes;
  MotionState end;  ///< where the last sample is, for what follows
  Outcome outcome = Outcome::reached_end;
  Failure failure;  ///< samples after it are not there: states has fewer columns
  Cost cost;        ///< of one pass; there is one for every eight columns
};

/// Integrates one motion with its derivatives, exact through touches, releases and stops of slip.
///
///   d/dt y_p = f_y y_p + f_p,   y_p+ = y_p- + (f+ - f-) (g_y y_p- + g_p) / (g_y f- + g_t)
///
/// The same series that move the motion are made of numbers with slopes: coefficients of the
/// equations bring theirs along, and those of states come out, whatever law, geometry or film.
/// Eight derivatives fill the lanes of a register and take one pass; a column is the same, bit by
/// bit, whichever others are asked for, and so is the motion.
///
/// The start, its phase with it, does not depend on parameters. One that sticks is taken to stick
/// beside it, too, and contacts that slip alike (ReducedContact::slip_group) to do so.
///
/// @param system      size 2 n
/// @param start       its contact states are found if they are not given
/// @param times       of the samples since the start, ascending, >= 0 [s]
/// @param parameters  of this system, any number
/// @throws NumericalError  if a neighbor of the system is of another shape, turns the other way, or
///                         has friction that switches where the system has none
/// @source [LeineNijmeijer2004], sec. 7.1 for the jumps; [GriewankWalther2008], ch. 13
MotionSlopes motion_slopes(const ContactSystem& system, const MotionState& start,
                           std::span<const double> times, std::span<const SystemSlope> parameters,
                           const SlopeOptions& options = {});

}  // namespace whirl::inline dyn
