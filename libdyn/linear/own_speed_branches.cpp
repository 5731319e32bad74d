#include "libdyn/linear/own_speed_branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libfe/analyses/excited_modes.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int lead_steps = 24;  ///< of the first shaft's speed
constexpr int own_steps = 12;   ///< of the further one's, before places between are looked for
constexpr double lowest_share = 1e-3;  ///< of the highest own speed, where the search begins

/// The plane of both speeds on one side, where the further shaft turns in one sense.
class OwnPlane {
 public:
  OwnPlane(const ModelAt& model_at, std::size_t rotor, double sense)
      : model_at_(model_at), rotor_(rotor), sense_(sense) {}

  /// @param own   size of the further shaft's speed [rad/s]
  Structure structure(double own) const {
    if (!base_ || follows_equilibrium_) {
      const Model model = model_at_(sense_ * own);
      follows_equilibrium_ = has_working_point(model);
      base_ = linear_structure(model);
    }
    Structure s = *base_;
    s.rotors[rotor_].lead = {0.0};
    s.rotors[rotor_].own = {sense_ * own};
    return s;
  }

  std::vector<ExcitedPlace> places(double lead, double low, double high, int count) const {
    ExcitedModes modes([&](double own) { return ExcitedRotor{structure(own), lead, own}; }, count);
    std::vector<double> grid;
    for (int i = 0; i <= own_steps; ++i) grid.push_back(low + (high - low) * i / own_steps);
    return modes.places(grid);
  }

 private:
  const ModelAt& model_at_;
  std::size_t rotor_;
  double sense_;
  mutable std::optional<Structure> base_;
  mutable bool follows_equilibrium_ = false;
};

double highest_speed(const CriticalOver& found) {
  double highest = 0.0;
  for (const CriticalOverBranch& branch : found.branches) {
    for (const double speed : branch.speed) {
      if (std::isfinite(speed)) highest = std::max(highest, speed);
    }
  }
  return highest;
}

/// Adds the branches of one sense of the further shaft.
void add_side(const OwnPlane& plane, double sense, const ShapeSampler& sampler, int count,
              CriticalOver& to) {
  double high = 0.0, low = INFINITY;
  for (const double value : to.values) {
    if (sense * value <= 0.0) continue;
    high = std::max(high, std::abs(value));
    low = std::min(low, std::abs(value));
  }
  if (high == 0.0) return;
  if (to.values.front() * to.values.back() <= 0.0) low = lowest_share * high;
  if (low == high) return;
  std::map<double, std::vector<Whirl>> senses;
  const SolveShapes solve = [&](double lead) {
    std::vector<ShapedValue> found;
    senses[lead].clear();
    for (const ExcitedPlace& place : plane.places(lead, low, high, count)) {
      const Assembler assembler(plane.structure(place.s));
      const CVec shape =
          sampler.at_points(assembler, assembler.at(lead, place.s).dofs, place.critical.shape);
      senses[lead].push_back(place.critical.whirl);
      found.push_back({.value = place.s, .shape = shape, .number = static_cast<int>(found.size())});
    }
    return found;
  };
  const ShapeBranches followed = follow_shapes(to.lead_speeds, solve, sampler.weight(), high);
  for (const ShapeBranch& branch : followed.branches) {
    OwnSpeedBranch own{.speed = Vec::Constant(std::ssize(to.lead_speeds), nan)};
    std::vector<Whirl> seen;
    for (const ToldAt& at : told_places(branch, to.lead_speeds)) {
      own.speed(at.index) = sense * at.found.value;
      seen.push_back(senses.at(to.lead_speeds[static_cast<std::size_t>(at.index)])
                         .at(static_cast<std::size_t>(at.found.number)));
    }
    own.whirl = most_frequent(seen);
    if (!seen.empty()) to.own_branches.push_back(std::move(own));
  }
}

}  // namespace

std::optional<std::size_t> rotor_of_speed(const Structure& structure, const std::string& path) {
  for (std::size_t i = 0; i < structure.rotors.size(); ++i) {
    if (path == fmt::format("rotor.{}.speed", structure.rotors[i].name) ||
        path == fmt::format("rotor.{}.speed", i + 1)) {
      return i;
    }
  }
  return {};
}

void add_own_branches(const ModelAt& model_at, const ShapeSampler& sampler,
                      const CriticalOptions& options, CriticalOver& to) {
  const Structure structure = model_at(to.values.back()).structure;
  const auto rotor = rotor_of_speed(structure, to.parameter.path);
  const double top = highest_speed(to);
  if (!rotor || !(top > 0.0)) return;
  to.shaft = structure.rotors[*rotor].name;
  for (int i = 0; i <= lead_steps; ++i) to.lead_speeds.push_back(top * i / lead_steps);
  for (const double sense : {1.0, -1.0}) {
    add_side(OwnPlane(model_at, *rotor, sense), sense, sampler, options.count, to);
  }
}

}  // namespace whirl::inline dyn
