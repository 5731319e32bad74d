// One contact in all lanes: parameters, state, series of its displacement and forces.

#if defined(WHIRL_CONTACT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_CONTACT_LANES_INL_H
#undef WHIRL_CONTACT_LANES_INL_H
#else
#define WHIRL_CONTACT_LANES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "libdyn/system/contact_system.hpp"
#include "libdyn/taylor/blade_lanes-inl.h"
#include "libdyn/taylor/convolution_tail-inl.h"
#include "libdyn/taylor/events-inl.h"
#include "libdyn/taylor/law_lanes-inl.h"
#include "libdyn/taylor/pattern.hpp"
#include "libdyn/taylor/rub_lanes-inl.h"
#include "libdyn/taylor/shape_lanes-inl.h"
#include "libdyn/taylor/wall_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Sets or clears a lane's bit.
inline void put(uint64_t& bits_of, uint64_t bit, bool yes) {
  bits_of = yes ? bits_of | bit : bits_of & ~bit;
}

/// The force of a contact is -(q d + tau rot d): q = N / r, tau = T / r, rot d = (-d_y, d_x).
///
/// Of a plane d is its normal, r is one, and s, else the square of the distance, is how far the
/// rotor is beyond it. Of a wall d is the slope of the depth, r is one, and s is beyond zero where
/// the rotor is beyond the wall. Of a rolling element d is its direction, which turns, r is one,
/// and s is how far it is pressed. A limit of a signal is a plane whose s knows rates, too.
template <class P>
struct ContactLanes {
  using Number = typename P::Number;

  const Pattern::ContactRows& rows;

  // parameters
  P clearance{1.0}, clearance2{1.0}, offset_x{0.0}, offset_y{0.0};  // of the circle
  P distance_scale{1.0};                                            // of d . d - clearance^2
  P mu{0.0}, rim{0.0}, inverse_width{1.0};  // friction, Omega R, 1 / width of a smoothed sign
  P force_scale{1.0}, slip_scale{1.0};
  P least_depth{0.0};  // at the start of a step, see depth()
  AnyContactLaw<P> law;
  std::vector<P> ux, uy;                  // per of_x, of_y
  std::vector<P> bx, by;                  // per pushed_by_x, pushed_by_y
  std::unique_ptr<RubLanes<P>> rub;       // where friction acts elsewhere, or a normal
  P plane_at{0.0};                        // n . u of a plane; play of an element
  std::unique_ptr<WallLanes<P>> wall;     // of a wall
  const BladeLanes<P>* disk = nullptr;    // of what turns, what it shares with the others
  std::unique_ptr<ShapeLanes<P>> shapes;  // of an element, where its races are not round
  P blade_cosine{1.0}, blade_sine{0.0}, excess{0.0};  // of its angle; d . d - clearance^2 at first
  uint64_t continuous = 0, damped = 0, exact = 0, smooth = 0;

  // state, a bit per lane
  uint64_t touching = 0, receding = 0, sticking = 0;
  uint64_t leading = 0;  // sticking, the first of those that slip alike: tau is that of all of them
  P sign{1.0};           // of the slip
  uint64_t surface_distance = 0, surface_force = 0, surface_slip = 0;
  uint64_t level_slip = 0;  // on the surface, and the rate of the slip is zero too

  // this step
  bool rows_are_flat = false;            // of_x and the others have no slopes that numbers carry
  bool is_evaluated = false;             // whether any lane needs the force
  bool any_has_tau = false;              // whether in any lane tau is more than a share of q
  bool is_ahead = false;                 // whether the force needs geometry one coefficient ahead
  bool slip_is_known = false;            // whether `slip` is a series that was watched
  typename P::Mask evaluated, in_touch;  // lanes that need the force, lanes that feel it
  typename P::Mask has_tau;              // lanes that slide smoothly or stick
  P inverse_r{1.0}, share{0.0};
  P dx[P::most_terms], dy[P::most_terms], s[P::most_terms], r[P::most_terms];
  P N[P::most_terms], q[P::most_terms], tau[P::most_terms];  // tau: of lanes that have it
  P fx, fy;                                                  // newest coefficient of the force
  P slip[P::most_terms], sine[P::most_terms],
      cosine2[P::most_terms];              // smooth friction: u, tanh u, 1 - tanh^2 u
  P ax[P::most_terms], ay[P::most_terms];  // relative acceleration, for sticking

