#include "libdyn/studies/classified_motion.hpp"

#include <algorithm>

#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

Regime ClassifiedMotion::regime() const {
  Regime strongest = Regime::none;
  for (const ContactDoing& c : contacts) strongest = std::max(strongest, c.regime);
  return strongest;
}

double ClassifiedMotion::impacts_per_rev() const {
  if (has_failed()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const ContactDoing& c : contacts) sum += c.impacts_per_rev;
  return sum;
}

double ClassifiedMotion::largest_exponent() const {
  return exponents.empty() ? std::numeric_limits<double>::quiet_NaN() : exponents[0];
}

MotionSummary summary_of(const ClassifiedMotion& motion) {
  if (motion.has_failed()) return {};
  MotionSummary summary{.motion = motion.kind, .regime = motion.regime()};
  if (motion.period > 0) summary.period = motion.period;
  if (!motion.exponents.empty()) summary.largest_exponent = motion.largest_exponent();
  return summary;
}

ClassifiedMotion classified(const Classification& found) {
  if (!found.is_good()) return {.failure = found.failure};
  ClassifiedMotion motion{.kind = found.kind,
                          .period = found.period,
                          .is_proven = found.is_proven,
                          .transient = found.transient,
                          .revolutions = found.revolutions,
                          .resolution = found.resolution,
                          .section_dimension = found.section_dimension,
                          .exponents = {found.exponents.begin(), found.exponents.end()},
                          .settles_after = found.settles_after};
  for (const ContactMeasure& m : found.contacts) {
    motion.contacts.push_back(contact_doing(m, found.revolutions));
  }
  return motion;
}

Eigen::Index StudySystem::exponents() const {
  return exponents_of(states, most_exponents);
}

StudySystem study_system(const Scene& scene, const ClassifyOptions& options) {
  StudySystem system{
      .contacts = std::vector<std::string>(static_cast<std::size_t>(scene.contacts.owners())),
      .states = scene.contacts.size(),
      .dofs = scene.reduced.dofs.T.rows(),
      .most_exponents = options.most_exponents};
  for (const ReducedContact& c : scene.contacts.contacts()) {
    system.contacts[static_cast<std::size_t>(c.owner)] = c.name;
  }
  return system;
}

}  // namespace whirl::inline dyn
