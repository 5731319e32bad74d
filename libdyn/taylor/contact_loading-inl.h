// How the numbers of a contact get into a lane.

#if defined(WHIRL_CONTACT_LOADING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_CONTACT_LOADING_INL_H
#undef WHIRL_CONTACT_LOADING_INL_H
#else
#define WHIRL_CONTACT_LOADING_INL_H
#endif

#include "libdyn/taylor/contact_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What a contact is made of, without its kind of law and its state.
template <class P>
HWY_ATTR void ContactLanes<P>::load_numbers(const ReducedContact& from, int l, double turn) {
  const Friction& f = from.friction;
  const Number circle = Number(from.clearance) + Number(tip_radius_of(from.geometry));
  set_lane(clearance, l, circle);
  set_lane(clearance2, l, circle * circle);
  set_lane(distance_scale, l, circle * Number(from.clearance));
  if (const auto* blade = std::get_if<geometry::BladeRow>(&from.geometry)) {
    set_lane(blade_cosine, l, blade->cosine);
    set_lane(blade_sine, l, blade->sine);
  }
  if (const auto* element = rolling_elements(from.geometry)) load_element(from, *element, l, turn);
  set_lane(offset_x, l, from.offset(0));
  set_lane(offset_y, l, from.offset(1));
  set_lane(mu, l, f.mu);
  set_lane(rim, l, from.rim_speed);
  set_lane(inverse_width, l, f.tolerance > 0.0 ? Number(1.0) / Number(f.tolerance) : Number(1.0));
  set_lane(force_scale, l, normal_force(from.law, from.clearance, 0.0));
  set_lane(slip_scale, l,
           std::max(std::abs(from.rim_speed), from.clearance * turn) * from.clearance);
  const double begins = whirl::least_depth(from.law) * from.clearance;
  set_lane(least_depth, l, is_analytic(from.law) ? -boundless : begins);
  set_law(law, from.law, l);
  for (size_t i = 0; i < ux.size(); ++i) set_lane(ux[i], l, from.U(0, rows.of_x[i]));
  for (size_t i = 0; i < uy.size(); ++i) set_lane(uy[i], l, from.U(1, rows.of_y[i]));
  for (size_t i = 0; i < bx.size(); ++i) set_lane(bx[i], l, from.B(rows.pushed_by_x[i], 0));
  for (size_t i = 0; i < by.size(); ++i) set_lane(by[i], l, from.B(rows.pushed_by_y[i], 1));
  if (const auto n = direction_of(from.geometry)) load_plane(from, *n, l, turn);
  if (wall) load_wall(from, l, turn);
  if (rub) rub->load(from, l);
}

/// A plane is compared with its clearance, and d and r do not have its unit.
template <class P>
HWY_ATTR void ContactLanes<P>::load_plane(const ReducedContact& from, const Vec2& n, int l,
                                          double turn) {
  const Number x = n(0), y = n(1);
  set_lane(dx[0], l, x);
  set_lane(dy[0], l, y);
  set_lane(plane_at, l,
           Number(from.clearance) + (x * Number(from.offset(0)) + y * Number(from.offset(1))));
  set_lane(clearance, l, 1.0);
  set_lane(clearance2, l, 1.0);
  set_lane(distance_scale, l, from.clearance);
  set_lane(slip_scale, l, std::max(std::abs(from.rim_speed), from.clearance * turn));
}

/// How far an element is pressed is compared with the clearance.
template <class P>
HWY_ATTR void ContactLanes<P>::load_element(const ReducedContact& from,
                                            const geometry::RollingElements& element, int l,
                                            double turn) {
  set_lane(blade_cosine, l, std::cos(element.angle));
  set_lane(blade_sine, l, std::sin(element.angle));
  set_lane(plane_at, l, element.play);
  set_lane(clearance, l, 1.0);
  set_lane(clearance2, l, 1.0);
  set_lane(distance_scale, l, from.clearance);
  if (shapes) shapes->load(from, turn, l);
}

/// What a wall is beyond zero is compared with one.
template <class P>
HWY_ATTR void ContactLanes<P>::load_wall(const ReducedContact& from, int l, double turn) {
  wall->load(from, l);
  for (P* one : {&clearance, &clearance2, &distance_scale}) set_lane(*one, l, 1.0);
  set_lane(slip_scale, l, std::max(std::abs(from.rim_speed), from.clearance * turn));
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
