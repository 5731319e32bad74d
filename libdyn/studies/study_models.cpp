#include "libdyn/studies/study_models.hpp"

#include <utility>

#include "libbase/error.hpp"
#include "libdyn/motions/start.hpp"

namespace whirl::inline dyn {

StudyModels study_models(std::function<Model(std::span<const double>)> model) {
  return {.member =
              [model = std::move(model)](std::span<const double> values) {
                StudyMember member{.model = model(values), .scene = nullptr};
                member.scene =
                    std::make_shared<const Scene>(make_scene(member.model, ReductionEstimate::no));
                return member;
              },
          .start =
              [](const StudyMember& member, const FullState* from) {
                if (!from) return start_state(member.model, *member.scene, nullptr);
                Model carried = member.model;
                carried.start.from = StartFrom::file;
                carried.start.whirl.clear();
                return start_state(carried, *member.scene, from);
              }};
}

StudyMotion begin_motion(const StudyModels& models, std::span<const double> values,
                         const FullState* from, long revolution) {
  StudyMotion motion;
  try {
    StudyMember member = models.member(values);
    motion.scene = member.scene;
    motion.subject.system = &motion.scene->contacts;
    MotionState& state = motion.subject.found.end;
    state = models.start(member, from);
    if (from && motion.scene->contacts.repeats_after() != 1) state.revolution = revolution;
    motion.model = std::make_shared<const Model>(std::move(member.model));
  } catch (const NumericalError& error) {
    motion.failure = error.what();
  }
  return motion;
}

void together(std::span<StudyMotion> motions,
              const std::function<void(std::span<ClassifyCandidate>)>& f) {
  std::vector<StudyMotion*> good;
  std::vector<ClassifyCandidate> subjects;
  for (StudyMotion& m : motions) {
    if (!m.is_good()) continue;
    good.push_back(&m);
    subjects.push_back(std::move(m.subject));
  }
  f(subjects);
  for (std::size_t i = 0; i < good.size(); ++i) good[i]->subject = std::move(subjects[i]);
}

void classify_together(std::span<StudyMotion> motions, const ClassifyOptions& options) {
  together(motions, [&](std::span<ClassifyCandidate> good) {
    settle(good, options);
    average(good, options);
  });
}

ClassifiedMotion classified(const StudyMotion& motion) {
  if (motion.failure) return {.failure = motion.failure};
  return classified(motion.subject.found);
}

ClassifyOptions stopped_by(const std::function<bool()>& is_stopped, ClassifyOptions options) {
  options.watch = {};
  if (is_stopped) options.watch = [is_stopped](long) { return !is_stopped(); };
  return options;
}

}  // namespace whirl::inline dyn
