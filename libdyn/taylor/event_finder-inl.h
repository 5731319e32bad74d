// Where in a step the first events happen.

#if defined(WHIRL_EVENT_FINDER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_EVENT_FINDER_INL_H
#undef WHIRL_EVENT_FINDER_INL_H
#else
#define WHIRL_EVENT_FINDER_INL_H
#endif

#include <algorithm>
#include <vector>

#include "libdyn/taylor/events-inl.h"
#include "libdyn/taylor/motion_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Lanes in which an event ended the step, by kind.
struct EventMask {
  uint64_t distance = 0, force = 0, slip = 0, stick = 0;
  uint64_t any() const { return distance | force | slip | stick; }
  void remove(uint64_t lanes) {
    for (uint64_t* f : {&distance, &force, &slip, &stick}) *f &= ~lanes;
  }
};

/// Gives a time at which the distance of a contact is an event the slopes that hold it there.
template <class P>
HWY_ATTR void move_with_distance(ContactLanes<P>& c, int N, P& h) {
  P value, rate;
  c.beyond_at(P(h.x), N + 2, value, rate);
  h.s = -(value.s * wide(typename P::Value(1.0) / rate.x));
}

/// Shortens a step to the first event in every lane.
template <class P>
class EventFinder {
 public:
  explicit EventFinder(MotionLanes<P>& of) : m_(of), N(of.N), masks_(of.contacts.size()) {}

  HWY_ATTR uint64_t find(P& h);
  /// What find() found, per contact.
  const std::vector<EventMask>& masks() const { return masks_; }

 private:
  using Mask = typename P::Mask;

  HWY_ATTR bool is_out_of_reach(const BladeLanes<P>& disk, const P& h) const;
  HWY_ATTR void watch_force(size_t i, P& h);
  HWY_ATTR void watch_slip(size_t i, P& h);
  HWY_ATTR void note_slip(size_t i, uint64_t asked, P& h);
  HWY_ATTR void watch_stick(size_t i, P& h);
  HWY_ATTR void note(size_t i, uint64_t EventMask::*kind, const Mask& fell);

  MotionLanes<P>& m_;
  const int& N;  // order of the series, which may change between steps
  std::vector<EventMask> masks_;
};

/// Notes events that are earlier than what was found before in their lanes.
template <class P>
HWY_ATTR void EventFinder<P>::note(size_t i, uint64_t EventMask::*kind, const Mask& fell) {
  const uint64_t lanes = bits(m_.clock.time, fell) & m_.active;
  if (lanes == 0) return;
  for (EventMask& f : masks_) f.remove(lanes);
  masks_[i].*kind |= lanes;
}

/// Shortens h to the first event in every lane; returns the lanes with one.
template <class P>
HWY_ATTR uint64_t EventFinder<P>::find(P& h) {
  std::fill(masks_.begin(), masks_.end(), EventMask{});
  bool is_far = false;
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    ContactLanes<P>& c = m_.contacts[i];
    if (c.disk) {
      if (i == c.disk->first) is_far = is_out_of_reach(*c.disk, h);
      if (is_far && !c.is_evaluated) continue;
      for (int k = 0; k <= N + 2 && !c.is_evaluated; ++k) c.turning_geometry(k, false);
    }
    // the distance: apart to touch; in touch to apart where the force vanishes with the depth;
    // beyond the circle without force to apart
    const P s0 = c.s[0];
    c.s[0] = c.beyond();
    const uint64_t watched = m_.active & (~c.touching | c.continuous);
    const P sign = select(mask_of<P>(c.touching | c.receding), P(1.0), P(-1.0));
    const Mask fell = first_downward_zero(c.s, N + 2, sign, c.distance_scale, h,
                                          mask_of<P>(watched), mask_of<P>(c.surface_distance));
    c.s[0] = s0;
    note(i, &EventMask::distance, fell);
    if constexpr (carries_slopes<P>) {
      if (any(h, fell)) move_with_distance(c, N, h);
    }
    if (!c.is_evaluated) continue;
    if (((c.touching | c.receding) & m_.active & c.damped) != 0) watch_force(i, h);
    if ((c.touching & m_.active & c.exact & ~c.sticking) != 0) watch_slip(i, h);
    if ((c.leading & m_.active) != 0) watch_stick(i, h);
  }
  uint64_t fell = 0;
  for (const EventMask& f : masks_) fell |= f.any();
  return fell;
}

/// Whether a disk stays within the clearance of its blades, or the slack of its elements, in all
/// active lanes: a tip is never farther out than u . u = c^2 would let it be.
template <class P>
HWY_ATTR bool EventFinder<P>::is_out_of_reach(const BladeLanes<P>& disk, const P& h) const {
  if ((disk.tight & m_.active) != 0) return false;
  P beyond[P::most_terms], until = h;
  std::copy(disk.square, disk.square + N + 3, beyond);
  beyond[0] = beyond[0] - disk.clearance2;
  const Mask active = mask_of<P>(m_.active);
  return !any(h, first_downward_zero(beyond, N + 2, P(-1.0), disk.clearance2, until, active,
                                     mask_of<P>(0)));
}

/// A damped law lets go where its force vanishes, and grips again where it would push. If it has a
/// rate factor, that says both: the force itself vanishes with the depth, too.
template <class P>
HWY_ATTR void EventFinder<P>::watch_force(size_t i, P& h) {
  ContactLanes<P>& c = m_.contacts[i];
  const uint64_t watched = (c.touching | c.receding) & m_.active & c.damped;
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
HWY_ATTR void EventFinder<P>::watch_slip(size_t i, P& h) {
  ContactLanes<P>& c = m_.contacts[i];
  const uint64_t sliding = c.touching & m_.active & c.exact & ~c.sticking;
  if (c.rows.is_plane) {
    for (int k = 0; k <= N; ++k) {
      c.rub->velocity(m_.term(k + 1), k);
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
HWY_ATTR void EventFinder<P>::note_slip(size_t i, uint64_t asked, P& h) {
  ContactLanes<P>& c = m_.contacts[i];
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
HWY_ATTR void EventFinder<P>::watch_stick(size_t i, P& h) {
  ContactLanes<P>& c = m_.contacts[i];
  P q[P::most_terms];
  std::copy(c.q, c.q + N + 1, q);
  for (size_t p = 0; p < m_.alike.size(); ++p) {
    if (m_.pattern.alike[p].first != i) continue;
    const ContactLanes<P>& other = m_.contacts[m_.pattern.alike[p].second];
    const Mask sticks = mask_of<P>(other.sticking & m_.alike[p] & c.leading);
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
       first_downward_zero(g, N, P(1.0), scale * scale, h, mask_of<P>(c.leading & m_.active),
                           mask_of<P>(0)));
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
