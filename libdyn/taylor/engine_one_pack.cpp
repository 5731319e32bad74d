// Many motions with tangents: one register of them at once, as two of them do not fit the caches.

#include <memory>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/pack_engines.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/engine_one_pack.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/motion_bodies-inl.h"
#include "libdyn/taylor/variation_films-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

void run_one_pack_here(const Pattern& pattern, const BatchOptions& options,
                       std::span<Trajectory> all, const Observer* observer) {
#if WHIRL_HAS_NO_LANES
  run_single(pattern, options, all, observer);
#else
  std::make_unique<Engine<Pack<8, 1>>>(pattern, options)->run(all, observer);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(run_one_pack_here);

void run_one_pack(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
                  const Observer* observer) {
  HWY_DYNAMIC_DISPATCH(run_one_pack_here)(pattern, options, all, observer);
}

}  // namespace whirl::inline dyn
#endif
