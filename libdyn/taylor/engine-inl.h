// The Taylor engine: trajectories in lanes.

#if defined(WHIRL_ENGINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_INL_H
#undef WHIRL_ENGINE_INL_H
#else
#define WHIRL_ENGINE_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "libdyn/flow/free_flight.hpp"
#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/system/events.hpp"
#include "libdyn/system/failure_text.hpp"
#include "libdyn/system/saltation.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/blade_disks-inl.h"
#include "libdyn/taylor/contact_loading-inl.h"
#include "libdyn/taylor/equation_lanes-inl.h"
#include "libdyn/taylor/events-inl.h"
#include "libdyn/taylor/film_lanes-inl.h"
#include "libdyn/taylor/slope_run.hpp"
#include "libdyn/taylor/tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What the engine keeps for numbers with slopes; else nothing.
template <class P, bool = carries_slopes<P>>
struct SlopeWork {};

template <class P>
class Engine {
 public:
  using Mask = typename P::Mask;
  using Number = typename P::Number;

  Engine(const Pattern& pattern, const BatchOptions& options)
      : pattern_(pattern),
        options_(options),
        N(options.order > 0 ? options.order : order_for(options.tolerance)),
        n_(pattern.n),
        lanes_(P::lanes()),
        log2_tolerance_(std::log2(options.tolerance)),
        equations_(pattern, pattern.bodies > 0 ? N + 1 : 0) {
    const auto n = static_cast<size_t>(n_);
    terms_.assign(n * static_cast<size_t>(N + 3), P(0.0));
    load_.assign(n * static_cast<size_t>(N + 1), P(0.0));
    scale_.assign(n, P(1.0));
    y_.assign(static_cast<size_t>(layout().size()), P(0.0));
    contacts_.reserve(pattern.contacts.size());
    const bool wants_tangents = options.exponents || options.tangent;
    const bool has_slopes = wants_tangents || carries_slopes<P>;
    for (const Pattern::ContactRows& rows : pattern.contacts) {
      contacts_.emplace_back(rows, N, has_slopes);
    }
    event_masks_.resize(contacts_.size());
    disks_ = disks_of(pattern, contacts_);
    alike_.assign(pattern.alike.size(), 0);
    for (const Pattern::ContactRows& rows : pattern.contacts) {
      is_analytic_ = is_analytic_ && rows.is_analytic;
    }
    for (const Pattern::FilmRows& rows : pattern.films) {
      films_.push_back(std::make_unique<FilmLanes<P>>(rows, N, has_slopes));
      is_analytic_ = false;  // near the wall steps get as short as at a surface
    }
    trajectory_.assign(static_cast<size_t>(lanes_), nullptr);
    records_.resize(static_cast<size_t>(lanes_));
    if constexpr (knows_tangents) {
      if (!wants_tangents) return;
      tangents_ = std::make_unique<Tangents<P>>();
      prepare_tangents();
    }
  }

  /// From now on derivatives are carried along.
  void carry_slopes(SlopeRun& run) { slopes_ = std::make_unique<SlopeWork<P>>(run); }

