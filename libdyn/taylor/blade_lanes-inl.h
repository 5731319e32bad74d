// What the places of a contact that turn share in all lanes: the motion of their disk as they see
// it.

#if defined(WHIRL_BLADE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_BLADE_LANES_INL_H
#undef WHIRL_BLADE_LANES_INL_H
#else
#define WHIRL_BLADE_LANES_INL_H
#endif

#include "libdyn/system/contact_system.hpp"
#include "libdyn/taylor/clock_lanes-inl.h"
#include "libdyn/taylor/series-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Series of u, the displacement of the disk, and of its products with the turning axes
/// e = (cos, sin)(Omega t) and f = (-sin, cos)(Omega t). A tip at the angle a is at
///
///   d = u + R (cos a e + sin a f),
///   d . d - (R + c)^2 = u . u + 2 R (cos a u . e + sin a u . f) - c (2 R + c)
///
/// in which the large R^2 do not appear: a blade costs one line, and keeps its digits. An element
/// of a rolling bearing is a blade of infinite length, n . u = cos a u . e + sin a u . f.
template <class P>
struct BladeLanes {
  using Number = typename P::Number;
  size_t first = 0;  ///< of the blades among all contacts
  size_t count = 0;

  P radius{1.0}, turns{1.0};       // R; speed over the rate of the phase
  P begin{0.0};                    // angle at the start of the revolution
  P rate{1.0};                     // of the phase
  P clearance2{1.0}, within{1.0};  // c^2, c (2 R + c)
  uint64_t tight = 0;              // lanes in which one may always touch
  P ux[P::most_terms], uy[P::most_terms], sine[P::most_terms], cosine[P::most_terms];
  P along[P::most_terms], across[P::most_terms], square[P::most_terms];

  HWY_ATTR void load(const ReducedContact& from, int l, Number rate_of_phase) {
    const Number R = tip_radius_of(from.geometry), c = from.clearance;
    const Number slack = slack_of(from.geometry, from.clearance);
    const uint64_t bit = uint64_t{1} << l;
    tight = slack > Number(0.0) ? tight & ~bit : tight | bit;
    set_lane(radius, l, R);
    set_lane(turns, l, turning_ratio_of(from.geometry));
    set_lane(rate, l, rate_of_phase);
    set_lane(clearance2, l, slack * slack);
    set_lane(within, l, c * (Number(2.0) * R + c));
  }
  HWY_ATTR void begin_revolution(const ReducedContact& from, long revolution, int l) {
    set_start_angle(begin, l, turning_ratio_of(from.geometry), revolution);
  }

  HWY_ATTR void start(const P& time) {
    sin_cos(fma(turns, rate * time, begin), sine[0], cosine[0]);
  }

  /// Coefficient k of all, from those of u, which stand in ux[k] and uy[k].
  HWY_ATTR void extend(int k) {
    if (k > 0) {
      const P turn = turns * rate * P(inverse_of<P>(k));
      sine[k] = turn * cosine[k - 1];
      cosine[k] = -(turn * sine[k - 1]);
    }
    P a(0.0), b(0.0), c(0.0);
    for (int i = 0; i <= k; ++i) {
      a = fma(ux[i], cosine[k - i], fma(uy[i], sine[k - i], a));
      b = fma(uy[i], cosine[k - i], fnma(ux[i], sine[k - i], b));
      c = fma(ux[i], ux[k - i], fma(uy[i], uy[k - i], c));
    }
    along[k] = a;
    across[k] = b;
    square[k] = c;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
