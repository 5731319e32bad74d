#include "libdyn/studies/orbit_search.hpp"

#include <algorithm>
#include <optional>

#include "libdyn/motions/transient.hpp"
#include "libdyn/orbits/contact_flow.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/orbit_travel.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "libdyn/studies/stopped_flow.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double same_state = 1e-6;       ///< at phase 0, in scales
constexpr double start_tolerance = 1e-8;  ///< of a step, on the way to a start of Newton's method

/// Whether two orbits are one, begun at any revolution of their period.
bool is_same(const PeriodicOrbit& a, const PeriodicOrbit& b, const Vec& scale) {
  return std::any_of(b.states.begin(), b.states.end(), [&](const Vec& y) {
    return (y - a.states[0]).cwiseQuotient(scale).lpNorm<Eigen::Infinity>() < same_state;
  });
}

/// The orbit near where a motion gets, without its tangents; nothing: there is none, or it was
/// stopped.
std::optional<PeriodicOrbit> orbit_near(const Flow& flow, Trajectory t,
                                        const OrbitSearchOptions& options,
                                        const std::function<bool()>& stops) {
  t.revolutions += until_forces_repeat(*t.system, t.state.revolution + t.revolutions);
  if (t.revolutions > 0) {
    integrate_single(t, {.tolerance = start_tolerance, .watch = [&](long) { return !stops(); }});
  }
  if (t.outcome != Outcome::reached_end) return std::nullopt;
  PeriodicOrbit orbit = find_orbit(flow, t.state.y, {.period = options.period});
  if (!orbit.is_good()) return std::nullopt;
  orbit.tangents.clear();
  return orbit;
}

/// What every start leads to.
struct Starts {
  PointRows<std::optional<PeriodicOrbit>> points;
};

/// The orbits that the first starts lead to, up to one that is not done.
OrbitSearch gathered(const Starts& starts, const Vec& scale) {
  OrbitSearch search;
  std::vector<SearchedOrbit>& all = search.orbits;
  for (std::optional<std::optional<PeriodicOrbit>> point : starts.points) {
    if (!point) break;
    ++search.done;
    std::optional<PeriodicOrbit>& orbit = *point;
    if (!orbit) {
      ++search.failed;
      continue;
    }
    const auto known = std::find_if(all.begin(), all.end(), [&](const SearchedOrbit& s) {
      return is_same(*orbit, s.orbit, scale);
    });
    if (known != all.end()) {
      ++known->starts;
    } else {
      const int shortest = shortest_period(*orbit, scale);
      all.push_back({std::move(*orbit), shortest});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const SearchedOrbit& a, const SearchedOrbit& b) {
    return std::pair(a.orbit.is_stable(), a.starts) > std::pair(b.orbit.is_stable(), b.starts);
  });
  return search;
}

}  // namespace

double SearchedOrbit::impacts() const {
  double all = 0.0;
  for (const ContactMeasure& c : orbit.contacts) all += c.impacts;
  return all;
}

std::vector<ContactShare> SearchedOrbit::contact_shares() const {
  return whirl::contact_shares(orbit.contacts, orbit.period).contacts;
}

OrbitSearch search_orbits(const Scene& scene, const MotionState& around,
                          const OrbitSearchOptions& options, const Monitor<OrbitSearch>& monitor) {
  const auto stops = [&monitor] { return monitor.stops(); };
  const Flow flow = until(stops, flow_of(scene.contacts));
  Starts starts;
  starts.points.resize(static_cast<std::size_t>(options.starts));
  PointWork<std::optional<PeriodicOrbit>> work{.most_together = 1, .threads = options.threads};
  work.compute = [&](const auto& piece, NothingGiven&) {
    const Trajectory begun{.system = &scene.contacts,
                           .state = random_start(scene.contacts, around, options.size, options.seed,
                                                 std::uint64_t{piece[0]}),
                           .revolutions = options.discard};
    return std::vector{orbit_near(flow, begun, options, stops)};
  };
  run_points(work, starts, monitor.of<Starts>());
  OrbitSearch search = gathered(starts, flow.scale);
  for (SearchedOrbit& s : search.orbits) {
    s.probes = probes_along(scene, s.orbit.states[0], options.period);
  }
  return search;
}

}  // namespace whirl::inline dyn
