#include "libdyn/linear/critical_over.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/film_equilibrium.hpp"

namespace whirl::inline dyn {

namespace {

using CriticalsAt = std::map<double, std::vector<Critical>>;

/// @param known  receives what is found
std::vector<ShapedValue> lowest(const Model& model, const ShapeSampler& sampler,
                                CriticalOptions options, std::vector<Critical>& known) {
  const Assembler assembler(linear_structure(model));
  options.count += spare_solutions;
  options.start = has_linear_films(model) ? model.speed : 0.0;
  known = critical_speeds(assembler, options);
  std::erase_if(known, [](const Critical& c) { return !std::isfinite(c.speed); });
  std::vector<ShapedValue> found;
  for (const Critical& c : known) {
    const DofMap dofs = assembler.at(c.speed).dofs;
    found.push_back({.value = c.speed,
                     .shape = sampler.at_points(assembler, dofs, c.shape),
                     .number = static_cast<int>(found.size())});
  }
  return found;
}

CriticalOverBranch branch_of(const std::vector<ToldAt>& places, const std::vector<double>& values,
                             const CriticalsAt& known) {
  const Vec gaps = Vec::Constant(std::ssize(values), nan);
  CriticalOverBranch branch{.speed = gaps, .damped_speed = gaps, .damping_ratio = gaps};
  std::vector<Whirl> seen;
  for (const ToldAt& at : places) {
    const Critical& critical = known.at(values[static_cast<std::size_t>(at.index)])
                                   .at(static_cast<std::size_t>(at.found.number));
    branch.speed(at.index) = critical.speed;
    branch.damped_speed(at.index) = critical.damped_speed;
    branch.damping_ratio(at.index) = critical.damping_ratio;
    seen.push_back(critical.whirl);
  }
  branch.whirl = most_frequent(seen);
  return branch;
}

}  // namespace

CriticalOver critical_over(const ModelAt& model_at, ParameterName parameter,
                           const std::vector<double>& values, const CriticalOptions& options) {
  CriticalOver result;
  result.parameter = std::move(parameter);
  result.values = values;
  const ShapeSampler sampler(Assembler(linear_structure(model_at(values.front()))));
  CriticalsAt known;
  const SolveShapes solve = [&](double value) {
    return lowest(model_at(value), sampler, options, known[value]);
  };
  const ShapeBranches followed =
      follow_shapes(values, solve, sampler.weight(), shape_limit(values, solve, options.count));
  for (const ShapeBranch& branch : followed.branches) {
    const std::vector<ToldAt> places = told_places(branch, values);
    if (!is_among_lowest(places, options.count)) continue;
    result.branches.push_back(branch_of(places, values, known));
  }
  result.gaps = gaps_of(followed);
  return result;
}

}  // namespace whirl::inline dyn
