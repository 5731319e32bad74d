// Steps of the engine: their length, moving the state, what is measured and told.

#if defined(WHIRL_ENGINE_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_STEP_INL_H
#undef WHIRL_ENGINE_STEP_INL_H
#else
#define WHIRL_ENGINE_STEP_INL_H
#endif

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Step at which the last two terms are as large as the tolerance allows.
template <class P>
HWY_ATTR P Engine<P>::step_length() {
  using V = PlainOf<P>;
  V last(1e-280), before(1e-280), sum(0.0), size(0.0);
  const P *a = term(N + 2), *b = term(N + 1), *y = y_.data();
  for (int i = 0; i < n_; ++i) {
    const V& scale = as<V>(scale_[static_cast<size_t>(i)]);
    const V in_a = abs(as<V>(a[i])) * scale, in_b = abs(as<V>(b[i])) * scale;
    last = max(last, in_a);
    before = max(before, in_b);
    sum = sum + in_a + in_b;  // unlike a maximum, it never loses what is no number
    size = max(size, abs(as<V>(y[i])) * scale);
  }
  // quadruple numbers reach further, and need to: with a law that has no Taylor series at a
  // surface, the last of thirty terms gets there
  const V huge(1e300);
  finite_ = less(sum, P::is_double ? huge : huge * huge * huge);
  bounded_ = less(size, V(boundless));
  const V e(log2_tolerance_);
  const V h1 = (e - rough_log2(last)) * V(1.0 / (N + 2));
  const V h2 = (e - rough_log2(before)) * V(1.0 / (N + 1));
  V h = min(min(h1, h2), V(900.0));
  if (!is_analytic_) {  // steps get short at a surface: the last term of the velocity counts too
    const V speed = rough_log2(as<V>(rate_)) - V(std::log2(N + 2.0));
    h = min(h, (e + speed - rough_log2(last)) * V(1.0 / (N + 1)));
  }
  return P(V(0.95) * rough_exp2(h));
}

/// Values at h of series and of their derivatives, in all active lanes; Bodies as in series_of.
/// Slopes of h come last:  x' += v h',  v' += a h'.
template <class P>
template <int Bodies>
HWY_ATTR void Engine<P>::evaluate(const P* terms, const P& h, P* y) const {
  constexpr int at_once = Bodies > 0 ? 2 * Bodies : 2;  // coordinates, whose chains overlap
  const int n = Bodies > 0 ? 2 * Bodies : n_;
  P* const rates = StateLayout(n).rates_at(y);
  const Mask active = mask_of<P>(active_);
  const auto& t = as<PlainOf<P>>(h);
  for (int first = 0; first < n; first += at_once) {
    const auto place = [&](int i) { return Bodies > 0 ? i : std::min(first + i, n - 1); };
    P x[at_once], v[at_once];
    const P* now = terms + (N + 2) * n;
    each<at_once>(0, [&](int i) HWY_ATTR {
      x[i] = now[place(i)];
      v[i] = P(0.0);
    });
    for (int k = N + 1; k >= 0; --k) {
      now -= n;
      each<at_once>(0, [&](int i) HWY_ATTR {
        v[i] = fma(t, v[i], x[i]);
        x[i] = fma(t, x[i], now[place(i)]);
      });
    }
    each<at_once>(0, [&](int i) HWY_ATTR {
      P &to_x = y[place(i)], &to_v = rates[place(i)];
      to_x = select(active, x[i], to_x);
      to_v = select(active, v[i], to_v);
    });
  }
  if constexpr (carries_slopes<P>) {
    if (is_flat(h)) return;
    for (int i = 0; i < n; ++i) {
      PlainOf<P> a(0.0);
      for (int k = N + 2; k >= 2; --k) {
        a = fma(a, t, PlainOf<P>(k * (k - 1.0)) * terms[k * n + i].x);
      }
      y[i].s = fma(wide(rates[i].x), h.s, y[i].s);
      rates[i].s = fma(wide(a), h.s, rates[i].s);
    }
  }
}