  // measures
  P duty{0.0}, stuck{0.0}, max_normal{0.0}, max_friction{0.0};

  /// @param order       of the series
  /// @param has_slopes  whether derivatives of the force are asked for
  ContactLanes(const Pattern::ContactRows& of, int order, bool has_slopes)
      : rows(of),
        ux(of.of_x.size(), P(0.0)),
        uy(of.of_y.size(), P(0.0)),
        bx(of.pushed_by_x.size(), P(0.0)),
        by(of.pushed_by_y.size(), P(0.0)),
        rub(of.slips_apart() ? std::make_unique<RubLanes<P>>(of) : nullptr) {
#ifndef NDEBUG  // a coefficient that is used before it is known makes no number
    for (P* of_all : {dx, dy, s, r, N, q, tau, slip, sine, cosine2, ax, ay, turn_rate}) {
      std::fill_n(of_all, P::most_terms, P(std::numeric_limits<double>::quiet_NaN()));
    }
#endif
    const auto* row = rolling_elements(of.geometry);
    if (row && !row->shapes.empty()) shapes = std::make_unique<ShapeLanes<P>>(*row);
    if (of.is_wall) wall = std::make_unique<WallLanes<P>>(of.geometry, order + 3, has_slopes);
    if (!of.has_normal()) return;
    for (int k = 0; k < P::most_terms; ++k) dx[k] = dy[k] = r[k] = P(0.0);
    r[0] = inverse_r = P(1.0);
  }

  HWY_ATTR void load(const ReducedContact& from, const ContactState& state, int l, double turn) {
    const uint64_t bit = uint64_t{1} << l;
    const Friction& f = from.friction;
    load_numbers(from, l, turn);
    put(continuous, bit, is_continuous(from.law));
    put(damped, bit, is_damped(from.law));
    put(exact, bit, f.is_exact());
    put(smooth, bit, f.mu > 0.0 && f.slip == Slip::actual && f.tolerance > 0.0);
    set_state(state, l);
    put(surface_distance, bit, false);
    put(surface_force, bit, false);
    put(surface_slip, bit, false);
    put(level_slip, bit, false);
    for (P* sum : {&duty, &stuck, &max_normal, &max_friction}) set_lane(*sum, l, 0.0);
  }

  // contact_loading-inl.h
  HWY_ATTR void load_numbers(const ReducedContact& from, int l, double turn);
  HWY_ATTR void load_plane(const ReducedContact& from, const Vec2& n, int l, double turn);
  HWY_ATTR void load_element(const ReducedContact& from, const geometry::RollingElements& element,
                             int l, double turn);
  HWY_ATTR void load_wall(const ReducedContact& from, int l, double turn);

  HWY_ATTR void set_state(const ContactState& state, int l) {
    const uint64_t bit = uint64_t{1} << l;
    put(touching, bit, state.in_touch());
    put(receding, bit, state.touch == Touch::receding);
    put(sticking, bit, state.touch == Touch::sticking);
    set_lane(sign, l, state.sign);
  }

  HWY_ATTR ContactState state(int l) const {
    const uint64_t bit = uint64_t{1} << l;
    if (sticking & bit) return {Touch::sticking, 1.0};
    if (touching & bit) return {Touch::sliding, lane(sign, l)};
    return {receding & bit ? Touch::receding : Touch::apart, 1.0};
  }

  /// Prepares for a step of the lanes that are active.
  /// @param last  the last coefficient of coordinates that there is
  HWY_ATTR void begin(uint64_t active, int last) {
    if (rub) rub->last = last;
    const uint64_t needed = (touching | receding) & active;
    is_evaluated = needed != 0;
    slip_is_known = false;
    const uint64_t own = sticking | (smooth & touching);
    has_tau = mask_of<P>(own);
    any_has_tau = (own & active) != 0;
    is_ahead = is_evaluated && (any_has_tau || rows.has_rate);
    evaluated = mask_of<P>(needed);
    in_touch = mask_of<P>(touching);
    share = mu * sign;
  }

