#include "libdyn/system/film.hpp"

namespace whirl::inline dyn {

namespace {

/// Displacement over the clearance.
Vec2 place(const ReducedFilm& film, const double* y, int coordinates) {
  const Eigen::Map<const Vec> eta(y, coordinates);
  return (film.U * eta - film.offset) / film.clearance;
}

}  // namespace

double eccentricity(const ReducedFilm& film, const double* y, int coordinates) {
  return place(film, y, coordinates).norm();
}

Vec2 film_force(const ReducedFilm& film, const double* y, int coordinates) {
  const Vec2 d = place(film, y, coordinates);
  const Eigen::Map<const Vec> rate(y + coordinates, coordinates);
  const Vec2 v = film.U * rate / (film.clearance * film.rate);
  const auto [fx, fy] = std::visit(
      [&](const auto& law) {
        return law.force(d(0), d(1), film.spin * d(0) - 2.0 * v(1), film.spin * d(1) + 2.0 * v(0));
      },
      film.law);
  return film.factor * film.rate * Vec2(fx, fy);
}

}  // namespace whirl::inline dyn
