// The Taylor engine: trajectories in lanes.

#if defined(WHIRL_ENGINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_INL_H
#undef WHIRL_ENGINE_INL_H
#else
#define WHIRL_ENGINE_INL_H
#endif

#include <algorithm>
#include <memory>
#include <vector>

#include "libdyn/system/failure_text.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/event_finder-inl.h"
#include "libdyn/taylor/free_lanes-inl.h"
#include "libdyn/taylor/lane_record.hpp"
#include "libdyn/taylor/measures-inl.h"
#include "libdyn/taylor/motion_series-inl.h"
#include "libdyn/taylor/slope_run.hpp"
#include "libdyn/taylor/step_length-inl.h"
#include "libdyn/taylor/sticking-inl.h"
#include "libdyn/taylor/variation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What the engine keeps for numbers with slopes (slope_carrier-inl.h); else nothing.
template <class P, bool = carries_slopes<P>>
class SlopeCarrier {};

/// Every step has the first order, but for those of slopes (SlopeLimit::choose_order).
template <class P>
SeriesOrders series_orders(const BatchOptions& options) {
  const int first = options.order > 0 ? options.order : order_for(options.tolerance);
  const bool is_chosen = carries_slopes<P> && options.order == 0 && !options.tangent;
  return {first, is_chosen ? std::max(order_of_slopes, first) : first};
}

/// Hands trajectories to lanes and takes all of them through their steps. What a step is made of is
/// in its parts.
template <class P>
class Engine {
 public:
  using Mask = typename P::Mask;
  using Number = typename P::Number;

  Engine(const Pattern& pattern, const BatchOptions& options)
      : options_(options),
        motion_(pattern, series_orders<P>(options),
                options.exponents || options.tangent || carries_slopes<P>),
        records_(static_cast<size_t>(P::lanes())) {
    if constexpr (knows_tangents<P>) {
      if (!options.exponents && !options.tangent) return;
      variation_ = std::make_unique<Variation<P>>(motion_, sticking_, options_);
    }
  }

  /// From now on derivatives are carried along.
  void carry_slopes(SlopeRun& run) {
    slopes_ = std::make_unique<SlopeCarrier<P>>(motion_, variation_.get(), options_, run);
  }

  /// Integrates trajectories, each in a lane of its own, refilled in order.
  HWY_ATTR void run(std::span<Trajectory> all, const Observer* observer) {
    size_t next = 0;
    for (int l = 0; l < P::lanes(); ++l) {
      if (next < all.size()) load(l, all[next++]);
    }
    while (motion_.active != 0) {
      if (finished_ == 0) step(observer);
      if (watch_.says_stop(options_.watch)) {
        for (uint64_t rest = motion_.active & ~finished_; rest != 0; rest &= rest - 1) {
          const int l = __builtin_ctzll(rest);
          records_[static_cast<size_t>(l)].trajectory->outcome = Outcome::stopped_by_observer;
        }
        for (; next < all.size(); ++next) all[next].outcome = Outcome::stopped_by_observer;
        finished_ = motion_.active;
      }
      for (uint64_t rest = finished_; rest != 0; rest &= rest - 1) {
        const int l = __builtin_ctzll(rest);
        unload(l);
        finished_ &= ~(uint64_t{1} << l);
        if (next < all.size()) load(l, all[next++]);
      }
    }
  }

 private:
  HWY_ATTR void load(int l, Trajectory& t);
  HWY_ATTR void unload(int l);
  HWY_ATTR void fail(int l, Outcome outcome, const char* what);

  // engine_step-inl.h
  HWY_ATTR void step(const Observer* observer);
  HWY_ATTR void fail_steps(uint64_t bad);
  HWY_ATTR void end_revolutions(uint64_t ends, bool is_observed);
  HWY_ATTR void end_of_step_of_exponents(uint64_t ends);

  // engine_events-inl.h
  HWY_ATTR void apply_events(uint64_t instant);
  HWY_ATTR void apply_rare_event(int l, size_t i);

  bool has_tangents() const { return knows_tangents<P> && variation_ != nullptr; }