  /// Coefficient k of the displacement: rows times coordinates. Here and below, Bodies is what
  /// Pattern::bodies says, where the compiler may know it; 0: anything.
  template <int Bodies = 0>
  HWY_ATTR inline void displacement(const P* x, P& to_x, P& to_y) const {
    if constexpr (Bodies > 0) {
      P along = ux[0] * x[0], across = uy[0] * x[1];
      for (int i = 1; i < Bodies; ++i) {
        along = fma(ux[static_cast<size_t>(i)], x[2 * i], along);
        across = fma(uy[static_cast<size_t>(i)], x[2 * i + 1], across);
      }
      to_x = along;
      to_y = across;
    } else {
      rows_are_flat ? displace<PlainOf<P>>(x, to_x, to_y) : displace<P>(x, to_x, to_y);
    }
  }
  /// V is P, or its value alone where rows have no slopes.
  template <class V>
  HWY_ATTR inline void displace(const P* x, P& to_x, P& to_y) const {
    to_x = as<V>(ux[0]) * x[rows.of_x[0]];
    to_y = as<V>(uy[0]) * x[rows.of_y[0]];
    for (size_t i = 1; i < ux.size(); ++i) to_x = fma(as<V>(ux[i]), x[rows.of_x[i]], to_x);
    for (size_t i = 1; i < uy.size(); ++i) to_y = fma(as<V>(uy[i]), x[rows.of_y[i]], to_y);
  }

  /// Coefficient 0 of displacement, distance squared, distance.
  HWY_ATTR inline void first_geometry(const P* x) {
    if (disk) return turning_geometry(0, is_evaluated);
    if (rows.is_plane) return plane_geometry(x, 0);
    if (wall) return wall_geometry(x, 0);
    P x0, y0;
    displacement(x, x0, y0);
    dx[0] = x0 = x0 - offset_x;
    dy[0] = y0 = y0 - offset_y;
    s[0] = fma(x0, x0, y0 * y0);
    if (is_evaluated) first_distance();
  }
  /// Coefficient 0 of the distance, and what divides by it.
  HWY_ATTR inline void first_distance() {
    r[0] = sqrt(select(evaluated, s[0], clearance2));  // harmless where there is no touch
    inverse_r = P(1.0) / r[0];
  }

  /// Coefficient k > 0 of the same.
  HWY_ATTR inline void geometry(const P* x, int k, bool with_distance) {
    if (disk) return turning_geometry(k, with_distance);
    if (rows.is_plane) return plane_geometry(x, k);
    if (wall) return wall_geometry(x, k);
    displacement(x, dx[k], dy[k]);
    if (!with_distance) {
      s[k] = square_of<P>(dx, dy, k);
      return;
    }
    ConvolutionTail<P> older;
    older.square(dx, dy, r, k);
    const P half_s = older.half_of_square(dx, dy, k);
    s[k] = half_s + half_s;
    r[k] = (half_s - older.rr) * inverse_r;
  }

  /// The same of a plane, for any k.
  HWY_ATTR inline void plane_geometry(const P* x, int k) {
    P xk, yk;
    displacement(x, xk, yk);
    s[k] = fma(dx[0], xk, dy[0] * yk);
    if (k == 0) s[0] = s[0] - plane_at;
    if (rows.is_limit) s[k] = rub->with_rates(s[k], x, k, dx[0], dy[0]);
  }

  /// The same of a wall, for any k. Out of line: inside the loop that has this call its tapes make
  /// films in lanes 6 % slower.
  HWY_NOINLINE HWY_ATTR void wall_geometry(const P* x, int k) {
    P xk, yk;
    displacement(x, xk, yk);
    if (k == 0) {
      xk = xk - offset_x;
      yk = yk - offset_y;
    }
    s[k] = wall->square_at(k, xk, yk);
    if (k == 0) s[0] = s[0] - P(1.0);
    if (!is_evaluated) return;
    wall->move_beyond(k, xk, yk, evaluated);
    dx[k] = wall->beyond.series(wall->nx)[k];
    dy[k] = wall->beyond.series(wall->ny)[k];
  }

  /// What s has beyond the surface at time t, and its rate, with slopes: beside touch those of s
  /// are left out.
  HWY_ATTR void beyond_at(const P& t, int last, P& value, P& rate_of_it) {
    if (disk || rows.has_normal()) {
      const P s0 = s[0];
      s[0] = beyond();
      horner(s, last, t, value, rate_of_it);
      s[0] = s0;
      return;
    }
    P x, y, u, v;
    horner(dx, last, t, x, u);
    horner(dy, last, t, y, v);
    value = fma(x, x, y * y) - clearance2;
    rate_of_it = 2.0 * fma(x, u, y * v);
  }

