#include "libdyn/studies/study_outcome.hpp"

#include <algorithm>

namespace whirl::inline dyn {

StudyOutcome study_outcome(const std::vector<const ClassifiedMotion*>& motions, std::size_t resumed,
                           const std::function<std::string(std::size_t)>& describe,
                           const Stripe& stripe) {
  StudyOutcome outcome{.resumed = resumed, .points = stripe.points(motions.size())};
  std::string example;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i] || !stripe.has(i)) continue;
    const ClassifiedMotion& motion = *motions[i];
    ++outcome.done;
    outcome.failed += motion.has_failed() ? 1 : 0;
    if (example.empty() && motion.failure) example = describe(i) + ": " + motion.failure.text();
    if (motion.kind != MotionKind::not_settled) continue;
    UnsettledMotions& unsettled = outcome.unsettled;
    ++unsettled.motions;
    if (motion.settles_after == 0) continue;
    ++unsettled.would_settle;
    unsettled.settles_after = std::max(unsettled.settles_after.value_or(0), motion.settles_after);
  }
  if (outcome.failed > 0) {
    outcome.failure = std::to_string(outcome.failed) + " of " + std::to_string(outcome.points) +
                      " points" + (example.empty() ? "" : ", for instance at " + example);
  }
  return outcome;
}

}  // namespace whirl::inline dyn
