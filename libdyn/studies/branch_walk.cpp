#include "libdyn/studies/branch_walk.hpp"

#include "libbase/system/interruption.hpp"

namespace whirl::inline dyn {

void add_news(Branch& known, const Branch& walked, const BranchExtent& beyond) {
  const auto add = [](auto& list, const auto& from, std::size_t begin) {
    list.insert(list.end(), from.begin() + static_cast<std::ptrdiff_t>(begin), from.end());
  };
  add(known.points, walked.points, beyond.points);
  add(known.bifurcations, walked.bifurcations, beyond.bifurcations);
  known.end = walked.end;
}

bool advance(Continuation& walk, const std::function<bool()>& stops) {
  if (stops()) return false;
  bool has_point = false;
  finishes_unless(stops, [&] { has_point = walk.advance(); });
  return has_point;
}

}  // namespace whirl::inline dyn
