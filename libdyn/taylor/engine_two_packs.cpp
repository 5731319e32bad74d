// Many motions: two registers of them at once, which hides the time that an operation takes.

#include <memory>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/pack_engines.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/engine_two_packs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/motion_bodies-inl.h"
#include "libdyn/taylor/variation_films-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

void run_two_packs_here(const Pattern& pattern, const BatchOptions& options,
                        std::span<Trajectory> all, const Observer* observer) {
#if WHIRL_HAS_NO_LANES
  run_single(pattern, options, all, observer);
#else
  std::make_unique<Engine<Pack<8, 2>>>(pattern, options)->run(all, observer);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(run_two_packs_here);

void run_two_packs(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                   const Observer* observer) {
  HWY_DYNAMIC_DISPATCH(run_two_packs_here)(pattern, options, all, observer);
}

}  // namespace whirl::inline dyn
#endif
