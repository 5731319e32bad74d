// What changes at the events of a step.

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

template <class P>
HWY_ATTR void Engine<P>::apply_events(uint64_t instant) {
  constexpr int most_instant_events = 50;
  for (size_t i = 0; i < motion_.contacts.size(); ++i) {
    ContactLanes<P>& c = motion_.contacts[i];
    const EventMask& f = events_.masks()[i];
    // touching and parting of continuous laws, in all lanes at once
    uint64_t common = f.distance & c.continuous & ~c.receding;
    if (common != 0) {
      const uint64_t enters = common & ~c.touching;
      if ((enters & c.exact) != 0) {  // the slip that it begins with
        P x = c.dx[0], y = c.dy[0], u, v;
        c.displacement(motion_.layout().rates_at(motion_.y.data()), u, v);
        if (!c.rows.is_plane) {
          c.displacement(motion_.y.data(), x, y);
          x = x - c.offset_x;
          y = y - c.offset_y;
        }
        const P slip = fma(c.rim, c.clearance, fma(x, v, -(y * u)));
        c.sign = select(mask_of<P>(enters & c.exact), select(less(slip, P(0.0)), P(-1.0), P(1.0)),
                        c.sign);
        const uint64_t at_rest =
            enters & c.exact &
            bits(slip, less_equal(abs(slip), c.slip_scale * P(1e3 * P::rounding)));
        common &= ~(at_rest | (enters & joins_sticking(motion_, i)));
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
        slopes_->tell_event(i, was_touching ? EventKind::release : EventKind::touch, nullptr);
      }
      if (!was_beyond && (c.touching & bit)) record.impacts[i] += 1.0;
      record.instant_events = instant & bit ? record.instant_events + 1 : 0;
      if (record.instant_events > most_instant_events) {
        fail(l, Outcome::step_too_small, "events follow without time passing");
      }
    }
  }
}

/// Events that need a decision (sticking, damped laws), one lane at a time, by the common rules.
template <class P>
HWY_ATTR void Engine<P>::apply_rare_event(int l, size_t i) {
  const uint64_t bit = uint64_t{1} << l;
  LaneRecord& record = records_[static_cast<size_t>(l)];
  const Trajectory& t = *record.trajectory;
  if (!record.watcher) record.watcher = std::make_unique<EventWatcher>(*t.system);
  Vec y = motion_.state_of(l);
  ContactStates states = motion_.contacts_of(l);

  const EventMask& f = events_.masks()[i];
  ContactLanes<P>& c = motion_.contacts[i];
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
  const Instant at(motion_.clock.phase(l), record.revolution);
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
    slopes_->tell_event(i, kind, jump ? &*jump : nullptr);
  } else if constexpr (knows_tangents<P>) {
    if (has_tangents()) {
      const auto jump = saltation(*t.system, event, at, y, before, states);
      if (jump) variation_->jump(l, *jump);
    }
  }
  t.system->remove_slip(y.data(), states);
  if constexpr (P::is_double) motion_.set_state(l, y);
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
  for (size_t j = 0; j < motion_.contacts.size(); ++j) {  // others stick and slip with it
    if (j == i || !t.system->slip_alike(i, j)) continue;
    motion_.contacts[j].set_state(states[j], l);
    const int other = static_cast<int>(j);
    if (!record.watcher->on_surface(other, EventKind::slip_stop)) continue;
    motion_.contacts[j].surface_slip |= bit;
    put(motion_.contacts[j].level_slip, bit, record.watcher->is_level(other, EventKind::slip_stop));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
