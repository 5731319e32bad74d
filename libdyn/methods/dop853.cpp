#include "libdyn/methods/dop853.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libdyn/methods/dop853_coefficients.hpp"
#include "libdyn/system/diagnosis.hpp"
#include "libdyn/system/events.hpp"

namespace whirl {

namespace {

constexpr double safety = 0.9, smallest_factor = 0.2, largest_factor = 5.0;
constexpr double too_small = 1e-14;      ///< of a revolution
constexpr int most_instant_events = 50;  ///< without time passing
constexpr int most_restarts = 4;         ///< Newton steps on the length of a step to an event
constexpr double missed = 1e-6;  ///< an event's function there: the step was too coarse for it

class Stepper {
 public:
  Stepper(const ContactSystem& system, const IntegrationOptions& options, Cost& cost)
      : system_(system),
        options_(options),
        cost_(cost),
        n_(system.coordinates()),
        k_(2 * n_, dop853::all_stages),
        y1_(2 * n_),
        argument_(2 * n_) {}

  /// Derivative of the state at the start of the next steps.
  void start(const MotionState& state) { evaluate(0, state.phase, state.y, state.contacts); }

  /// Tries a step; returns the error estimate relative to the tolerance.
  double attempt(const MotionState& from, double h) {
    h_ = h;
    const double rate = system_.phase_rate();
    for (int i = 1; i < dop853::stages; ++i) {
      combine(from.y, i);
      evaluate(i, from.phase + dop853::c[static_cast<std::size_t>(i)] * h * rate, argument_,
               from.contacts);
    }
    combine(from.y, dop853::stages);
    y1_ = argument_;
    double five = 0.0, three = 0.0;
    for (Eigen::Index i = 0; i < y1_.size(); ++i) {
      double e5 = 0.0, e3 = 0.0;
      for (std::size_t j = 0; j < 12; ++j) {
        const double k = k_(i, static_cast<Eigen::Index>(j));
        e5 += dop853::e5[j] * k;
        e3 += (dop853::a[12][j] - dop853::b3[j]) * k;
      }
      const double size = std::max(std::abs(from.y(i)), std::abs(y1_(i)));
      const double weight = options_.tolerance * (system_.state_scale()(i) + size);
      five += e5 * e5 / (weight * weight);
      three += e3 * e3 / (weight * weight);
    }
    const double denominator = five + 0.01 * three;
    if (denominator == 0.0) return 0.0;
    return std::abs(h) * five / std::sqrt(denominator * static_cast<double>(y1_.size()));
  }

  const Vec& end() const { return y1_; }

  /// Completes the stages and gives the step as polynomials.
  void dense(const MotionState& from, Step& step) {
    const double rate = system_.phase_rate();
    evaluate(12, from.phase + h_ * rate, y1_, from.contacts);
    for (int i = 13; i < dop853::all_stages; ++i) {
      combine(from.y, i);
      evaluate(i, from.phase + dop853::c[static_cast<std::size_t>(i)] * h_ * rate, argument_,
               from.contacts);
    }
    // y = y0 + s (F0 + (1-s) (F1 + s (F2 + (1-s) (F3 + s (F4 + (1-s) (F5 + s F6))))))
    Eigen::Matrix<double, Eigen::Dynamic, 8> p(2 * n_, 8);
    p.setZero();
    const auto times_s = [&] {
      for (int k = 7; k > 0; --k) p.col(k) = p.col(k - 1);
      p.col(0).setZero();
    };
    const auto times_one_minus_s = [&] {
      for (int k = 7; k > 0; --k) p.col(k) -= p.col(k - 1);
    };
    const Vec change = y1_ - from.y;
    for (int row = 6; row >= 3; --row) {
      const auto& d = dop853::d[static_cast<std::size_t>(row - 3)];
      for (int j = 0; j < dop853::all_stages; ++j) {
        if (d[static_cast<std::size_t>(j)] != 0.0) {
          p.col(0) += h_ * d[static_cast<std::size_t>(j)] * k_.col(j);
        }
      }
      row % 2 == 0 ? times_s() : times_one_minus_s();
    }
    p.col(0) += 2.0 * change - h_ * (k_.col(0) + k_.col(12));
    times_s();
    p.col(0) += h_ * k_.col(0) - change;
    times_one_minus_s();
    p.col(0) += change;
    times_s();
    p.col(0) += from.y;
    step.revolution = from.revolution;
    step.phase = from.phase;
    step.h = h_;
    step.turn = h_ * rate;
    step.q = p.topRows(n_);
    step.v = p.bottomRows(n_);
    step.contacts = from.contacts;
  }

  /// The derivative at the end becomes the one at the start of the next step.
  void reuse_last() { k_.col(0) = k_.col(12); }

 private:
  void combine(const Vec& y0, int stage) {
    argument_ = y0;
    const auto& a = dop853::a[static_cast<std::size_t>(stage)];
    for (int j = 0; j < stage; ++j) {
      const double weight = a[static_cast<std::size_t>(j)];
      if (weight != 0.0) argument_ += (h_ * weight) * k_.col(j);
    }
  }
  void evaluate(int stage, double phase, const Vec& y, const ContactStates& contacts) {
    k_.col(stage).head(n_) = y.tail(n_);
    system_.acceleration(phase, y.data(), contacts, k_.col(stage).data() + n_);
    ++cost_.evaluations;
  }

