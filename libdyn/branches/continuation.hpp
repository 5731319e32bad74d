#pragma once
/// Walking along branches of periodic motions, round folds, stable or not.

#include <optional>
#include <string>

#include "libdyn/branches/branch_corrector.hpp"

namespace whirl::inline dyn {

struct ContinuationOptions {
  double low = 0.0, high = 1.0;  ///< range of the parameter, where a branch ends
  double first = 0.0;            ///< value at the start, within the range
  double direction = 1.0;        ///< in which the parameter goes at the start: 1 or -1
  double largest_step = 0.0;     ///< of the parameter; 0: a hundredth of the range
  double smallest_step = 1e-9;   ///< arc length of a step, below which the branch ends
  double located = 1e-9;         ///< accuracy of located bifurcations, over the range
  int period = 1;                ///< of orbits [revolutions]
  int most_points = 10000;
  std::string unit{};  ///< of the parameter, as sentences tell its values; empty: none

  /// @throws OptionError  if a number is outside of what it may be
  void check() const;
  double range() const { return high - low; }
  /// A value of the parameter as sentences tell it: "1.25 mm".
  std::string value_text(double value) const;
};

/// Walks along a branch by pseudo-arclength.
///
///   F(z) = 0,  <t, z - z_predicted> = 0,   z = (x, u)
///   <a, b> = mean of a_i b_i over the unknowns x + a_u b_u
///
/// Newton's method corrects what the tangent t predicts. The derivative by the parameter is taken
/// at each point, exactly where the equations give it, else as a difference of further evaluations,
/// central but for the ends of the range. The length of steps follows the number of corrections and
/// the angle between tangents; a step that does not converge is tried again, shorter. A bifurcation
/// between two points shows by the sign of a test function (see bifurcation.hpp) or by another
/// number of impacts; solving for the point of that change locates the bifurcation.
///
/// All that the walk depends on is in the branch: a branch that is read back goes on with the same
/// numbers, bit by bit.
///
/// @source [Keller1977]; [Kuznetsov2004], 10.2
class Continuation {
 public:
  /// Starts from a solution near x at the first value.
  /// @throws NumericalError  if there is no such solution, or no tangent
  Continuation(BranchEquations equations, const Vec& x, const ContinuationOptions& options);
  /// Goes on with a branch of at least one point.
  /// @param by_parameter  by_parameter() at the last point; empty: computed again
  Continuation(BranchEquations equations, Branch branch, const ContinuationOptions& options,
               Vec by_parameter = {});

  /// Adds a point, and the bifurcations on the way to it; false: the branch has ended.
  /// An exception, as of an interruption_point, leaves the branch as it is.
  bool advance();

  const Branch& branch() const { return branch_; }
  /// Derivative of the residual by the parameter at the last point.
  const Vec& by_parameter() const { return by_parameter_; }

 private:
  /// The point that the tangent predicts at an arc length from the last one, corrected, with a
  /// tangent of its own.
  BranchTrial reach(double step) const;
  /// The plane at the end of the range that the last tangent leads to.
  BranchPlane range_end_ahead() const;
  double next_step(const BranchTrial& trial, double step) const;
  /// The trial, or a point on the way to it at which the branch is done.
  BranchTrial stop_on_the_way(BranchTrial trial) const;
  void accept(BranchTrial trial);
  /// Takes off the folds and pitchforks at a vertex, where the branch is born from one of half its
  /// period: these are no bifurcations of its orbits.
  void forget_vertex(const BranchPoint& vertex);
  /// The first point of the branch, with its tangent, if the way from a to b leads through that
  /// point.
  BranchTrial closing(const BranchPoint& a, const BranchPoint& b) const;
  /// Arc length from a from which on orbits repeat after half their period, if that is before b.
  std::optional<double> halving(const BranchPoint& a, const BranchPoint& b) const;
  /// advance(), which leaves bifurcations or an end behind where an exception leaves it.
  bool add_point();
  /// Adds the bifurcations between two points; false: one of these could not be located.
  bool find_bifurcations(const BranchPoint& a, const BranchPoint& b);
  /// The point of the branch between a and b at an arc length from a.
  BranchTrial between(const BranchPoint& a, const BranchPoint& b, double length) const;
  /// Adds a bifurcation between two points; false: it could not be located.
  bool locate(BifurcationKind kind, const BranchPoint& a, const BranchPoint& b);
  bool locate_grazings(const BranchPoint& a, const BranchPoint& b);
  /// Where no step succeeds: looks for a grazing ahead, beyond which the branch goes on if an orbit
  /// is found there; else notes why the branch ends.
  void cross_or_end(const std::string& why);
  /// An orbit beyond a grazing at which all of a circle touches at once, so that no tangent leads
  /// across. The orbit touches all the time if the last one does not touch, or the other way round.
  /// @param u  parameter at the grazing, 0 at low and 1 at high
  BranchTrial beyond_grazing(const Bifurcation& grazes, double u) const;
  double limited(double step, const Vec& tangent) const;

  BranchCorrector corrector_;
  ContinuationOptions options_;
  Branch branch_;
  Vec by_parameter_;
};

}  // namespace whirl::inline dyn
