// What the engine keeps of its tangents.

#if defined(WHIRL_TANGENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_TANGENTS_INL_H
#undef WHIRL_TANGENTS_INL_H
#else
#define WHIRL_TANGENTS_INL_H
#endif

#include <array>
#include <cmath>
#include <vector>

#include "libdyn/taylor/contact_slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Rate times step up to which a slope is as exact as the tolerance: its series ends with the power
/// N + 2, and the first term that it leaves out, (rate h)^(N+3) / (N+3)!, is as large there.
inline double reach_of_slopes(double tolerance, int N) {
  int sign = 1;  // std::lgamma writes the global signgam, and several threads come here at once
  return std::exp((std::log(tolerance) + ::lgamma_r(N + 4.0, &sign)) / (N + 3.0));
}

/// Memory of the tangents: nothing unless they are asked for.
template <class P>
struct Tangents {
  std::vector<P> columns;   ///< of 2 n rows, one after another
  std::vector<P> log_sums;  ///< log of the growth of every column
  std::vector<P> weights;   ///< 1 / scale^2 of the state
  P fastest2{0.0};          ///< square of the fastest rate of the linear part [1/s^2]
  P trace{0.0};             ///< divergence of the flow without contacts [1/s]
  P divergence{0.0};        ///< its integral with contacts
  double reach = 0.0;       ///< largest rate times step, from reach_of_slopes
  std::vector<ContactSlopes<P>> slopes;
  std::vector<P> gain;  ///< per contact, largest eigenvalue of U B [1/kg]
  /// d(force of a film) = J d(displacement) + H d(velocity).
  struct FilmSlopes {
    SeriesMatrix<P> J, H;
  };
  std::vector<FilmSlopes> film_slopes;
  /// A contact as one column moves it: displacement, distance, acceleration, friction.
  struct Column {
    P dx[P::most_terms], dy[P::most_terms], vx[P::most_terms], vy[P::most_terms];
    P r[P::most_terms], ax[P::most_terms], ay[P::most_terms], tau[P::most_terms];
  };
  /// The series of one column; two go side by side, so that slopes are loaded once for both.
  struct Track {
    std::vector<P> terms;  ///< as MotionLanes::terms
    std::vector<Column> contacts;
    /// A film as one column moves it: displacement and velocity.
    struct FilmColumn {
      P dx[P::most_terms], dy[P::most_terms], vx[P::most_terms], vy[P::most_terms];
    };
    std::vector<FilmColumn> films;
  };
  std::array<Track, 2> tracks;
  /// Coefficient k of a track.
  HWY_ATTR inline P* term(Track& track, int k) const {
    return track.terms.data() + static_cast<size_t>(k) * weights.size() / 2;
  }
  std::vector<P> forces;    ///< of contacts on both tracks, x and y of each
  std::vector<P> weighted;  ///< a column times its weights
};

/// Adds coefficient k of m times two displacements (or velocities), newest terms last.
///
/// @param u, w  x and y of the first and the second column
/// @param sums  x and y of the first, x and y of the second
template <class P>
HWY_ATTR inline void add_slope_forces(const SeriesMatrix<P>& m, const P* ux, const P* uy,
                                      const P* wx, const P* wy, int k, P* sums) {
  P a(0.0), b(0.0), c(0.0), d(0.0), e(0.0), f(0.0), g(0.0), h(0.0);
  for (int j = k; j >= 0; --j) {
    a = fma(m.xx[j], ux[k - j], a);
    b = fma(m.xy[j], uy[k - j], b);
    c = fma(m.yx[j], ux[k - j], c);
    d = fma(m.yy[j], uy[k - j], d);
    e = fma(m.xx[j], wx[k - j], e);
    f = fma(m.xy[j], wy[k - j], f);
    g = fma(m.yx[j], wx[k - j], g);
    h = fma(m.yy[j], wy[k - j], h);
  }
  sums[0] = sums[0] + (a + b);
  sums[1] = sums[1] + (c + d);
  sums[2] = sums[2] + (e + f);
  sums[3] = sums[3] + (g + h);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
