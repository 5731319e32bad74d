// Friction that acts elsewhere than the normal force, as that of a face.

#if defined(WHIRL_RUB_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_RUB_LANES_INL_H
#undef WHIRL_RUB_LANES_INL_H
#else
#define WHIRL_RUB_LANES_INL_H
#endif

#include <vector>

#include "libdyn/taylor/pack-inl.h"
#include "libdyn/taylor/pattern.hpp"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// The lateral velocity of the slip in all lanes, the coordinates that friction pushes.
template <class P>
struct RubLanes {
  const Pattern::ContactRows& rows;
  std::vector<P> vx, vy;                             // per slips_by_x, slips_by_y
  std::vector<P> bx, by;                             // per rubbed_x, rubbed_y
  P wx[P::most_terms] = {}, wy[P::most_terms] = {};  // lateral velocity V eta'
  int last = 0;                                      // coefficient of the coordinates that there is
  P fx{0.0}, fy{0.0};  // newest coefficient of the friction on the rotor, sign reversed

  explicit RubLanes(const Pattern::ContactRows& of)
      : rows(of),
        vx(of.slips_by_x.size(), P(0.0)),
        vy(of.slips_by_y.size(), P(0.0)),
        bx(of.rubbed_x.size(), P(0.0)),
        by(of.rubbed_y.size(), P(0.0)) {}

  HWY_ATTR void load(const ReducedContact& from, int l) {
    const PlaneRows& V = from.rubs_apart() ? from.V : from.U;
    const PlaneColumns& B_t = from.rubs_apart() ? from.B_t : from.B;
    for (size_t i = 0; i < vx.size(); ++i) set_lane(vx[i], l, V(0, rows.slips_by_x[i]));
    for (size_t i = 0; i < vy.size(); ++i) set_lane(vy[i], l, V(1, rows.slips_by_y[i]));
    for (size_t i = 0; i < bx.size(); ++i) set_lane(bx[i], l, B_t(rows.rubbed_x[i], 0));
    for (size_t i = 0; i < by.size(); ++i) set_lane(by[i], l, B_t(rows.rubbed_y[i], 1));
  }

  /// V times coordinates or their rates.
  HWY_ATTR inline void lateral(const P* x, P& to_x, P& to_y) const {
    to_x = to_y = P(0.0);
    for (size_t i = 0; i < vx.size(); ++i) to_x = fma(vx[i], x[rows.slips_by_x[i]], to_x);
    for (size_t i = 0; i < vy.size(); ++i) to_y = fma(vy[i], x[rows.slips_by_y[i]], to_y);
  }

  /// Coefficient k of the velocity, from coefficient k + 1 of the coordinates.
  HWY_ATTR inline void velocity(const P* next, int k) {
    lateral(next, wx[k], wy[k]);
    const P whole(k + 1.0);
    wx[k] = whole * wx[k];
    wy[k] = whole * wy[k];
  }

  /// Coefficient k of a signal with the rates that are in it, n . V eta'.
  HWY_NOINLINE HWY_ATTR P with_rates(const P& s, const P* x, int k, const P& nx, const P& ny) {
    if (k >= last) return s;
    velocity(x + rows.coordinates, k);
    return fma(nx, wx[k], fma(ny, wy[k], s));
  }

  /// Coefficient k of d x w, whose quotient by the distance is in the slip.
  HWY_ATTR inline P turn(const P* dx, const P* dy, int k) const {
    P sum(0.0);
    for (int i = 0; i <= k; ++i) sum = fma(dx[i], wy[k - i], fnma(dy[i], wx[k - i], sum));
    return sum;
  }

  /// Adds -force to the accelerations of the coordinates.
  HWY_ATTR inline void push(P* acceleration, const P& of_x, const P& of_y) const {
    for (size_t i = 0; i < bx.size(); ++i) {
      P& a = acceleration[rows.rubbed_x[i]];
      a = fnma(bx[i], of_x, a);
    }
    for (size_t i = 0; i < by.size(); ++i) {
      P& a = acceleration[rows.rubbed_y[i]];
      a = fnma(by[i], of_y, a);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
