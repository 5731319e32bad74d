#pragma once
/// What a call of `whirl continue` asks for, and what comes of it.

#include <memory>

#include "apps/invocation.hpp"
#include "apps/verbs/branch_parameters.hpp"
#include "libdyn/studies/bifurcation_curves.hpp"
#include "libdyn/studies/branch_tree.hpp"
#include "libio/results/branch_results.hpp"
#include "libio/results/curve_results.hpp"

namespace whirl::inline cli {

struct ContinueCall {
  BranchParameters parameters;
  BranchTreeOptions tree;
  Model at_first;  ///< the model at the first value
  std::shared_ptr<const Scene> scene;
  BranchNames names;

  ParameterScenes scenes() const {
    return {scene, [this](double value) { return parameters.scene(value); }};
  }
  PlaneScenes plane() const {
    return {scene, [this](double a, double b) { return parameters.scene(a, b); }};
  }
  /// With a second parameter only.
  BifurcationCurveOptions curve_options() const {
    return {tree.along, parameters.across->range, tree.most_points};
  }
  CurveAxes curve_axes() const {
    return {parameters.along.axis, tree.along, parameters.across->axis};
  }
};

/// @throws ModelError  for options that are wrong, or do not go together
ContinueCall continue_call(const Invocation& call, const Model& model);

/// All that is found, and what of it is in the file already.
struct FollowedBranches {
  BranchTree tree;
  BifurcationCurves curves{};
  long resumed = 0;  ///< points
  int status = 0;
};

}  // namespace whirl::inline cli
