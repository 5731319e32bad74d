#include "libbase/system/cgroups.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace whirl::inline base {

namespace {

namespace fs = std::filesystem;

std::optional<double> smaller(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

/// The smallest number of a cgroup and of all that it is in.
/// @param mount  where the groups are
/// @param path   of the group there, "/a/b"
std::optional<double> least_along(const fs::path& mount, const fs::path& path,
                                  const CgroupNumber::Of& number_of) {
  fs::path group = path.lexically_normal().relative_path();
  std::optional<double> least = number_of(mount);
  for (; !group.empty(); group = group.parent_path()) {
    least = smaller(least, number_of(mount / group));
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

}  // namespace

std::optional<double> least_of_cgroups(const fs::path& root, const CgroupNumber& number) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");  // lines of "hierarchy:controllers:path"
  std::optional<double> least;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path path = line.substr(second + 1);
    if (line.starts_with("0::")) {
      for (const fs::path& mount : {mounts, mounts / "unified"}) {  // alone, and beside version 1
        least = smaller(least, least_along(mount, path, number.of_v2));
      }
    } else if (has_word(controllers, number.name)) {
      for (const std::string_view mount : number.mounts) {
        least = smaller(least, least_along(mounts / mount, path, number.of_v1));
      }
    }
  }
  return least;
}

}  // namespace whirl::inline base
