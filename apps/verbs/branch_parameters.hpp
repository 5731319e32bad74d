#pragma once
/// What branches are followed over: --over, once or twice, and --at.

#include <memory>
#include <optional>
#include <vector>

#include "apps/invocation.hpp"
#include "libdyn/studies/parameter_range.hpp"
#include "libio/model/model_family.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline cli {

/// A parameter of branches and its range.
struct BranchParameter {
  ParameterAxis axis;
  ParameterRange range;
};

/// The parameter of the branch, the second one of borders, if any, and the model at their values.
struct BranchParameters {
  BranchParameter along;
  std::optional<BranchParameter> across{};
  std::shared_ptr<const ModelFamily> family{};

  /// At the first value of the second parameter.
  Model model(double first) const { return model(first, across ? across->range.first : 0.0); }
  Model model(double first, double second) const { return family->model(values(first, second)); }
  std::shared_ptr<const Scene> scene(double first) const {
    return scene(first, across ? across->range.first : 0.0);
  }
  /// @throws NumericalError  where there is no such model
  std::shared_ptr<const Scene> scene(double first, double second) const;

 private:
  std::vector<double> values(double first, double second) const {
    return across ? std::vector{first, second} : std::vector{first};
  }
};

/// From --over, once or twice, and --at.
/// @throws ModelError  for values that do not fit
BranchParameters branch_parameters(const Invocation& call, const Model& model);

/// Attribute `fixed` of /branch: the value of the second parameter, as --set takes it, a line for
/// every path; none without a second parameter.
void write_fixed(ResultWriter& file, const BranchParameters& parameters);

}  // namespace whirl::inline cli
