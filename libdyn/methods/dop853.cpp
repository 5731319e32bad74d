#include "libdyn/methods/dop853.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libdyn/methods/dop853_coefficients.hpp"
#include "libdyn/methods/step_limits.hpp"
#include "libdyn/system/events.hpp"
#include "libdyn/system/failure_text.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double safety = 0.9, smallest_factor = 0.2, largest_factor = 5.0;
constexpr int most_restarts = 4;  ///< Newton steps on the length of a step to an event

class Stepper {
 public:
  Stepper(const ContactSystem& system, const IntegrationOptions& options, Cost& cost)
      : system_(system),
        options_(options),
        cost_(cost),
        layout_(system.layout()),
        k_(layout_.size(), dop853::all_stages),
        y1_(layout_.size()),
        argument_(layout_.size()) {}

  /// Derivative of the state at the start of the next steps.
  void start(const MotionState& state) { evaluate(0, state.instant(), state.y, state.contacts); }

  /// Tries a step; returns the error estimate relative to the tolerance.
  double attempt(const MotionState& from, double h) {
    h_ = h;
    const double rate = system_.phase_rate();
    for (int i = 1; i < dop853::stages; ++i) {
      combine(from.y, i);
      evaluate(i, {from.phase + dop853::c[static_cast<std::size_t>(i)] * h * rate, from.revolution},
               argument_, from.contacts);
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
    evaluate(12, {from.phase + h_ * rate, from.revolution}, y1_, from.contacts);
    for (int i = 13; i < dop853::all_stages; ++i) {
      combine(from.y, i);
      evaluate(i,
               {from.phase + dop853::c[static_cast<std::size_t>(i)] * h_ * rate, from.revolution},
               argument_, from.contacts);
    }
    // y = y0 + s (F0 + (1-s) (F1 + s (F2 + (1-s) (F3 + s (F4 + (1-s) (F5 + s F6))))))
    Eigen::Matrix<double, Eigen::Dynamic, 8> p(layout_.size(), 8);
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
    step.set(system_.clock(), from.instant(), h_);
    step.q = layout_.eta(p);
    step.v = layout_.rate(p);
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
  void evaluate(int stage, const Instant& at, const Vec& y, const ContactStates& contacts) {
    layout_.eta(k_).col(stage) = layout_.rate(y);
    system_.acceleration(at, y.data(), contacts, layout_.rates_at(k_.col(stage).data()));
    ++cost_.evaluations;
  }

  const ContactSystem& system_;
  const IntegrationOptions& options_;
  Cost& cost_;
  StateLayout layout_;
  Mat k_;
  Vec y1_, argument_;
  double h_ = 0.0;
};

/// Moves the end of a step onto an event: Newton on its length, each time with a new step.
/// @return  what is left of the event's function
double step_onto(const Event& event, const EventWatcher& watcher, Stepper& stepper,
                 const MotionState& state, Step& step, double rate) {
  const double whole = step.h;
  const auto instant = [&](double share) -> Instant {
    return {state.phase + share * whole * rate, state.revolution};
  };
  double s = event.s;
  double best = std::numeric_limits<double>::infinity(), last = best;
  for (int restart = 0; restart <= most_restarts; ++restart) {
    stepper.attempt(state, s * whole);
    const double g = watcher.value(event, instant(s), stepper.end().data(), state.contacts);
    last = std::abs(g);
    if (last <= 2e-15 || last >= 0.5 * best) break;
    best = last;
    // slope by a difference of the function over the dense output of the whole step
    Vec y(stepper.end().size());
    const double ds = 1e-6;
    step.at(s - ds, y.data());
    const double before = watcher.value(event, instant(s - ds), y.data(), state.contacts);
    step.at(s + ds, y.data());
    const double after = watcher.value(event, instant(s + ds), y.data(), state.contacts);
    const double change = -g * 2.0 * ds / (after - before);
    if (!(std::abs(change) < 0.05) || s + change <= 0.0) break;  // a graze: as good as it gets
    s += change;
  }
  stepper.dense(state, step);
  return last;
}

/// One integration: the state, the step sizes, what has happened.
class Dop853Run {
 public:
  Dop853Run(const ContactSystem& system, MotionState& state, const IntegrationOptions& options,
            const Observer& observer)
      : system_(system),
        state_(state),
        options_(options),
        observer_(observer),
        stepper_(system, options, result_.cost),
        watcher_(system),
        rate_(system.phase_rate()),
        period_(system.period()),
        h_(is_fixed() ? options.fixed_step : period_ / 50.0) {}

  Integration go(long last);

 private:
  enum class Result { goes_on, ended };

  bool is_fixed() const { return options_.fixed_step > 0.0; }
  Result fail(Outcome outcome, std::string_view what) {
    whirl::fail(result_, system_, state_, outcome, what);
    return Result::ended;
  }
  void begin_revolution() {
    ++state_.revolution;
    state_.phase = 0.0;
  }
  Result advance();
  /// Makes the next trial shorter: the error of one was too large, or an event was missed.
  Result reject(double trial, double error);
  Result miss(double trial);
  Result apply_at_once(const Event& event);
  /// @param next  size of the next step, that the error asks for
  Result accept(const std::optional<Event>& event, bool ends_revolution, double next);

  const ContactSystem& system_;
  MotionState& state_;
  const IntegrationOptions& options_;
  const Observer& observer_;
  Integration result_;
  Stepper stepper_;
  EventWatcher watcher_;
  double rate_, period_;
  double h_;
  double longest_ = std::numeric_limits<double>::infinity();  ///< after an event was missed
  bool is_rejected_ = false;
  int instant_events_ = 0;
  Step step_;
};

Integration Dop853Run::go(long last) {
  if (state_.contacts.size() != system_.contacts().size()) {
    state_.contacts = system_.classify(state_.instant(), state_.y.data());
  }
  if (system_.left_bearing(state_.y.data())) {
    fail(Outcome::left_bearing, "");
    return result_;
  }
  stepper_.start(state_);
  while (state_.revolution < last && advance() == Result::goes_on) {
  }
  return result_;
}

Dop853Run::Result Dop853Run::advance() {
  const double left = period_ - state_.phase / rate_;  // steps end on revolutions
  if (left <= too_small_step * period_) {              // an event fell on the end
    begin_revolution();
    return Result::goes_on;
  }
  double trial = std::min(h_, longest_);
  bool ends_revolution = trial >= left * (1.0 - 1e-12);
  if (ends_revolution) {
    trial = left;
  } else if (!is_fixed() && trial > 0.5 * left) {
    trial = 0.5 * left;
  }
  const double error = stepper_.attempt(state_, trial);
  if (!std::isfinite(error) || (error > 1.0 && !is_fixed())) return reject(trial, error);
  double factor = error > 0.0 ? safety * std::pow(error, -1.0 / 8.0) : largest_factor;
  factor = std::clamp(factor, smallest_factor, is_rejected_ ? 1.0 : largest_factor);
  is_rejected_ = false;

  stepper_.dense(state_, step_);
  const auto event = watcher_.first(step_);
  if (event) {
    ends_revolution = false;
    if (event->s * trial <= too_small_step * period_) return apply_at_once(*event);
    const double remainder = step_onto(*event, watcher_, stepper_, state_, step_, rate_);
    if (!std::isfinite(remainder)) return fail(Outcome::not_finite, "a distance overflowed");
    if (remainder > missed_event) return miss(trial);
    ++result_.cost.events;
  }
  return accept(event, ends_revolution, trial * factor);
}

Dop853Run::Result Dop853Run::reject(double trial, double error) {
  ++result_.cost.rejected;
  is_rejected_ = true;
  const bool is_finite = std::isfinite(error);
  h_ = trial * (is_finite ? std::max(smallest_factor, safety * std::pow(error, -1.0 / 8.0)) : 0.1);
  if (h_ >= too_small_step * period_) return Result::goes_on;
  return fail(is_finite ? Outcome::step_too_small : Outcome::not_finite, "the step underflowed");
}

Dop853Run::Result Dop853Run::miss(double trial) {
  ++result_.cost.rejected;
  longest_ = 0.5 * trial;
  if (longest_ >= too_small_step * period_) return Result::goes_on;
  return fail(Outcome::step_too_small, "an event could not be located");
}

Dop853Run::Result Dop853Run::apply_at_once(const Event& event) {
  if (++instant_events_ > most_instant_events) {
    return fail(Outcome::step_too_small, "events follow without time passing");
  }
  ++result_.cost.events;
  watcher_.apply(event, state_.instant(), state_.y.data(), state_.contacts);
  stepper_.start(state_);
  return Result::goes_on;
}

Dop853Run::Result Dop853Run::accept(const std::optional<Event>& event, bool ends_revolution,
                                    double next) {
  if (is_boundless(system_, stepper_.end())) return fail(Outcome::step_too_small, boundless_text);
  instant_events_ = 0;
  longest_ = std::numeric_limits<double>::infinity();
  state_.y = stepper_.end();
  state_.phase += step_.turn();
  if (ends_revolution) begin_revolution();
  ++result_.cost.steps;
  watcher_.moved_on();
  if (event) {
    watcher_.apply(*event, state_.instant(), state_.y.data(), state_.contacts);
  } else if (!is_fixed()) {
    h_ = ends_revolution ? std::max(h_, next) : next;
  }
  const bool sticks = std::any_of(state_.contacts.begin(), state_.contacts.end(),
                                  [](const ContactState& c) { return c.touch == Touch::sticking; });
  if (sticks) system_.remove_slip(state_.y.data(), state_.contacts);
  event || sticks ? stepper_.start(state_) : stepper_.reuse_last();
  if (!observer_ || observer_(step_)) return Result::goes_on;
  result_.outcome = Outcome::stopped_by_observer;
  return Result::ended;
}

}  // namespace

Integration Dop853::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                              const IntegrationOptions& options, const Observer& observer) {
  return Dop853Run(system, state, options, observer).go(state.revolution + revolutions);
}

}  // namespace whirl::inline dyn
