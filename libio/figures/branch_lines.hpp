#pragma once
/// Lines and marks of branches of periodic orbits, in their own figure and over those of sweeps.

#include "libio/figures/common.hpp"

namespace whirl::inline io::figures {

/// Points of all branches, one after another, and what happens between them.
struct BranchPoints {
  explicit BranchPoints(const ResultView& result);
  ShownAxis axis;
  std::vector<double> branch, stable;  ///< per point
  std::vector<double> period;          ///< per branch [revolutions]
  std::vector<double> bifurcation, on, after;
  std::vector<std::string> kind;  ///< of the bifurcations

  std::size_t size() const { return branch.size(); }
  /// Number of the point before a bifurcation, among those of all branches.
  std::size_t before(std::size_t b) const;
  /// Shows the parameter in the unit of another axis of it.
  void show_as(const ShownAxis& other);
};

/// Numbers of a column of a table with a row per point.
std::vector<double> column_of(const ResultView& result, const std::string& path, std::size_t i);

/// The size of the largest multiplier of each point.
std::vector<double> largest_multipliers(const ResultView& result);

/// How lines of branches are told apart, beside solid and dashed.
struct BranchStyle {
  bool is_named = false;
  bool is_ink = false;  ///< all in one color, over what has colors; else one per branch
};

/// Lines through a number per point: solid where orbits are stable, dashed where they are not; they
/// change at the bifurcation between the points.
void add_branch_lines(Panel& p, const BranchPoints& b, const std::vector<double>& y,
                      const BranchStyle& style);

/// Marks of bifurcations on the lines; small ones for grazings, of which there are many.
void add_branch_marks(Panel& p, const BranchPoints& b, const std::vector<double>& y);

}  // namespace whirl::inline io::figures
