#include "libdyn/taylor/batch.hpp"

#include <algorithm>
#include <thread>

#include "libbase/processors.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/pack_engines.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

const char* name_of_target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(name_of_target);

int order_for(double tolerance) {
  if (tolerance >= 1e-7) return 8;
  if (tolerance >= 1e-11) return 12;
  if (tolerance >= 1e-14) return 16;
  return tolerance >= 1e-17 ? 20 : 30;
}

void integrate_batch(std::span<Trajectory> trajectories, const BatchOptions& options) {
  const Pattern pattern = pattern_of(trajectories);
  const auto wanted =
      static_cast<std::size_t>(options.threads > 0 ? options.threads : usable_processors());
  const std::size_t chunks = std::clamp<std::size_t>(trajectories.size(), 1, wanted);
  const bool has_tangents = options.exponents || options.tangent;
  const auto run = has_tangents ? run_one_pack : run_two_packs;
  const auto run_chunk = [&](std::size_t chunk) {
    const std::size_t begin = chunk * trajectories.size() / chunks;
    const std::size_t end = (chunk + 1) * trajectories.size() / chunks;
    run(pattern, options, trajectories.subspan(begin, end - begin), nullptr);
  };
  std::vector<std::jthread> threads;
  for (std::size_t chunk = 1; chunk < chunks; ++chunk) threads.emplace_back(run_chunk, chunk);
  run_chunk(0);
}

void integrate_single(Trajectory& trajectory, const BatchOptions& options,
                      const Observer& observer) {
  const Pattern pattern = pattern_of({&trajectory, 1});
  run_single(pattern, options, {&trajectory, 1}, observer ? &observer : nullptr);
}

const char* instruction_set() {
  return HWY_DYNAMIC_DISPATCH(name_of_target)();
}
}  // namespace whirl::inline dyn
#endif
