#include "libdyn/studies/branch_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/branches/bifurcation.hpp"
#include "libdyn/branches/harmonic_branch.hpp"
#include "libdyn/branches/range_slopes.hpp"
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

  /// Null: there are no exact derivatives.
  EndSlopeAt end_slope() const {
    if (!scenes_.slopes) return {};
    return [this](double value, const Vec& start, double revolutions) {
      MotionState at;
      at.y = start;
      return scenes_.slopes->end_slope(value, at, revolutions);
    };
  }
  EndSlopeAt rotating_end_slope() const {
    if (!scenes_.slopes) return {};
    return [this](double value, const Vec& start, double revolutions) {
      return scenes_.slopes->end_slope(value, rotating_start(*scenes_.first, start, revolutions),
                                       revolutions);
    };
  }
  HarmonicSlopeAt harmonic_slope_at() const {
    if (!scenes_.slopes) return {};
    return [this](double value) { return scenes_.slopes->problem_slope(value); };
  }

  BranchEquations of(const BranchLayout& layout) const {
    if (options_.method == OrbitMethod::harmonic_balance) {
      return harmonic_equations([this](double value) { return problem_at(value); }, options_.period,
                                layout.harmonics, length_scale(), harmonic_slope_at());
    }
    return layout.is_rotating
               ? autonomous_equations(autonomous_flow_at(), layout.scale, rotating_end_slope())
               : shooting_equations(flow_at(), layout.scale, end_slope());
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
    throw ModelError({}, "",
                     "harmonic balance: without contacts or films there is one motion for each "
                     "value, which is the linear response to unbalance");
  }

  /// Adds what the orbit of a point does, and its state at phase 0.
  /// @param period  of the branch [revolutions]
  /// @param to      with measures and starts
  void measure(const BranchLayout& layout, int period, const BranchPoint& point, auto& to) const {
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
      found = measure_orbit(*at, options_.stations, change.to(start), layout.period(period, point),
                            options_.frame);
    }
    if (layout.is_rotating) found.sections.resize(found.sections.rows(), 0);
    to.measures.push_back(std::move(found));
    to.starts.push_back(std::move(start));
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

/// The number of the first branch that would be walked again from where another one ends, among
/// those that come behind it; nothing: there is none.
std::optional<std::size_t> same_branch(const std::vector<TracedBranch>& branches,
                                       std::size_t number, double range) {
  const Branch& done = branches[number].branch;
  const double u = done.points.back().value;
  for (std::size_t i = number + 1; i < branches.size(); ++i) {
    const TracedBranch& b = branches[i];
    if (b.parent == branches[number].parent && b.branch.period == done.period &&
        std::abs(b.branch.points[0].value - u) < same_place * range) {
      return i;
    }
  }
  return std::nullopt;
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
    equations.measure(tree.layout, next->period, next->start, branch);
    tree.branches.push_back(std::move(branch));
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
        : is_rotating ? autonomous_continuation(equations.autonomous_flow_at(), start, period, how,
                                                equations.rotating_end_slope())
                      : orbit_continuation(equations.flow_at(), start, how, equations.end_slope());
    tree.branches.push_back({.branch = walk.branch(), .direction = direction});
    equations.measure(tree.layout, options.period, walk.branch().points[0], tree.branches.back());
  }
  return tree;
}

WalkNews walk_branch(const ParameterScenes& scenes, const BranchTreeOptions& options,
                     BegunWalk begun, const StretchLimits& limits) {
  const TreeEquations equations(scenes, options);
  BranchLayout layout = empty_tree(*scenes.first, options).layout;
  layout.harmonics = begun.harmonics;
  const int period = begun.branch.period;
  return walk_stretch({equations.of(layout), std::move(begun.branch),
                       walk_options(options, begun.direction), std::move(begun.by_parameter)},
                      limits, [&](const BranchPoint& point, WalkNews& news) {
                        equations.measure(layout, period, point, news);
                      });
}

TreeGrowth::TreeGrowth(const ParameterScenes& scenes, const BranchTreeOptions& options,
                       BranchTree& tree)
    : scenes_(scenes), options_(options), tree_(tree) {
  number_walks();
  while (has_ended(settled_)) ++settled_;
}

void TreeGrowth::number_walks() {
  while (walks_.size() < tree_.branches.size()) walks_.push_back({.number = numbers_++});
}

bool TreeGrowth::has_ended(std::size_t branch) const {
  return branch < tree_.branches.size() && tree_.branches[branch].branch.end;
}

std::optional<TreeGrowth::OpenWalk> TreeGrowth::next() {
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    if (walks_[i].is_away || has_ended(i)) continue;
    walks_[i].is_away = true;
    const TracedBranch& traced = tree_.branches[i];
    return OpenWalk{walks_[i].number,
                    {.branch = traced.branch,
                     .direction = traced.direction,
                     .harmonics = tree_.layout.harmonics,
                     .by_parameter = walks_[i].by_parameter}};
  }
  return std::nullopt;
}

void TreeGrowth::keep(std::size_t number, WalkNews news) {
  const auto walk =
      std::find_if(walks_.begin(), walks_.end(), [&](const Walk& w) { return w.number == number; });
  if (walk == walks_.end()) return;  // of a branch that was dropped meanwhile
  walk->is_away = false;
  walk->by_parameter = std::move(news.by_parameter);
  TracedBranch& traced = tree_.branches[static_cast<std::size_t>(walk - walks_.begin())];
  add_news(traced.branch, news.branch, {});
  std::move(news.measures.begin(), news.measures.end(), std::back_inserter(traced.measures));
  std::move(news.starts.begin(), news.starts.end(), std::back_inserter(traced.starts));
  while (has_ended(settled_)) branch_out(settled_++);
}

void TreeGrowth::branch_out(std::size_t number) {
  const auto drop = [this](std::size_t other) {
    tree_.branches.erase(tree_.branches.begin() + static_cast<std::ptrdiff_t>(other));
    walks_.erase(walks_.begin() + static_cast<std::ptrdiff_t>(other));
  };
  const Branch& done = tree_.branches[number].branch;
  const bool closes = done.ends_as(EndKind::closed);
  if (done.ends_as(EndKind::period_halved)) {
    const double range = options_.along.high - options_.along.low;
    if (const auto same = same_branch(tree_.branches, number, range)) drop(*same);
  }
  if (number == 0 && closes && tree_.branches.size() > 1) drop(1);
  if (tree_.branches[number].generation < options_.generations) {
    add_switched(tree_, number, TreeEquations(scenes_, options_));
    number_walks();
  }
}

}  // namespace whirl::inline dyn
