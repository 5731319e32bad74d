#include <algorithm>

#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/rk4.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/rk4-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

void run_rk4(const Pattern& pattern, const IntegrationOptions& options, std::span<Trajectory> all) {
  using P = Pack<8, 2>;
  const auto lanes = static_cast<size_t>(P::lanes());
  for (size_t begin = 0; begin < all.size(); begin += lanes) {
    const size_t count = std::min(lanes, all.size() - begin);
    Rk4Lanes<P>(pattern).run(all.subspan(begin, count), options);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(run_rk4);

void integrate_batch_rk4(std::span<Trajectory> trajectories, const IntegrationOptions& options) {
  const Pattern pattern = pattern_of(trajectories);
  HWY_DYNAMIC_DISPATCH(run_rk4)(pattern, options, trajectories);
}

}  // namespace whirl::inline dyn
#endif
