#pragma once
/// Peaks of a response over speed: how sharp they are, and how far from the operating speed they
/// have to be.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// Relative distance up to which only rounding tells two speeds apart.
inline constexpr double same_speed = 1e-12;

/// A peak of a response over speed.
struct ResponsePeak {
  Eigen::Index row = 0;    ///< the response that is largest there
  double speed = 0.0;      ///< N_c [rad/s]
  double amplitude = 0.0;  ///< in the unit of the response
  double below = 0.0;      ///< N_1: where the amplitude is 0.707 of the peak [rad/s]
  double above = 0.0;      ///< N_2, likewise; both NaN where the samples do not tell them

  /// N_c / (N_2 - N_1), of a lightly damped rotor 1 / (2 zeta); NaN without these sides.
  double amplification() const { return speed / (above - below); }
};

/// Peaks of the largest of several responses that are known at some speeds only, ascending speeds;
/// response_curve knows the true ones.
///
/// A peak lies on the parabola through its three highest samples, sides between two samples. Where
/// less than five samples are between the sides, or the amplitude does not fall that far, they are
/// not told.
///
/// @param speeds     ascending [rad/s]
/// @param amplitude  responses x speeds, >= 0
/// @param most       how many at most, the highest ones
/// @source [API617], [API684]: amplification factor from the half-power points
std::vector<ResponsePeak> response_peaks(const std::vector<double>& speeds, const Mat& amplitude,
                                         std::size_t most = 8);

/// The highest of some peaks, ascending speeds.
std::vector<ResponsePeak> highest_peaks(std::vector<ResponsePeak> peaks, std::size_t most);

/// Amplification factor below which a peak is critically damped, and no critical speed.
/// @source [API617], definitions of a lateral analysis
inline constexpr double least_amplification = 2.5;

/// How far a peak is from the operating speed, and should be.
struct SeparationMargin {
  double actual = 0.0;    ///< distance over the operating speed
  double required = 0.0;  ///< 0: it is critically damped, any distance will do; NaN: not known
  bool is_below = false;  ///< the peak is below the operating speed

  bool is_kept() const { return actual >= required; }
};

/// Separation margin of a peak.
///
///   below the operating speed:   17 (1 - 1 / (AF - 1.5)) %, 16 % at most
///   above it:               10 + 17 (1 - 1 / (AF - 1.5)) %, 26 % at most
///
/// Below AF = 2.5 none is required.
///
/// @param operating  operating speed, above zero [rad/s]
/// @source [API617], separation margins
SeparationMargin separation_margin(const ResponsePeak& peak, double operating);

}  // namespace whirl::inline fe
