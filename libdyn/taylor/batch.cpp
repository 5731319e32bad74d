#include "libdyn/taylor/batch.hpp"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cstdint>
#include <system_error>
#include <thread>

#include "libbase/system/processors.hpp"
#include "libdyn/taylor/instruction_sets.hpp"
#include "libdyn/taylor/lanes.hpp"
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

int two_registers() {  // of engine_two_packs.cpp
#if WHIRL_HAS_NO_LANES
  return 1;
#else
  return 2 *
         static_cast<int>(hwy::HWY_NAMESPACE::Lanes(hwy::HWY_NAMESPACE::CappedTag<double, 8>()));
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace whirl::inline dyn {
HWY_EXPORT(name_of_target);
HWY_EXPORT(two_registers);

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
  std::size_t chunk = 1;
  try {
    for (; chunk < chunks; ++chunk) threads.emplace_back(run_chunk, chunk);
  } catch (const std::system_error&) {  // the system gives no more threads: the rest is done here
  }
  for (; chunk < chunks; ++chunk) run_chunk(chunk);
  run_chunk(0);
}

void integrate_single(Trajectory& trajectory, const BatchOptions& options,
                      const Observer& observer) {
  const Pattern pattern = pattern_of({&trajectory, 1});
  run_single(pattern, options, {&trajectory, 1}, observer ? &observer : nullptr);
}

namespace {

struct Target {
  std::string name;
  std::int64_t bit = 0;
};

/// A target as people call it.
std::string name_of(std::string_view target) {
  if (target == "AVX3") return "avx512";
  if (target == "SCALAR" || target == "EMU128") return std::string(baseline_set);
  std::string name;
  for (const char c : target) name += static_cast<char>(std::tolower(c));
  return name;
}

/// Those of this program and processor, the best first.
/// @note  Highway says so as long as none has been ruled out.
const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> found;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
      const std::int64_t bit = rest & -rest;
      found.push_back({name_of(hwy::TargetName(bit)), bit});
    }
    return found;
  }();
  return all;
}

bool fuses(std::string_view set) {
  return set == "avx512" || set == "avx2";
}

}  // namespace

std::string instruction_set() {
  return name_of(HWY_DYNAMIC_DISPATCH(name_of_target)());
}

int lanes_together() {
  return HWY_DYNAMIC_DISPATCH(two_registers)();
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) names.push_back(target.name);
  return names;
}

void use_instruction_set(std::string_view name) {
  std::int64_t left_out = 0;
  for (const Target& target : targets()) {
    if (target.name == name) left_out = ~target.bit;
  }
  assert(name.empty() || left_out != 0);
  hwy::DisableTargets(left_out);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

bool rounds_alike(std::string_view set, std::string_view other) {
  return set == other || (fuses(set) && fuses(other));
}
}  // namespace whirl::inline dyn
#endif
