#include "libio/model/branch_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libio/model/model_file.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

/// Where branches begin, from the part of --at of a parameter.
/// @throws ModelError  if that is not within the range
double value_at(const BranchParameter& p, const std::string& at) {
  const std::string line = p.axis.path + "=" + at;
  const auto same = parse_axis(line + p.axis.shown_unit, 0);
  const auto own = parse_axis(line, 0);  // with a unit of its own
  const auto& found = own && !own->unit.empty() ? own : same;
  if (!found || found->values.size() != 1 || found->unit != p.axis.unit) {
    throw wrong_option("at", at, "expected a value such as those of --over");
  }
  const double first = found->values[0];
  if (first < p.range.low || first > p.range.high) {
    throw wrong_option("at", at, "expected a value within --over");
  }
  return first;
}

/// A parameter from its --over and its part of --at, which may be empty.
BranchParameter parameter_of(const std::string& over, const std::string& at, int points) {
  const auto axis = parse_axis(over, points);
  if (!axis) throw wrong_option("over", over, axis.problem);
  if (axis->path.starts_with("force.") && axis->path.ends_with(".order")) {
    throw wrong_option("over", over,
                       "between whole orders motions repeat after other times, or never: there is "
                       "no branch along them; see whirl sweep and map");
  }
  BranchParameter p{.axis = *axis, .range = {}};
  ParameterRange& range = p.range;
  const auto& values = axis->values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  range.low = *low;
  range.high = *high;
  range.unit = axis->unit;
  range.first = values.front();
  if (!(range.low < range.high)) {
    throw wrong_option("over", over, "expected two values that differ");
  }
  range.direction = values.back() >= values.front() ? 1.0 : -1.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    range.largest_step = std::max(range.largest_step, std::abs(values[i] - values[i - 1]));
  }
  if (at.empty()) return p;
  range.first = value_at(p, at);
  range.goes_both = range.first > range.low && range.first < range.high;
  if (range.first == range.high) range.direction = -1.0;
  if (range.first == range.low) range.direction = 1.0;
  return p;
}

}  // namespace

std::shared_ptr<const Scene> BranchParameters::scene(double first, double second) const {
  try {
    return family->scene(values(first, second));
  } catch (const ModelError& error) {  // no model there: the branch ends
    throw NumericalError(error.what());
  }
}

std::string BranchParameters::fixed() const {
  if (!across) return "";
  return fmt::format("{}", fmt::join(across->axis.assignments_of(across->range.first), "\n"));
}

BranchParameters branch_parameters(const Model& model, const std::vector<std::string>& over,
                                   std::string at, int points) {
  if (over.empty() || over.size() > 2) {
    throw ModelError(
        {"--over"}, "",
        fmt::format("found {} of them, expected one, or two for bifurcation curves: --over "
                    "PATH=first:last:step, such as --over contact.ring.friction=0:0.15:0.002",
                    over.size()));
  }
  std::string second_at;
  if (const auto comma = at.find(','); comma != std::string::npos) {
    if (over.size() == 1) {
      throw wrong_option("at", at, "expected one value for one --over");
    }
    second_at = at.substr(comma + 1);
    at.resize(comma);
  }
  BranchParameters p{.along = parameter_of(over[0], at, points)};
  std::vector<ParameterAxis> axes{p.along.axis};
  if (over.size() == 2) {
    p.across = parameter_of(over[1], second_at, points);
    axes.push_back(p.across->axis);
  }
  p.family = std::make_shared<const ModelFamily>(model, std::move(axes));
  const ParameterRange& along = p.along.range;
  for (const double first : {along.low, along.high, along.first}) {
    require_speed(p.model(first));
    if (!p.across) continue;
    for (const double second : {p.across->range.low, p.across->range.high}) {
      require_speed(p.model(first, second));
    }
  }
  return p;
}

}  // namespace whirl::inline io
