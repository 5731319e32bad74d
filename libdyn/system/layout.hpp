#pragma once
/// Where the parts of a state stand.

#include <string_view>
#include <type_traits>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline dyn {

/// A state y holds the displacements eta of the reduced coordinates, then their rates eta'.
/// Nothing else knows that order.
class StateLayout {
 public:
  /// The parts of a state in their order, for files that hold states.
  static constexpr std::string_view parts = "displacements, rates";

  /// The layout of states of so many coordinates.
  constexpr StateLayout(Eigen::Index coordinates) : coordinates_(static_cast<int>(coordinates)) {}
  /// The layout of a state that has so many numbers.
  static constexpr StateLayout of(Eigen::Index size) { return StateLayout(size / 2); }

  constexpr int coordinates() const { return coordinates_; }
  /// Numbers of a state.
  constexpr int size() const { return 2 * coordinates_; }
  /// Where the rate of a coordinate stands; the coordinate itself stands at its own number.
  constexpr int place_of_rate(int coordinate) const { return coordinates_ + coordinate; }

  /// Displacements of a state, or of all states in the columns of a matrix: a view that can be
  /// written to.
  template <class States>
  requires requires { std::remove_cvref_t<States>::IsVectorAtCompileTime; }
  auto eta(States&& y) const { return rows(y, 0); }
  /// Rates of a state, or of all states in the columns of a matrix: a view that can be written to.
  template <class States>
  requires requires { std::remove_cvref_t<States>::IsVectorAtCompileTime; }
  auto rate(States&& y) const { return rows(y, coordinates_); }
  Eigen::Map<const Vec> eta(const double* y) const { return {y, coordinates_}; }
  Eigen::Map<Vec> eta(double* y) const { return {y, coordinates_}; }
  Eigen::Map<const Vec> rate(const double* y) const { return {y + coordinates_, coordinates_}; }
  Eigen::Map<Vec> rate(double* y) const { return {y + coordinates_, coordinates_}; }

  /// Where the rates of a state begin, and where a state ends, in numbers of any kind.
  template <class Number>
  constexpr Number* rates_at(Number* y) const {
    return y + coordinates_;
  }
  template <class Number>
  constexpr Number* end(Number* y) const {
    return y + size();
  }

  /// Columns of displacements, or of rates, of a matrix whose columns belong to the numbers of a
  /// state.
  template <class Matrix>
  auto eta_columns(Matrix&& m) const {
    return m.leftCols(coordinates_);
  }
  template <class Matrix>
  auto rate_columns(Matrix&& m) const {
    return m.rightCols(coordinates_);
  }

  /// The matrix that does the same to displacements and to rates.
  Mat to_both(const Mat& m) const {
    Mat both = Mat::Zero(size(), size());
    both.topLeftCorner(coordinates_, coordinates_) = m;
    both.bottomRightCorner(coordinates_, coordinates_) = m;
    return both;
  }
  /// A of y' = A y, of eta'' + D eta' + K eta = 0.
  Mat first_order(const Mat& K, const Mat& D) const {
    Mat A = Mat::Zero(size(), size());
    A.topRightCorner(coordinates_, coordinates_).setIdentity();
    A.bottomLeftCorner(coordinates_, coordinates_) = -K;
    A.bottomRightCorner(coordinates_, coordinates_) = -D;
    return A;
  }

 private:
  template <class States>
  auto rows(States& y, Eigen::Index first) const {
    if constexpr (std::remove_cvref_t<States>::IsVectorAtCompileTime) {
      return y.segment(first, coordinates_);
    } else {
      return y.middleRows(first, coordinates_);
    }
  }

  int coordinates_;
};

}  // namespace whirl::inline dyn
