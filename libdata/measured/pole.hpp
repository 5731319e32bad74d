#pragma once
/// A pole of a model that was identified from measured signals.

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// A free oscillation y = Re(shape e^(lambda t)) of the channels.
struct Pole {
  Complex lambda;  ///< eigenvalue, Im > 0 [rad/s]
  CVec shape;      ///< of the channels, of length one

  double frequency() const { return lambda.imag(); }  ///< damped natural frequency [rad/s]
  double damping_ratio() const { return -lambda.real() / std::abs(lambda); }
  /// 2 pi zeta / sqrt(1 - zeta^2); positive: stable.
  double log_decrement() const { return -turn * lambda.real() / lambda.imag(); }
};

/// Modal assurance criterion |a* b|^2 / (a* a  b* b) of shapes at the same channels, 0 to 1; 0 if a
/// shape is zero.
/// @source [AllemangBrown1982]
inline double channel_mac(const CVec& a, const CVec& b) {
  const double sizes = a.squaredNorm() * b.squaredNorm();
  return sizes > 0.0 ? std::norm(a.dot(b)) / sizes : 0.0;
}

/// How unlike two poles are: relative distance of their frequencies, plus one less their MAC.
/// @source [Magalhaes2009]
inline double pole_distance(const Pole& a, const Pole& b) {
  return std::abs(a.frequency() - b.frequency()) / std::max(a.frequency(), b.frequency()) + 1.0 -
         channel_mac(a.shape, b.shape);
}

}  // namespace whirl::inline data
