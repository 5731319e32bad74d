#include "libdyn/methods/rk4.hpp"

#include <cmath>

#include "libdyn/system/equal_steps.hpp"
#include "libdyn/system/failure_text.hpp"

namespace whirl::inline dyn {

namespace {

/// The step as polynomials: the quintic through displacements, velocities and accelerations of both
/// ends, and its derivative. They meet the ends exactly and keep the order within.
void dense(const Vec& y0, const Vec& dy0, const Vec& y1, const Vec& dy1, Step& step) {
  const StateLayout layout = StateLayout::of(y0.size());
  const double h = step.h;
  const Vec q0 = layout.eta(y0), v0 = h * layout.rate(y0), a0 = 0.5 * h * h * layout.rate(dy0);
  // what the first three terms leave at the end, for value, slope and half the curvature
  const Vec a = layout.eta(y1) - q0 - v0 - a0, b = h * layout.rate(y1) - v0 - 2.0 * a0,
            c = 0.5 * h * h * layout.rate(dy1) - a0;
  step.q.resize(layout.coordinates(), 6);
  step.q << q0, v0, a0, 10.0 * a - 4.0 * b + c, -15.0 * a + 7.0 * b - 2.0 * c,
      6.0 * a - 3.0 * b + c;
  step.v.resize(layout.coordinates(), 5);
  for (int k = 1; k <= 5; ++k) step.v.col(k - 1) = (k / h) * step.q.col(k);
}

/// Slopes within a step, and where it ends.
struct Slopes {
  Vec k1, k2, k3, k4, stage, end;
  explicit Slopes(int size) : k1(size), k2(size), k3(size), k4(size), stage(size), end(size) {}
};

/// Makes a step from y, with its first slope.
template <class Derivative>
void try_step(const Derivative& derivative, double phase, double turn, double h, const Vec& y,
              Slopes& s) {
  s.stage = y + 0.5 * h * s.k1;
  derivative(phase + 0.5 * turn, s.stage, s.k2);
  s.stage = y + 0.5 * h * s.k2;
  derivative(phase + 0.5 * turn, s.stage, s.k3);
  s.stage = y + h * s.k3;
  derivative(phase + turn, s.stage, s.k4);
  s.end = y + (h / 6.0) * (s.k1 + 2.0 * (s.k2 + s.k3) + s.k4);
}

}  // namespace

Integration Rk4::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                           const IntegrationOptions& options, const Observer& observer) {
  Integration result;
  Cost& cost = result.cost;
  const StateLayout layout = system.layout();
  const double rate = system.phase_rate(), period = system.period();
  const long last = state.revolution + revolutions;
  bool has_left = false;  // a stage has left a bearing
  const auto derivative = [&](double phase, const Vec& y, Vec& dy) {
    layout.eta(dy) = layout.rate(y);
    system.acceleration({phase, state.revolution}, y.data(), layout.rates_at(dy.data()));
    ++cost.evaluations;
    has_left = has_left || system.left_bearing(y.data()) != nullptr;
  };

  Vec& y = state.y;
  Slopes s(layout.size());
  Step step;
  derivative(state.phase, y, s.k1);
  while (state.revolution < last) {
    const double first = state.phase, left = period - first / rate;
    const double count = equal_steps(period, left, options);
    const double h = left / count, turn = h * rate;
    for (double i = 0.0; i < count; ++i) {  // a double: counts beyond any integer fail by time
      const double phase = first + i * turn;
      try_step(derivative, phase, turn, h, y, s);
      has_left = has_left || system.left_bearing(s.end.data()) != nullptr;
      if (has_left || is_boundless(system, s.end)) {
        state.contacts = system.classify(state.instant(), y.data());
        fail(result, system, state, has_left ? Outcome::left_bearing : Outcome::not_finite,
             has_left ? "a step of RK4 leaves a bearing" : boundless_text);
        return result;
      }
      ++cost.steps;
      const bool ends_revolution = i + 1.0 == count;
      step.set(system.clock(), {phase, state.revolution}, h);
      if (observer) step.contacts = system.classify({phase, state.revolution}, y.data());
      derivative(phase + turn, s.end, s.k2);  // of the end, where the next step starts
      if (observer) dense(y, s.k1, s.end, s.k2, step);
      y.swap(s.end);
      s.k1.swap(s.k2);
      state.phase = phase + turn;
      if (ends_revolution) {
        ++state.revolution;
        state.phase = 0.0;
      }
      if (observer && !observer(step)) {
        result.outcome = Outcome::stopped_by_observer;
        state.contacts = system.classify(state.instant(), y.data());
        return result;
      }
    }
  }
  state.contacts = system.classify(state.instant(), y.data());
  return result;
}

}  // namespace whirl::inline dyn
