// Events of the engine: where they happen in a step, and what changes there.

#if defined(WHIRL_ENGINE_EVENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_EVENTS_INL_H
#undef WHIRL_ENGINE_EVENTS_INL_H
#else
#define WHIRL_ENGINE_EVENTS_INL_H
#endif

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Notes events that are earlier than what was found before in their lanes.
template <class P>
HWY_ATTR void Engine<P>::note(size_t i, uint64_t EventMask::*kind, const Mask& fell) {
  const uint64_t lanes = bits(time_, fell) & active_;
  if (lanes == 0) return;
  for (EventMask& f : event_masks_) f.remove(lanes);
  event_masks_[i].*kind |= lanes;
}

/// Shortens h to the first event in every lane; returns the lanes with one.
template <class P>
HWY_ATTR uint64_t Engine<P>::find_events(P& h) {
  std::fill(event_masks_.begin(), event_masks_.end(), EventMask{});
  bool is_far = false;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    ContactLanes<P>& c = contacts_[i];
    if (c.disk) {
      if (i == c.disk->first) is_far = is_out_of_reach(*c.disk, h);
      if (is_far && !c.is_evaluated) continue;
      for (int k = 0; k <= N + 2 && !c.is_evaluated; ++k) c.blade_geometry(k, false);
    }
    // the distance: apart to touch; in touch to apart where the force vanishes with the depth;
    // beyond the circle without force to apart
    const P s0 = c.s[0];
    c.s[0] = c.beyond();
    const uint64_t watched = active_ & (~c.touching | c.continuous);
    const P sign = select(mask_of<P>(c.touching | c.receding), P(1.0), P(-1.0));
    const Mask fell = first_downward_zero(c.s, N + 2, sign, c.distance_scale, h,
                                          mask_of<P>(watched), mask_of<P>(c.surface_distance));
    c.s[0] = s0;
    note(i, &EventMask::distance, fell);
    if constexpr (carries_slopes<P>) {
      if (any(h, fell)) move_with_distance(c, h);
    }
    if (!c.is_evaluated) continue;
    if (((c.touching | c.receding) & active_ & c.damped) != 0) watch_force(i, h);
    if ((c.touching & active_ & c.exact & ~c.sticking) != 0) watch_slip(i, h);
    if ((c.leading & active_) != 0) watch_stick(i, h);
  }
  uint64_t fell = 0;
  for (const EventMask& f : event_masks_) fell |= f.any();
  return fell;
}

/// Whether a disk stays within the clearance of its blades in all active lanes: a tip is never
/// farther out than u . u = c^2 would let it be.
template <class P>
HWY_ATTR bool Engine<P>::is_out_of_reach(const BladeLanes<P>& disk, const P& h) const {
  P beyond[P::most_terms], until = h;
  std::copy(disk.square, disk.square + N + 3, beyond);
  beyond[0] = beyond[0] - disk.clearance2;
  const Mask active = mask_of<P>(active_);
  return !any(h, first_downward_zero(beyond, N + 2, P(-1.0), disk.clearance2, until, active,
                                     mask_of<P>(0)));
}

/// A damped law lets go where its force vanishes, and grips again where it would push. If it has a
/// rate factor, that says both: the force itself vanishes with the depth, too.
template <class P>
HWY_ATTR void Engine<P>::watch_force(size_t i, P& h) {
  ContactLanes<P>& c = contacts_[i];
  const uint64_t watched = (c.touching | c.receding) & active_ & c.damped;
  const P sign = select(mask_of<P>(c.touching), P(1.0), P(-1.0));
  const auto rate = [&](int k) HWY_ATTR { return c.rate(k); };
  P factor[P::most_terms];
  const bool has_factor = find_rate_factor(c.law, rate, N, factor);
  note(i, &EventMask::force,
       first_downward_zero(has_factor ? factor : c.N, N, sign, has_factor ? P(1.0) : c.force_scale,
                           h, mask_of<P>(watched), mask_of<P>(c.surface_force)));
}

/// Slip that comes to rest. A bound tells most steps that it cannot:  |d x d'| <= max |d| max |d'|.
template <class P>
HWY_ATTR void Engine<P>::watch_slip(size_t i, P& h) {
  ContactLanes<P>& c = contacts_[i];
  const uint64_t sliding = c.touching & active_ & c.exact & ~c.sticking;
  if (c.rows.is_plane) {
    for (int k = 0; k <= N; ++k) {
      c.rub->velocity(term(k + 1), k);
      c.slip[k] = fma(c.rim, c.r[k], c.rub->turn(c.dx, c.dy, k));
    }
    return note_slip(i, sliding, h);
  }
  P distance(0.0), speed(0.0);
  for (int k = N + 1; k >= 1; --k) {
    const P size = abs(c.dx[k]) + abs(c.dy[k]);
    speed = fma(speed, h, distance);
    distance = fma(distance, h, size);
  }
  speed = fma(speed, h, distance);
  distance = fma(distance, h, abs(c.dx[0]) + abs(c.dy[0]));
  const Mask certain = less(distance * speed, abs(c.rim) * c.clearance);
  const uint64_t asked = sliding & (~bits(h, certain) | c.surface_slip);
  if (asked == 0) return;
  // sign * (Omega R r + d x d'), which has the sign of the slip times the sense it had
  for (int k = 0; k <= N; ++k) c.slip[k] = c.add_turn(c.rim * c.r[k], k);
  note_slip(i, asked, h);
}

