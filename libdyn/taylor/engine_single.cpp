// One motion alone, as wide as a number.

#include <memory>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/pack_engines.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/engine_single.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/motion_bodies-inl.h"
#include "libdyn/taylor/variation_films-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

void run_single_here(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                     const Observer* observer) {
  std::make_unique<Engine<Pack<1, 1>>>(pattern, options)->run(all, observer);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(run_single_here);

void run_single(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                const Observer* observer) {
  HWY_DYNAMIC_DISPATCH(run_single_here)(pattern, options, all, observer);
}

}  // namespace whirl::inline dyn
#endif
