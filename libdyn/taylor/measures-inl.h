// What is measured of contacts in a step.

#if defined(WHIRL_MEASURES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_MEASURES_INL_H
#undef WHIRL_MEASURES_INL_H
#else
#define WHIRL_MEASURES_INL_H
#endif

#include <algorithm>

#include "libdyn/taylor/events-inl.h"
#include "libdyn/taylor/motion_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

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
HWY_ATTR P shared_friction(const MotionLanes<P>& m, size_t i, const P& t) {
  const int N = m.N;
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
  const P own = limit(m.contacts[i]);
  P force = held(m.contacts[i]), sum = own;
  for (size_t p = 0; p < m.alike.size(); ++p) {
    const auto [first, second] = m.pattern.alike[p];
    if (first != i && second != i) continue;
    const ContactLanes<P>& other = m.contacts[first == i ? second : first];
    const typename P::Mask sticks = mask_of<P>(other.sticking & m.alike[p]);
    if ((other.sticking & m.alike[p]) == 0) continue;
    force = force + select(sticks, held(other), P(0.0));
    sum = sum + select(sticks, limit(other), P(0.0));
  }
  const typename P::Mask is_shared = less(own, sum);
  return select(is_shared, force * (own / select(is_shared, sum, P(1.0))), force);
}

/// Time in touch and sticking; largest forces, by parabolas through samples of the series.
template <class P>
HWY_ATTR void measure(MotionLanes<P>& m, const P& h) {
  constexpr int intervals = 8;
  const int N = m.N;
  for (const auto& disk : m.disks) {  // with any blade
    uint64_t touching = 0;
    for (size_t i = 0; i < disk->count; ++i) touching |= m.contacts[disk->first + i].touching;
    P& duty = m.contacts[disk->first].duty;
    duty = duty + select(mask_of<P>(touching & m.active), h, P(0.0));
  }
  for (ContactLanes<P>& c : m.contacts) {
    const uint64_t touching = c.touching & m.active;
    if (touching == 0) continue;
    const typename P::Mask in_touch = mask_of<P>(touching);
    if (!c.disk) c.duty = c.duty + select(in_touch, h, P(0.0));
    c.stuck = c.stuck + select(mask_of<P>(c.sticking & m.active), h, P(0.0));
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
      if (!m.alike.empty() && (c.sticking & m.active) != 0) {
        const P share = shared_friction(m, static_cast<size_t>(&c - m.contacts.data()), t);
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

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
