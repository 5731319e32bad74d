#include "libdyn/studies/walk_stretch.hpp"

#include <utility>

#include "libdyn/studies/branch_walk.hpp"

namespace whirl::inline dyn {

WalkNews walk_stretch(Continuation walk, const StretchLimits& limits,
                      const std::function<void(const BranchPoint& point, WalkNews&)>& measure) {
  using clock = std::chrono::steady_clock;
  const auto begin = clock::now();
  const BranchExtent begun = extent_of(walk.branch());
  WalkNews news;
  while (advance(walk, limits.is_stopped)) {
    if (measure) measure(walk.branch().points.back(), news);
    if (clock::now() - begin >= limits.lasts) break;
  }
  add_news(news.branch, walk.branch(), begun);
  news.by_parameter = walk.by_parameter();
  return news;
}

}  // namespace whirl::inline dyn