/// Ends the trajectories of lanes that cannot make a step.
template <class P>
HWY_ATTR void Engine<P>::fail_steps(uint64_t bad) {
  const uint64_t numbers = bits(time_, finite_), bounded = bits(time_, bounded_);
  for (uint64_t rest = bad; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    if (const auto* film =
            trajectory_[static_cast<size_t>(l)]->system->left_bearing(state_of(l).data())) {
      fail_by_film(l, *film);
    } else if ((numbers >> l & 1) == 0) {
      fail(l, Outcome::not_finite, "the state is not finite");
    } else {
      fail(l, Outcome::step_too_small,
           (bounded >> l & 1) != 0 ? "the step underflowed" : boundless_text);
    }
  }
}

template <class P>
HWY_ATTR void Engine<P>::step(const Observer* observer) {
  constexpr Number too_small = 10.0 * P::rounding;  // of a revolution
  constexpr Number brief_step = 1e4 * P::rounding;  // of a revolution; its square is nothing
  series();
  if constexpr (carries_slopes<P>) jump_deviations();
  P h = step_length();
  if constexpr (knows_tangents) {
    if (has_tangents()) h = limit_for_tangents(h);
  }
  if constexpr (carries_slopes<P>) h = limit_for_slopes(h);
  if (options_.fixed_step > 0.0) h = P(options_.fixed_step);
  for (const auto& film : films_) h = film->shortened(h, N);
  const P left = max(period_ - time_, P(0.0));
  const Mask reaches = less_equal(left * P(Number(1.0) - 100.0 * P::rounding), h);
  const Mask moves = either(reaches, less(period_ * P(too_small), h));
  const uint64_t good = bits(h, both(both(finite_, bounded_), moves));
  uint64_t ends = active_ & bits(h, reaches);
  h = select(reaches, left, h);
  const uint64_t bad = active_ & ~good;
  if (bad != 0) {
    fail_steps(bad);
    return;  // the others begin this step again
  }
  h = select(mask_of<P>(active_), h, P(0.0));
  uint64_t fell = find_events(h);
  ends &= ~fell;
  if (options_.measures) measure(h);
  const uint64_t instant = bits(h, less_equal(h, period_ * P(too_small))) & active_;
  for (uint64_t rest = instant; rest != 0; rest &= rest - 1) {
    ++records_[static_cast<size_t>(__builtin_ctzll(rest))].no_steps;
  }
  bool goes_on = true;
  if (observer && instant == 0) goes_on = tell(*observer, lane(h, 0));
  if constexpr (carries_slopes<P>) h = end_of_step(h, fell, ends);
  if constexpr (knows_tangents) {
    if (has_tangents()) move_tangents(h);
  }
  if (pattern_.bodies == 2) {
    evaluate<2>(terms_.data(), h, y_.data());
  } else {
    evaluate<0>(terms_.data(), h, y_.data());
  }
  time_ = time_ + h;
  time_ = select(mask_of<P>(ends), P(0.0), time_);
  ++steps_;
  // where next to no time passed, a contact is still on its surface: others touch at the same
  // instant
  const uint64_t brief = bits(h, less_equal(h, period_ * P(brief_step)));
  for (ContactLanes<P>& c : contacts_) {
    for (uint64_t* surface :
         {&c.surface_distance, &c.surface_force, &c.surface_slip, &c.level_slip}) {
      *surface &= brief;
    }
  }
  if (fell != 0) apply_events(instant);
  end_revolutions(ends, observer != nullptr);
  if constexpr (carries_slopes<P>) {
    if (slopes_->run->is_done()) {
      keep_deviations();
      finished_ |= 1;
    }
  } else if constexpr (knows_tangents) {
    if (has_tangents() && options_.exponents) orthonormalize(due_lanes(ends));
    if (has_tangents() && options_.growths) keep_growths(ends);
  }
  if (!goes_on) {
    trajectory_[0]->outcome = Outcome::stopped_by_observer;
    finished_ |= 1;
  }
}

