#include "libdyn/system/film.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "libbase/numerics/roots.hpp"
#include "libcontact/dual_functions.hpp"

namespace whirl::inline dyn {

namespace {

/// Displacement over the clearance.
Vec2 place(const ReducedFilm& film, const double* y, StateLayout layout) {
  return (film.U * layout.eta(y) - film.offset) / film.clearance;
}

}  // namespace

double drag_speed(const OilFilm& film, const Assembler& assembler, double Omega) {
  return assembler.spin_speed(assembler.point(film.at), Omega) +
         assembler.spin_speed(assembler.point(film.against), Omega);
}

FilmAtSpeed at_speed(const OilFilm& film, double Omega, double drag) {
  const double rate = Omega != 0.0 ? std::abs(Omega) : 2.0 * std::numbers::pi;
  return std::visit(
      [&](const auto& law) {
        return FilmAtSpeed{.offset = film.offset,
                           .clearance = film.bearing.clearance,
                           .factor = law.factor(film.bearing),
                           .spin = law.is_dragged ? drag / rate : 0.0,
                           .rate = rate,
                           .law = film.law};
      },
      film.law);
}

double eccentricity(const ReducedFilm& film, const double* y, StateLayout layout) {
  return place(film, y, layout).norm();
}

Vec2 film_force(const ReducedFilm& film, const double* y, StateLayout layout) {
  const Vec2 d = place(film, y, layout);
  const Vec2 v = film.U * layout.rate(y) / (film.clearance * film.rate);
  const auto [fx, fy] = std::visit(
      [&](const auto& law) {
        return law.force(d(0), d(1), film.spin * d(0) - 2.0 * v(1), film.spin * d(1) + 2.0 * v(0));
      },
      film.law);
  return film.factor * film.rate * Vec2(fx, fy);
}

std::optional<FilmSlopes> film_slopes(const FilmAtSpeed& film, const Vec2& u, const Vec2& u_rate) {
  using D = Dual<4>;
  D d[2], v[2];
  for (int i = 0; i < 2; ++i) {
    d[i] = (D::variable(u(i), i) - film.offset(i)) / film.clearance;
    v[i] = D::variable(u_rate(i), 2 + i) / (film.clearance * film.rate);
  }
  if (!(d[0].value * d[0].value + d[1].value * d[1].value < 1.0)) return std::nullopt;
  const auto [fx, fy] = std::visit(
      [&](const auto& law) {
        const auto force = law.force(d[0], d[1], D(film.spin * d[0] - 2.0 * v[1]),
                                     D(film.spin * d[1] + 2.0 * v[0]));
        return std::pair<D, D>(force);
      },
      film.law);
  FilmSlopes s;
  const D* f[] = {&fx, &fy};
  for (int i = 0; i < 2; ++i) {
    const double factor = film.factor * film.rate;
    s.force(i) = factor * f[i]->value;
    s.by_u.row(i) = factor * f[i]->slopes.head<2>();
    s.by_u_rate.row(i) = factor * f[i]->slopes.tail<2>();
  }
  return s;
}

std::optional<Vec2> place_under(const FilmAtSpeed& film, const Vec2& load) {
  constexpr double lightest = 1e-12, nearest = 1e-12, tolerance = 1e-14;
  const double W = load.norm();
  if (W == 0.0) return film.offset;
  // e = s / (1 + s): the film grows stiff at the wall, where only 1 - e = 1 / (1 + s) tells
  const auto at = [&](double log_s) -> Vec2 {
    const double s = std::pow(10.0, log_s);
    return film.offset + Vec2(film.clearance * s / (1.0 + s), 0.0);
  };
  const auto force = [&](double log_s) -> Vec2 {
    const auto slopes = film_slopes(film, at(log_s), Vec2::Zero());
    return slopes ? slopes->force : Vec2::Constant(nan);
  };
  const auto excess = [&](double log_s) { return std::log(force(log_s).norm() / W); };
  const double least = std::log10(lightest), most = -std::log10(nearest);
  if (excess(least) >= 0.0) return film.offset;
  const double log_s = bracketed_root(excess, least, most, tolerance);
  if (!std::isfinite(log_s)) return std::nullopt;
  const Vec2 f = force(log_s), up = -load;
  const double turn = std::atan2(up(1), up(0)) - std::atan2(f(1), f(0));
  return film.offset + Eigen::Rotation2Dd(turn) * Vec2(at(log_s) - film.offset);
}

}  // namespace whirl::inline dyn
