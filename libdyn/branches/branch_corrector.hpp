#pragma once
/// The equations of a branch over (x, u), u the parameter over its range: where they are solved.

#include <functional>
#include <optional>

#include "libbase/failure.hpp"
#include "libdyn/branches/branch.hpp"

namespace whirl::inline dyn {

/// A point that may become the next one.
struct BranchTrial {
  BranchPoint point;
  int corrections = 0;
  bool is_outside = false;  ///< of the range
  Failure failure;
  Mat jacobian;                  ///< by the unknowns
  std::function<Vec()> slope;    ///< as of BranchEquations::Value
  Vec by_parameter;              ///< derivative of the residual by the parameter
  std::optional<BranchEnd> end;  ///< set if the branch ends at this point
};

/// The plane that the corrector keeps z in: <normal, z - at> = 0.
struct BranchPlane {
  Vec normal, at;
};

/// Solves the equations of a branch in planes of z = (x, u), and finds its tangents.
class BranchCorrector {
 public:
  /// @param low, high  range of the parameter
  /// @param unknowns   size of x
  BranchCorrector(BranchEquations equations, double low, double high, Eigen::Index unknowns);

  /// The parameter at u of its range, 0 to 1.
  double value_of(double u) const;
  /// <a, b> of Continuation.
  double dot(const Vec& a, const Vec& b) const;
  /// What cannot be computed says so in its failure.
  BranchEquations::Value evaluate(const Vec& z, WithTangent wanted) const;
  /// Derivative of the residual by the parameter over its range.
  /// @param slope  as of BranchEquations::Value, at z
  Vec derivative_by_parameter(const Vec& z, const std::function<Vec()>& slope) const;
  /// The solution in a plane, by Newton's method from the plane's place.
  /// @param by_parameter  derivative near that place; empty: taken where the corrector begins
  BranchTrial correct(const BranchPlane& plane, Vec by_parameter) const;
  /// Adds the tangent at a point of the branch, and the derivative by the parameter; false: there
  /// is no tangent.
  bool add_tangent(BranchTrial& trial, const Vec& along) const;

 private:
  Vec difference_by_parameter(const Vec& z) const;

  BranchEquations equations_;
  double low_, high_;
  Vec weights_;
};

}  // namespace whirl::inline dyn