/// Notes where the series in c.slip comes to rest, in lanes that are asked.
template <class P>
HWY_ATTR void Engine<P>::note_slip(size_t i, uint64_t asked, P& h) {
  ContactLanes<P>& c = contacts_[i];
  P* g = c.slip;
  c.slip_is_known = true;
  if (c.level_slip != 0) g[1] = select(mask_of<P>(c.level_slip), P(0.0), g[1]);
  note(i, &EventMask::slip,
       first_downward_zero(g, N, c.sign, c.slip_scale, h, mask_of<P>(asked),
                           mask_of<P>(c.surface_slip)));
}

/// Sticking ends where the friction it needs is more than mu N:  (mu q)^2 - tau^2 falls below zero.
/// With others that slip alike, mu q is the sum of theirs; tau is that of all already.
template <class P>
HWY_ATTR void Engine<P>::watch_stick(size_t i, P& h) {
  ContactLanes<P>& c = contacts_[i];
  P q[P::most_terms];
  std::copy(c.q, c.q + N + 1, q);
  for (size_t p = 0; p < alike_.size(); ++p) {
    if (pattern_.alike[p].first != i) continue;
    const ContactLanes<P>& other = contacts_[pattern_.alike[p].second];
    const Mask sticks = mask_of<P>(other.sticking & alike_[p] & c.leading);
    for (int k = 0; k <= N; ++k) {
      q[k] = q[k] + select(sticks, other.q[k] * (other.mu / c.mu), P(0.0));
    }
  }
  P* g = c.slip;
  const P mu2 = c.mu * c.mu;
  for (int k = 0; k <= N; ++k) {
    P qq(0.0), tt(0.0);
    for (int j = 0; j <= k; ++j) {
      qq = fma(q[j], q[k - j], qq);
      tt = fma(c.tau[j], c.tau[k - j], tt);
    }
    g[k] = fma(mu2, qq, -tt);
  }
  const P scale = c.force_scale / c.clearance;
  note(i, &EventMask::stick,
       first_downward_zero(g, N, P(1.0), scale * scale, h, mask_of<P>(c.leading & active_),
                           mask_of<P>(0)));
}

template <class P>
HWY_ATTR void Engine<P>::apply_events(uint64_t instant) {
  constexpr int most_instant_events = 50;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    ContactLanes<P>& c = contacts_[i];
    const EventMask& f = event_masks_[i];
    // touching and parting of continuous laws, in all lanes at once
    uint64_t common = f.distance & c.continuous & ~c.receding;
    if (common != 0) {
      const uint64_t enters = common & ~c.touching;
      if ((enters & c.exact) != 0) {  // the slip that it begins with
        P x = c.dx[0], y = c.dy[0], u, v;
        c.displacement(layout().rates_at(y_.data()), u, v);
        if (!c.rows.is_plane) {
          c.displacement(y_.data(), x, y);
          x = x - c.offset_x;
          y = y - c.offset_y;
        }
        const P slip = fma(c.rim, c.clearance, fma(x, v, -(y * u)));
        c.sign = select(mask_of<P>(enters & c.exact), select(less(slip, P(0.0)), P(-1.0), P(1.0)),
                        c.sign);
        const uint64_t at_rest =
            enters & c.exact &
            bits(slip, less_equal(abs(slip), c.slip_scale * P(1e3 * P::rounding)));
        common &= ~(at_rest | (enters & joins_sticking(i)));
      }
      if ((enters & ~c.exact) != 0) c.sign = select(mask_of<P>(enters & ~c.exact), P(1.0), c.sign);
      c.touching ^= common;
      c.sticking &= c.touching;
      c.surface_distance |= common;
    }
    for (uint64_t rest = f.any(); rest != 0; rest &= rest - 1) {
      const int l = __builtin_ctzll(rest);
      const uint64_t bit = rest & (~rest + 1);
      LaneRecord& record = records_[static_cast<size_t>(l)];
      ++record.events;
      const bool was_touching = ((c.touching ^ (common & bit)) & bit) != 0;
      const bool was_beyond = was_touching || (c.receding & bit) != 0;
      if (!(common & bit)) {
        apply_rare_event(l, i);
      } else if constexpr (carries_slopes<P>) {
        tell_event(i, was_touching ? EventKind::release : EventKind::touch, false);
      }
      if (!was_beyond && (c.touching & bit)) record.impacts[i] += 1.0;
      record.instant_events = instant & bit ? record.instant_events + 1 : 0;
      if (record.instant_events > most_instant_events) {
        fail(l, Outcome::step_too_small, "events follow without time passing");
      }
    }
  }
}

