// How long a step may be for the series of the motion.

#if defined(WHIRL_STEP_LENGTH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_STEP_LENGTH_INL_H
#undef WHIRL_STEP_LENGTH_INL_H
#else
#define WHIRL_STEP_LENGTH_INL_H
#endif

#include <cmath>

#include "libdyn/taylor/motion_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Logarithm to base 2 of the step at which a term of a series is as large as the tolerance: its
/// coefficient `last` times the step to the power `order`.
template <class V>
HWY_ATTR inline V log2_step(const V& log2_tolerance, const V& last, int order) {
  return (log2_tolerance - rough_log2(last)) * V(1.0 / order);
}

/// How far the series of a step may be trusted, and whether they are numbers at all.
template <class P>
struct StepLength {
  double log2_tolerance;
  typename P::Mask finite, bounded;  ///< lanes whose series is one of numbers, whose motion is of
                                     ///< sane size

  explicit StepLength(double tolerance) : log2_tolerance(std::log2(tolerance)) {}

  HWY_ATTR P find(MotionLanes<P>& m);
};

/// Step at which the last two terms are as large as the tolerance allows.
template <class P>
HWY_ATTR P StepLength<P>::find(MotionLanes<P>& m) {
  using V = PlainOf<P>;
  const int N = m.N;
  V last(1e-280), before(1e-280), sum(0.0), size(0.0);
  const P *a = m.term(N + 2), *b = m.term(N + 1), *y = m.y.data();
  for (int i = 0; i < m.n; ++i) {
    const V& scale = as<V>(m.scale[static_cast<size_t>(i)]);
    const V in_a = abs(as<V>(a[i])) * scale, in_b = abs(as<V>(b[i])) * scale;
    last = max(last, in_a);
    before = max(before, in_b);
    sum = sum + in_a + in_b;  // unlike a maximum, it never loses what is no number
    size = max(size, abs(as<V>(y[i])) * scale);
  }
  // quadruple numbers reach further, and need to: with a law that has no Taylor series at a
  // surface, the last of thirty terms gets there
  const V huge(1e300);
  finite = less(sum, P::is_double ? huge : huge * huge * huge);
  bounded = less(size, V(boundless));
  const V e(log2_tolerance);
  V h = min(min(log2_step(e, last, N + 2), log2_step(e, before, N + 1)), V(900.0));
  if (!m.is_analytic) {  // steps get short at a surface: the last term of the velocity counts too
    const V speed = rough_log2(as<V>(m.clock.rate)) - V(std::log2(N + 2.0));
    h = min(h, log2_step(V(e + speed), last, N + 1));
  }
  V step = V(0.95) * rough_exp2(h);
  for (const ContactLanes<P>& c : m.contacts) {
    if (c.shapes) step = min(step, as<V>(c.shapes->longest));
  }
  return P(step);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
