#pragma once
/// The least squares of a search for parameters.

#include <vector>

#include "libbase/numerics/dogleg.hpp"
#include "libdata/fit/fit_search.hpp"

namespace whirl::inline data {

/// Derivatives of the residuals by all unknowns: the parameters first, then unknown offsets, then
/// the states at which windows begin.
struct FitJacobian {
  Sparse readings;  ///< of (reading - measured) / noise; empty where a motion does not get through
  Sparse gaps;      ///< of what is left between windows, over what may be

  /// Whether nothing depends on an unknown.
  bool is_idle(Eigen::Index unknown) const {
    return readings.col(unknown).squaredNorm() == 0.0 && gaps.col(unknown).squaredNorm() == 0.0;
  }
};

class FitLeastSquares {
 public:
  /// @param search  is moved; must live as long
  explicit FitLeastSquares(FitSearch& search);

  /// Powell's dogleg, whose steps may make things worse for a while: the valleys of motions that
  /// must be one are narrow and bent. Levenberg and Marquardt's way gets stuck in them in a fifth
  /// of the twin experiments of chaos (bench/fit_twins.cpp).
  /// @param between    as of FitSearch
  /// @param tolerance  change of the sum of squares in an iteration that is the last
  DoglegResult solve(double between, int most_iterations, double tolerance);

  /// The last solve. Where the model does not explain the records, steps shrink by nearly the same
  /// factor each, and hardly: after some of them what they sum up to is gone at once.
  DoglegResult finish(double between, int most_iterations, double tolerance);

  int iterations() const { return iterations_; }

  void hold_parameters() { are_parameters_held_ = true; }
  void free_parameters() { are_parameters_held_ = false; }

  /// Moves a parameter that does nothing where it is, as the clearance of a contact that is out of
  /// reach, to a value at which it does something, down to a third and up to three times its own.
  /// @return  false where there is none, or the model explains the records as it is: nothing has
  ///          moved
  bool rouse();

  FitJacobian jacobian();

  /// All that is searched for, in its scales: in the order of the columns of jacobian().
  Vec place() const;
  void go_to(const Vec& place);

 private:
  /// Numbers of parameters that do nothing.
  std::vector<Eigen::Index> idle_parameters();
  /// Whether a parameter does something with another value.
  bool does_something_at(double x, Eigen::Index parameter);
  /// All that is searched for, part by part.
  std::vector<Vec*> unknowns() const;
  Vec bounds(double FreeParameter::*side, double none) const;
  /// Residuals of all windows at the place gone to, and the entries of their derivatives.
  /// @return  false where a motion does not get through
  bool residuals(Vec& r, std::vector<Triplet>* entries);
  /// @return  half the sum of squares there; infinite outside of bounds, and where motions do not
  ///          get through
  double cost_at(const Vec& place);
  /// From two steps b and c with c = q b nearly: c q / (1 - q) further on, or less where that is
  /// worse.
  void leap(double between);

  FitSearch& search_;
  Vec systems_at_;  ///< values of the parameters at which systems were made last
  bool are_parameters_held_ = false;
  int iterations_ = 0;
};

}  // namespace whirl::inline data
