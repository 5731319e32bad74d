#pragma once
/// Processors that this process may use.

#include <filesystem>
#include <optional>

namespace whirl::inline base {

/// What limits how many threads of a process can work at once.
struct ProcessorLimits {
  int affinity = 1;               ///< processors of its affinity mask (taskset, cpusets)
  std::optional<double> quota{};  ///< processors' worth of time by its cgroups; nothing: all
  std::optional<int> openmp{};    ///< OMP_NUM_THREADS, of the outermost level
  std::optional<int> slurm{};     ///< SLURM_CPUS_PER_TASK
};

/// The limits of this process.
///
/// The quota is the smallest of its cgroup and all cgroups around that: cpu.max of version 2,
/// cpu.cfs_quota_us over cpu.cfs_period_us of version 1. Where its cgroup cannot be seen, as in a
/// container, the quota of the container holds. What cannot be read limits nothing.
///
/// @param root  under which /proc/self/cgroup and /sys/fs/cgroup are looked for
/// @source cgroups(7); Linux, Documentation/admin-guide/cgroup-v2.rst, scheduler/sched-bwc.rst
ProcessorLimits processor_limits(const std::filesystem::path& root = "/");

/// Threads that these limits leave: the smallest of the affinity mask, the quota rounded up, and
/// OMP_NUM_THREADS, or where that is not set SLURM_CPUS_PER_TASK; at least one.
int usable_processors(const ProcessorLimits& limits);

/// Threads that the limits of this process leave, as they were at the first call.
int usable_processors();

}  // namespace whirl::inline base