/// Ends a revolution in lanes: the next one begins, or the trajectory is done.
template <class P>
HWY_ATTR void Engine<P>::end_revolutions(uint64_t ends, bool is_observed) {
  for (uint64_t rest = ends; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    LaneRecord& record = records_[static_cast<size_t>(l)];
    ++record.revolution;
    ++revolutions_;
    if (!equations_.other_loads.empty()) {
      equations_.begin_revolution(*trajectory_[static_cast<size_t>(l)]->system, lane(rate_, l),
                                  record.revolution, l);
      if constexpr (carries_slopes<P>) begin_revolution_of_neighbors(record.revolution);
    }
    remove_slip(l);
    if (options_.sections) {
      std::vector<double>& sections = trajectory_[static_cast<size_t>(l)]->sections;
      for (const P& y : y_) sections.push_back(lane(y, l));
    }
    const bool is_alone = !is_observed && !has_tangents() && !carries_slopes<P>;
    if (P::is_double && is_alone && films_.empty()) fly_on(l);
    if (record.revolution >= record.last) finished_ |= uint64_t{1} << l;
  }
}

/// Ends a trajectory in closed form where no contact can ever happen again; looked into after 1, 2,
/// 4, ... revolutions without contact.
template <class P>
HWY_ATTR void Engine<P>::fly_on(int l) {
  LaneRecord& record = records_[static_cast<size_t>(l)];
  const uint64_t bit = uint64_t{1} << l;
  uint64_t near = 0;
  for (const ContactLanes<P>& c : contacts_) near |= c.touching | c.receding;
  if ((near & bit) != 0 || record.events != record.events_before) {
    record.events_before = record.events;
    record.free_since = record.revolution;
    record.certificate_due = record.revolution + 1;
    return;
  }
  if (record.revolution < record.certificate_due || record.revolution >= record.last) return;
  record.certificate_due = 2 * record.revolution - record.free_since;
  Trajectory& t = *trajectory_[static_cast<size_t>(l)];
  if (!record.free_flight) record.free_flight = std::make_unique<FreeFlight>(*t.system);
  MotionState state = motion_of(l);
  if (!record.free_flight->is_certain(state)) return;
  while (record.revolution < record.last) {
    const long to = options_.sections ? record.revolution + 1 : record.last;
    record.free_flight->finish(state, to);
    revolutions_ += to - record.revolution;
    record.revolution = to;
    if (options_.sections) t.sections.insert(t.sections.end(), state.y.begin(), state.y.end());
  }
  set_state(l, state.y);
}

/// Takes off the slip that sticking contacts of a lane have gathered by rounding and truncation.
template <class P>
HWY_ATTR void Engine<P>::remove_slip(int l) {
  if constexpr (!P::is_double) return;  // what double computes would be worse than what is left
  const uint64_t bit = uint64_t{1} << l;
  const auto sticks = [&](const ContactLanes<P>& c) { return (c.sticking & bit) != 0; };
  if (std::none_of(contacts_.begin(), contacts_.end(), sticks)) return;
  const ContactStates states = contacts_of(l);
  Vec y = state_of(l);
  trajectory_[static_cast<size_t>(l)]->system->remove_slip(y.data(), states);
  set_state(l, y);
}

/// Largest value of a parabola through three equidistant values, if its top lies between them.
template <class P>
HWY_ATTR inline P top(const P& a, const P& b, const P& c) {
  const P bend = b + b - a - c, slope = P(0.5) * (c - a);
  const typename P::Mask inside = both(less(P(0.0), bend), less_equal(abs(slope), bend));
  const P at_top = fma(P(0.5) * slope, slope / select(inside, bend, P(1.0)), b);
  return select(inside, at_top, max(b, max(a, c)));
}

