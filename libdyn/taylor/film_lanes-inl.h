// One oil film in all lanes: parameters, series of its force and of the force's derivatives.

#if defined(WHIRL_FILM_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_FILM_LANES_INL_H
#undef WHIRL_FILM_LANES_INL_H
#else
#define WHIRL_FILM_LANES_INL_H
#endif

#include <array>
#include <vector>

#include "libdyn/system/film.hpp"
#include "libdyn/taylor/contact_slopes-inl.h"
#include "libdyn/taylor/series_tape-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// The force of a film is force_scale (fx, fy), with fx and fy of the law from
///
///   x, y: displacement over the clearance,   a = spin x - 2 y' / rate,   b = spin y + 2 x' / rate
template <class P>
struct FilmLanes {
  using Number = typename P::Number;

  const Pattern::FilmRows& rows;
  P inverse_clearance{1.0}, twice_inverse_speed{1.0};  // 2 / (clearance rate)
  P offset_x{0.0}, offset_y{0.0}, spin{0.0}, force_scale{0.0};
  P gain{0.0};            // largest eigenvalue of U B [1/kg]
  std::vector<P> ux, uy;  // per of_x, of_y
  std::vector<P> bx, by;  // per pushed_by_x, pushed_by_y
  SeriesTape<P> tape;
  Recorded<P> gap, fx, fy;                      // gap: 1 - x^2 - y^2
  std::vector<Recorded<P>> slopes_x, slopes_y;  // by x, y, a, b, if asked for

  FilmLanes(const Pattern::FilmRows& of, int order, bool has_slopes)
      : rows(of),
        ux(of.of_x.size(), P(0.0)),
        uy(of.of_y.size(), P(0.0)),
        bx(of.pushed_by_x.size(), P(0.0)),
        by(of.pushed_by_y.size(), P(0.0)),
        tape(order + 1) {
    const auto x = tape.input(), y = tape.input(), a = tape.input(), b = tape.input();
    gap = 1.0 - (x * x + y * y);
    std::visit([&](const auto& law) { std::tie(fx, fy) = law.force(x, y, a, b); }, rows.law);
    if (!has_slopes) return;
    slopes_x = tape.gradient(fx);
    slopes_y = tape.gradient(fy);
  }
  // what is recorded points to the tape
  FilmLanes(const FilmLanes&) = delete;
  FilmLanes& operator=(const FilmLanes&) = delete;

  HWY_ATTR void load(const ReducedFilm& from, int l) {
    const Number inverse = Number(1.0) / Number(from.clearance);
    set_lane(inverse_clearance, l, inverse);
    set_lane(twice_inverse_speed, l, Number(2.0) * inverse / Number(from.rate));
    set_lane(offset_x, l, from.offset(0));
    set_lane(offset_y, l, from.offset(1));
    set_lane(spin, l, from.spin);
    set_lane(force_scale, l, Number(from.factor) * Number(from.rate));
    set_lane(gain, l, (from.U * from.B).norm());
    for (size_t i = 0; i < ux.size(); ++i) set_lane(ux[i], l, from.U(0, rows.of_x[i]));
    for (size_t i = 0; i < uy.size(); ++i) set_lane(uy[i], l, from.U(1, rows.of_y[i]));
    for (size_t i = 0; i < bx.size(); ++i) set_lane(bx[i], l, from.B(rows.pushed_by_x[i], 0));
    for (size_t i = 0; i < by.size(); ++i) set_lane(by[i], l, from.B(rows.pushed_by_y[i], 1));
  }

  /// Rows times coordinates.
  HWY_ATTR inline void displacement(const P* x, P& to_x, P& to_y) const {
    to_x = ux[0] * x[rows.of_x[0]];
    to_y = uy[0] * x[rows.of_y[0]];
    for (size_t i = 1; i < ux.size(); ++i) to_x = fma(ux[i], x[rows.of_x[i]], to_x);
    for (size_t i = 1; i < uy.size(); ++i) to_y = fma(uy[i], x[rows.of_y[i]], to_y);
  }

