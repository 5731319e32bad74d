// Sums over older coefficients in products of series, those of a contact at once.

#if defined(WHIRL_CONVOLUTION_TAIL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_CONVOLUTION_TAIL_INL_H
#undef WHIRL_CONVOLUTION_TAIL_INL_H
#else
#define WHIRL_CONVOLUTION_TAIL_INL_H
#endif

#include "libdyn/taylor/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What coefficients 1 to k - 1 add to coefficient k of products of series; of squares, half of it.
///
/// Pairs i, k - i from the middle outwards: the newest come last, which shortens the chain.
/// Operands are references, for g++ 12 stores copies of packs and never reads them.
///
/// @tparam P  of the sums; operands are of this type, or carry slopes that are left out
template <class P>
struct ConvolutionTail {
  P xx{0.0}, yy{0.0}, rr{0.0};  // halves
  P xq{0.0}, yq{0.0}, rq{0.0};

  template <class Q>
  HWY_ATTR inline void square(const Q* x, const Q* y, int k) {
    if (k % 2 == 0) {
      const P &xm = as<P>(x[k / 2]), &ym = as<P>(y[k / 2]);
      xx = 0.5 * xm * xm;
      yy = 0.5 * ym * ym;
    }
    for (int i = (k - 1) / 2; i > 0; --i) {
      xx = fma(as<P>(x[i]), as<P>(x[k - i]), xx);
      yy = fma(as<P>(y[i]), as<P>(y[k - i]), yy);
    }
  }
  HWY_ATTR inline void square(const P* x, const P* y, const P* r, int k) {
    if (k % 2 == 0) {
      const P &xm = x[k / 2], &ym = y[k / 2], &rm = r[k / 2];
      xx = 0.5 * xm * xm;
      yy = 0.5 * ym * ym;
      rr = 0.5 * rm * rm;
    }
    for (int i = (k - 1) / 2; i > 0; --i) {
      xx = fma(x[i], x[k - i], xx);
      yy = fma(y[i], y[k - i], yy);
      rr = fma(r[i], r[k - i], rr);
    }
  }
  HWY_ATTR inline void multiply(const P* x, const P* y, const P* r, const P* q, int k) {
    if (k % 2 == 0) {
      const P& qm = q[k / 2];
      xq = x[k / 2] * qm;
      yq = y[k / 2] * qm;
      rq = r[k / 2] * qm;
    }
    for (int i = (k - 1) / 2; i > 0; --i) {
      const P &qi = q[i], &qj = q[k - i];
      xq = fma(x[i], qj, fma(x[k - i], qi, xq));
      yq = fma(y[i], qj, fma(y[k - i], qi, yq));
      rq = fma(r[i], qj, fma(r[k - i], qi, rq));
    }
  }
  /// Half of order k of x^2 + y^2, with the newest terms.
  template <class Q>
  HWY_ATTR inline P half_of_square(const Q* x, const Q* y, int k) const {
    return fma(as<P>(x[0]), as<P>(x[k]), xx) + fma(as<P>(y[0]), as<P>(y[k]), yy);
  }
  /// Squares and products at once, with one load of every coefficient.
  HWY_ATTR inline void square_and_multiply(const P* x, const P* y, const P* r, const P* q, int k) {
    if (k % 2 == 0) {
      const P &xm = x[k / 2], &ym = y[k / 2], &rm = r[k / 2], &qm = q[k / 2];
      xx = 0.5 * xm * xm;
      yy = 0.5 * ym * ym;
      rr = 0.5 * rm * rm;
      xq = xm * qm;
      yq = ym * qm;
      rq = rm * qm;
    }
    for (int i = (k - 1) / 2; i > 0; --i) {
      const P &qi = q[i], &qj = q[k - i];
      const P &xi = x[i], &xj = x[k - i], &yi = y[i], &yj = y[k - i], &ri = r[i], &rj = r[k - i];
      xx = fma(xi, xj, xx);
      xq = fma(xi, qj, fma(xj, qi, xq));
      yy = fma(yi, yj, yy);
      yq = fma(yi, qj, fma(yj, qi, yq));
      rr = fma(ri, rj, rr);
      rq = fma(ri, qj, fma(rj, qi, rq));
    }
  }
};

/// Order k > 0 of x^2 + y^2, without slopes.
template <class P>
HWY_ATTR inline P square_of(const P* x, const P* y, int k) {
  ConvolutionTail<PlainOf<P>> older;
  older.square(x, y, k);
  const PlainOf<P> half = older.half_of_square(x, y, k);
  return P(half + half);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
