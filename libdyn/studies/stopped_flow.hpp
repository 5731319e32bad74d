#pragma once
/// Flows that can be stopped, for searches for orbits, which know nothing but a flow.

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "libdyn/orbits/autonomous_orbit.hpp"
#include "libdyn/orbits/shooting.hpp"

namespace whirl::inline dyn {

/// A flow that fails once it is asked to stop.
inline Flow until(std::function<bool()> stops, Flow flow) {
  flow.go = [stops = std::move(stops), go = std::move(flow.go)](
                std::span<const Vec> starts, long revolutions, WithTangent wanted) {
    if (!stops()) return go(starts, revolutions, wanted);
    return std::vector<FlowResult>(starts.size(), FlowResult{{}, {}, {}, "stopped"});
  };
  return flow;
}

/// The same of an autonomous flow.
inline AutonomousFlow until(std::function<bool()> stops, AutonomousFlow flow) {
  flow.go = [stops = std::move(stops), go = std::move(flow.go)](const Vec& y, double time,
                                                                WithTangent wanted) {
    if (!stops()) return go(y, time, wanted);
    return AutonomousFlow::Result{{}, {}, {}, "stopped"};
  };
  return flow;
}

}  // namespace whirl::inline dyn