  const ContactSystem& system_;
  const IntegrationOptions& options_;
  Cost& cost_;
  Eigen::Index n_;
  Mat k_;
  Vec y1_, argument_;
  double h_ = 0.0;
};

/// Moves the end of a step onto an event: Newton on its length, each time with a new step.
/// @return  what is left of the event's function
double step_onto(const Event& event, const EventWatcher& watcher, Stepper& stepper,
                 const MotionState& state, Step& step, double rate) {
  const double whole = step.h;
  double s = event.s;
  double best = std::numeric_limits<double>::infinity(), last = best;
  for (int restart = 0; restart <= most_restarts; ++restart) {
    stepper.attempt(state, s * whole);
    const double g =
        watcher.value(event, state.phase + s * whole * rate, stepper.end().data(), state.contacts);
    last = std::abs(g);
    if (last <= 2e-15 || last >= 0.5 * best) break;
    best = last;
    // slope by a difference of the function over the dense output of the whole step
    Vec y(stepper.end().size());
    const double ds = 1e-6;
    step.at(s - ds, y.data());
    const double before =
        watcher.value(event, state.phase + (s - ds) * whole * rate, y.data(), state.contacts);
    step.at(s + ds, y.data());
    const double after =
        watcher.value(event, state.phase + (s + ds) * whole * rate, y.data(), state.contacts);
    const double change = -g * 2.0 * ds / (after - before);
    if (!(std::abs(change) < 0.05) || s + change <= 0.0) break;  // a graze: as good as it gets
    s += change;
  }
  stepper.dense(state, step);
  return last;
}

}  // namespace

Integration Dop853::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                              const IntegrationOptions& options, const Observer& observer) {
  Integration result;
  Cost& cost = result.cost;
  Stepper stepper(system, options, cost);
  EventWatcher watcher(system);
  const double rate = system.phase_rate(), period = system.period();
  const long last = state.revolution + revolutions;
  double h = options.fixed_step > 0.0 ? options.fixed_step : period / 50.0;
  double longest = std::numeric_limits<double>::infinity();  // after an event was missed
  bool is_rejected = false;
  int instant_events = 0;
  Step step;
  if (state.contacts.size() != system.contacts().size()) {
    state.contacts = system.classify(state.phase, state.y.data());
  }
  if (system.left_bearing(state.y.data())) {
    fail(result, system, state, Outcome::left_bearing, "");
    return result;
  }
  stepper.start(state);

  while (state.revolution < last) {
    const double left = period - state.phase / rate;  // steps end on revolutions
    if (left <= too_small * period) {                 // an event fell on the end
      ++state.revolution;
      state.phase = 0.0;
      continue;
    }
    double trial = std::min(h, longest);
    bool ends_revolution = false;
    if (trial >= left * (1.0 - 1e-12)) {
      trial = left;
      ends_revolution = true;
    } else if (options.fixed_step == 0.0 && trial > 0.5 * left) {
      trial = 0.5 * left;
    }
    const double error = stepper.attempt(state, trial);
    if (!std::isfinite(error) || (error > 1.0 && options.fixed_step == 0.0)) {
      ++cost.rejected;
      is_rejected = true;
      const double factor = std::isfinite(error)
                                ? std::max(smallest_factor, safety * std::pow(error, -1.0 / 8.0))
                                : 0.1;
      h = trial * factor;
      if (h < too_small * period) {
        fail(result, system, state,
             std::isfinite(error) ? Outcome::step_too_small : Outcome::not_finite,
             "the step underflowed");
        return result;
      }
      continue;
    }
    double factor = error > 0.0 ? safety * std::pow(error, -1.0 / 8.0) : largest_factor;
    factor = std::clamp(factor, smallest_factor, is_rejected ? 1.0 : largest_factor);
    is_rejected = false;

    stepper.dense(state, step);
    const auto event = watcher.first(step);
    if (event) {
      ends_revolution = false;
      const bool is_instant = event->s * trial <= too_small * period;
      if (is_instant && ++instant_events > most_instant_events) {
        result.outcome = Outcome::step_too_small;
        result.diagnosis = diagnosis(system, state, "events follow without time passing");
        return result;
      }
      if (is_instant) {
        ++cost.events;
        watcher.apply(*event, state.phase, state.y.data(), state.contacts);
        stepper.start(state);
        continue;
      }
      const double remainder = step_onto(*event, watcher, stepper, state, step, rate);
      if (!std::isfinite(remainder)) {
        result.outcome = Outcome::not_finite;
        result.diagnosis = diagnosis(system, state, "a distance overflowed");
        return result;
      }
      if (remainder > missed) {
        ++cost.rejected;
        longest = 0.5 * trial;
        if (longest < too_small * period) {
          result.outcome = Outcome::step_too_small;
          result.diagnosis = diagnosis(system, state, "an event could not be located");
          return result;
        }
        continue;
      }
      ++cost.events;
    }
    instant_events = 0;
    longest = std::numeric_limits<double>::infinity();

    state.y = stepper.end();
    state.phase += step.turn;
    if (ends_revolution) {
      ++state.revolution;
      state.phase = 0.0;
    }
    ++cost.steps;
    watcher.moved_on();
    bool must_restart = false;
    if (event) {
      watcher.apply(*event, state.phase, state.y.data(), state.contacts);
      must_restart = true;
    } else if (options.fixed_step == 0.0 && !ends_revolution) {
      h = trial * factor;
    } else if (options.fixed_step == 0.0) {
      h = std::max(h, trial * factor);
    }
    for (const ContactState& c : state.contacts) {
      if (c.touch != Touch::sticking) continue;
      system.remove_slip(state.y.data(), state.contacts);
      must_restart = true;
      break;
    }
    must_restart ? stepper.start(state) : stepper.reuse_last();
    if (observer && !observer(step)) {
      result.outcome = Outcome::stopped_by_observer;
      return result;
    }
  }
  return result;
}

}  // namespace whirl
