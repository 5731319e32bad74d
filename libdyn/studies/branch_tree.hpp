#pragma once
/// Branches of periodic orbits along a parameter, and those that begin at their bifurcations.

#include <string>
#include <vector>

#include "libdyn/orbits/orbit_measure.hpp"
#include "libdyn/studies/found_orbit.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/parameter_range.hpp"
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
  int parent = 0;      ///< number of the branch that it begins on, from 1; 0: none
  int generation = 0;  ///< how many branches it is away from the first
  double direction = 1.0;
  std::vector<OrbitMeasure> measures{};  ///< per point
  std::vector<Vec> starts{};  ///< per point, state at phase 0, in the basis of the first value
};

/// What all branches of a tree have in common.
struct BranchLayout {
  Eigen::Index states = 0;              ///< of a revolution, reduced
  Vec scale{};                          ///< of the states
  int harmonics = 0;                    ///< of harmonic balance; 0: shooting
  bool is_rotating = false;             ///< closed as seen from the rotor, after any period
  std::vector<std::string> contacts{};  ///< names
  ProbeLabels probes{};                 ///< those of the model

  /// Of a point of a branch [revolutions].
  double period(const Branch& branch, const BranchPoint& point) const {
    return is_rotating ? point.z(states) : branch.period;
  }
};

struct BranchTree {
  BranchLayout layout{};
  std::vector<TracedBranch> branches{};

  /// Nothing is left to be walked.
  bool is_complete() const;
  long points() const;
};

/// The layout of a tree without branches.
/// @param first  the scene at the first value of the parameter
BranchTree empty_tree(const Scene& first, const BranchTreeOptions& options);

/// The first branch, or two of them both ways, from an orbit near a start.
/// @throws NumericalError  if there is no orbit
BranchTree begin_tree(const ParameterScenes& scenes, const Vec& start,
                      const BranchTreeOptions& options);

/// Walks until all branches have ended. A first branch that closes is not walked the other way, too.
/// @param tree  at least begun; what it has is gone on with, bit by bit
BranchTree grow_tree(const ParameterScenes& scenes, BranchTree tree,
                     const BranchTreeOptions& options, const Monitor<BranchTree>& monitor);

}  // namespace whirl::inline dyn
