#include "libdyn/studies/branch_walk.hpp"

namespace whirl::inline dyn {

void add_news(Branch& known, const Branch& walked, const BranchExtent& beyond) {
  const auto add = [](auto& list, const auto& from, std::size_t begin) {
    list.insert(list.end(), from.begin() + static_cast<std::ptrdiff_t>(begin), from.end());
  };
  add(known.points, walked.points, beyond.points);
  add(known.bifurcations, walked.bifurcations, beyond.bifurcations);
  known.end = walked.end;
}

}  // namespace whirl::inline dyn
