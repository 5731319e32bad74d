#include "libdyn/methods/cvode.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "libdyn/events.hpp"
#include "libdyn/methods/diagnosis.hpp"

namespace whirl {

namespace {

constexpr long most_steps_per_revolution = 1'000'000;
constexpr int most_instant_events = 50;

template <auto release>
struct Releaser {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using Vector = std::unique_ptr<_generic_N_Vector, Releaser<N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Releaser<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Releaser<SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, Releaser<SUNNonlinSolFree>>;
struct CvodeFree {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
struct ContextFree {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
};

/// What the callbacks see: the equations in time since the last restart's revolution.
struct Problem {
  const ContactSystem& system;
  EventWatcher& watcher;
  const MotionState& state;
  std::vector<std::pair<int, EventKind>> roots;
  Cost& cost;
};

int derivative(realtype t, N_Vector y, N_Vector dy, void* data) {
  auto& p = *static_cast<Problem*>(data);
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(dy);
  const int n = p.system.coordinates();
  std::copy(from + n, from + 2 * n, to);
  p.system.acceleration(t * p.system.phase_rate(), from, p.state.contacts, to + n);
  ++p.cost.evaluations;
  return std::all_of(to, to + 2 * n, [](double x) { return std::isfinite(x); }) ? 0 : 1;
}

int root_functions(realtype t, N_Vector y, realtype* g, void* data) {
  auto& p = *static_cast<Problem*>(data);
  for (std::size_t i = 0; i < p.roots.size(); ++i) {
    g[i] = p.watcher.value({0.0, p.roots[i].first, p.roots[i].second}, t * p.system.phase_rate(),
                           N_VGetArrayPointer(y), p.state.contacts);
  }
  return 0;
}

/// The solver's interpolating polynomial over its last step, in s = (t - from) / h.
void dense(void* memory, double from, double to, int n, N_Vector work, Step& step) {
  int order = 1;
  CVodeGetLastOrder(memory, &order);
  step.q.resize(n, order + 1);
  step.v.resize(n, order + 1);
  double factor = 1.0;
  for (int k = 0; k <= order; ++k) {
    if (k > 0) factor *= (to - from) / k;
    CVodeGetDky(memory, from, k, work);
    const Eigen::Map<const Vec> derivative_k(N_VGetArrayPointer(work), 2 * n);
    step.q.col(k) = factor * derivative_k.head(n);
    step.v.col(k) = factor * derivative_k.tail(n);
  }
}

/// States of the contacts between two restarts decide which roots are watched.
std::vector<std::pair<int, EventKind>> roots_of(const EventWatcher& watcher,
                                                const ContactStates& states) {
  std::vector<std::pair<int, EventKind>> roots;
  for (int i = 0; i < static_cast<int>(states.size()); ++i) {
    for (const EventKind kind : watcher.kinds(i, states[static_cast<std::size_t>(i)])) {
      roots.emplace_back(i, kind);
    }
  }
  return roots;
}

/// Makes the events that are due at the very start. CVODE finds changes of sign only, and so passes
/// over a function that is zero at the start and falls.
void apply_events_at_start(const ContactSystem& system, EventWatcher& watcher, MotionState& state,
                           Cost& cost) {
  constexpr double zero = 1e-15;            // of a function, which is dimensionless
  const double h = 1e-6 * system.period();  // ahead, to see which way the functions go
  const int n = system.coordinates();
  Vec a(n), ahead(2 * n);
  system.acceleration(state.phase, state.y.data(), state.contacts, a.data());
  ahead << state.y.head(n) + h * state.y.tail(n) + 0.5 * h * h * a, state.y.tail(n) + h * a;
  const ContactStates before = state.contacts;
  for (const auto& [contact, kind] : roots_of(watcher, before)) {
    const Event event{0.0, contact, kind};
    if (watcher.value(event, state.phase, state.y.data(), before) > zero) continue;
    const double phase = state.phase + h * system.phase_rate();
    if (!(watcher.value(event, phase, ahead.data(), before) < -zero)) continue;
    watcher.apply(event, state.phase, state.y.data(), state.contacts);
    ++cost.events;
  }
}

Integration run(int method, const ContactSystem& system, MotionState& state, long revolutions,
                const IntegrationOptions& options, const Observer& observer) {
  Integration result;
  EventWatcher watcher(system);
  if (state.contacts.size() != system.contacts().size()) {
    state.contacts = system.classify(state.phase, state.y.data());
  }
  apply_events_at_start(system, watcher, state, result.cost);
  const int n = system.coordinates();
  const double rate = system.phase_rate(), period = system.period();
  const long last = state.revolution + revolutions;

  SUNContext raw_context = nullptr;
  SUNContext_Create(nullptr, &raw_context);
  const std::unique_ptr<_SUNContext, ContextFree> context(raw_context);
  const Vector y(N_VNew_Serial(2 * n, raw_context)), weight(N_VNew_Serial(2 * n, raw_context)),
      work(N_VNew_Serial(2 * n, raw_context));
  Eigen::Map<Vec> values(N_VGetArrayPointer(y.get()), 2 * n);
  values = state.y;
  Eigen::Map<Vec>(N_VGetArrayPointer(weight.get()), 2 * n) =
      options.tolerance * system.state_scale();

  Problem problem{system, watcher, state, roots_of(watcher, state.contacts), result.cost};
  const std::unique_ptr<void, CvodeFree> memory(CVodeCreate(method, raw_context));
  void* cv = memory.get();
  CVodeSetErrHandlerFn(
      cv, [](int, const char*, const char*, char*, void*) {}, nullptr);
  double t = state.phase / rate;  // since the start of the revolution
  CVodeInit(cv, derivative, t, y.get());
  CVodeSVtolerances(cv, options.tolerance, weight.get());
  CVodeSetUserData(cv, &problem);
  CVodeSetMaxNumSteps(cv, most_steps_per_revolution);
  Matrix jacobian;
  LinearSolver linear;
  NonlinearSolver nonlinear;
  if (method == CV_BDF) {
    jacobian.reset(SUNDenseMatrix(2 * n, 2 * n, raw_context));
    linear.reset(SUNLinSol_Dense(y.get(), jacobian.get(), raw_context));
    CVodeSetLinearSolver(cv, linear.get(), jacobian.get());
  } else {
    nonlinear.reset(SUNNonlinSol_FixedPoint(y.get(), 0, raw_context));
    CVodeSetNonlinearSolver(cv, nonlinear.get());
  }
  const auto watch = [&] {
    problem.roots = roots_of(watcher, state.contacts);
    CVodeRootInit(cv, static_cast<int>(problem.roots.size()), root_functions);
    std::vector<int> falling(problem.roots.size(), -1);
    if (!falling.empty()) CVodeSetRootDirection(cv, falling.data());
    CVodeSetNoInactiveRootWarn(cv);
    CVodeSetStopTime(cv, period);
  };
  watch();

  Step step;
  int instant_events = 0;
  while (state.revolution < last) {
    const double before = t;
    const int flag = CVode(cv, period, y.get(), &t, CV_ONE_STEP);
    if (flag < 0 || !values.allFinite()) {
      result.outcome = values.allFinite() ? Outcome::step_too_small : Outcome::not_finite;
      result.diagnosis = diagnosis(system, state, fmt::format("CVODE failed with flag {}", flag));
      return result;
    }
    const bool has_moved = t > before;
    if (has_moved) {
      step.revolution = state.revolution;
      step.phase = state.phase;
      step.h = t - before;
      step.turn = step.h * rate;
      step.contacts = state.contacts;
      dense(cv, before, t, n, work.get(), step);
      ++result.cost.steps;
      instant_events = 0;
    }
    state.y = values;
    state.phase = t * rate;
    if (flag == CV_ROOT_RETURN) {
      std::vector<int> found(problem.roots.size());
      CVodeGetRootInfo(cv, found.data());
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] == 0) continue;
        const Event event{1.0, problem.roots[i].first, problem.roots[i].second};
        watcher.apply(event, state.phase, state.y.data(), state.contacts);
        ++result.cost.events;
      }
      if (!has_moved && ++instant_events > most_instant_events) {
        result.outcome = Outcome::step_too_small;
        result.diagnosis = diagnosis(system, state, "events follow without time passing");
        return result;
      }
      CVodeReInit(cv, t, y.get());
      watch();
    }
    if (flag == CV_TSTOP_RETURN) {
      ++state.revolution;
      state.phase = 0.0;
      t = 0.0;
      CVodeReInit(cv, t, y.get());
      watch();
    }
    if (has_moved && observer && !observer(step)) {
      result.outcome = Outcome::stopped_by_observer;
      return result;
    }
  }
  return result;
}

}  // namespace

Integration CvodeAdams::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                                  const IntegrationOptions& options, const Observer& observer) {
  return run(CV_ADAMS, system, state, revolutions, options, observer);
}

Integration CvodeBdf::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                                const IntegrationOptions& options, const Observer& observer) {
  return run(CV_BDF, system, state, revolutions, options, observer);
}

}  // namespace whirl
