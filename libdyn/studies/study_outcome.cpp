#include "libdyn/studies/study_outcome.hpp"

#include <algorithm>

namespace whirl::inline dyn {

void OutcomeCount::add(std::size_t point, const ClassifiedMotion& motion) {
  ++sum_.done;
  sum_.failed += motion.has_failed() ? 1 : 0;
  if (example_.empty() && motion.failure)
    example_ = describe_(point) + ": " + motion.failure.text();
  sum_.hardest.add(point, motion.contacts);
  if (motion.kind != MotionKind::not_settled) return;
  UnsettledMotions& unsettled = sum_.unsettled;
  ++unsettled.motions;
  if (motion.settles_after == 0) return;
  ++unsettled.would_settle;
  unsettled.settles_after = std::max(unsettled.settles_after.value_or(0), motion.settles_after);
}

StudyOutcome OutcomeCount::outcome(std::size_t points, std::size_t resumed) const {
  StudyOutcome outcome = sum_;
  outcome.resumed = resumed;
  outcome.points = points;
  if (outcome.failed > 0) {
    outcome.failure = std::to_string(outcome.failed) + " of " + std::to_string(points) + " points" +
                      (example_.empty() ? "" : ", for instance at " + example_);
  }
  return outcome;
}

}  // namespace whirl::inline dyn
