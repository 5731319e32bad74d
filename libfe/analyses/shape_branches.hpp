#pragma once
/// Solutions of an eigenproblem that depends on a parameter, followed by their shapes.

#include <functional>
#include <string>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline fe {

/// A number with the shape that belongs to it, such as a critical speed.
struct ShapedValue {
  double value = 0.0;  ///< above zero
  CVec shape;
  Complex eigenvalue{};  ///< where the number does not tell all of it; zero where it does
  int number = 0;        ///< for who solves: of the solution at this value of the parameter
};

/// One solution along the parameter.
struct ShapeBranch {
  std::vector<double> at;  ///< values of the parameter, ascending
  std::vector<ShapedValue> found;
};

/// A value of the parameter that was asked for, at which the eigenproblem failed.
struct ShapeGap {
  double at = 0.0;
  std::string reason;
};

struct ShapeBranches {
  std::vector<ShapeBranch> branches;  ///< in the order of their values where they begin
  std::vector<ShapeGap> gaps;
};

/// Lowest solutions at a value of the parameter, ascending; throws NumericalError or ModelError
/// where there are none to be had.
using SolveShapes = std::function<std::vector<ShapedValue>(double at)>;

/// Follows solutions along a parameter, each by its shape.
///
/// Solutions at neighboring values belong together one to one, those of the best agreement
/// |a^H W b|^2 / (a^H W a  b^H W b) first, a small share of it for near values. Where a branch
/// finds none that agrees by 0.8, values of the parameter between are solved too, down to 1/64 of a
/// step. Equal solutions count as one space, from which each branch takes what is most like its own
/// shape. A branch that finds no successor ends, one that nothing precedes begins. Where the
/// eigenproblem fails the branches go on at the next value, and the failure is told; between the
/// values that were asked for it is not.
///
/// @param at     ascending; where branches are told beside the values between
/// @param W      symmetric, of the size of the shapes
/// @param limit  branches above it need not agree: they leave the picture
ShapeBranches follow_shapes(const std::vector<double>& at, const SolveShapes& solve,
                            const Sparse& W, double limit);

/// Share of a shape within the space of others: 1 if it is one of their sums.
/// @param Q  columns with Q^H W Q = I
double share_within(const CVec& shape, const CMat& Q, const Sparse& W);

}  // namespace whirl::inline fe
