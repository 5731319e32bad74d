#include "libdyn/methods/sundials.hpp"

#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>

#include "libdyn/methods/step_limits.hpp"
#include "libdyn/system/failure_text.hpp"

namespace whirl::inline dyn::sundials {

namespace {

enum Flag { stop_time = 1, root = 2 };  // of CVODE and ARKODE alike; below zero: a failure

}  // namespace

Context new_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return Context(context);
}

Eigen::Map<Vec> values(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength_Serial(v)};
}

NewtonSolver::NewtonSolver(N_Vector y, SUNContext context)
    : jacobian(SUNDenseMatrix(N_VGetLength_Serial(y), N_VGetLength_Serial(y), context)),
      linear(SUNLinSol_Dense(y, jacobian.get(), context)) {}

Motion::Motion(const ContactSystem& system, MotionState& state, double tolerance)
    : system_(system),
      state_(state),
      watcher_(system),
      context_(new_context()),
      y_(N_VNew_Serial(system.size(), context())),
      weight_(N_VNew_Serial(system.size(), context())),
      work_(N_VNew_Serial(system.size(), context())) {
  if (state.contacts.size() != system.contacts().size()) {
    state.contacts = system.classify(state.instant(), state.y.data());
  }
  apply_events_at_start();
  values(y_.get()) = state.y;
  values(weight_.get()) = tolerance * system.state_scale();
}

int Motion::rhs(realtype t, N_Vector y, N_Vector dy, void* motion) {
  auto& m = *static_cast<Motion*>(motion);
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(dy);
  const StateLayout layout = m.system_.layout();
  std::copy(layout.rates_at(from), layout.end(from), to);
  m.system_.acceleration(m.instant(t), from, m.state_.contacts, layout.rates_at(to));
  ++m.result_.cost.evaluations;
  return std::all_of(to, layout.end(to), [](double x) { return std::isfinite(x); }) ? 0 : 1;
}

int Motion::root_functions(realtype t, N_Vector y, realtype* g, void* motion) {
  const auto& m = *static_cast<Motion*>(motion);
  for (std::size_t i = 0; i < m.roots_.size(); ++i) {
    g[i] = m.watcher_.value({0.0, m.roots_[i].first, m.roots_[i].second}, m.instant(t),
                            N_VGetArrayPointer(y), m.state_.contacts);
  }
  return 0;
}

/// The events that can end the contacts' present states.
void Motion::find_roots() {
  roots_.clear();
  for (int i = 0; i < static_cast<int>(state_.contacts.size()); ++i) {
    for (const EventKind kind : watcher_.kinds(i, state_.contacts)) {
      roots_.emplace_back(i, kind);
    }
  }
}

/// Makes the events that are due at the very start. The solvers find changes of sign only, and so
/// pass over a function that is zero at the start and falls.
void Motion::apply_events_at_start() {
  constexpr double zero = 1e-15;             // of a function, which is dimensionless
  const double h = 1e-6 * system_.period();  // ahead, to see which way the functions go
  const StateLayout layout = system_.layout();
  const auto eta = layout.eta(state_.y), rate = layout.rate(state_.y);
  Vec a(layout.coordinates()), ahead(layout.size());
  system_.acceleration(state_.instant(), state_.y.data(), state_.contacts, a.data());
  layout.eta(ahead) = eta + h * rate + 0.5 * h * h * a;
  layout.rate(ahead) = rate + h * a;
  const ContactStates before = state_.contacts;
  find_roots();
  for (const auto& [contact, kind] : roots_) {
    const Event event{0.0, contact, kind};
    if (watcher_.value(event, state_.instant(), state_.y.data(), before) > zero) continue;
    const Instant soon(state_.phase + h * system_.phase_rate(), state_.revolution);
    if (!(watcher_.value(event, soon, ahead.data(), before) < -zero)) continue;
    watcher_.apply(event, state_.instant(), state_.y.data(), state_.contacts);
    ++result_.cost.events;
  }
}

/// Lets a solver look for the ends of the contacts' present states, and stop with the revolution.
void Motion::watch(const Solver& solver, void* memory) {
  find_roots();
  solver.watch(memory, static_cast<int>(roots_.size()), root_functions);
  std::vector<int> falling(roots_.size(), -1);
  if (!falling.empty()) solver.set_root_direction(memory, falling.data());
  solver.set_no_inactive_root_warning(memory);
  solver.set_stop_time(memory, system_.period());
}

void Motion::restart(const Solver& solver, void* memory, double t) {
  solver.restart(memory, t, y());
  watch(solver, memory);
}

/// The solver's interpolating polynomial over its last step, in s = (t - from) / h.
void Motion::dense(const Solver& solver, void* memory, double from, double to, Step& step) {
  const StateLayout layout = system_.layout();
  const int degree = solver.degree(memory);
  step.q.resize(layout.coordinates(), degree + 1);
  step.v.resize(layout.coordinates(), degree + 1);
  const Eigen::Map<Vec> found = values(work_.get());
  double factor = 1.0;
  for (int k = 0; k <= degree; ++k) {
    if (k > 0) factor *= (to - from) / k;
    solver.derivative(memory, from, k, work_.get());
    step.q.col(k) = factor * layout.eta(found);
    step.v.col(k) = factor * layout.rate(found);
  }
}

void Motion::apply_roots(const Solver& solver, void* memory) {
  std::vector<int> found(roots_.size());
  solver.found_roots(memory, found.data());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == 0) continue;
    const Event event{1.0, roots_[i].first, roots_[i].second};
    watcher_.apply(event, state_.instant(), state_.y.data(), state_.contacts);
    ++result_.cost.events;
  }
}

Integration Motion::run(const Solver& solver, void* memory, long revolutions,
                        const Observer& observer) {
  const double rate = system_.phase_rate(), period = system_.period();
  const long last = state_.revolution + revolutions;
  const Eigen::Map<Vec> now = values(y_.get());
  const auto fail = [&](Outcome outcome, std::string_view what) {
    whirl::fail(result_, system_, state_, outcome, what);
    return result_;
  };
  if (system_.left_bearing(state_.y.data())) return fail(Outcome::left_bearing, "");
  double t = start();
  watch(solver, memory);
  Step step;
  int instant_events = 0;
  while (state_.revolution < last) {
    const double before = t;
    const int flag = solver.step(memory, period, y(), &t);
    if (flag < 0 || !now.allFinite()) {
      return fail(now.allFinite() ? Outcome::step_too_small : Outcome::not_finite,
                  fmt::format("{} failed with flag {}", solver.name, flag));
    }
    const bool has_moved = t > before;
    if (has_moved) {
      step.set(system_.clock(), state_.instant(), t - before);
      step.contacts = state_.contacts;
      if (observer) dense(solver, memory, before, t, step);
      ++result_.cost.steps;
      instant_events = 0;
    }
    if (is_boundless(system_, now)) return fail(Outcome::step_too_small, boundless_text);
    state_.y = now;
    state_.phase = t * rate;
    if (flag == Flag::root) {
      apply_roots(solver, memory);
      if (!has_moved && ++instant_events > most_instant_events) {
        return fail(Outcome::step_too_small, "events follow without time passing");
      }
      restart(solver, memory, t);
    }
    if (flag == Flag::stop_time) {
      ++state_.revolution;
      state_.phase = 0.0;
      t = 0.0;
      restart(solver, memory, t);
    }
    if (has_moved && observer && !observer(step)) {
      result_.outcome = Outcome::stopped_by_observer;
      return result_;
    }
  }
  return result_;
}

}  // namespace whirl::inline dyn::sundials
