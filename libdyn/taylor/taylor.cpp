#include "libdyn/taylor/taylor.hpp"

#include <utility>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

Integration Taylor::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                              const IntegrationOptions& options, const Observer& observer) const {
  Trajectory trajectory{.system = &system, .state = std::move(state), .revolutions = revolutions};
  integrate_single(
      trajectory,
      {.tolerance = options.tolerance, .fixed_step = options.fixed_step, .order = order}, observer);
  state = std::move(trajectory.state);
  return {trajectory.outcome, trajectory.cost, std::move(trajectory.failure)};
}

}  // namespace whirl::inline dyn
