#include "libdyn/studies/work_precision_study.hpp"

#include <algorithm>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double settling = 1e-10;  ///< tolerance of the transient

/// The options with the methods that suit, and with what is left of a revolution discarded.
WorkPrecisionOptions whole(WorkPrecisionOptions options, const ContactSystem& system,
                           const MotionState& start) {
  if (start.phase > 0.0) options.discard = std::max(1L, options.discard);
  if (!options.methods.empty()) return options;
  for (const std::string_view name : candidate_names()) {
    if (name != Collocation::name || Collocation::abilities.can(system))
      options.methods.emplace_back(name);
  }
  return options;
}

}  // namespace

Mat WorkPrecisionStudy::table(double (*number)(const TimedRun&)) const {
  const auto columns = static_cast<Eigen::Index>(options.tolerances.size());
  const auto rows = static_cast<Eigen::Index>(options.methods.size());
  Mat all = Mat::Constant(rows, columns, nan);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!runs[i].has_failed()) all(at / columns, at % columns) = number(runs[i]);
  }
  return all;
}

Mat WorkPrecisionStudy::errors() const {
  return table([](const TimedRun& run) { return run.error; });
}

Mat WorkPrecisionStudy::times() const {
  return table([](const TimedRun& run) { return run.time; });
}

Mat WorkPrecisionStudy::steps() const {
  return table([](const TimedRun& run) { return static_cast<double>(run.steps()); }) /
         static_cast<double>(options.revolutions);
}

Mat WorkPrecisionStudy::evaluations() const {
  return table([](const TimedRun& run) { return static_cast<double>(run.evaluations()); }) /
         static_cast<double>(options.revolutions);
}

WorkPrecisionStudy work_precision_study(const ContactSystem& system, MotionState start,
                                        const WorkPrecisionOptions& options,
                                        const Monitor<WorkPrecisionStudy>& monitor) {
  WorkPrecisionStudy study{.options = whole(options, system, start)};
  const std::vector<std::string>& methods = study.options.methods;
  const auto count = static_cast<long>(methods.size() * options.tolerances.size());
  // it is stopped within the transient, and between runs, which an observer would slow down
  const Integration transient =
      integrate(AnyMethod{}, system, start, study.options.discard, {.tolerance = settling},
                [&](const Step&) { return !monitor.stops(); });
  study.is_whole = transient.outcome != Outcome::stopped_by_observer;
  if (!study.is_whole) return study;
  if (transient.outcome != Outcome::reached_end) {
    throw NumericalError("the transient failed: " + transient.failure.text());
  }
  study.reference = reference_motion(system, start, options.revolutions);
  for (const std::string& method : methods) {
    const Candidate measured = candidate(system, method);
    for (const double tolerance : options.tolerances) {
      monitor.show(1 + std::ssize(study.runs), count + 1);
      study.is_whole = !monitor.stops();
      if (!study.is_whole) return study;
      study.runs.push_back(measure(measured, tolerance, system, start, study.reference));
    }
  }
  return study;
}

}  // namespace whirl::inline dyn
