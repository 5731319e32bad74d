// Events of polynomials in lanes: conservative advancement, each lane by itself.

#if defined(WHIRL_EVENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_EVENTS_INL_H
#undef WHIRL_EVENTS_INL_H
#else
#define WHIRL_EVENTS_INL_H
#endif

#include "libdyn/taylor/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Value and derivative of a polynomial in w, every second of the coefficients up to `last`.
template <class P>
HWY_ATTR inline void horner_of_half(const P* c, int last, const P& w, P& value, P& slope) {
  value = c[last];
  slope = P(0.0);
  for (int k = last - 2; k >= 0; k -= 2) {
    slope = fma(slope, w, value);
    value = fma(value, w, c[k]);
  }
}

/// Value and derivative of a polynomial, lowest coefficient first:  g(t) = a(t^2) + t b(t^2), two
/// short chains instead of a long one.
template <class P>
HWY_ATTR inline void horner(const P* c, int degree, const P& t, P& value, P& slope) {
  const P w = t * t;
  P a, a_slope, b, b_slope;
  horner_of_half(c, degree - degree % 2, w, a, a_slope);
  horner_of_half(c, degree - 1 + degree % 2, w, b, b_slope);
  value = fma(b, t, a);
  slope = fma(t + t, fma(b_slope, t, a_slope), b);
}

/// The positive root u of g + g' u - M u^2 / 2, for g >= 0, without cancellation and never too
/// long.
template <class P>
HWY_ATTR inline P safe_advance(const P& value, const P& slope, const P& M, const P& inverse_M,
                               const P& tiny) {
  const P square = fma(slope, slope, (M + M) * value);
  const P root = sqrt(square);
  const P up = (slope + root) * inverse_M;
  const P down = (value + value) / max(root - slope, tiny);
  return select(less(slope, P(0.0)), down, up) * P(typename P::Number(1.0) - P::rounding);
}

/// First fall below zero of sign * g on [0, h] in every active lane.
///
/// The same method as first_downward_zero of libbase/numerics/polynomial.hpp: with M >= |g''| on
/// [0, h], g(t + u) is at least g + g' u - M u^2 / 2, so t moves by the positive root of that. No
/// root can be jumped.
///
/// @param g           coefficients in time; g[0] counts as zero in lanes of `surface`
/// @param scale       what g is measured by: zero is P::rounding of it
/// @param h           in: length searched; out: shortened to the event where there is one
/// @param active      lanes that are asked; others keep their h
/// @param surface     lanes that start on the surface
/// @return            lanes with an event
template <class P>
HWY_ATTR typename P::Mask first_downward_zero(const P* g, int degree, const P& sign, const P& scale,
                                              P& h, const typename P::Mask& active,
                                              const typename P::Mask& surface) {
  using Mask = typename P::Mask;
  const P zero = scale * P(P::rounding), tiny = scale * P(1e-200), nothing(0.0);
  P M = P(degree * (degree - 1.0)) * abs(g[degree]);
  for (int k = degree - 1; k >= 2; --k) M = fma(M, h, P(k * (k - 1.0)) * abs(g[k]));
  M = max(M, scale * P(1e-60));
  const P value = select(surface, nothing, sign * g[0]);
  const P slope = sign * g[1];
  // most often a bound tells, without a root, that g does not get down to zero
  const P most_fall = fma(P(0.5) * M * h, h, abs(slope) * h);
  const Mask asked = without(active, less(most_fall + zero, value));
  if (!any(h, asked)) return asked;
  const P inverse_M = P(1.0) / M;
  Mask fell = both(asked, less(value, nothing));
  Mask running = without(asked, fell);

  // first advance from the start; on the surface, to the middle of where g is positive for certain
  const Mask near = both(running, less_equal(value, zero));
  const P from_surface = max(slope * inverse_M, nothing);
  P t = select(near, from_surface, safe_advance(max(value, nothing), slope, M, inverse_M, tiny));
  if (any(t, near)) {
    // on the surface the slope decides, or the bend where the slope is nothing but rounding
    const Mask flat =
        both(near, less_equal(abs(slope) * h, fma(M * h, h, scale) * P(1e3 * P::rounding)));
    const Mask falls = both(without(near, flat), less(slope, nothing));
    fell = either(fell, falls);
    running = without(running, falls);
    if (any(t, flat)) {
      const P bend = sign * g[2] * h * h, rounding = scale * P(1e3 * P::rounding);
      const Mask bends_down = both(flat, less(bend, -rounding));
      const Mask bends_up = both(flat, less(rounding, bend));
      P third = P(degree * (degree - 1.0) * (degree - 2.0)) * abs(g[degree]);
      for (int k = degree - 1; k >= 3; --k) {
        third = fma(third, h, P(k * (k - 1.0) * (k - 2.0)) * abs(g[k]));
      }
      t = select(bends_up, P(3.0) * sign * g[2] / max(third, scale * P(1e-60)), t);
      fell = either(fell, bends_down);
      running =
          without(running, without(flat, bends_up));  // without a bend it stays on the surface
    }
  }
  h = select(fell, nothing, h);
  running = both(running, less(t, h));

  constexpr int most_steps = 300;
  for (int step = 0; any(t, running); ++step) {
    P a, b;
    horner(g, degree, t, a, b);
    a = a * sign;
    b = b * sign;
    const P advance = safe_advance(max(a, nothing), b, M, inverse_M, tiny);
    const Mask hit = both(less_equal(a, zero), less(b, nothing));
    Mask found = both(running, either(hit, less(advance, P(P::rounding) * h)));
    if (step == most_steps) found = running;
    fell = either(fell, found);
    h = select(found, t, h);
    t = t + advance;
    running = both(without(running, found), less(t, h));
  }
  return fell;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
