#include "libbase/processors.hpp"

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

std::optional<double> smaller(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

/// The smallest quota of a cgroup and of all that it is in.
/// @param mount  where the groups are
/// @param path   of the group there, "/a/b"
template <class QuotaOf>
std::optional<double> quota_along(const fs::path& mount, const fs::path& path,
                                  const QuotaOf& quota_of) {
  fs::path group = path.lexically_normal().relative_path();
  std::optional<double> least = quota_of(mount);
  for (; !group.empty(); group = group.parent_path()) {
    least = smaller(least, quota_of(mount / group));
  }
  return least;
}

bool has_word(std::string_view list, std::string_view word) {
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    if (list.substr(begin, end - begin) == word) return true;
    begin = end + 1;
  }
  return false;
}

/// What the cgroups of this process allow; their lines are "hierarchy:controllers:path".
std::optional<double> cgroup_quota(const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  std::optional<double> least;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path path = line.substr(second + 1);
    if (line.starts_with("0::")) {
      for (const fs::path& mount : {mounts, mounts / "unified"}) {  // alone, and beside version 1
        least = smaller(least, quota_along(mount, path, quota_v2));
      }
    } else if (has_word(controllers, "cpu")) {
      for (const char* name : {"cpu", "cpu,cpuacct", "cpuacct,cpu"}) {
        least = smaller(least, quota_along(mounts / name, path, quota_v1));
      }
    }
  }
  return least;
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
