#pragma once
/// Branches of periodic orbits along a parameter, and branches that begin at their bifurcations.

#include <optional>
#include <string>
#include <vector>

#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/parameter_range.hpp"
#include "libdyn/studies/walk_stretch.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline dyn {

struct BranchTreeOptions {
  ParameterRange along{};
  OrbitMethod method = OrbitMethod::shooting;
  OrbitFrame frame = OrbitFrame::stationary;  ///< rotating: by shooting, without generations
  int period = 1;                             ///< of the first orbit [revolutions]
  int harmonics = 0;              ///< of harmonic balance; 0: as many as the first orbit takes
  int generations = 0;            ///< of branches that begin at bifurcations of others
  int most_points = 2000;         ///< of a branch
  std::vector<Point> stations{};  ///< whose amplitudes are measured
};

/// A branch among those of a tree.
struct TracedBranch {
  Branch branch{};
  int parent = 0;      ///< number of the branch on which this one begins, from 1; 0: none
  int generation = 0;  ///< how many branches away from the first
  double direction = 1.0;
  std::vector<OrbitMeasure> measures{};  ///< per point
  std::vector<Vec> starts{};  ///< per point, state at phase 0, in the basis of the first value
};

/// What all branches of a tree have in common.
struct BranchLayout {
  Eigen::Index states = 0;              ///< of a revolution, reduced
  Vec scale{};                          ///< of the states
  int harmonics = 0;                    ///< of harmonic balance; 0: shooting
  bool is_rotating = false;             ///< orbits close as seen from the rotor, after any period
  std::vector<std::string> contacts{};  ///< names
  ProbeLabels probes{};                 ///< of the model

  /// Period of a point of a branch [revolutions].
  /// @param of_branch  period of the branch, where that is fixed
  double period(int of_branch, const BranchPoint& point) const {
    return is_rotating ? point.z(states) : of_branch;
  }
};

struct BranchTree {
  BranchLayout layout{};
  std::vector<TracedBranch> branches{};

  /// Whether nothing is left to be walked.
  bool is_complete() const;
  long points() const;
};

/// The layout of a tree without branches.
/// @param first  the scene at the first value of the parameter
BranchTree empty_tree(const Scene& first, const BranchTreeOptions& options);

/// The first branch, or one branch each way, from an orbit near a start.
/// @throws NumericalError  if there is no orbit
BranchTree begin_tree(const ParameterScenes& scenes, const Vec& start,
                      const BranchTreeOptions& options);

/// A stretch of the walk along a branch.
WalkNews walk_branch(const ParameterScenes& scenes, const BranchTreeOptions& options,
                     BegunWalk begun, const StretchLimits& limits);

/// A tree that grows by stretches of its branches, several of them at a time.
///
/// The tree becomes the same as if one branch were walked after the other, whichever ends first.
/// Branches that begin on a branch are added behind all others, once that branch and all before it
/// have ended; a branch that would be walked twice is dropped at the same time. A first branch that
/// closes needs no walk the other way.
class TreeGrowth {
 public:
  struct OpenWalk {
    std::size_t number = 0;  ///< that the walk keeps, whatever becomes of the tree
    BegunWalk begun{};
  };

  /// @param tree  at least begun; its walks go on, bit by bit
  TreeGrowth(const ParameterScenes& scenes, const BranchTreeOptions& options, BranchTree& tree);

  /// A walk to go on with; nothing: all walks are away, or have ended.
  std::optional<OpenWalk> next();
  /// Takes in what a stretch of a walk has found.
  void keep(std::size_t number, WalkNews news);

 private:
  struct Walk {
    std::size_t number = 0;
    bool is_away = false;
    Vec by_parameter{};  ///< as of BegunWalk
  };

  void number_walks();
  bool has_ended(std::size_t branch) const;
  /// Adds and drops branches where a branch has ended.
  void branch_out(std::size_t number);

  const ParameterScenes& scenes_;
  const BranchTreeOptions& options_;
  BranchTree& tree_;
  std::vector<Walk> walks_;  ///< in the order of the branches
  std::size_t numbers_ = 0;  ///< given to walks
  std::size_t settled_ = 0;  ///< branches that have ended, with all before them, and branched out
};

}  // namespace whirl::inline dyn
