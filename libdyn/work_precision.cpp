#include "libdyn/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "libfe/base/error.hpp"

namespace whirl {

namespace {

constexpr double tightest = 1e-15, second_tightest = 1e-14;
constexpr double deviation = 1e-8;  ///< of the scales: far above rounding, far below the motion

/// Time that this thread was on a processor [s].
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

double error_between(const ContactSystem& system, const Vec& a, const Vec& b) {
  return ((a - b).array() / system.state_scale().array()).abs().maxCoeff();
}

ReferenceMotion dop853_reference(const ContactSystem& system, const MotionState& start,
                                 long revolutions) {
  const auto end = [&](MotionState state, double tolerance) {
    const Integration run =
        Dop853::integrate(system, state, revolutions, {.tolerance = tolerance}, {});
    if (run.outcome != Outcome::reached_end) {
      throw NumericalError("the reference motion failed: " + run.diagnosis);
    }
    return state.y;
  };
  ReferenceMotion reference;
  reference.revolutions = revolutions;
  reference.made_by = fmt::format("dop853 at {:g}", tightest);
  reference.end = end(start, tightest);
  reference.error = error_between(system, reference.end, end(start, second_tightest));
  MotionState near = start;
  for (Eigen::Index i = 0; i < near.y.size(); ++i) {
    near.y(i) += (i % 2 == 0 ? deviation : -deviation) * system.state_scale()(i);
  }
  near.contacts.clear();  // a contact that just began may not have begun there
  const double later = error_between(system, reference.end, end(near, 1e-13));
  reference.growth = later / deviation;
  return reference;
}

Candidate candidate(const ContactSystem& system, std::string_view method) {
  const AnyMethod any = method_named(method);
  return {std::string(method), [&system, any](MotionState& state, long revolutions, double T) {
            return integrate(any, system, state, revolutions, {.tolerance = T});
          }};
}

TimedRun measure(const Candidate& candidate, double tolerance, const ContactSystem& system,
                 const MotionState& start, const ReferenceMotion& reference,
                 const TimingOptions& options) {
  TimedRun run{.method = candidate.name, .tolerance = tolerance};
  MotionState state = start;
  const double begin = processor_time();
  run.integration = candidate.move(state, reference.revolutions, tolerance);
  const double first = processor_time() - begin;
  run.error = run.has_failed() ? std::numeric_limits<double>::quiet_NaN()
                               : error_between(system, state.y, reference.end);

  // the first run warms caches up and counts only if it is the only one
  std::vector<double> times;
  const int batch = static_cast<int>(std::ceil(options.least_time / std::max(first, 1e-9)));
  double spent = first;
  while (!run.has_failed() && static_cast<int>(times.size()) < options.most_runs &&
         spent < options.most_time) {
    double time = 0.0;
    for (int i = 0; i < batch; ++i) {
      state = start;
      const double from = processor_time();
      candidate.move(state, reference.revolutions, tolerance);
      time += processor_time() - from;
    }
    spent += time;
    times.push_back(time / batch);
  }
  if (times.empty()) times.push_back(first);
  run.time = median(times) / static_cast<double>(reference.revolutions) / candidate.motions;
  return run;
}

}  // namespace whirl
