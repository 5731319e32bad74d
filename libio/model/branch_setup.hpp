#pragma once
/// Branches and circles as they are asked for: over which values, how, and of which stations.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libdyn/studies/branch_result.hpp"
#include "libdyn/studies/branch_study.hpp"
#include "libdyn/studies/curve_result.hpp"
#include "libdyn/studies/torus_result.hpp"
#include "libio/model/branch_parameters.hpp"

namespace whirl::inline io {

struct BranchSetup {
  BranchParameters parameters;
  BranchTreeOptions tree;
  Model at_first;                      ///< the model at the first value
  std::shared_ptr<const Scene> scene;  ///< of at_first
  std::vector<std::string> stations;   ///< names of the stations that are measured
  int threads = 1;                     ///< of this process that follow branches

  bool has_curves() const { return parameters.across.has_value(); }
  BranchStudyOptions options() const;
  BranchScenes scenes() const;

  BranchResult result(const BranchTree& found) const;
  /// Only if there is a second parameter.
  CurveResult result(const BifurcationCurves& found) const;
};

/// A circle as it is asked for, and over which values, if it is to be followed.
struct TorusSetup {
  std::optional<BranchParameters> parameters{};
  TorusOptions options{};
  Model at_first{};                    ///< the model at the first value
  std::shared_ptr<const Scene> scene;  ///< of at_first

  ParameterScenes scenes() const;
  TorusResult result(const TorusBranch& torus) const;
};

/// @param parameters  nothing: a single circle
/// @throws ModelError  for a second parameter
TorusSetup torus_setup(const Model& model, std::optional<BranchParameters> parameters,
                       TorusOptions options);

/// @param tree      its range and stations are set here
/// @param stations  names, as select_points takes them
/// @throws ModelError  for stations that are not there
BranchSetup branch_setup(BranchParameters parameters, BranchTreeOptions tree,
                         const std::string& stations);

}  // namespace whirl::inline io
