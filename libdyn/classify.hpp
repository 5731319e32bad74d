#pragma once
/// The kind of a steady motion: what its tangents and its sections say together.

#include <array>
#include <functional>
#include <vector>

#include "libdyn/contact_measures.hpp"
#include "libdyn/contact_system.hpp"
#include "libdyn/trajectory.hpp"
#include "libfe/base/field.hpp"

namespace whirl {

enum class MotionKind { equilibrium, periodic, quasi_periodic, chaotic, hyperchaotic };
constexpr auto choices(MotionKind) {
  return std::array{Choice<MotionKind>{"equilibrium", MotionKind::equilibrium},
                    Choice<MotionKind>{"periodic", MotionKind::periodic},
                    Choice<MotionKind>{"quasi-periodic", MotionKind::quasi_periodic},
                    Choice<MotionKind>{"chaotic", MotionKind::chaotic},
                    Choice<MotionKind>{"hyperchaotic", MotionKind::hyperchaotic}};
}

struct ClassifyOptions {
  long discard = 500;        ///< revolutions before, for the transient
  long revolutions = 1000;   ///< over which exponents are averaged
  double tolerance = 1e-10;  ///< of a step, displacements by the length scale
  int longest_period = 32;   ///< that is looked for [revolutions]
  /// Called now and then with the revolutions done, of discard + revolutions; false: stop.
  std::function<bool(long)> progress;
};

struct Classification {
  MotionKind kind = MotionKind::periodic;
  int period =
      0;  ///< of a periodic motion [revolutions]; 0: not periodic, or longer than looked for
  /// All Lyapunov exponents per revolution, descending. Of a proven periodic motion they are those
  /// of its Floquet multipliers, else means.
  Vec exponents;
  bool is_proven = false;   ///< periodic: Newton's method found the orbit, and it attracts
  double residual = 0.0;    ///< of a proven orbit after its period, in length scales
  double resolution = 0.0;  ///< exponents within +-this count as zero [1/revolution]
  long revolutions =
      0;  ///< that contacts were measured over: the period, or all that were averaged
  std::vector<ContactMeasure> contacts;
  MotionState end;
  Outcome outcome = Outcome::reached_end;
  std::string diagnosis;

  /// Impacts of all contacts, the p of the p/n notation (n: revolutions).
  double impacts() const;
};

/// Tells what a motion becomes.
///
/// After the transient, sections at phase 0 are searched for a period p. Newton's method on the
/// p-th return map, with the tangent, then finds the orbit itself; if its multipliers lie within the
/// unit circle and it is where the motion was, the motion is periodic and this is proven. Else the
/// exponents are averaged: the motion is hyperchaotic or chaotic with two or one of them above the
/// resolution, quasi-periodic if the largest is within it, and periodic below it. The resolution,
/// (1 + ln T) / T for T revolutions, is above one over the averaging time: smaller exponents than
/// that cannot be told from zero.
///
/// @throws NumericalError  if the system has no coordinates
/// @source [Benettin1980] for the exponents, [LeineNijmeijer2004] for multipliers of nonsmooth flows
Classification classify(const ContactSystem& system, MotionState start,
                        const ClassifyOptions& options);

}  // namespace whirl