/// Lanes in which a contact sticks that slips as contact i would.
template <class P>
uint64_t Engine<P>::joins_sticking(size_t i) const {
  uint64_t lanes = 0;
  for (size_t p = 0; p < alike_.size(); ++p) {
    const auto [first, second] = pattern_.alike[p];
    if (first == i) lanes |= alike_[p] & contacts_[second].sticking;
    if (second == i) lanes |= alike_[p] & contacts_[first].sticking;
  }
  return lanes;
}

/// Events that need a decision (sticking, damped laws), one lane at a time, by the common rules.
template <class P>
HWY_ATTR void Engine<P>::apply_rare_event(int l, size_t i) {
  const uint64_t bit = uint64_t{1} << l;
  const Trajectory& t = *trajectory_[static_cast<size_t>(l)];
  LaneRecord& record = records_[static_cast<size_t>(l)];
  if (!record.watcher) record.watcher = std::make_unique<EventWatcher>(*t.system);
  Vec y = state_of(l);
  ContactStates states = contacts_of(l);

  const EventMask& f = event_masks_[i];
  ContactLanes<P>& c = contacts_[i];
  EventKind kind = EventKind::touch;
  if (f.distance & bit) {
    kind = states[i].touch == Touch::receding ? EventKind::part
           : states[i].in_touch()             ? EventKind::release
                                              : EventKind::touch;
  } else if (f.force & bit) {
    kind = !states[i].in_touch()  ? EventKind::retouch
           : (c.continuous & bit) ? EventKind::pull
                                  : EventKind::release;
  } else {
    kind = f.slip & bit ? EventKind::slip_stop : EventKind::stick_limit;
  }
  const int index = static_cast<int>(i);
  const Event event{0.0, index, kind};
  const Instant at(lane(rate_ * time_, l), record.revolution);
  const ContactStates before = states;
  t.system->remove_slip(y.data(), before);  // what sticking has gathered must not look like slip
  record.watcher->moved_on();               // what it notes now is of this event
  record.watcher->apply(event, at, y.data(), states);
  if constexpr (!P::is_double) {
    // where double cannot tell, it sticks: whether it can, the series of its friction tells at once
    constexpr double undecided = 1e-9;
    if (kind == EventKind::slip_stop) {
      const Hold hold = t.system->hold(at, y.data(), before, index);
      if (std::abs(std::abs(hold.force) - hold.limit) <= undecided * hold.limit)
        t.system->set_group(states, index, {Touch::sticking, 1.0});
    }
  }
  if constexpr (carries_slopes<P>) {
    const auto jump = saltation(*t.system, event, at, y, before, states);
    if (jump) has_tangents() ? note_jump(i, kind) : jump_slopes(i, kind, *jump);
    tell_event(i, kind, jump.has_value());
  } else if constexpr (knows_tangents) {
    if (has_tangents()) {
      const auto jump = saltation(*t.system, event, at, y, before, states);
      if (jump) jump_tangents(l, *jump);
    }
  }
  t.system->remove_slip(y.data(), states);
  if constexpr (P::is_double) set_state(l, y);
  c.set_state(states[i], l);
  const auto starts = [&](EventKind k) { return record.watcher->on_surface(index, k); };
  put(c.surface_distance, bit,
      starts(EventKind::touch) || starts(EventKind::part) ||
          (starts(EventKind::release) && (c.continuous & bit)));
  put(c.surface_force, bit,
      starts(EventKind::retouch) || starts(EventKind::pull) ||
          (starts(EventKind::release) && !(c.continuous & bit)));
  put(c.surface_slip, bit, starts(EventKind::slip_stop));
  put(c.level_slip, bit, record.watcher->is_level(index, EventKind::slip_stop));
  for (size_t j = 0; j < contacts_.size(); ++j) {  // others stick and slip with it
    if (j == i || !t.system->slip_alike(i, j)) continue;
    contacts_[j].set_state(states[j], l);
    const int other = static_cast<int>(j);
    if (!record.watcher->on_surface(other, EventKind::slip_stop)) continue;
    contacts_[j].surface_slip |= bit;
    put(contacts_[j].level_slip, bit, record.watcher->is_level(other, EventKind::slip_stop));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