  /// Coefficient 0 of what s has beyond the surface.
  HWY_ATTR inline P beyond() const {
    return rows.has_normal() ? s[0] : disk ? excess : s[0] - clearance2;
  }

  /// The same of a place that turns, for any k, from what its disk does.
  HWY_ATTR void turning_geometry(int k, bool with_distance) {
    const P turned = fma(blade_cosine, disk->along[k], blade_sine * disk->across[k]);
    if (rows.is_rolling) {
      s[k] = k == 0 ? turned - plane_at : turned;
      if (shapes) s[k] = s[k] + shapes->height(k);
      dx[k] = fnma(disk->sine[k], blade_sine, disk->cosine[k] * blade_cosine);
      dy[k] = fma(disk->cosine[k], blade_sine, disk->sine[k] * blade_cosine);
      return;
    }
    s[k] = fma(disk->radius + disk->radius, turned, disk->square[k]);
    if (k == 0) {
      excess = s[0] - disk->within;
      s[0] = excess + clearance2;
    }
    if (!with_distance && !is_evaluated) return;  // the displacement is for forces and slips
    const P along_x = fnma(disk->sine[k], blade_sine, disk->cosine[k] * blade_cosine);
    const P along_y = fma(disk->cosine[k], blade_sine, disk->sine[k] * blade_cosine);
    dx[k] = fma(disk->radius, along_x, disk->ux[k]);
    dy[k] = fma(disk->radius, along_y, disk->uy[k]);
    if (!with_distance) return;
    if (k == 0) return first_distance();
    P rest = s[k];
    for (int i = 1; i < k; ++i) rest = fnma(r[i], r[k - i], rest);
    r[k] = rest * (P(0.5) * inverse_r);
  }

  /// Coefficient k of the depth. A law that has no Taylor series at the surface starts its step
  /// just below it, where its force is still nothing; steps near the surface are short by
  /// themselves.
  HWY_ATTR inline P depth(int k) const {
    if (rows.has_normal()) {
      const P* own = depth_of_normal();
      return k == 0 ? max(own[0], least_depth) : own[k];
    }
    P d = r[k];
    if (k == 0) d = max(disk ? first_depth_of_blade() : d - clearance, least_depth);
    return d;
  }

  HWY_ATTR P first_depth_of_blade() const {
    return select(evaluated, excess, P(0.0)) / (r[0] + clearance);
  }

  /// Rate of the distance, coefficient k; for laws that know it, geometry is one coefficient ahead.
  HWY_ATTR inline P rate(int k) const {
    if (!rows.has_rate) return P(0.0);
    return P(k + 1.0) * (rows.has_normal() ? depth_of_normal()[k + 1] : r[k + 1]);
  }
  /// The series of the depth, where the lanes keep it.
  HWY_ATTR const P* depth_of_normal() const {
    return wall ? wall->beyond.series(wall->depth) : s;
  }

  /// Coefficient k of the normal force.
  HWY_ATTR inline P normal(AnyLawWork<P>& work, int k) const {
    P result;
    with_alternative(work, [&](auto& l) HWY_ATTR {
      result = rows.has_rate ? l.normal(k, depth(k), rate(k)) : l.normal(k, depth(k));
    });
    return result;
  }

  /// Coefficient k of the force on the rotor, sign reversed, in fx and fy; without the share of
  /// tau_k while sticking.
  HWY_ATTR inline void force(AnyLawWork<P>& work, int k) {
    N[k] = normal(work, k);
    P px, py;
    if (k == 0) {
      q[0] = select(in_touch, N[0] * inverse_r, P(0.0));
      px = q[0] * dx[0];
      py = q[0] * dy[0];
    } else {
      ConvolutionTail<P> older;
      older.multiply(dx, dy, r, q, k);
      q[k] = select(in_touch, (N[k] - fma(r[k], q[0], older.rq)) * inverse_r, P(0.0));
      px = fma(q[k], dx[0], fma(q[0], dx[k], older.xq));
      py = fma(q[k], dy[0], fma(q[0], dy[k], older.yq));
    }
    if (rub) return forces_apart(k, px, py);
    fx = fnma(share, py, px);
    fy = fma(share, px, py);
    if (!any_has_tau) return;
    tau[k] = friction(k);
    for (int i = 0; i <= k; ++i) {
      px = fnma(tau[i], dy[k - i], px);
      py = fma(tau[i], dx[k - i], py);
    }
    fx = select(has_tau, px, fx);
    fy = select(has_tau, py, fy);
  }

