#include "libbase/system/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/system/cgroups.hpp"

namespace whirl::inline base {

namespace {

namespace fs = std::filesystem;

constexpr double kibibyte = 1024.0;

/// The number behind a word at the begin of a line, such as "MemAvailable:" or "inactive_file".
std::optional<double> number_behind(const fs::path& file, const std::string& word) {
  std::ifstream lines(file);
  for (std::string name; lines >> name;) {
    double number = 0.0;
    if (name == word) return lines >> number ? std::make_optional(number) : std::nullopt;
    lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0.0;
  return stream >> number ? std::make_optional(number) : std::nullopt;
}

/// What a group leaves.
/// @param limit, used, files  names of its files, and of the line of memory.stat
std::optional<double> left_in(const fs::path& group, const char* limit, const char* used,
                              const char* files) {
  const auto most = number_in(group / limit), taken = number_in(group / used);
  if (!most || !taken) return std::nullopt;
  return *most - *taken + number_behind(group / "memory.stat", files).value_or(0.0);
}

std::optional<double> left_of_cgroups(const fs::path& root) {
  return least_of_cgroups(
      root, {.name = "memory",
             .mounts = {"memory"},
             .of_v1 =
                 [](const fs::path& group) {
                   return left_in(group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file");
                 },
             .of_v2 =
                 [](const fs::path& group) {
                   return left_in(group, "memory.max", "memory.current", "inactive_file");
                 }});
}

std::optional<double> left_of_addresses(const fs::path& root) {
  rlimit most{};
  const auto pages = number_in(root / "proc/self/statm");
  if (!pages || ::getrlimit(RLIMIT_AS, &most) != 0 || most.rlim_cur == RLIM_INFINITY) {
    return std::nullopt;
  }
  return static_cast<double>(most.rlim_cur) - *pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// "512 MB", "5.2 GB", "13 000 GB" at most
std::string size_text(double bytes) {
  constexpr double giga = 1e9, mega = 1e6;
  if (bytes < giga) return fmt::format("{:.0f} MB", std::max(0.0, bytes / mega));
  return bytes < 100.0 * giga ? fmt::format("{:.1f} GB", bytes / giga)
                              : fmt::format("{:.0f} GB", bytes / giga);
}

}  // namespace

MemoryLimits memory_limits(const fs::path& root) {
  MemoryLimits limits{.cgroup = left_of_cgroups(root), .addresses = left_of_addresses(root)};
  const fs::path facts = root / "proc/meminfo";
  if (const auto there = number_behind(facts, "MemAvailable:")) {
    limits.machine = kibibyte * (*there + number_behind(facts, "SwapFree:").value_or(0.0));
  }
  return limits;
}

double least_of(const MemoryLimits& limits) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : {limits.machine, limits.cgroup, limits.addresses}) {
    if (one) least = std::min(least, *one);
  }
  return least;
}

void require_memory(const std::string& option, double bytes, const std::string& what,
                    const std::string& advice) {
  constexpr double never_short = 1e8;  // nobody is asked about so little
  if (bytes < never_short) return;
  const double there = least_of(memory_limits());
  if (bytes <= there) return;
  throw OptionError(option, fmt::format("{} take {}, and this process can have {}; {}", what,
                                        size_text(bytes), size_text(there), advice));
}

}  // namespace whirl::inline base
