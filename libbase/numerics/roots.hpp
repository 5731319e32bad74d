#pragma once
/// Roots and maxima of functions of one variable, between bounds that hold them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline base {

/// Where a function with opposite signs at two places is zero, by Brent's method: inverse quadratic
/// interpolation and secants, bisection where they would not help.
///
/// @param f          double -> double, finite; where it is not, the search ends there
/// @param a, b       bounds in any order, f(a) f(b) <= 0
/// @param fa, fb     values there
/// @param tolerance  of the root, absolute
/// @return           NaN if the signs at the bounds are the same or the function is not finite
/// @source [Brent1973], ch. 4
template <class Function>
double bracketed_root(Function&& f, double a, double fa, double b, double fb, double tolerance) {
  constexpr int most = 200;  // bisection alone needs 60 from any bounds
  if (fa == 0.0) return a;
  if (fb == 0.0) return b;
  if (!std::isfinite(fa) || !std::isfinite(fb) || (fa > 0.0) == (fb > 0.0)) return nan;
  double c = a, fc = fa;               // root between b and c, b the better one
  double step = b - a, before = step;  // this step and the last but one
  for (int i = 0; i < most; ++i) {
    if ((fb > 0.0) == (fc > 0.0)) {
      c = a, fc = fa;
      step = before = b - a;
    }
    if (std::abs(fc) < std::abs(fb)) {
      a = b, fa = fb;
      b = c, fb = fc;
      c = a, fc = fa;
    }
    const double least =
        2.0 * std::numeric_limits<double>::epsilon() * std::abs(b) + 0.5 * tolerance;
    const double half = 0.5 * (c - b);
    if (std::abs(half) <= least || fb == 0.0) return b;
    if (std::abs(before) >= least && std::abs(fa) > std::abs(fb)) {
      double p, q;
      const double s = fb / fa;
      if (a == c) {
        p = 2.0 * half * s;
        q = 1.0 - s;
      } else {
        const double r = fa / fc, t = fb / fc;
        p = s * (2.0 * half * r * (r - t) - (b - a) * (t - 1.0));
        q = (r - 1.0) * (t - 1.0) * (s - 1.0);
      }
      if (p > 0.0) q = -q;
      p = std::abs(p);
      const bool helps =
          2.0 * p < std::min(3.0 * half * q - std::abs(least * q), std::abs(before * q));
      before = helps ? step : half;
      step = helps ? p / q : half;
    } else {
      step = before = half;
    }
    a = b, fa = fb;
    b += std::abs(step) > least ? step : std::copysign(least, half);
    fb = f(b);
    if (!std::isfinite(fb)) return nan;
  }
  return b;
}

/// The same, where the values at the bounds are not known yet.
template <class Function>
double bracketed_root(Function&& f, double a, double b, double tolerance) {
  const double fa = f(a), fb = f(b);
  return bracketed_root(f, a, fa, b, fb, tolerance);
}

/// A place and the value of a function there.
struct Maximum {
  double at = 0.0, value = 0.0;
};

/// The maximum of a function with one maximum between two places, by Brent's method: parabolas, and
/// golden sections where they would not help.
///
/// @param f          double -> double
/// @param guess      between the bounds
/// @param tolerance  of the place, absolute; a tolerance below the square root of rounding is not
///                   reached
/// @source [Brent1973], ch. 5
template <class Function>
Maximum bracketed_maximum(Function&& f, double low, double guess, double high, double tolerance) {
  constexpr int most = 200;  // golden sections alone need 40 to 1e-8
  constexpr double golden = 0.3819660112501051;
  constexpr double rounding = 1.5e-8;  // square root of the machine's, relative
  double x = guess, w = x, v = x;      // the best, second and third place so far
  double fx = f(x), fw = fx, fv = fx;
  double step = 0.0, before = 0.0;
  for (int i = 0; i < most; ++i) {
    const double middle = 0.5 * (low + high);
    const double least = rounding * std::abs(x) + 0.25 * tolerance;
    if (std::abs(x - middle) <= 2.0 * least - 0.5 * (high - low)) break;
    bool is_golden = true;
    if (std::abs(before) > least) {
      const double r = (x - w) * (fx - fv);
      double q = (x - v) * (fx - fw);
      double p = (x - v) * q - (x - w) * r;
      q = 2.0 * (q - r);
      if (q > 0.0) p = -p;
      q = std::abs(q);
      const double last = std::exchange(before, step);
      if (std::abs(p) < std::abs(0.5 * q * last) && p > q * (low - x) && p < q * (high - x)) {
        step = p / q;
        const double u = x + step;
        if (u - low < 2.0 * least || high - u < 2.0 * least)
          step = std::copysign(least, middle - x);
        is_golden = false;
      }
    }
    if (is_golden) {
      before = (x < middle ? high : low) - x;
      step = golden * before;
    }
    const double u = x + (std::abs(step) >= least ? step : std::copysign(least, step));
    const double fu = f(u);
    if (fu >= fx) {
      (u < x ? high : low) = x;
      v = w, fv = fw;
      w = x, fw = fx;
      x = u, fx = fu;
    } else {
      (u < x ? low : high) = u;
      if (fu >= fw || w == x) {
        v = w, fv = fw;
        w = u, fw = fu;
      } else if (fu >= fv || v == x || v == w) {
        v = u, fv = fu;
      }
    }
  }
  return {x, fx};
}

}  // namespace whirl::inline base