  /// The same from coefficient k of q d, normal force and friction apart.
  HWY_ATTR void forces_apart(int k, const P& of_x, const P& of_y) {
    fx = of_x;
    fy = of_y;
    rub->fx = -(share * of_y);
    rub->fy = share * of_x;
    if (!any_has_tau) return;
    tau[k] = friction(k);
    P tx(0.0), ty(0.0);
    for (int i = 0; i <= k; ++i) {
      tx = fnma(tau[i], dy[k - i], tx);
      ty = fma(tau[i], dx[k - i], ty);
    }
    rub->fx = select(has_tau, tx, rub->fx);
    rub->fy = select(has_tau, ty, rub->fy);
  }

  /// Adds coefficient k of d x d' to a sum;  d'_i = (i + 1) d_{i+1}.
  HWY_ATTR inline P add_turn(P sum, int k) const {
    for (int i = 0; i <= k; ++i) {
      const P factor(k - i + 1.0);
      sum = fma(dx[i], factor * dy[k - i + 1], sum);
      sum = fnma(dy[i], factor * dx[k - i + 1], sum);
    }
    return sum;
  }

  /// tau_k of lanes that slide smoothly; zero in sticking ones, for which it is solved later.
  HWY_ATTR P friction(int k) {
    if (smooth == 0) return P(0.0);
    // slip velocity rim + (d x d') / r, where friction acts elsewhere rim + (d x w) / r, over the
    // width
    P cross = rub ? rub->turn(dx, dy, k) : add_turn(P(0.0), k);
    for (int i = 1; i <= k; ++i) cross = fnma(r[i], turn_rate[k - i], cross);
    turn_rate[k] = cross * inverse_r;
    slip[k] = (k == 0 ? rim + turn_rate[0] : turn_rate[k]) * inverse_width;
    // y = tanh u:  y' = (1 - y^2) u'
    P y(0.0), z(0.0);
    if (k == 0) {
      y = tanh(slip[0]);
    } else {
      for (int i = 1; i <= k; ++i) y = fma(P(i * inverse_of<P>(k)) * slip[i], cosine2[k - i], y);
    }
    sine[k] = y;
    for (int i = 0; i <= k; ++i) z = fnma(sine[i], sine[k - i], z);
    cosine2[k] = k == 0 ? P(1.0) + z : z;
    P t(0.0);
    for (int i = 0; i <= k; ++i) t = fma(q[i], sine[k - i], t);
    return select(mask_of<P>(smooth), mu * t, P(0.0));
  }
  P turn_rate[P::most_terms];  // (d x d') / r

  /// Adds -force to the accelerations of the coordinates.
  template <int Bodies = 0>
  HWY_ATTR inline void push(P* acceleration, const P& of_x, const P& of_y) const {
    if constexpr (Bodies > 0) {
      for (int i = 0; i < Bodies; ++i) {
        P &x = acceleration[2 * i], &y = acceleration[2 * i + 1];
        x = fnma(bx[static_cast<size_t>(i)], of_x, x);
        y = fnma(by[static_cast<size_t>(i)], of_y, y);
      }
    } else {
      rows_are_flat ? push_on<PlainOf<P>>(acceleration, of_x, of_y)
                    : push_on<P>(acceleration, of_x, of_y);
    }
  }
  template <class V>
  HWY_ATTR inline void push_on(P* acceleration, const P& of_x, const P& of_y) const {
    for (size_t i = 0; i < bx.size(); ++i) {
      P& a = acceleration[rows.pushed_by_x[i]];
      a = fnma(as<V>(bx[i]), of_x, a);
    }
    for (size_t i = 0; i < by.size(); ++i) {
      P& a = acceleration[rows.pushed_by_y[i]];
      a = fnma(as<V>(by[i]), of_y, a);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
