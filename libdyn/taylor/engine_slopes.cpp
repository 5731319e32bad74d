// One motion with its slopes, which lie side by side in a register.

#include <memory>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/slope_run.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/engine_slopes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/sloped-inl.h"
// after the number that they are for
#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/motion_bodies-inl.h"
#include "libdyn/taylor/slope_carrier-inl.h"
#include "libdyn/taylor/variation_films-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

void run_slopes_here(const Pattern& pattern, const BatchOptions& options, Trajectory& trajectory,
                     SlopeRun& run) {
  BatchOptions how = options;
  how.tangent = run.deviations.size() > 0;
  const auto engine = std::make_unique<Engine<Sloped>>(pattern, how);
  engine->carry_slopes(run);
  engine->run({&trajectory, 1}, nullptr);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(run_slopes_here);

void run_slopes(const Pattern& pattern, const BatchOptions& options, Trajectory& trajectory,
                SlopeRun& run) {
  HWY_DYNAMIC_DISPATCH(run_slopes_here)(pattern, options, trajectory, run);
}

}  // namespace whirl::inline dyn
#endif