  /// Adds a force to the accelerations of the coordinates.
  HWY_ATTR inline void push(P* acceleration, const P& of_x, const P& of_y) const {
    for (size_t i = 0; i < bx.size(); ++i) {
      P& a = acceleration[rows.pushed_by_x[i]];
      a = fma(bx[i], of_x, a);
    }
    for (size_t i = 0; i < by.size(); ++i) {
      P& a = acceleration[rows.pushed_by_y[i]];
      a = fma(by[i], of_y, a);
    }
  }

  /// Adds coefficient k of what the film does, from coefficients k and k + 1 of the coordinates.
  HWY_ATTR void add(const P* x, const P* next, int k, P* acceleration) {
    P inputs[4], vx, vy;
    displacement(x, inputs[0], inputs[1]);
    displacement(next, vx, vy);
    if (k == 0) {
      inputs[0] = inputs[0] - offset_x;
      inputs[1] = inputs[1] - offset_y;
    }
    inputs[0] = inputs[0] * inverse_clearance;
    inputs[1] = inputs[1] * inverse_clearance;
    const P rate = P(k + 1.0) * twice_inverse_speed;
    inputs[2] = fnma(rate, vy, spin * inputs[0]);
    inputs[3] = fma(rate, vx, spin * inputs[1]);
    tape.at(k, inputs);
    push(acceleration, force_scale * tape.series(fx)[k], force_scale * tape.series(fy)[k]);
  }

  /// The step in which the film gets thinner than a tenth of what it is now is too long: with
  ///
  ///   |Q(t) - Q_0| <= sum_{k>0} |Q_k| t^k = M(t),   M(s h) <= s M(h) for s <= 1.
  HWY_ATTR P shortened(const P& h, int order) const {
    const P* Q = tape.series(gap);
    P change(0.0);
    for (int k = order; k >= 1; --k) change = fma(change, h, abs(Q[k]));
    change = change * h;
    const P room = P(0.9) * Q[0];
    return select(less(room, change), h * (room / max(change, P(1e-300))), h);
  }

  /// J and H in  d(force) = J d(displacement) + H d(velocity).
  HWY_ATTR void find_slopes(SeriesMatrix<P>& J, SeriesMatrix<P>& H, int order) const {
    const P per_length = force_scale * inverse_clearance,
            per_speed = force_scale * twice_inverse_speed;
    const auto fill = [&](const std::vector<Recorded<P>>& by_input, P* jx, P* jy, P* hx, P* hy)
                          HWY_ATTR {
                            const P *x = tape.series(by_input[0]), *y = tape.series(by_input[1]),
                                    *a = tape.series(by_input[2]), *b = tape.series(by_input[3]);
                            for (int k = 0; k <= order; ++k) {
                              jx[k] = per_length * fma(spin, a[k], x[k]);
                              jy[k] = per_length * fma(spin, b[k], y[k]);
                              hx[k] = per_speed * b[k];
                              hy[k] = -(per_speed * a[k]);
                            }
                          };
    fill(slopes_x, J.xx, J.xy, H.xx, H.xy);
    fill(slopes_y, J.yx, J.yy, H.yx, H.yy);
  }

  /// The force at displacements and their rates, for one-step methods.
  HWY_ATTR void add_force(const P* y, const P* rate, P* acceleration, P& thinnest) const {
    P dx, dy, vx, vy;
    displacement(y, dx, dy);
    displacement(rate, vx, vy);
    dx = (dx - offset_x) * inverse_clearance;
    dy = (dy - offset_y) * inverse_clearance;
    const P a = fnma(twice_inverse_speed, vy, spin * dx),
            b = fma(twice_inverse_speed, vx, spin * dy);
    thinnest = min(thinnest, P(1.0) - fma(dx, dx, dy * dy));
    with_alternative(rows.law, [&](const auto& law) HWY_ATTR {
      const auto [x, y_force] = law.force(dx, dy, a, b);
      push(acceleration, force_scale * x, force_scale * y_force);
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
