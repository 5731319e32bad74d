#include "libdyn/methods/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libbase/error.hpp"
#include "libdyn/flow/free_flight.hpp"
#include "libdyn/methods/contact_step.hpp"
#include "libdyn/methods/step_limits.hpp"
#include "libdyn/system/failure_text.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_corrections = 5;     ///< of the place of an event
constexpr double rounding = 4e-15;      ///< of an event's function
constexpr double coarsest_path = 1e-4;  ///< error of a path in free flight, by the clearance
constexpr double wanted_path = 1e-6;    ///< the same, aimed at
constexpr double whole_turn = 2.0 * std::numbers::pi;

/// The last piece of a step, which the observer has not seen.
struct HeldPiece {
  Step piece;
  Vec end;
  bool is_there = false;
};

bool touches(const MotionState& state) {
  return std::any_of(state.contacts.begin(), state.contacts.end(),
                     [](const ContactState& c) { return c.in_touch(); });
}

/// One integration: the state, the step sizes, what has happened.
class CollocationRun {
 public:
  CollocationRun(const ContactSystem& system, MotionState& state, const IntegrationOptions& options,
                 const Observer& observer)
      : system_(system),
        state_(state),
        options_(options),
        observer_(observer),
        watcher_(system),
        free_flight_(system),
        step_(system, is_fixed() ? options.fixed_step : system.period(), options.tolerance) {
    if (state.contacts.size() != system.contacts().size()) {
      state.contacts = system.classify(state.instant(), state.y.data());
    }
    if (is_fixed()) return;
    const double w = contact_frequency(system);
    const double shortest = too_small_step * system.period();
    if (w > 0.0) touch_ = step_.rung_for(std::clamp(1.0 / w, shortest, system.period()));
    flight_ = {4};
  }

  Integration go(long last);

 private:
  enum class Result { goes_on, ended };

  bool is_fixed() const { return options_.fixed_step > 0.0; }
  Result fail(Outcome outcome, std::string_view what) {
    result_.outcome = outcome;
    result_.failure = failure_text(system_, state_, what);
    return Result::ended;
  }
  Result advance();
  /// To the end of a step.
  void move_on(double turn, bool ends_revolution, const std::optional<Event>& event);
  Result finish(long last);
  /// Gives the pieces of a step but the last to the observer; true if it stopped there.
  bool show(double limit);
  /// Gives the last one, after the state has moved on.
  Result show_last();
  /// Moves the end of a step onto an event; what is left of the event's function.
  double locate(Event& event, double h);
  void choose_next(Rung tried, bool touched);

  const ContactSystem& system_;
  MotionState& state_;
  const IntegrationOptions& options_;
  const Observer& observer_;
  EventWatcher watcher_;
  FreeFlight free_flight_;
  ContactStep step_;
  Rung touch_, flight_;
  bool may_be_certain_ = true;
  int instant_events_ = 0;
  Vec end_;
  HeldPiece held_;
  Integration result_;
};

Integration CollocationRun::go(long last) {
  while (state_.revolution < last) {
    if (!state_.y.allFinite()) {
      fail(Outcome::not_finite, "the state is no number");
      break;
    }
    if (may_be_certain_ && !is_fixed() && free_flight_.is_certain(state_)) {
      finish(last);
      break;
    }
    if (advance() == Result::ended) break;
  }
  result_.cost.evaluations = step_.evaluations();
  return result_;
}

double CollocationRun::locate(Event& event, double h) {
  if (event.kind == EventKind::stick_limit) {  // from the forces of the step, which are unknowns
    step_.advance(event.s, state_, end_);
    return 0.0;
  }
  // Newton's method, then secants, on the exact motion under the step's forces
  const double rate = system_.phase_rate();
  const auto value = [&](double s) {
    step_.advance(s, state_, end_);
    return watcher_.value(event, {state_.phase + s * h * rate, state_.revolution}, end_.data(),
                          state_.contacts);
  };
  double s = event.s, g = value(s), slope = step_.event_slope();
  for (int i = 0; i < most_corrections && std::abs(g) > rounding; ++i) {
    const double next = s - g / slope;
    if (!(std::abs(next - s) < 0.05) || next <= 0.0 || next > 1.0) break;
    const double g_next = value(next);
    if (!(std::abs(g_next) < 0.5 * std::abs(g))) {  // as good as it gets
      step_.advance(s, state_, end_);
      break;
    }
    slope = (g_next - g) / (next - s);
    s = next;
    g = g_next;
  }
  event.s = s;
  return std::abs(g);
}

void CollocationRun::choose_next(Rung tried, bool touched) {
  if (is_fixed()) return;
  const auto next = [&](double error, int order) {
    const double factor = 0.9 * std::pow(std::max(error, 1e-10), -1.0 / order);
    const int rungs = static_cast<int>(std::floor(2.0 * std::log2(factor)));
    return Rung{std::max(0, tried.number - std::clamp(rungs, -2, 2))};
  };
  if (touched) {
    touch_ = next(step_.error(), StepTables::terms);
  } else {
    flight_ = next(step_.path_error() / wanted_path, StepTables::samples - 2);
  }
}

