#pragma once
/// What a continuation runs over, and the borders in the plane of two parameters.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/invocation.hpp"
#include "apps/verbs/branches.hpp"
#include "libdyn/branches/border.hpp"
#include "libio/model/model_family.hpp"
#include "libio/text/parameter_axis.hpp"

namespace whirl {

/// A parameter of a branch and its range.
struct BranchParameter {
  ParameterAxis axis;
  double low = 0.0, high = 0.0, first = 0.0, largest_step = 0.0;
  double direction = 1.0;  ///< towards the last value
  bool goes_both = false;  ///< the start is within the range

  ContinuationOptions options() const {
    return {.low = low,
            .high = high,
            .first = first,
            .direction = direction,
            .largest_step = largest_step};
  }
};

/// The parameter of the branch, the second one of borders, if any, and the model at their values.
struct BranchParameters {
  BranchParameter along;
  std::optional<BranchParameter> across;
  std::shared_ptr<const ModelFamily> family{};

  /// At the first value of the second parameter.
  Model model(double first) const { return model(first, across ? across->first : 0.0); }
  Model model(double first, double second) const { return family->model(values(first, second)); }
  std::shared_ptr<const Scene> scene(double first) const {
    return scene(first, across ? across->first : 0.0);
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

/// Curves of all bifurcations of branches; none without a second parameter.
class Borders {
 public:
  Borders(const BranchParameters& parameters, std::shared_ptr<const Scene> first,
          const BranchLayout& layout, int most_points);

  /// Walks along all of them until they end; false: interrupted.
  /// @param added  called after each point
  bool walk(const std::vector<TracedBranch>& branches,
            const std::function<void(std::size_t points)>& added);

  void write(ResultWriter& file) const;
  void read(const ResultReader& file);
  Record record() const;
  std::string text() const;

 private:
  void begin(const std::vector<TracedBranch>& branches);
  BranchEquations equations(const TracedBranch& border) const;
  ContinuationOptions options(const TracedBranch& border) const;
  BorderAxes axes() const;

  const BranchParameters& parameters_;
  std::shared_ptr<const Scene> first_;
  const BranchLayout& layout_;
  int most_points_;
  std::vector<TracedBranch> borders_;
};

}  // namespace whirl
