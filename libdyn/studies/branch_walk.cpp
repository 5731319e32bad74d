#include "libdyn/studies/branch_walk.hpp"

namespace whirl::inline dyn {

void add_news(Branch& known, const Branch& walked) {
  const auto from = [](const auto& list, std::size_t begin) {
    return list.begin() + static_cast<std::ptrdiff_t>(begin);
  };
  known.points.insert(known.points.end(), from(walked.points, known.points.size()),
                      walked.points.end());
  known.bifurcations.insert(known.bifurcations.end(),
                            from(walked.bifurcations, known.bifurcations.size()),
                            walked.bifurcations.end());
  known.end = walked.end;
}

}  // namespace whirl::inline dyn
