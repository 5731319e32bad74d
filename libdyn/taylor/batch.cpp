#include "libdyn/taylor/batch.hpp"

#include <algorithm>
#include <memory>
#include <thread>

// instruction sets: what every processor has, AVX2, AVX-512
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libdyn/taylor/batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "libdyn/taylor/engine_bodies-inl.h"
#include "libdyn/taylor/engine_events-inl.h"
#include "libdyn/taylor/engine_films-inl.h"
#include "libdyn/taylor/engine_series-inl.h"
#include "libdyn/taylor/engine_step-inl.h"
#include "libdyn/taylor/engine_tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl {
namespace HWY_NAMESPACE {

template <class P>
void run_with(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all,
              const Observer* observer) {
  const auto engine = std::make_unique<Engine<P>>(pattern, options);
  engine->run(all, observer);
}

void run_many(const Pattern& pattern, const BatchOptions& options, std::span<Trajectory> all) {
  if (options.exponents || options.tangent) {  // two packs of tangents do not fit the caches
    run_with<Pack<8, 1>>(pattern, options, all, nullptr);
  } else {
    run_with<Pack<8, 2>>(pattern, options, all, nullptr);
  }
}

void run_one(const Pattern& pattern, const BatchOptions& options, Trajectory& one,
             const Observer* observer) {
  run_with<Pack<1, 1>>(pattern, options, {&one, 1}, observer);
}

const char* name_of_target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl {
HWY_EXPORT(run_many);
HWY_EXPORT(run_one);
HWY_EXPORT(name_of_target);

int order_for(double tolerance) {
  if (tolerance >= 1e-7) return 8;
  if (tolerance >= 1e-11) return 12;
  if (tolerance >= 1e-14) return 16;
  return tolerance >= 1e-17 ? 20 : 30;
}

void integrate_batch(std::span<Trajectory> trajectories, const BatchOptions& options) {
  const Pattern pattern = pattern_of(trajectories);
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t wanted =
      options.threads > 0 ? static_cast<std::size_t>(options.threads) : processors;
  const std::size_t chunks = std::clamp<std::size_t>(trajectories.size(), 1, wanted);
  const auto run_chunk = [&](std::size_t chunk) {
    const std::size_t begin = chunk * trajectories.size() / chunks;
    const std::size_t end = (chunk + 1) * trajectories.size() / chunks;
    HWY_DYNAMIC_DISPATCH(run_many)(pattern, options, trajectories.subspan(begin, end - begin));
  };
  std::vector<std::jthread> threads;
  for (std::size_t chunk = 1; chunk < chunks; ++chunk) threads.emplace_back(run_chunk, chunk);
  run_chunk(0);
}

void integrate_single(Trajectory& trajectory, const BatchOptions& options,
                      const Observer& observer) {
  const Pattern pattern = pattern_of({&trajectory, 1});
  HWY_DYNAMIC_DISPATCH(run_one)(pattern, options, trajectory, observer ? &observer : nullptr);
}

const char* instruction_set() {
  return HWY_DYNAMIC_DISPATCH(name_of_target)();
}
}  // namespace whirl
#endif
