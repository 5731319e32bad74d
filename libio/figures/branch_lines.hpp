#pragma once
/// Lines and marks of branches of periodic orbits, in their own figure and over figures of sweeps.

#include <functional>

#include "libdyn/studies/branch_result.hpp"
#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Branches, and how they are shown along their parameter.
struct BranchPoints {
  explicit BranchPoints(const ResultView& result);
  const BranchResult& of;
  ShownAxis axis;
  std::vector<double> period;  ///< per branch [revolutions]

  std::size_t size() const { return of.points.size(); }
  /// Where a bifurcation is along the axis.
  double place(const BranchBifurcation& b) const { return b.value / axis.factor; }
  /// Number of the point before a bifurcation, among those of all branches.
  std::size_t before(const BranchBifurcation& b) const;
  /// Shows the parameter in the unit of another axis that it has.
  void show_as(const ShownAxis& other);
  /// A number of every point.
  std::vector<double> numbers(const std::function<double(const BranchOrbit&)>& number) const;
  /// Number i of every point's list of numbers; NaN where the list is shorter.
  std::vector<double> numbers(std::vector<double> BranchOrbit::*list, std::size_t i) const;
};

/// The size of the largest multiplier of a point.
double largest_multiplier(const BranchOrbit& point);

/// How lines of branches are told apart, beside solid and dashed.
struct BranchStyle {
  bool is_named = false;
  bool is_ink = false;  ///< all in one color, over what has colors; else one per branch
};

/// Lines through a number per point: solid where orbits are stable, dashed where they are not. The
/// style of a line changes at the bifurcation between the points.
void add_branch_lines(Panel& p, const BranchPoints& b, const std::vector<double>& y,
                      const BranchStyle& style);

/// Marks of bifurcations on the lines; small ones for grazings, of which there are many.
void add_branch_marks(Panel& p, const BranchPoints& b, const std::vector<double>& y);

}  // namespace whirl::inline io::figures
