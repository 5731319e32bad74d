#include "libbase/system/processors.hpp"

#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "libbase/system/cgroups.hpp"

namespace whirl::inline base {

namespace {

namespace fs = std::filesystem;

/// Processors in the affinity mask. The kernel refuses a mask that is smaller than its own.
int affinity_of_this_process() {
  for (int size = 1024; size <= 1 << 20; size *= 2) {
    cpu_set_t* const mask = CPU_ALLOC(static_cast<std::size_t>(size));
    if (!mask) break;
    const std::size_t bytes = CPU_ALLOC_SIZE(static_cast<std::size_t>(size));
    const bool is_known = ::sched_getaffinity(0, bytes, mask) == 0;
    const int count = is_known ? CPU_COUNT_S(bytes, mask) : 0;
    CPU_FREE(mask);
    if (is_known) return count;
  }
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// The whole number of 1 or more that a text begins with: 4 of "4,2".
std::optional<int> count_of(const char* text) {
  if (!text) return std::nullopt;
  const std::string_view all(text);
  int count = 0;
  const auto [end, problem] = std::from_chars(all.data(), all.data() + all.size(), count);
  const bool is_count = problem == std::errc{} && count > 0 &&
                        (end == all.data() + all.size() || *end == ',' || *end == ' ');
  return is_count ? std::make_optional(count) : std::nullopt;
}

/// What cpu.max of version 2 allows: "150000 100000", "max 100000".
std::optional<double> quota_v2(const fs::path& group) {
  std::ifstream file(group / "cpu.max");
  double quota = 0.0, period = 0.0;
  if (!(file >> quota >> period) || !(quota > 0.0) || !(period > 0.0)) return std::nullopt;
  return quota / period;
}

/// The same of version 1, where -1 is no limit.
std::optional<double> quota_v1(const fs::path& group) {
  std::ifstream quota_file(group / "cpu.cfs_quota_us"), period_file(group / "cpu.cfs_period_us");
  double quota = 0.0, period = 0.0;
  if (!(quota_file >> quota) || !(period_file >> period)) return std::nullopt;
  if (!(quota > 0.0) || !(period > 0.0)) return std::nullopt;
  return quota / period;
}

/// What the cgroups of this process allow.
std::optional<double> cgroup_quota(const fs::path& root) {
  return least_of_cgroups(root, {.name = "cpu",
                                 .mounts = {"cpu", "cpu,cpuacct", "cpuacct,cpu"},
                                 .of_v1 = quota_v1,
                                 .of_v2 = quota_v2});
}

}  // namespace

ProcessorLimits processor_limits(const fs::path& root) {
  return {.affinity = affinity_of_this_process(),
          .quota = cgroup_quota(root),
          .openmp = count_of(std::getenv("OMP_NUM_THREADS")),
          .slurm = count_of(std::getenv("SLURM_CPUS_PER_TASK"))};
}

int usable_processors(const ProcessorLimits& limits) {
  int most = limits.affinity;
  if (limits.quota && *limits.quota < most) most = static_cast<int>(std::ceil(*limits.quota));
  const std::optional<int> asked = limits.openmp ? limits.openmp : limits.slurm;
  if (asked) most = std::min(most, *asked);
  return std::max(1, most);
}

int usable_processors() {
  static const int processors = usable_processors(processor_limits());
  return processors;
}

}  // namespace whirl::inline base
