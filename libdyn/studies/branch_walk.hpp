#pragma once
/// What studies along branches share: walks that can be stopped, and results that are saved.

#include <functional>

#include "libdyn/branches/continuation.hpp"
#include "libdyn/studies/monitor.hpp"

namespace whirl::inline dyn {

/// How much of a branch is known.
struct BranchExtent {
  std::size_t points = 0, bifurcations = 0;
};
inline BranchExtent extent_of(const Branch& branch) {
  return {branch.points.size(), branch.bifurcations.size()};
}

/// Adds to a branch what a walk has found beyond an extent, and the end of the walk; no more is
/// copied.
void add_news(Branch& known, const Branch& walked, const BranchExtent& beyond);

/// Advances a walk by a point.
/// @param stops  asked before the point and often on the way to it
/// @return  false: the branch has ended, or the walk was stopped and is where it was
bool advance(Continuation& walk, const std::function<bool()>& stops);

/// Walks until a branch ends.
///
/// @param branch   gets what the walk finds, point by point: the walk can go on from it at any time
/// @param measure  called with each point before the branch gets it
/// @param added    called after the branch has got a point
/// @return  false: stopped before the end of the branch
template <class Result>
bool walk_to_end(Continuation& walk, Branch& branch, const Monitor<Result>& monitor,
                 const std::function<void(const BranchPoint& point)>& measure,
                 const std::function<void()>& added) {
  while (advance(walk, [&] { return monitor.stops(); })) {
    measure(walk.branch().points.back());
    add_news(branch, walk.branch(), extent_of(branch));
    added();
  }
  add_news(branch, walk.branch(), extent_of(branch));
  return branch.end.has_value();
}

/// Calls f, which is to call its argument after every point that it adds to the result; saves now
/// and then, at the end, and before an exception leaves.
template <class Result>
void save_as_it_grows(const Result& result, const Monitor<Result>& monitor,
                      const std::function<void(const std::function<void()>& save_if_due)>& f) {
  SaveTimer timer;
  const auto save = [&] {
    if (monitor.save) monitor.save(result);
  };
  try {
    f([&] {
      if (timer.is_due()) timer.save(save);
    });
  } catch (...) {
    save();
    throw;
  }
  save();
}

}  // namespace whirl::inline dyn
