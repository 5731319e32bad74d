#pragma once
/// The least squares of a search for parameters, solved by Ceres.

#include <ceres/ceres.h>

#include <vector>

#include "libdyn/fit/fit_search.hpp"

namespace whirl::inline dyn {

class FitLeastSquares {
 public:
  /// @param search  is moved; must live as long
  explicit FitLeastSquares(FitSearch& search);

  /// Powell's dogleg, whose steps may make things worse for a while: the valleys of motions that must be
  /// one are narrow and bent. Levenberg and Marquardt's way gets stuck in them in a fifth of the twin
  /// experiments of chaos (bench/fit_twins.cpp).
  /// @param between    as of FitSearch
  /// @param tolerance  change of the sum of squares in an iteration that is the last
  ceres::Solver::Summary solve(double between, int most_iterations, double tolerance);

  /// The last solve. Where the model does not explain the records, steps shrink by nearly the same factor
  /// each, and hardly: after some of them what they sum up to is gone at once.
  ceres::Solver::Summary finish(double between, int most_iterations, double tolerance);

  int iterations() const { return iterations_; }

  void hold_parameters() { problem_.SetParameterBlockConstant(search_.x.data()); }
  void free_parameters() { problem_.SetParameterBlockVariable(search_.x.data()); }

  /// Moves a parameter that does nothing where it is, as the clearance of a contact that is out of reach,
  /// to a value at which it does something, down to a third and up to three times its own.
  /// @return  false where there is none, or the model explains the records as it is: nothing has moved
  bool rouse();

  /// Derivatives of all residuals, the parameters first, then unknown offsets; empty where a motion does
  /// not get through.
  Sparse jacobian();

 private:
  /// Stops Ceres where somebody asks for it.
  class Interruption : public ceres::IterationCallback {
   public:
    explicit Interruption(const FitOptions& options) : options_(options) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
      return options_.is_stopped && options_.is_stopped() ? ceres::SOLVER_ABORT
                                                          : ceres::SOLVER_CONTINUE;
    }

   private:
    const FitOptions& options_;
  };

  /// Numbers of parameters that do nothing.
  std::vector<Eigen::Index> idle_parameters();
  /// Whether a parameter does something with another value.
  bool does_something_at(double x, Eigen::Index parameter);
  /// All that is searched for, in its scales.
  std::vector<Eigen::Map<Vec>> unknowns();
  Vec place();
  /// @return  half the sum of squares there; infinite outside of bounds, and where motions do not get
  ///          through
  double go_to(const Vec& place);
  /// From two steps b and c with c = q b nearly: c q / (1 - q) further on, or less where that is worse.
  void leap(double between);

  FitSearch& search_;
  ceres::Problem problem_;
  Interruption stop_;
  int iterations_ = 0;
};

}  // namespace whirl::inline dyn
