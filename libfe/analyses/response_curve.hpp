#pragma once
/// The unbalance response as a curve over speed: with as many speeds as it needs, and true peaks.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libbase/failure.hpp"
#include "libfe/analyses/amplification.hpp"
#include "libfe/analyses/unbalance.hpp"

namespace whirl::inline fe {

/// Speeds where the response may have a peak, from the damped modes, with their half-widths.
struct Resonance {
  double speed = 0.0;       ///< |Im lambda| = order Omega [rad/s]
  double half_width = 0.0;  ///< |Re lambda| / order [rad/s]
};

struct ResponseCurveOptions {
  double phase_step = 4.0;     ///< between neighboring speeds at most [deg]
  int steps = 100;             ///< equal ones across the range, at least
  std::size_t most = 20000;    ///< speeds of the curve
  std::size_t most_peaks = 8;  ///< the highest ones
  /// Those between the first and the last speed, as another load of this rotor told them; nothing:
  /// they are looked for.
  std::optional<std::vector<Resonance>> resonances{};
  /// Of an order of the speed, in place of all that has the frequency of the speed; nothing: these.
  std::optional<Excitation> load{};
};

/// Response over a range of speeds.
struct ResponseCurve {
  UnbalanceResponse response;       ///< at the speeds of the curve, peaks and sides among them
  std::vector<ResponsePeak> peaks;  ///< of the largest major semi-axis of all points [m]
  std::vector<double> unbounded;    ///< undamped resonances: no peaks [rad/s]
  Failure failure;                  ///< why modes did not help to find narrow peaks
};

/// The response from the first to the last of some speeds.
///
/// Narrow peaks are found from the complex modes: the speeds where |Im lambda| = Omega, and those a
/// half-width -Re lambda beside them, are part of the curve. Where the phase of a point that moves
/// visibly turns by more than `phase_step` between two speeds, the speed between them is added.
/// Peaks, and the speeds where they have fallen to 0.707, are roots and maxima of the response
/// itself, to 1e-9 of the speed (a peak's own speed to 1e-8, the root of rounding).
///
/// @param at_least  ascending; all are on the curve but those with an unbounded response [rad/s]
ResponseCurve response_curve(const Assembler& assembler, const std::vector<double>& at_least,
                             const std::vector<Point>& points,
                             const ResponseCurveOptions& options = {});

/// A size of the response at any speed; infinite where it is unbounded.
using SizeAt = std::function<double(double Omega)>;

/// The peak of a size around the number k of some speeds, where it is larger than at both
/// neighbors: its top and its sides as roots of the size itself.
/// @param known  the size at speed number i
ResponsePeak refined_peak(const SizeAt& size_at, const std::vector<double>& speeds,
                          const std::function<double(std::size_t i)>& known, std::size_t k);

/// Peaks of a size that is known at the speeds of a curve, such as what a probe reads.
/// @param sizes  at the speeds of the curve
std::vector<ResponsePeak> refined_peaks(const SizeAt& size_at, const ResponseCurve& curve,
                                        const Vec& sizes, std::size_t most = 8);

/// The largest major semi-axis of every point [m] and its speed [rad/s], on the parabola through
/// the inverse squares of the three highest samples: what one mode makes is one.
struct LargestResponse {
  double speed = 0.0, amplitude = 0.0;
};
std::vector<LargestResponse> largest_responses(const UnbalanceResponse& response);

/// Those of all modes between two speeds, ascending.
/// @param order  of the load: its frequency over the speed, 1 for unbalance
/// @throws NumericalError  if an eigensolver fails
std::vector<Resonance> resonances_between(const Assembler& assembler, double first, double last,
                                          double order = 1.0);

}  // namespace whirl::inline fe
