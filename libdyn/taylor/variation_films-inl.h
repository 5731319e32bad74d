// What oil films do to the variation.

#if defined(WHIRL_VARIATION_FILMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_VARIATION_FILMS_INL_H
#undef WHIRL_VARIATION_FILMS_INL_H
#else
#define WHIRL_VARIATION_FILMS_INL_H
#endif

#include "libdyn/taylor/variation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Finds the slopes of the films and adds the squares of the rates that they lend the tangents;
/// shortens the step where the slopes change faster than the motion.
template <class P>
HWY_ATTR void Variation<P>::find_film_slopes(const P& h, P& square, P& longest) {
  Tangents<P>& t = tangents_;
  for (size_t i = 0; i < m_.films.size(); ++i) {
    FilmLanes<P>& film = *m_.films[i];
    auto& [J, H] = t.film_slopes[i];
    film.find_slopes(J, H, N);
    const P damping = film.gain * (H.size(0) + H.size(1) * h);
    square = square + fma(damping, damping, film.gain * (J.size(0) + J.size(1) * h));
    const P last = max(film.gain * J.size(N), P(1e-280)) / (m_.clock.rate * P(N + 1.0));
    longest = min(longest, rough_exp2(log2_step(P(log2_tolerance_), last, N + 1)));
  }
}

/// Integral of trace(H U B) of all films over the step.
template <class P>
HWY_ATTR P Variation<P>::film_divergence(const P& h) {
  P sum(0.0);
  for (size_t i = 0; i < m_.films.size(); ++i) {
    const FilmLanes<P>& film = *m_.films[i];
    const SeriesMatrix<P>& H = tangents_.film_slopes[i].H;
    P xx(0.0), xy(0.0), yx(0.0), yy(0.0);  // of U B
    work_.assign(static_cast<size_t>(m_.n), P(0.0));
    film.push(work_.data(), P(1.0), P(0.0));
    film.displacement(work_.data(), xx, yx);
    work_.assign(static_cast<size_t>(m_.n), P(0.0));
    film.push(work_.data(), P(0.0), P(1.0));
    film.displacement(work_.data(), xy, yy);
    P integral(0.0);
    for (int k = N; k >= 0; --k) {
      const P trace = fma(H.xx[k], xx, fma(H.xy[k], yx, fma(H.yx[k], xy, H.yy[k] * yy)));
      integral = fma(integral, h, trace * inverse_of<P>(k + 1));
    }
    sum = fma(integral, h, sum);
  }
  return sum;
}

/// Adds coefficient k of the films' share to the accelerations of two columns.
template <class P>
HWY_ATTR void Variation<P>::add_film_slopes(int k, P* to_a, P* to_b) {
  Tangents<P>& t = tangents_;
  auto& [first, second] = t.tracks;
  const P whole(k + 1.0);
  for (size_t i = 0; i < m_.films.size(); ++i) {
    const FilmLanes<P>& film = *m_.films[i];
    auto &u = first.films[i], &w = second.films[i];
    for (auto [column, track] : {std::pair(&u, &first), std::pair(&w, &second)}) {
      P vx, vy;
      film.displacement(t.term(*track, k), column->dx[k], column->dy[k]);
      film.displacement(t.term(*track, k + 1), vx, vy);
      column->vx[k] = whole * vx;
      column->vy[k] = whole * vy;
    }
    P forces[4] = {P(0.0), P(0.0), P(0.0), P(0.0)};
    add_slope_forces(t.film_slopes[i].J, u.dx, u.dy, w.dx, w.dy, k, forces);
    add_slope_forces(t.film_slopes[i].H, u.vx, u.vy, w.vx, w.vy, k, forces);
    film.push(to_a, forces[0], forces[1]);
    film.push(to_b, forces[2], forces[3]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
