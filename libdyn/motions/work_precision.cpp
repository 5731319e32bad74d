#include "libdyn/motions/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/statistics.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/pattern.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double tightest = 1e-15, second_tightest = 1e-14;
const BatchOptions quad{.tolerance = 1e-26, .order = 28};
const BatchOptions other_quad{.tolerance = 1e-23, .order = 25};
constexpr std::string_view taylor_batch = "taylor-batch", rk4_batch = "rk4-batch";
constexpr double most_quad_work = 2e8;  ///< as quad_work; some 3 s
constexpr int lanes = 16;               ///< motions of a batch: two registers of AVX-512
constexpr double deviation = 1e-8;      ///< of the scales: far above rounding, far below the motion

/// Time that this thread was on a processor [s].
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct End {
  Vec y;
  Cost cost;
};

/// End by DOP853.
End end_of(const ContactSystem& system, MotionState state, long revolutions, double tolerance) {
  const Integration run =
      Dop853::integrate(system, state, revolutions, {.tolerance = tolerance}, {});
  if (run.outcome != Outcome::reached_end) {
    throw NumericalError("the reference motion failed: " + run.failure.text());
  }
  return {state.y, run.cost};
}

/// End of a motion that starts a small deviation off.
End deviated_end(const ContactSystem& system, MotionState start, long revolutions) {
  for (Eigen::Index i = 0; i < start.y.size(); ++i) {
    start.y(i) += (i % 2 == 0 ? deviation : -deviation) * system.state_scale()(i);
  }
  start.contacts.clear();  // a contact that just began may not have begun there
  return end_of(system, start, revolutions, 1e-13);
}

/// What a run in quadruple precision costs, roughly in multiplications: steps of DOP853, of which
/// it needs a few times less, times terms of the equations times the order.
double quad_work(const ContactSystem& system, long steps) {
  const ContactSystem* one = &system;
  const Pattern pattern = Pattern::of({&one, 1});
  const auto contacts = static_cast<double>(pattern.contacts.size());
  const auto films = static_cast<double>(pattern.films.size());
  const double terms =
      pattern.off_diagonals + 4.0 * pattern.n + (8.0 * contacts + 13.0 * films) * quad.order;
  return static_cast<double>(steps) * quad.order * terms;
}

ReferenceMotion quad_reference(const ContactSystem& system, const MotionState& start,
                               long revolutions, const End& deviated) {
  const auto end = [&](const BatchOptions& options) {
    Trajectory t{.system = &system, .state = start, .revolutions = revolutions};
    integrate_quad(t, options);
    if (t.outcome != Outcome::reached_end) {
      throw NumericalError("the reference motion failed: " + t.failure.text());
    }
    return t;
  };
  const Trajectory a = end(quad), b = end(other_quad);
  ReferenceMotion reference;
  reference.revolutions = revolutions;
  reference.made_by = fmt::format("taylor in quadruple precision at {:g}", quad.tolerance);
  reference.end = a.state.y;
  reference.error = distance(system, a.state.y - b.state.y, b.lower_digits);
  reference.growth = distance(system, reference.end, deviated.y) / deviation;
  return reference;
}

ReferenceMotion dop853_reference(const ContactSystem& system, const MotionState& start,
                                 long revolutions, const End& deviated) {
  ReferenceMotion reference;
  reference.revolutions = revolutions;
  reference.made_by = fmt::format("dop853 at {:g}", tightest);
  reference.end = end_of(system, start, revolutions, tightest).y;
  reference.error =
      distance(system, reference.end, end_of(system, start, revolutions, second_tightest).y);
  reference.growth = distance(system, reference.end, deviated.y) / deviation;
  return reference;
}

/// Moves a whole batch from the same state; integrate(trajectories, tolerance).
template <class F>
Candidate batch_of(std::string_view name, const ContactSystem& system, F integrate) {
  const auto move = [&system, integrate](MotionState& state, long revolutions, double tolerance) {
    const Trajectory one{.system = &system, .state = state, .revolutions = revolutions};
    std::vector<Trajectory> all(lanes, one);
    integrate(all, tolerance);
    Trajectory& first = all.front();
    state = std::move(first.state);
    return Integration{first.outcome, first.cost, std::move(first.failure)};
  };
  return {std::string(name), move, lanes};
}

}  // namespace

ReferenceMotion reference_motion(const ContactSystem& system, const MotionState& start,
                                 long revolutions) {
  const End deviated = deviated_end(system, start, revolutions);
  if (quad_work(system, deviated.cost.steps) <= most_quad_work) {
    try {
      return quad_reference(system, start, revolutions, deviated);
    } catch (const NumericalError&) {  // a reference in double is better than none
    }
  }
  return dop853_reference(system, start, revolutions, deviated);
}

ReferenceMotion quad_reference(const ContactSystem& system, const MotionState& start,
                               long revolutions) {
  return quad_reference(system, start, revolutions, deviated_end(system, start, revolutions));
}

ReferenceMotion dop853_reference(const ContactSystem& system, const MotionState& start,
                                 long revolutions) {
  return dop853_reference(system, start, revolutions, deviated_end(system, start, revolutions));
}

std::vector<std::string_view> candidate_names() {
  std::vector<std::string_view> names = method_names();
  names.insert(std::find(names.begin(), names.end(), Taylor::name) + 1, taylor_batch);
  names.insert(std::find(names.begin(), names.end(), Rk4::name) + 1, rk4_batch);
  return names;
}

Candidate candidate(const ContactSystem& system, std::string_view name) {
  if (name == taylor_batch) {
    return batch_of(name, system, [](std::span<Trajectory> all, double T) {
      integrate_batch(all, {.tolerance = T, .threads = 1});
    });
  }
  if (name == rk4_batch) {
    return batch_of(name, system, [](std::span<Trajectory> all, double T) {
      integrate_batch_rk4(all, {.tolerance = T});
    });
  }
  const AnyMethod any = method_named(name);
  return {std::string(name), [&system, any](MotionState& state, long revolutions, double T) {
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
                               : distance(system, state.y, reference.end);

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
  run.time = median_of(times) / static_cast<double>(reference.revolutions) / candidate.motions;
  return run;
}

}  // namespace whirl::inline dyn