CollocationRun::Result CollocationRun::advance() {
  const double rate = system_.phase_rate(), period = system_.period();
  const double left = period - state_.phase / rate;
  if (left <= too_small_step * period) {
    ++state_.revolution;
    state_.phase = 0.0;
    return Result::goes_on;
  }
  const bool touched = touches(state_);
  Rung rung = touched ? touch_ : flight_;
  while (!is_fixed() && step_.size({rung.number + 1}) >= left * (1.0 - 1e-12)) ++rung.number;
  const auto shorten = [&](int by) {
    ++result_.cost.rejected;
    (touched ? touch_ : flight_).number = rung.number + by;
    if (step_.size({rung.number + by}) < too_small_step * period || is_fixed()) {
      return fail(Outcome::step_too_small, "the step underflowed");
    }
    return Result::goes_on;
  };
  if (!step_.solve(rung, state_)) return shorten(2);
  if (!is_fixed() && step_.error() > 1.0) {
    const double factor = 0.9 * std::pow(step_.error(), -1.0 / StepTables::terms);
    return shorten(static_cast<int>(std::clamp(std::ceil(-2.0 * std::log2(factor)), 1.0, 6.0)));
  }
  const double h = step_.size(rung);
  double limit = left / h;
  bool ends_revolution = true;
  if (limit > 1.0 + 1e-12) {
    limit = 1.0;
    ends_revolution = false;
  } else if (limit > 1.0 - 1e-12) {
    limit = 1.0;
  }
  bool is_sure = true;
  std::optional<Event> event = step_.first_event(watcher_, limit, state_, is_sure);
  if (!is_fixed() && (!is_sure || (!touched && step_.path_error() > coarsest_path))) {
    return shorten(1);
  }
  if (event && event->s * h <= too_small_step * period) {
    if (++instant_events_ > most_instant_events) {
      return fail(Outcome::step_too_small, "events follow without time passing");
    }
    ++result_.cost.events;
    watcher_.apply(*event, state_.instant(), state_.y.data(), state_.contacts);
    return Result::goes_on;
  }
  if (event) {
    if (locate(*event, h) > missed_event) return shorten(1);
    limit = event->s;
    ends_revolution = false;
    ++result_.cost.events;
  } else {
    step_.advance(limit, state_, end_);
  }
  if (is_boundless(system_, end_)) return fail(Outcome::step_too_small, boundless_text);
  instant_events_ = 0;
  if (observer_ && show(limit)) return Result::ended;
  move_on(limit * h * rate, ends_revolution, event);
  choose_next(rung, touched);
  return show_last();
}

void CollocationRun::move_on(double turn, bool ends_revolution, const std::optional<Event>& event) {
  state_.y = end_;
  state_.phase += turn;
  if (ends_revolution) {
    ++state_.revolution;
    state_.phase = 0.0;
  }
  watcher_.moved_on();
  if (event) watcher_.apply(*event, state_.instant(), state_.y.data(), state_.contacts);
  may_be_certain_ = event.has_value() || ends_revolution;
  system_.remove_slip(state_.y.data(), state_.contacts);
}

bool CollocationRun::show(double limit) {
  held_.is_there = false;
  const bool goes_on = step_.dense(state_, limit, [&](const Step& piece, const Vec& end) {
    if (held_.is_there) {
      ++result_.cost.steps;
      if (!observer_(held_.piece)) return false;
    }
    held_ = {piece, end, true};
    return true;
  });
  if (goes_on) return false;
  state_.y = held_.end;
  state_.phase = held_.piece.angle(1.0);
  result_.outcome = Outcome::stopped_by_observer;
  return true;
}

CollocationRun::Result CollocationRun::show_last() {
  if (!observer_) {
    ++result_.cost.steps;
    return Result::goes_on;
  }
  ++result_.cost.steps;
  if (observer_(held_.piece)) return Result::goes_on;
  result_.outcome = Outcome::stopped_by_observer;
  return Result::ended;
}

CollocationRun::Result CollocationRun::finish(long last) {
  if (!observer_) {
    ++result_.cost.steps;
    free_flight_.finish(state_, last);
    if (is_boundless(system_, state_.y)) return fail(Outcome::step_too_small, boundless_text);
    return Result::goes_on;
  }
  while (state_.revolution < last) {
    step_.solve({0}, state_);
    const double limit = 1.0 - state_.phase / whole_turn;
    step_.advance(limit, state_, end_);
    if (is_boundless(system_, end_)) return fail(Outcome::step_too_small, boundless_text);
    if (show(limit)) return Result::ended;
    state_.y = end_;
    state_.phase = 0.0;
    ++state_.revolution;
    if (show_last() == Result::ended) return Result::ended;
  }
  return Result::goes_on;
}

}  // namespace

Integration Collocation::integrate(const ContactSystem& system, MotionState& state,
                                   long revolutions, const IntegrationOptions& options,
                                   const Observer& observer) {
  abilities.require(system);
  return CollocationRun(system, state, options, observer).go(state.revolution + revolutions);
}

bool prefers_collocation(const ContactSystem& system) {
  return Collocation::abilities.can(system) &&
         fastest_mode(system) > 10.0 * contact_frequency(system);
}

}  // namespace whirl::inline dyn
