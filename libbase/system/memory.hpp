#pragma once
/// Memory that this process can still take, asked before it is taken.

#include <filesystem>
#include <optional>
#include <string>

namespace whirl::inline base {

/// What limits the memory of this process [bytes]; nothing: no limit of this kind.
struct MemoryLimits {
  std::optional<double> machine{};    ///< MemAvailable and SwapFree of /proc/meminfo
  std::optional<double> cgroup{};     ///< what the limits of its cgroups leave
  std::optional<double> addresses{};  ///< what RLIMIT_AS (ulimit -v) leaves
};

/// The limits of this process, now.
///
/// A cgroup leaves memory.max of version 2, or memory.limit_in_bytes of version 1, less the memory
/// in use that is not only files that were read (inactive_file). What cannot be read limits
/// nothing.
///
/// @param root  under which /proc and /sys/fs/cgroup are looked for
/// @source proc(5), getrlimit(2); Linux, Documentation/admin-guide/cgroup-v2.rst,
///         cgroup-v1/memory.rst
MemoryLimits memory_limits(const std::filesystem::path& root = "/");

/// The smallest of the limits [bytes]; infinite without any.
double least_of(const MemoryLimits& limits);

/// Checks that there is as much memory as something is estimated to take.
/// @param option  that asks for the memory, in words with hyphens: "revolutions"
/// @param bytes   estimated
/// @param what    takes the memory: "512 revolutions with 64 samples each"
/// @param advice  what would take less: "record fewer"
/// @throws OptionError  with both numbers, if there is less
void require_memory(const std::string& option, double bytes, const std::string& what,
                    const std::string& advice);

}  // namespace whirl::inline base
