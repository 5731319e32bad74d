#include "libdyn/studies/branch_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/error.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/branches/harmonic_branch.hpp"
#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/contact_harmonics.hpp"
#include "libdyn/studies/branch_walk.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double same_place = 1e-5;  ///< of the range, where branches meet

/// The equations that all branches of a tree solve, and what their points are measured by.
class TreeEquations {
 public:
  TreeEquations(const ParameterScenes& scenes, const BranchTreeOptions& options)
      : scenes_(scenes), options_(options) {}

  FlowAt flow_at() const {
    return [this](double value) { return flow_of(scenes_.at(value), *scenes_.first); };
  }
  AutonomousFlowAt autonomous_flow_at() const {
    return [this](double value) { return rotating_flow(scenes_.at(value), *scenes_.first); };
  }

  BranchEquations of(const BranchLayout& layout) const {
    if (options_.method == OrbitMethod::harmonic_balance) {
      return harmonic_equations([this](double value) { return problem_at(value); }, options_.period,
                                layout.harmonics, length_scale());
    }
    return layout.is_rotating ? autonomous_equations(autonomous_flow_at(), layout.scale)
                              : shooting_equations(flow_at(), layout.scale);
  }

  /// The orbit of harmonic balance near a start.
  HarmonicOrbit series_near(const Vec& start) const {
    const ContactOrbit found =
        find_harmonic_orbit(scenes_.first->contacts, start,
                            {.period = options_.period, .harmonics = options_.harmonics});
    if (found.orbit.is_good()) return found.orbit;
    throw NumericalError(fmt::format("at the first value, {:g}: {}", options_.along.first,
                                     found.orbit.failure.text()));
  }
  /// Its unknowns.
  Vec unknowns_of(const HarmonicOrbit& orbit) const {
    const Vec unknowns = harmonic_unknowns(orbit, length_scale());
    if (unknowns.size() > 0) return unknowns;
    throw NumericalError(
        "harmonic balance: without contacts or films there is one motion for each value, which "
        "whirl unbalance has");
  }

  /// Adds what the orbit of a point does, and its state at phase 0.
  void measure(const BranchLayout& layout, TracedBranch& branch, const BranchPoint& point) const {
    const auto at = scenes_.at(point.value);
    const BasisChange change(*at, *scenes_.first);
    OrbitMeasure found;
    Vec start;
    if (options_.method == OrbitMethod::harmonic_balance) {
      const HarmonicOrbit orbit =
          orbit_of_unknowns(harmonic_problem(at->contacts), point.z.head(point.z.size() - 1),
                            options_.period, length_scale());
      found = measure_orbit(*at, options_.stations, orbit.motion);
      start = change.back(orbit.state());
    } else {
      // the state in the basis of this value; in most cases the first one's
      start = point.state(layout.scale);
      found = measure_orbit(*at, options_.stations, change.to(start),
                            layout.period(branch.branch, point));
    }
    if (layout.is_rotating) found.sections.resize(found.sections.rows(), 0);
    branch.measures.push_back(std::move(found));
    branch.starts.push_back(std::move(start));
  }

 private:
  struct Problem {
    std::shared_ptr<const Scene> scene;
    HarmonicProblem equations;
  };
  std::shared_ptr<const HarmonicProblem> problem_at(double value) const {
    const auto at = scenes_.at(value);
    const auto both = std::make_shared<const Problem>(Problem{at, harmonic_problem(at->contacts)});
    return {both, &both->equations};
  }
  double length_scale() const { return scenes_.first->contacts.length_scale(); }

  const ParameterScenes& scenes_;
  const BranchTreeOptions& options_;
};

ContinuationOptions walk_options(const BranchTreeOptions& options, double direction) {
  ContinuationOptions how = options.along.options(direction);
  how.period = options.period;
  how.most_points = options.most_points;
  return how;
}

