#include "libdyn/linear/critical_over.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/own_speed_branches.hpp"
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

/// Adds the branches that one shaft excites.
void add_branches(const ModelAt& model_at, const ShapeSampler& sampler,
                  const CriticalOptions& options, CriticalOver& to) {
  CriticalsAt known;
  const SolveShapes solve = [&](double value) {
    return lowest(model_at(value), sampler, options, known[value]);
  };
  const ShapeBranches followed = follow_shapes(to.values, solve, sampler.weight(),
                                               shape_limit(to.values, solve, options.count));
  for (const ShapeBranch& branch : followed.branches) {
    const std::vector<ToldAt> places = told_places(branch, to.values);
    if (!is_among_lowest(places, options.count)) continue;
    to.branches.push_back(branch_of(places, to.values, known));
    if (!options.by.empty()) to.branches.back().shaft = options.by;
  }
  if (options.by.empty()) to.gaps = gaps_of(followed);
}

/// Names of the further shafts whose excitation changes with the speed of the first one in another
/// way, at the first value or the last.
std::vector<std::string> other_exciting(const Structure& first, const Structure& last) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(first.rotors.size(), last.rotors.size()); ++i) {
    const auto excites = [](const Rotor& rotor) {
      if (rotor.has_own_speed()) return rotor.own.size() > 1;
      return rotor.ratio != 0.0 && std::abs(rotor.ratio) != 1.0;
    };
    if (excites(first.rotors[i]) || excites(last.rotors[i])) names.push_back(first.rotors[i].name);
  }
  return names;
}

}  // namespace

CriticalOver critical_over(const ModelAt& model_at, ParameterName parameter,
                           const std::vector<double>& values, const CriticalOptions& options) {
  CriticalOver result;
  result.parameter = std::move(parameter);
  result.values = values;
  const Structure first = linear_structure(model_at(values.front()));
  const ShapeSampler sampler{Assembler(first)};
  add_branches(model_at, sampler, options, result);
  if (options.order != 1.0 || first.rotors.empty()) return result;
  for (const std::string& name : other_exciting(first, model_at(values.back()).structure)) {
    CriticalOptions by = options;
    by.by = name;
    add_branches(model_at, sampler, by, result);
  }
  add_own_branches(model_at, sampler, options, result);
  return result;
}

}  // namespace whirl::inline dyn