  BatchOptions options_;
  MotionLanes<P> motion_;
  Sticking<P> sticking_{motion_};
  MotionSeries<P> series_{motion_, sticking_};
  StepLength<P> length_{options_.tolerance};
  EventFinder<P> events_{motion_};
  std::unique_ptr<Variation<P>> variation_;
  std::unique_ptr<SlopeCarrier<P>> slopes_;

  std::vector<LaneRecord> records_;
  long steps_ = 0;
  Watch watch_;
  uint64_t finished_ = 0;  // lanes whose trajectories are done
};

template <class P>
HWY_ATTR void Engine<P>::load(int l, Trajectory& t) {
  const ContactSystem& s = *t.system;
  LaneRecord& record = records_[static_cast<size_t>(l)];
  record = {};
  record.trajectory = &t;
  record.first_step = steps_;
  record.revolution = record.first_revolution = t.state.revolution;
  record.first_phase = t.state.phase;
  record.last = t.state.revolution + t.revolutions;
  record.free_since = t.state.revolution;
  record.certificate_due = t.state.revolution + 1;
  record.impacts.assign(motion_.contacts.size(), 0.0);
  if (t.state.contacts.size() != motion_.contacts.size()) {
    t.state.contacts = s.classify(t.state.instant(), t.state.y.data());
  }
  motion_.load(s, t.state, l);
  if constexpr (!P::is_double) {
    for (int i = 0; i < t.lower_digits.size(); ++i) {
      P& y = motion_.y[static_cast<size_t>(i)];
      y = y + P(t.lower_digits(i));
    }
  }
  if constexpr (knows_tangents<P>) {
    if (has_tangents()) variation_->load(l, s);
  }
  if constexpr (carries_slopes<P>) slopes_->load(record);
  if (t.revolutions <= 0) finished_ |= uint64_t{1} << l;
}

template <class P>
HWY_ATTR void Engine<P>::unload(int l) {
  LaneRecord& record = records_[static_cast<size_t>(l)];
  Trajectory& t = *record.trajectory;
  t.state = motion_of(motion_, record.revolution, l);
  if constexpr (!P::is_double) {
    t.lower_digits.resize(motion_.layout().size());
    for (int i = 0; i < motion_.layout().size(); ++i) {
      t.lower_digits(i) = lane(motion_.y[static_cast<size_t>(i)] - P(t.state.y(i)), l);
    }
  }
  const long steps = steps_ - record.first_step;
  t.cost.steps += steps - record.no_steps;
  t.cost.evaluations += steps * (motion_.N + 1);  // one for each coefficient
  t.cost.events += record.events;
  if (options_.measures) {
    t.contacts.resize(static_cast<size_t>(t.system->owners()));
    for (size_t c = 0; c < motion_.contacts.size(); ++c) {
      const ContactLanes<P>& from = motion_.contacts[c];
      const ReducedContact& contact = t.system->contacts()[c];
      ContactTimes& m = t.contacts[static_cast<size_t>(contact.owner)];
      m.name = contact.name;
      m.in_touch += lane(from.duty, l);
      m.sticking += lane(from.stuck, l);
      m.impacts += record.impacts[c];
      m.max_normal = std::max(m.max_normal, lane(from.max_normal, l));
      m.max_tangential = std::max(m.max_tangential, lane(from.max_friction, l));
    }
  }
  if constexpr (knows_tangents<P> && !carries_slopes<P>) {
    const double turns = static_cast<double>(record.revolution - record.first_revolution);
    const double start = record.first_phase / t.system->phase_rate();
    const double end = turns * t.system->period() + t.state.phase / t.system->phase_rate();
    if (has_tangents()) variation_->unload(l, end - start, t);
  }
  motion_.active &= ~(uint64_t{1} << l);
  record.trajectory = nullptr;
}

/// Ends a trajectory that cannot go on; its state is the last good one.
template <class P>
HWY_ATTR void Engine<P>::fail(int l, Outcome outcome, const char* what) {
  const LaneRecord& record = records_[static_cast<size_t>(l)];
  Trajectory& t = *record.trajectory;
  t.outcome = outcome;
  t.failure = failure_text(*t.system, motion_of(motion_, record.revolution, l), what);
  finished_ |= uint64_t{1} << l;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