  /// Integrates trajectories, each in a lane of its own, refilled in order.
  HWY_ATTR void run(std::span<Trajectory> all, const Observer* observer) {
    size_t next = 0;
    for (int l = 0; l < lanes_; ++l) {
      if (next < all.size()) load(l, all[next++]);
    }
    while (active_ != 0) {
      if (finished_ == 0) step(observer);
      if (options_.watch && ++watched_steps_ % watch_interval == 0 &&
          !options_.watch(revolutions_)) {
        for (uint64_t rest = active_ & ~finished_; rest != 0; rest &= rest - 1) {
          const int l = __builtin_ctzll(rest);
          trajectory_[static_cast<size_t>(l)]->outcome = Outcome::stopped_by_observer;
        }
        for (; next < all.size(); ++next) all[next].outcome = Outcome::stopped_by_observer;
        finished_ = active_;
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
  /// What is kept per lane in plain numbers.
  struct LaneRecord {
    long last = 0;  ///< revolution at which it is done
    long revolution = 0;
    long first_revolution = 0;
    double first_phase = 0.0;
    long first_step = 0;  ///< of the engine, when it was loaded
    long no_steps = 0;    ///< of the engine, in which no time passed here
    int instant_events = 0;
    long events = 0;
    std::vector<double> impacts;
    long free_since = 0;       ///< revolution after the last contact
    long events_before = 0;    ///< at the end of the revolution before
    long certificate_due = 0;  ///< revolution at which free flight is looked into
    std::unique_ptr<FreeFlight> free_flight;
    std::unique_ptr<EventWatcher> watcher;  ///< for events that are rare
  };

  /// Lanes in which an event ended the step, by kind.
  struct EventMask {
    uint64_t distance = 0, force = 0, slip = 0, stick = 0;
    uint64_t any() const { return distance | force | slip | stick; }
    void remove(uint64_t lanes) {
      for (uint64_t* f : {&distance, &force, &slip, &stick}) *f &= ~lanes;
    }
  };

  HWY_ATTR void load(int l, Trajectory& t);
  HWY_ATTR void load_system(const ContactSystem& s, const MotionState& at, int l);
  HWY_ATTR void unload(int l);
  StateLayout layout() const { return n_; }
  HWY_ATTR Vec state_of(int l) const;
  HWY_ATTR void set_state(int l, const Vec& y);
  HWY_ATTR ContactStates contacts_of(int l) const;
  HWY_ATTR MotionState motion_of(int l) const;
  HWY_ATTR void fail(int l, Outcome outcome, const char* what);

  // engine_step-inl.h
  HWY_ATTR void step(const Observer* observer);
  HWY_ATTR void fail_steps(uint64_t bad);
  HWY_ATTR void end_revolutions(uint64_t ends, bool is_observed);
  HWY_ATTR P step_length();
  template <int Bodies>
  HWY_ATTR void evaluate(const P* terms, const P& h, P* y) const;
  HWY_ATTR void measure(const P& h);
  HWY_ATTR P shared_friction(size_t i, const P& t) const;
  HWY_ATTR void fly_on(int l);
  HWY_ATTR void remove_slip(int l);
  HWY_ATTR bool tell(const Observer& observer, double h);

  // engine_series-inl.h, engine_bodies-inl.h
  HWY_ATTR void series();
  /// Whether series_of_bodies can make this step.
  bool is_rotor_in_stator() const { return pattern_.bodies == 2 && !contacts_[0].any_has_tau; }
  __attribute__((flatten)) HWY_ATTR void series_of_any();
  template <int Bodies, bool Isotropic, class V, class Law>
  __attribute__((flatten)) HWY_ATTR void series_of_bodies(Law& law);
  template <class V>
  HWY_ATTR inline void accelerate(int k, P* to);
  template <class V>
  HWY_ATTR void find_load();
  template <class V>
  HWY_ATTR inline void oscillate(const V& rate, const V& angle, const std::vector<P>& fc,
                                 const std::vector<P>& fs, const auto& put) const;
  void find_leaders();
  HWY_ATTR void stick(int k);
  HWY_ATTR void solve_influence();

  // engine_events-inl.h
  HWY_ATTR uint64_t find_events(P& h);
  HWY_ATTR bool is_out_of_reach(const BladeLanes<P>& disk, const P& h) const;
  HWY_ATTR void watch_force(size_t i, P& h);
  HWY_ATTR void watch_slip(size_t i, P& h);
  HWY_ATTR void note_slip(size_t i, uint64_t asked, P& h);
  HWY_ATTR void watch_stick(size_t i, P& h);
  HWY_ATTR void note(size_t i, uint64_t EventMask::*kind, const Mask& fell);
  HWY_ATTR void apply_events(uint64_t instant);
  HWY_ATTR void apply_rare_event(int l, size_t i);
  uint64_t joins_sticking(size_t i) const;

  // engine_tangents-inl.h
  /// Packs of several registers are for motions alone: their tangents would not fit the caches.
  static constexpr bool knows_tangents = P::blocks == 1;
  bool has_tangents() const { return knows_tangents && tangents_ != nullptr; }
  HWY_ATTR void prepare_tangents();
  HWY_ATTR void load_tangents(int l, const ContactSystem& s);
  HWY_ATTR void unload_tangents(int l, double time, Trajectory& to);
  HWY_ATTR P limit_for_tangents(const P& h);
  HWY_ATTR void move_tangents(const P& h);
  HWY_ATTR void jump_tangents(int l, const Saltation& s);
  HWY_ATTR uint64_t due_lanes(uint64_t ends) const;
  HWY_ATTR void orthonormalize(uint64_t due);
  HWY_ATTR void keep_growths(uint64_t ends);
  HWY_ATTR void add_divergence(const P& h);
  HWY_ATTR P contact_divergence(size_t i, const P& h);
  template <int Bodies>
  __attribute__((flatten)) HWY_ATTR void move_columns(P* columns, bool any_sticks, const P& h);
  template <int Bodies>
  HWY_ATTR inline void accelerate_columns(int k, const P* forces, P* to_a, P* to_b);
  HWY_ATTR void stick_column(typename Tangents<P>::Track& track, int k);

  // engine_slopes-inl.h, of numbers with slopes; the motion is in lane 0
  HWY_ATTR void load_slopes(const Trajectory& t);
  HWY_ATTR void begin_revolution_of_neighbors(long revolution);
  HWY_ATTR P limit_for_slopes(const P& h);
  HWY_ATTR P to_fixed_phase(const P& h) const;
  HWY_ATTR double elapsed() const;
  HWY_ATTR void take_samples(const P& h);
  HWY_ATTR void jump_slopes(size_t i, EventKind kind, const Saltation& s);
  HWY_ATTR void find_grazes(const P& h);
  HWY_ATTR void find_graze(const P* g, const P& first, int degree, double sign, double scale,
                           double h, size_t i, EventKind kind);
  HWY_ATTR void tell_event(size_t i, EventKind kind, bool jumps);
  HWY_ATTR void load_deviations();
  HWY_ATTR P end_of_step(const P& h, uint64_t& fell, uint64_t ends);
  HWY_ATTR P to_same_depth(const P& h);
  HWY_ATTR void move_with_distance(ContactLanes<P>& c, P& h) const;
  HWY_ATTR P along_event(const ContactLanes<P>& c, EventKind kind, const P* moved,
                         const P* rates) const;
  HWY_ATTR void note_jump(size_t i, EventKind kind);
  HWY_ATTR void jump_deviations();
  HWY_ATTR void keep_deviations();

  // engine_films-inl.h
  HWY_ATTR void fail_by_film(int l, const ReducedFilm& film);
  HWY_ATTR void find_film_slopes(const P& h, P& square, P& longest);
  HWY_ATTR P film_divergence(const P& h);
  HWY_ATTR void add_film_slopes(int k, P* to_a, P* to_b);

  /// Coefficient k of all coordinates.
  HWY_ATTR inline P* term(int k) {
    return terms_.data() + static_cast<size_t>(k) * static_cast<size_t>(n_);
  }

  const Pattern& pattern_;
  BatchOptions options_;
  int N, n_, lanes_;  // order of the series, coordinates, lanes
  double log2_tolerance_;

  // equations
  EquationLanes<P> equations_;
  std::vector<P> scale_;
  std::vector<ContactLanes<P>> contacts_;
  std::vector<uint64_t> alike_;  // per pair of Pattern::alike, the lanes in which they slip alike
  std::vector<std::unique_ptr<BladeLanes<P>>> disks_;  // of contacts with blades
  std::vector<std::unique_ptr<FilmLanes<P>>> films_;
  bool is_analytic_ = true;  // all laws are, and there is no film
  bool is_flat_ = false;     // the linear part has no slopes that numbers carry
  std::vector<AnyLawWork<P>> laws_;
  P rate_{1.0}, period_{1.0};

  // motion
  std::vector<P> y_;
  P time_{0.0};  // since the start of the revolution
  long steps_ = 0;
  static constexpr long watch_interval = 256;
  long watched_steps_ = 0, revolutions_ = 0;  // revolutions done in all lanes
  uint64_t active_ = 0, finished_ = 0;
  std::vector<Trajectory*> trajectory_;
  std::vector<LaneRecord> records_;

  // this step
  Mask finite_, bounded_;  // lanes whose series is one of numbers, whose motion is of sane size
  std::vector<P> terms_, load_, influence_, work_;
  std::vector<EventMask> event_masks_;
  std::unique_ptr<Tangents<P>> tangents_;
  std::unique_ptr<SlopeWork<P>> slopes_;
};

template <class P>
HWY_ATTR void Engine<P>::load(int l, Trajectory& t) {
  const ContactSystem& s = *t.system;
  const uint64_t bit = uint64_t{1} << l;
  trajectory_[static_cast<size_t>(l)] = &t;
  LaneRecord& record = records_[static_cast<size_t>(l)];
  record = {};
  record.first_step = steps_;
  record.revolution = record.first_revolution = t.state.revolution;
  record.first_phase = t.state.phase;
  record.last = t.state.revolution + t.revolutions;
  record.free_since = t.state.revolution;
  record.certificate_due = t.state.revolution + 1;
  record.impacts.assign(contacts_.size(), 0.0);
  if (t.state.contacts.size() != contacts_.size()) {
    t.state.contacts = s.classify(t.state.instant(), t.state.y.data());
  }
  load_system(s, t.state, l);
  set_state(l, t.state.y);
  if constexpr (!P::is_double) {
    for (int i = 0; i < t.lower_digits.size(); ++i) {
      P& y = y_[static_cast<size_t>(i)];
      y = y + P(t.lower_digits(i));
    }
  }
  for (size_t c = 0; c < contacts_.size(); ++c) {
    contacts_[c].load(s.contacts()[c], t.state.contacts[c], l, s.phase_rate());
  }
  for (size_t p = 0; p < alike_.size(); ++p) {
    put(alike_[p], bit, s.slip_alike(pattern_.alike[p].first, pattern_.alike[p].second));
  }
  if constexpr (knows_tangents) {
    if (has_tangents()) load_tangents(l, s);
  }
  if constexpr (carries_slopes<P>) load_slopes(t);
  active_ |= bit;
  if (t.revolutions <= 0) finished_ |= bit;
}

/// Numbers of a system, but for its contacts and where the motion is.
template <class P>
HWY_ATTR void Engine<P>::load_system(const ContactSystem& s, const MotionState& at, int l) {
  equations_.load(s, l);
  for (int i = 0; i < n_; ++i) {
    set_lane(scale_[static_cast<size_t>(i)], l, 1.0 / s.state_scale()(i));
    set_lane(load_[static_cast<size_t>(i)], l, s.constant_load()(i));
  }
  // a revolution is 2 pi to the last digit of P; without spin it is one second
  const Number turn = Number(2.0) * P::pi;
  const Number rate = s.Omega() != 0.0 ? Number(s.phase_rate()) : turn;
  set_lane(rate_, l, rate);
  set_lane(period_, l, turn / rate);
  set_lane(time_, l, Number(at.phase) / rate);
  equations_.begin_revolution(s, rate, at.revolution, l);
  for (size_t i = 0; i < films_.size(); ++i) films_[i]->load(s.films()[i], l);
  for (const auto& disk : disks_) disk->load(s.contacts()[disk->first], l, rate);
}

template <class P>
HWY_ATTR void Engine<P>::unload(int l) {
  Trajectory& t = *trajectory_[static_cast<size_t>(l)];
  const LaneRecord& record = records_[static_cast<size_t>(l)];
  t.state = motion_of(l);
  if constexpr (!P::is_double) {
    t.lower_digits.resize(layout().size());
    for (int i = 0; i < layout().size(); ++i) {
      t.lower_digits(i) = lane(y_[static_cast<size_t>(i)] - P(t.state.y(i)), l);
    }
  }
  const long steps = steps_ - record.first_step;
  t.cost.steps += steps - record.no_steps;
  t.cost.evaluations += steps * (N + 1);  // one for each coefficient
  t.cost.events += record.events;
  if (options_.measures) {
    t.contacts.resize(static_cast<size_t>(t.system->owners()));
    for (size_t c = 0; c < contacts_.size(); ++c) {
      const ContactLanes<P>& from = contacts_[c];
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
  if constexpr (knows_tangents && !carries_slopes<P>) {
    const double turns = static_cast<double>(record.revolution - record.first_revolution);
    const double start = record.first_phase / t.system->phase_rate();
    const double end = turns * t.system->period() + t.state.phase / t.system->phase_rate();
    if (has_tangents()) unload_tangents(l, end - start, t);
  }
  active_ &= ~(uint64_t{1} << l);
  trajectory_[static_cast<size_t>(l)] = nullptr;
}

/// State in a lane, rounded to double.
template <class P>
HWY_ATTR Vec Engine<P>::state_of(int l) const {
  Vec y(layout().size());
  for (int i = 0; i < layout().size(); ++i) y(i) = lane(y_[static_cast<size_t>(i)], l);
  return y;
}

template <class P>
HWY_ATTR void Engine<P>::set_state(int l, const Vec& y) {
  for (int i = 0; i < layout().size(); ++i) {
    P& number = y_[static_cast<size_t>(i)];
    if constexpr (carries_slopes<P>) {
      number.x = typename P::Value(y(i));  // slopes stay
    } else {
      set_lane(number, l, y(i));
    }
  }
}

template <class P>
HWY_ATTR ContactStates Engine<P>::contacts_of(int l) const {
  ContactStates states;
  for (const ContactLanes<P>& c : contacts_) states.push_back(c.state(l));
  return states;
}

/// Where the motion in a lane is.
template <class P>
HWY_ATTR MotionState Engine<P>::motion_of(int l) const {
  const auto ul = static_cast<size_t>(l);
  return {records_[ul].revolution, lane(time_, l) * trajectory_[ul]->system->phase_rate(),
          state_of(l), contacts_of(l)};
}

/// Ends a trajectory that cannot go on; its state is the last good one.
template <class P>
HWY_ATTR void Engine<P>::fail(int l, Outcome outcome, const char* what) {
  Trajectory& t = *trajectory_[static_cast<size_t>(l)];
  t.outcome = outcome;
  t.failure = failure_text(*t.system, motion_of(l), what);
  finished_ |= uint64_t{1} << l;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
