#include "libdyn/motions/touches.hpp"

#include <algorithm>

namespace whirl::inline dyn {

std::vector<ContactTouch> touches_of(const Recording& recording, std::size_t most) {
  std::vector<ContactTouch> all;
  for (std::size_t i = 0; i < recording.contacts.size(); ++i) {
    const auto normal = recording.normal.row(static_cast<Eigen::Index>(i));
    for (Eigen::Index j = 0; j < normal.size(); ++j) {
      if (!(normal(j) > 0.0)) continue;
      ContactTouch touch{recording.contacts[i].name, recording.time(j)};
      for (; j < normal.size() && normal(j) > 0.0; ++j) {
        touch.ends = recording.time(j);
        touch.largest = std::max(touch.largest, normal(j));
      }
      all.push_back(std::move(touch));
    }
  }
  std::ranges::stable_sort(all, {}, &ContactTouch::begins);
  if (all.size() > most) all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(most));
  return all;
}

}  // namespace whirl::inline dyn
