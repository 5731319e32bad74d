// Series for a few bodies with one contact between them, the commonest small model:
// everything about an order that fits stays in registers.

#if defined(WHIRL_MOTION_BODIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_MOTION_BODIES_INL_H
#undef WHIRL_MOTION_BODIES_INL_H
#else
#define WHIRL_MOTION_BODIES_INL_H
#endif

#include "libdyn/taylor/motion_series-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// A contact's displacement along x and y, of bodies whose x and y take turns.
template <int Bodies, class V, class P>
HWY_ATTR HWY_INLINE void displacement(const P* ux, const P* uy, const P* x, P& to_x, P& to_y) {
  P along = as<V>(ux[0]) * x[0], across = as<V>(uy[0]) * x[1];
  for (int i = 1; i < Bodies; ++i) {
    along = fma(as<V>(ux[i]), x[2 * i], along);
    across = fma(as<V>(uy[i]), x[2 * i + 1], across);
  }
  to_x = along;
  to_y = across;
}

/// Coefficients x_{k+2} from those up to k + 1, of Pattern::bodies, while friction has no series of
/// its own. Loads from memory decide how long this takes, so what is used twice is loaded once:
/// of isotropic bodies, one coefficient serves x and y.
///
/// V is P, or its value alone where the linear part and the contact's rows have no slopes.
///
/// Every number is made by the operations of find_of_any in their order: a lane must not notice
/// which of the two its neighbors ask for.
template <class P>
template <int Bodies, bool Isotropic, class V, class Law>
HWY_ATTR void MotionSeries<P>::find_of_bodies(Law& law) {
  constexpr int n = 2 * Bodies;
  const int N = m_.N;
  ContactLanes<P>& c = m_.contacts[0];
  std::copy(m_.y.begin(), m_.y.end(), m_.term(0));
  m_.equations.template find_load<V>(m_.clock, N + 1);
  // none of these overlap, which the compiler cannot know of registers in memory
  P* __restrict dx = c.dx, * __restrict dy = c.dy, * __restrict s = c.s, * __restrict r = c.r;
  P* __restrict N_of = c.N, * __restrict q = c.q;
  const P *ux = c.ux.data(), *uy = Isotropic ? ux : c.uy.data();
  const P *bx = c.bx.data(), *by = Isotropic ? bx : c.by.data();
  const P *K = m_.equations.K.data(), *D = m_.equations.damping.data(),
          *load = m_.equations.load_terms.data();
  const typename P::Mask in_touch = c.in_touch;
  P *now = m_.term(0), *rate = m_.term(1), *next = m_.term(2);

  P acceleration[n];
  const auto accelerate = [&](const P* newest) HWY_ATTR {
    each<n>(n, [&](int i) HWY_ATTR {
      const int j = Isotropic ? i & ~1 : i;
      acceleration[i] = fnma(as<V>(D[j]), newest[i], fnma(as<V>(K[j]), now[i], load[i]));
    });
  };

  displacement<Bodies, V>(ux, uy, now, dx[0], dy[0]);
  displacement<Bodies, V>(ux, uy, rate, dx[1], dy[1]);
  dx[0] = dx[0] - c.offset_x;
  dy[0] = dy[0] - c.offset_y;
  s[0] = fma(dx[0], dx[0], dy[0] * dy[0]);
  if (c.is_evaluated) c.first_distance();
  accelerate(rate);
  for (int k = 0;; ++k) {
    ConvolutionTail<P> older;
    if (c.is_evaluated) {
      P px, py;
      if (k == 0) {
        N_of[0] = law.normal(0, max(r[0] - c.clearance, c.least_depth));
        q[0] = select(in_touch, N_of[0] * c.inverse_r, P(0.0));
        px = q[0] * dx[0];
        py = q[0] * dy[0];
      } else {
        older.square_and_multiply(dx, dy, r, q, k);
        const P half_s = older.half_of_square(dx, dy, k);
        s[k] = half_s + half_s;
        r[k] = (half_s - older.rr) * c.inverse_r;
        N_of[k] = law.normal(k, r[k]);
        q[k] = select(in_touch, (N_of[k] - fma(r[k], q[0], older.rq)) * c.inverse_r, P(0.0));
        px = fma(q[k], dx[0], fma(q[0], dx[k], older.xq));
        py = fma(q[k], dy[0], fma(q[0], dy[k], older.yq));
      }
      const P fx = fnma(c.share, py, px), fy = fma(c.share, px, py);
      for (int i = 0; i < Bodies; ++i) {
        acceleration[2 * i] = fnma(as<V>(bx[i]), fx, acceleration[2 * i]);
        acceleration[2 * i + 1] = fnma(as<V>(by[i]), fy, acceleration[2 * i + 1]);
      }
    } else if (k > 0) {
      s[k] = square_of<P>(dx, dy, k);
    }
    const typename P::Number scale = twice_integrated<P>(k);
    P newest[n];
    each<n>(n, [&](int i) HWY_ATTR { next[i] = newest[i] = acceleration[i] * scale; });
    displacement<Bodies, V>(ux, uy, newest, dx[k + 2], dy[k + 2]);
    if (k == N) break;
    now = rate;
    rate = next;
    next += n;
    D += n;
    load += n;
    accelerate(newest);  // of the next order, while its rates are at hand
  }
  for (int k = N + 1; k <= N + 2; ++k) s[k] = square_of<P>(dx, dy, k);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