/// A branch that ends on another one would be walked again from there.
void drop_same(std::vector<TracedBranch>& branches, std::size_t number, double range) {
  const Branch& done = branches[number].branch;
  const double u = done.points.back().value;
  for (std::size_t i = number + 1; i < branches.size(); ++i) {
    const TracedBranch& b = branches[i];
    if (b.parent == branches[number].parent && b.branch.period == done.period &&
        b.branch.points.size() == 1 &&
        std::abs(b.branch.points[0].value - u) < same_place * range) {
      branches.erase(branches.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }
}

/// Adds the branches that begin on one of a tree.
void add_switched(BranchTree& tree, std::size_t number, const TreeEquations& equations) {
  const TracedBranch from = tree.branches[number];
  for (const Bifurcation& b : from.branch.bifurcations) {
    const auto next = switch_branch(equations.flow_at(), tree.layout.scale, from.branch.period, b);
    if (!next) continue;
    TracedBranch branch{.branch = {.period = next->period, .points = {next->start}},
                        .parent = static_cast<int>(number) + 1,
                        .generation = from.generation + 1};
    equations.measure(tree.layout, branch, next->start);
    tree.branches.push_back(std::move(branch));
  }
}

/// What the end of a branch means for the others.
void branch_out(BranchTree& tree, std::size_t number, const TreeEquations& equations,
                const BranchTreeOptions& options) {
  const Branch& done = tree.branches[number].branch;
  if (done.ends_as(EndKind::period_halved)) {
    drop_same(tree.branches, number, options.along.high - options.along.low);
  }
  if (number == 0 && done.ends_as(EndKind::closed) && tree.branches.size() > 1) {
    tree.branches.erase(tree.branches.begin() + 1);
  }
  if (tree.branches[number].generation < options.generations) {
    add_switched(tree, number, equations);
  }
}

}  // namespace

bool BranchTree::is_complete() const {
  return !branches.empty() && std::all_of(branches.begin(), branches.end(),
                                          [](const auto& b) { return b.branch.end.has_value(); });
}

long BranchTree::points() const {
  long count = 0;
  for (const TracedBranch& b : branches) count += std::ssize(b.branch.points);
  return count;
}

BranchTree empty_tree(const Scene& first, const BranchTreeOptions& options) {
  BranchTree tree{.layout = {.states = first.contacts.size(),
                             .scale = first.contacts.state_scale(),
                             .is_rotating = options.frame == OrbitFrame::rotating,
                             .probes = ProbeLabels(probes_of(first))}};
  tree.layout.contacts.resize(static_cast<std::size_t>(first.contacts.owners()));
  for (const ReducedContact& c : first.contacts.contacts()) {
    tree.layout.contacts[static_cast<std::size_t>(c.owner)] = c.name;
  }
  return tree;
}

BranchTree begin_tree(const ParameterScenes& scenes, const Vec& start,
                      const BranchTreeOptions& options) {
  const Scene& first = *scenes.first;
  const TreeEquations equations(scenes, options);
  BranchTree tree = empty_tree(first, options);
  std::optional<Vec> unknowns;
  if (options.method == OrbitMethod::harmonic_balance) {
    const HarmonicOrbit orbit = equations.series_near(start);
    unknowns = equations.unknowns_of(orbit);
    tree.layout.harmonics = orbit.harmonics();
  }
  const bool is_rotating = tree.layout.is_rotating;
  const double period = is_rotating ? guessed_period(first, start) / first.contacts.period() : 0.0;
  for (const double direction : options.along.directions()) {
    const ContinuationOptions how = walk_options(options, direction);
    const Continuation walk =
        unknowns      ? Continuation(equations.of(tree.layout), *unknowns, how)
        : is_rotating ? autonomous_continuation(equations.autonomous_flow_at(), start, period, how)
                      : orbit_continuation(equations.flow_at(), start, how);
    tree.branches.push_back({.branch = walk.branch(), .direction = direction});
    equations.measure(tree.layout, tree.branches.back(), walk.branch().points[0]);
  }
  return tree;
}

BranchTree grow_tree(const ParameterScenes& scenes, BranchTree tree,
                     const BranchTreeOptions& options, const Monitor<BranchTree>& monitor) {
  const TreeEquations equations(scenes, options);
  long added = 0;
  save_as_it_grows(tree, monitor, [&](const std::function<void()>& save_if_due) {
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
      TracedBranch& traced = tree.branches[i];
      if (traced.branch.end) continue;
      Continuation walk(equations.of(tree.layout), traced.branch,
                        walk_options(options, traced.direction));
      const bool has_ended = walk_to_end(
          walk, traced.branch, monitor,
          [&](const BranchPoint& point) { equations.measure(tree.layout, traced, point); },
          [&] {
            monitor.show(++added, options.most_points);
            // a branch that has ended is not saved before those that begin on it
            if (!traced.branch.end) save_if_due();
          });
      if (!has_ended) return;
      branch_out(tree, i, equations, options);
      save_if_due();
    }
  });
  return tree;
}

}  // namespace whirl::inline dyn