/// Size of the friction of a sticking contact at a time, its share of what holds all that slip
/// alike: in proportion to mu N.
template <class P>
HWY_ATTR P Engine<P>::shared_friction(size_t i, const P& t) const {
  P unused, tau, r;
  const auto limit = [&](const ContactLanes<P>& c) HWY_ATTR {
    P normal;
    horner(c.N, N, t, normal, unused);
    return c.mu * max(normal, P(0.0));
  };
  const auto held = [&](const ContactLanes<P>& c) HWY_ATTR {
    horner(c.tau, N, t, tau, unused);
    horner(c.r, N, t, r, unused);
    return select(mask_of<P>(c.leading), abs(tau * r), P(0.0));
  };
  const P own = limit(contacts_[i]);
  P force = held(contacts_[i]), sum = own;
  for (size_t p = 0; p < alike_.size(); ++p) {
    const auto [first, second] = pattern_.alike[p];
    if (first != i && second != i) continue;
    const ContactLanes<P>& other = contacts_[first == i ? second : first];
    const Mask sticks = mask_of<P>(other.sticking & alike_[p]);
    if ((other.sticking & alike_[p]) == 0) continue;
    force = force + select(sticks, held(other), P(0.0));
    sum = sum + select(sticks, limit(other), P(0.0));
  }
  const Mask is_shared = less(own, sum);
  return select(is_shared, force * (own / select(is_shared, sum, P(1.0))), force);
}

/// Time in touch and sticking; largest forces, by parabolas through samples of the series.
template <class P>
HWY_ATTR void Engine<P>::measure(const P& h) {
  constexpr int intervals = 8;
  for (const auto& disk : disks_) {  // with any blade
    uint64_t touching = 0;
    for (size_t i = 0; i < disk->count; ++i) touching |= contacts_[disk->first + i].touching;
    P& duty = contacts_[disk->first].duty;
    duty = duty + select(mask_of<P>(touching & active_), h, P(0.0));
  }
  for (ContactLanes<P>& c : contacts_) {
    const uint64_t touching = c.touching & active_;
    if (touching == 0) continue;
    const Mask in_touch = mask_of<P>(touching);
    if (!c.disk) c.duty = c.duty + select(in_touch, h, P(0.0));
    c.stuck = c.stuck + select(mask_of<P>(c.sticking & active_), h, P(0.0));
    P normal[intervals + 1], friction[intervals + 1], unused;
    for (int j = 0; j <= intervals; ++j) {
      const P t = h * P(static_cast<double>(j) / intervals);
      horner(c.N, N, t, normal[j], unused);
      friction[j] = c.mu * normal[j];
      if (c.any_has_tau) {
        P tau, r;
        horner(c.tau, N, t, tau, unused);
        horner(c.r, N, t, r, unused);
        friction[j] = select(c.has_tau, abs(tau * r), friction[j]);
      }
      if (!alike_.empty() && (c.sticking & active_) != 0) {
        const P share = shared_friction(static_cast<size_t>(&c - contacts_.data()), t);
        friction[j] = select(mask_of<P>(c.sticking), share, friction[j]);
      }
    }
    for (int j = 1; j < intervals; ++j) {
      const P largest = top(normal[j - 1], normal[j], normal[j + 1]);
      const P strongest = top(friction[j - 1], friction[j], friction[j + 1]);
      c.max_normal = select(in_touch, max(c.max_normal, largest), c.max_normal);
      c.max_friction = select(in_touch, max(c.max_friction, strongest), c.max_friction);
    }
  }
}

/// Shows the step of lane 0, as polynomials in s = t / h; false: stop.
template <class P>
HWY_ATTR bool Engine<P>::tell(const Observer& observer, double h) {
  const Trajectory& t = *trajectory_[0];
  Step step;
  step.revolution = records_[0].revolution;
  step.phase = lane(time_, 0) * t.system->phase_rate();
  step.h = h;
  step.turn = h * t.system->phase_rate();
  step.q.resize(n_, N + 3);
  step.v.resize(n_, N + 2);
  double power = 1.0;
  for (int k = 0; k <= N + 2; ++k, power *= h) {
    for (int i = 0; i < n_; ++i) {
      step.q(i, k) = lane(term(k)[i], 0) * power;
      if (k <= N + 1) step.v(i, k) = (k + 1) * lane(term(k + 1)[i], 0) * power;
    }
  }
  step.contacts = contacts_of(0);
  return observer(step);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
