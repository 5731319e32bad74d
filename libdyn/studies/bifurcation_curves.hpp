#pragma once
/// Curves of the bifurcations of branches in the plane of two parameters.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libdyn/branches/bifurcation_curve.hpp"
#include "libdyn/studies/branch_tree.hpp"
#include "libdyn/studies/parameter_range.hpp"

namespace whirl::inline dyn {

struct BifurcationCurveOptions {
  ParameterRange along{};   ///< the parameter of the branches
  ParameterRange across{};  ///< the second parameter; branches are at its first value
  int most_points = 2000;   ///< of a curve
};

/// The scenes of a plane of two parameters; states are told in the basis of the first one.
struct PlaneScenes {
  std::shared_ptr<const Scene> first;
  /// May throw NumericalError where there is no scene.
  std::function<std::shared_ptr<const Scene>(double along, double across)> at;
  std::shared_ptr<const PlaneSlopes> slopes{};  ///< of scenes; null: derivatives are differences
};

/// The flows of scenes over a plane.
/// @param scenes   must live as long as the flows
/// @param contact  whose grazings are looked for; empty: any
FlowPlane flows_of(const PlaneScenes& scenes, const std::string& contact = {});

/// A curve that goes through a bifurcation of a branch, one way along the second parameter.
struct BifurcationCurve {
  BifurcationKind kind{};
  std::string contact;     ///< that grazes; of a grazing only
  int branch_number = 0;   ///< of the branch that the curve goes through, from 1
  double direction = 1.0;  ///< of the second parameter
  Branch branch{};         ///< along the second parameter; the last unknown is the first parameter
};

struct BifurcationCurves {
  std::vector<BifurcationCurve> curves{};

  /// Whether all curves that are begun have ended.
  bool is_complete() const;
};

/// Value of the first parameter at a point of a curve.
double first_value(const ParameterRange& along, const BranchPoint& point);

/// Curves through every fold, period doubling, Neimark-Sacker point and grazing of complete
/// branches, at their first points.
/// @param tree  the branches with these bifurcations
BifurcationCurves begin_curves(const PlaneScenes& scenes, const BranchTree& tree,
                               const BifurcationCurveOptions& options);

/// A curve as a walk.
BegunWalk begun_walk(const BifurcationCurve& curve);

/// A stretch of the walk along a curve.
WalkNews walk_curve(const PlaneScenes& scenes, const BifurcationCurveOptions& options,
                    BegunWalk begun, const StretchLimits& limits);

}  // namespace whirl::inline dyn
