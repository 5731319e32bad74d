#pragma once
/// Branches along a parameter, and the curves of their bifurcations along a second one, together.

#include <chrono>
#include <functional>
#include <optional>

#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/studies/monitor.hpp"

namespace whirl::inline dyn {

struct BranchStudy {
  BranchTree tree{};
  BifurcationCurves curves{};

  /// Whether nothing is left to be walked.
  bool is_complete() const { return tree.is_complete() && curves.is_complete(); }
};

struct BranchStudyOptions {
  BranchTreeOptions tree{};
  std::optional<BifurcationCurveOptions> curves{};  ///< nothing: branches alone
  int threads = 1;                                  ///< of this process; 0: the calling one
  /// Time after which a walk can be saved, and goes on.
  std::chrono::duration<double> stretch = std::chrono::milliseconds(100);
};

/// The scenes of the branches, and of the plane in which their bifurcations are followed.
struct BranchScenes {
  ParameterScenes along;
  PlaneScenes plane;
};

/// Follows branches, and then the curves of their bifurcations; threads and processes share the
/// walks. What is found depends neither on threads and processes nor on the stretches.
///
/// @param study    what there is already, and goes on, bit by bit; may be an empty_tree
/// @param settled  a state near the first orbit, asked where there is no branch; nothing: stop
/// @throws NumericalError  if there is no first orbit
BranchStudy follow_branches(const BranchScenes& scenes, BranchStudy study,
                            const std::function<std::optional<Vec>()>& settled,
                            const BranchStudyOptions& options, const Monitor<BranchStudy>& monitor);

}  // namespace whirl::inline dyn
