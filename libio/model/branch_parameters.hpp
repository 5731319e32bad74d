#pragma once
/// What branches are followed over, as a command line says it: --over, once or twice, and --at.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libdyn/studies/parameter_range.hpp"
#include "libio/model/model_family.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl::inline io {

/// A parameter of branches and its range.
struct BranchParameter {
  ParameterAxis axis;
  ParameterRange range;
};

/// The parameter of the branch, the second one of bifurcation curves, if any, and the model at
/// their values.
struct BranchParameters {
  BranchParameter along;
  std::optional<BranchParameter> across{};
  std::shared_ptr<const ModelFamily> family{};

  /// The model at a value of the first parameter and the first value of the second one.
  Model model(double first) const { return model(first, across ? across->range.first : 0.0); }
  Model model(double first, double second) const { return family->model(values(first, second)); }
  std::shared_ptr<const Scene> scene(double first) const {
    return scene(first, across ? across->range.first : 0.0);
  }
  /// @throws NumericalError  where there is no such model
  std::shared_ptr<const Scene> scene(double first, double second) const;
  /// The first value of the second parameter, as --set takes it, a line for every path; empty:
  /// there is no second parameter.
  std::string fixed() const;

 private:
  std::vector<double> values(double first, double second) const {
    return across ? std::vector{first, second} : std::vector{first};
  }
};

/// @param over    what --over says, once or twice
/// @param at      what --at says, with a comma for both; empty: the first values
/// @param points  of a range without a step
/// @throws ModelError  for values that do not fit, and for models without an operating speed
BranchParameters branch_parameters(const Model& model, const std::vector<std::string>& over,
                                   std::string at, int points);

}  // namespace whirl::inline io
