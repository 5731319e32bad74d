#include "libdyn/system/running_film.hpp"

#include <cassert>
#include <numbers>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

double RunningFilm::attitude_deg() const {
  return attitude / degree;
}

RunningFilm running_film(const OilFilm& film, double Omega, const Vec2& place, double drag) {
  FilmAtSpeed at = at_speed(film, Omega, drag);
  at.offset.setZero();
  const auto slopes = film_slopes(at, place, Vec2::Zero());
  assert(slopes);
  RunningFilm running{.name = film.name,
                      .place = place,
                      .load = -slopes->force,
                      .stiffness = -slopes->by_u,
                      .damping = -slopes->by_u_rate};
  const auto& [R, L, c, viscosity] = film.bearing;
  const Vec2& p = running.place;
  const Vec2& W = running.load;
  const double e = p.norm() / c, cross = W(0) * p(1) - W(1) * p(0);
  running.eccentricity = e;
  running.thickness = c - p.norm();
  const bool is_loaded = !W.isZero(0.0);
  running.attitude = is_loaded ? std::atan2(cross, W.dot(p)) : nan;
  const double spin = at.spin == 0.0 ? 0.0 : std::abs(drag);
  const double turns = spin / (2.0 * std::numbers::pi);
  running.sommerfeld = is_loaded && spin > 0.0
                           ? viscosity * turns * 2.0 * R * L / W.norm() * (R / c) * (R / c)
                           : nan;
  const double shear = 2.0 * std::numbers::pi * viscosity * spin * R * R * R * L /
                       (c * std::sqrt((1.0 - e) * (1.0 + e)));
  running.power_loss = spin * (shear + 0.5 * std::abs(cross));
  return running;
}

}  // namespace whirl::inline dyn
