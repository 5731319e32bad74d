#include "libdyn/studies/critical_over.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "libbase/constants.hpp"
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

/// A branch at the values where it was found; none if it is never among the lowest ones.
std::optional<CriticalOverBranch> branch_of(const ShapeBranch& followed,
                                            const std::vector<double>& values,
                                            const CriticalsAt& known, int count) {
  const Vec gaps = Vec::Constant(std::ssize(values), nan);
  CriticalOverBranch branch{.speed = gaps, .damped_speed = gaps, .damping_ratio = gaps};
  std::map<Whirl, int> senses;
  bool is_among = false;
  for (std::size_t i = 0; i < followed.at.size(); ++i) {
    const auto value = std::lower_bound(values.begin(), values.end(), followed.at[i]);
    if (value == values.end() || *value != followed.at[i]) continue;  // one between them
    const int number = followed.found[i].number;
    const Critical& critical = known.at(*value).at(static_cast<std::size_t>(number));
    const auto k = value - values.begin();
    branch.speed(k) = critical.speed;
    branch.damped_speed(k) = critical.damped_speed;
    branch.damping_ratio(k) = critical.damping_ratio;
    ++senses[critical.whirl];
    is_among = is_among || number < count;
  }
  if (!is_among) return {};
  branch.whirl = std::max_element(senses.begin(), senses.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
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
    if (auto wanted = branch_of(branch, values, known, options.count)) {
      result.branches.push_back(std::move(*wanted));
    }
  }
  result.gaps = gaps_of(followed);
  return result;
}

}  // namespace whirl::inline dyn
