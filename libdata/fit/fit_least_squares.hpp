#pragma once
/// The least squares of a search for parameters.

#include <vector>

#include "libbase/numerics/dogleg.hpp"
#include "libdata/fit/fit_search.hpp"

namespace whirl::inline data {

/// Derivatives of the residuals by all unknowns: the parameters first, then unknown offsets, then
/// the states at which windows begin.
struct FitJacobian {
  Sparse readings;  ///< of (reading - measured) / noise; empty where a motion fails
  Sparse gaps;      ///< of the gaps between windows over those that are allowed

  /// Whether no residual depends on an unknown.
  bool is_idle(Eigen::Index unknown) const {
    return readings.col(unknown).squaredNorm() == 0.0 && gaps.col(unknown).squaredNorm() == 0.0;
  }
};

class FitLeastSquares {
 public:
  /// @param search  is changed by this object; must live as long
  explicit FitLeastSquares(FitSearch& search);

  /// Powell's dogleg, whose steps may increase the cost for a while: where the motions in the
  /// windows have to be one, the valleys of the cost are narrow and bent. The method of Levenberg
  /// and Marquardt gets stuck in such valleys in a fifth of the twin experiments of chaos
  /// (bench/fit_twins.cpp).
  /// @param between    see FitSearch::between
  /// @param tolerance  relative change of the sum of squares below which an iteration is the last
  DoglegResult solve(double between, int most_iterations, double tolerance);

  /// The last solve. Where the model does not explain the records, steps shrink slowly, each by
  /// nearly the same factor: after some steps the sum of all that would follow is taken as one
  /// step.
  DoglegResult finish(double between, int most_iterations, double tolerance);

  int iterations() const { return iterations_; }

  void hold_parameters() { are_parameters_held_ = true; }
  void free_parameters() { are_parameters_held_ = false; }

  /// Moves a parameter on which no residual depends at its value, as the clearance of a contact
  /// that is out of reach, to a value at which residuals depend on it, from a third to three times
  /// the old one.
  /// @return  false: nothing has moved, as there is no such parameter or value, or the model
  ///          explains the records as it is
  bool rouse();

  FitJacobian jacobian();

  /// All unknowns over their scales, in the order of the columns of jacobian().
  Vec place() const;
  void go_to(const Vec& place);

 private:
  /// Numbers of parameters on which no residual depends.
  std::vector<Eigen::Index> idle_parameters();
  /// Whether residuals depend on a parameter at another value.
  bool does_something_at(double x, Eigen::Index parameter);
  /// All unknowns, part by part.
  std::vector<Vec*> unknowns() const;
  Vec bounds(double FreeParameter::*side, double none) const;
  /// Residuals of all windows at the place of go_to(), and the entries of their derivatives.
  /// @return  false where a motion fails
  bool residuals(Vec& r, std::vector<Triplet>* entries);
  /// @return  half the sum of squares there; infinite outside of bounds, and where a motion fails
  double cost_at(const Vec& place);
  /// Takes two steps b and c. If c = q b nearly, goes on by the sum of the steps that would follow,
  /// c q / (1 - q), or by less where the cost would rise.
  void leap(double between);

  FitSearch& search_;
  Vec systems_at_;  ///< values of the parameters at which systems were made last
  bool are_parameters_held_ = false;
  int iterations_ = 0;
};

}  // namespace whirl::inline data
