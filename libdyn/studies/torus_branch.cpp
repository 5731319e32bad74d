#include "libdyn/studies/torus_branch.hpp"

#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/studies/branch_walk.hpp"
#include "libdyn/studies/stopped_flow.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double section_tolerance = 1e-11;  ///< of steps: sections are averaged to many digits
constexpr double shortest = 1e-6;            ///< arc length of a step along the parameter

CirclePoint point_of(const BranchPoint& p, const Vec& scale, int period) {
  const InvariantCircle circle = circle_of(p.z.head(p.z.size() - 1), scale, period);
  const double growth = p.multipliers.size() > 0 ? std::log(p.multipliers(0).real())
                                                 : std::numeric_limits<double>::quiet_NaN();
  return {p.value, circle.rotation / period, growth / period, circle.tail};
}

/// States at phase 0 of every period of the map, a column each; none: it was stopped.
Mat sections_of(const Scene& scene, const MotionState& start, int period, long count,
                const std::function<bool()>& stops) {
  Trajectory motion{.system = &scene.contacts, .state = start, .revolutions = count * period};
  integrate_single(motion, {.tolerance = section_tolerance, .sections = true, .watch = [&](long) {
                              return !stops();
                            }});
  if (motion.outcome == Outcome::stopped_by_observer) return {};
  if (motion.outcome != Outcome::reached_end) throw NumericalError(motion.failure.text());
  const Eigen::Index n = scene.contacts.size();
  const Eigen::Map<const Mat> all(motion.sections.data(), n, std::ssize(motion.sections) / n);
  Mat sections(n, count);
  for (Eigen::Index i = 0; i < count; ++i) sections.col(i) = all.col((i + 1) * period - 1);
  return sections;
}

}  // namespace

std::vector<CirclePoint> TorusBranch::points() const {
  if (walks.empty()) return {};
  const std::vector<CirclePoint>& last = walks.back().points;
  if (walks.size() == 1) return last;
  const std::vector<CirclePoint>& other = walks.front().points;
  std::vector<CirclePoint> all(other.rbegin(), other.rend());
  all.insert(all.end(), last.begin() + 1, last.end());
  return all;
}

TorusBranch find_torus(const Scene& scene, const MotionState& start, const TorusOptions& options,
                       const std::function<bool()>& stops) {
  const int period = options.circle.period;
  const Flow flow = until(stops, flow_of(scene.contacts));
  require_loads_of_a_revolution(flow);
  const Mat sections = sections_of(scene, start, period, options.sections, stops);
  if (sections.size() == 0) return {};
  const auto guess = guessed_circle(sections, flow.scale, period, options.circle.harmonics);
  if (!guess) {
    throw NumericalError("the motion has settled on a periodic orbit: there is no circle");
  }
  TorusBranch torus{.circle = find_circle(flow, *guess, options.circle),
                    .motion_rotation = guess->rotation};
  if (!torus.circle.is_good() && stops()) return {};
  torus.is_complete = torus.circle.is_good() && !options.along;
  return torus;
}

namespace {

/// Begins the walks that are still to be begun, and goes on with all of them.
void follow(const BranchEquations& equations, const Vec& scale, TorusBranch& torus,
            const TorusOptions& options, const Monitor<TorusBranch>& monitor,
            const std::function<void()>& save_if_due) {
  const int period = options.circle.period;
  const std::vector<double> directions = options.along->directions();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    ContinuationOptions how = options.along->options(directions[i]);
    how.most_points = options.most_points;
    how.smallest_step = shortest;
    if (i == torus.walks.size()) {
      const Continuation begun(equations, circle_unknowns(torus.circle, scale), how);
      const BranchPoint& first = begun.branch().points[0];
      torus.walks.push_back({begun.branch(), {point_of(first, scale, period)}});
    }
    CircleWalk& walk = torus.walks[i];
    if (walk.branch.end) continue;
    Continuation on(equations, walk.branch, how);
    const bool has_ended = walk_to_end(
        on, walk.branch, monitor,
        [&](const BranchPoint& p) { walk.points.push_back(point_of(p, scale, period)); },
        [&] {
          monitor.show(std::ssize(walk.points), options.most_points);
          save_if_due();
        });
    if (!has_ended) return;
  }
  torus.is_complete = true;
}

}  // namespace

TorusBranch follow_torus(const FlowAt& flow_at, const Vec& scale, TorusBranch torus,
                         const TorusOptions& options, const Monitor<TorusBranch>& monitor) {
  if (torus.is_complete || !options.along) return torus;
  save_as_it_grows(torus, monitor, [&](const std::function<void()>& save_if_due) {
    follow(circle_equations(flow_at, scale, options.circle.period, torus.circle.coordinate), scale,
           torus, options, monitor, save_if_due);
  });
  return torus;
}

TorusBranch grow_torus(const ParameterScenes& scenes, TorusBranch torus,
                       const std::function<std::optional<MotionState>()>& settled,
                       const TorusOptions& options, const Monitor<TorusBranch>& monitor) {
  if (torus.circle.points.size() == 0) {
    const std::optional<MotionState> start = settled();
    if (!start) return torus;
    torus = find_torus(*scenes.first, *start, options, [&] { return monitor.stops(); });
    if (torus.circle.points.size() == 0 || !torus.circle.is_good()) return torus;
    if (monitor.save) monitor.save(torus);
  }
  const FlowAt flow_at = [&](double value) { return flow_of(scenes.at(value), *scenes.first); };
  return follow_torus(flow_at, scenes.first->contacts.state_scale(), torus, options, monitor);
}

}  // namespace whirl::inline dyn
