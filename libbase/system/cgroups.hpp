#pragma once
/// What the control groups of this process allow.

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace whirl::inline base {

/// A number that a controller gives each of its groups, read from the folder of a group; nothing:
/// the group has no such number.
struct CgroupNumber {
  using Of = std::function<std::optional<double>(const std::filesystem::path& group)>;

  std::string_view name;  ///< of the controller
  std::vector<std::string_view>
      mounts;       ///< where its groups of version 1 may be, in /sys/fs/cgroup
  Of of_v1, of_v2;  ///< as version 1 and version 2 say it
};

/// The smallest number of the groups of this process and of all groups around them; nothing: no
/// group has a number. Where the group of the process cannot be seen, as in a container, the number
/// of the container's group holds.
/// @param root  under which /proc/self/cgroup and /sys/fs/cgroup are looked for
/// @source cgroups(7)
std::optional<double> least_of_cgroups(const std::filesystem::path& root,
                                       const CgroupNumber& number);

}  // namespace whirl::inline base
