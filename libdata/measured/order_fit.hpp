#pragma once
/// Orders of readings: a constant and multiples of the speed that make up samples over the angle of
/// the rotor.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline data {

/// A constant and orders fitted to samples by least squares, weighted by a Hann window over the
/// angle:
///
///   p_j = c + sum_q Re(C_q e^(i q angle_j))
///
/// Samples need not go evenly into revolutions.
class OrderFit {
 public:
  /// @param angle   of the rotor at the samples [rad]
  /// @param middle  angle of the middle of the window [rad]
  /// @param width   of the window, over two periods of the lowest order and of the smallest
  /// distance
  ///                of two orders, so that orders can be told apart [rad]
  OrderFit(const Vec& angle, double middle, double width, const std::vector<double>& orders);

  /// The constant, then real and imaginary part of each order: 1 + 2 orders rows, a column per
  /// reading.
  /// @param readings  samples x readings
  Mat of(const Mat& readings) const;

 private:
  Mat weighted_;
  Vec weights_;
};

}  // namespace whirl::inline data
