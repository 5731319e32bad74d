// The motion's variation: columns of the linearized flow, carried by series of their own.

#if defined(WHIRL_VARIATION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_VARIATION_INL_H
#undef WHIRL_VARIATION_INL_H
#else
#define WHIRL_VARIATION_INL_H
#endif

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/system/saltation.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/step_length-inl.h"
#include "libdyn/taylor/sticking-inl.h"
#include "libdyn/taylor/tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Packs of several registers are for motions alone: their tangents would not fit the caches.
template <class P>
constexpr bool knows_tangents = P::blocks == 1;

/// The columns in every lane: the tangent of the end by the start, or exponents and how they grow.
template <class P>
class Variation {
 public:
  Variation(MotionLanes<P>& of, Sticking<P>& sticking, const BatchOptions& options);

  HWY_ATTR void load(int l, const ContactSystem& s);
  HWY_ATTR void unload(int l, double time, Trajectory& to);
  HWY_ATTR P limit(const P& h);
  HWY_ATTR void move(const P& h);
  HWY_ATTR void jump(int l, const Saltation& s);
  HWY_ATTR void orthonormalize(uint64_t due);
  HWY_ATTR void keep_growths(int l, std::vector<double>& growths) const;
  /// One after another, of 2 n numbers each.
  std::vector<P>& columns() { return tangents_.columns; }

 private:
  using Mask = typename P::Mask;

  HWY_ATTR void add_divergence(const P& h);
  HWY_ATTR P contact_divergence(size_t i, const P& h);
  template <int Bodies>
  __attribute__((flatten)) HWY_ATTR void move_columns(P* columns, bool any_sticks, const P& h);
  template <int Bodies>
  HWY_ATTR inline void accelerate_columns(int k, const P* forces, P* to_a, P* to_b);
  /// Adds what a limit reads of the rates to coefficient k of a column.
  HWY_ATTR static void add_rates(const ContactLanes<P>& c, const P* next, int k,
                                 typename Tangents<P>::Column& to) {
    P wx, wy;
    c.rub->lateral(next, wx, wy);
    const P whole(k + 1.0);
    to.dx[k] = fma(whole, wx, to.dx[k]);
    to.dy[k] = fma(whole, wy, to.dy[k]);
  }
  // variation_films-inl.h
  HWY_ATTR void find_film_slopes(const P& h, P& square, P& longest);
  HWY_ATTR P film_divergence(const P& h);
  HWY_ATTR void add_film_slopes(int k, P* to_a, P* to_b);

  int columns_wanted() const {
    const int size = m_.layout().size();
    return options_.tangent ? size : static_cast<int>(exponents_of(size, options_.most_exponents));
  }

  MotionLanes<P>& m_;
  Sticking<P>& sticking_;
  const BatchOptions& options_;
  int N;
  double log2_tolerance_;
  Tangents<P> tangents_;
  std::vector<P> work_;
};

template <class P>
Variation<P>::Variation(MotionLanes<P>& of, Sticking<P>& sticking, const BatchOptions& options)
    : m_(of),
      sticking_(sticking),
      options_(options),
      N(of.N),
      log2_tolerance_(std::log2(options.tolerance)) {
  const auto size = static_cast<size_t>(m_.layout().size());
  Tangents<P>& t = tangents_;
  const auto wanted = static_cast<size_t>(columns_wanted());
  const size_t count = wanted + wanted % 2;  // two are moved side by side, and 2 n are even
  t.columns.assign(count * size, P(0.0));
  t.log_sums.assign(count, P(0.0));
  t.weights.assign(size, P(1.0));
  t.weighted.assign(size, P(0.0));
  t.forces.assign(8 * m_.contacts.size(), P(0.0));  // the second half: friction that acts elsewhere
  t.slopes.resize(m_.contacts.size());
  t.film_slopes.resize(m_.films.size());
  for (auto& track : t.tracks) {
    track.contacts.resize(m_.contacts.size());
    track.films.resize(m_.films.size());
    track.terms.assign(m_.terms.size(), P(0.0));
  }
  t.gain.assign(m_.contacts.size(), P(0.0));
  t.reach = reach_of_slopes(options_.tolerance, N);
}

template <class P>
HWY_ATTR void Variation<P>::load(int l, const ContactSystem& s) {
  Tangents<P>& t = tangents_;
  const int size = m_.layout().size();
  Vec scale(size);
  scale << s.state_scale();
  for (int i = 0; i < size; ++i) {
    set_lane(t.weights[static_cast<size_t>(i)], l, 1.0 / (scale(i) * scale(i)));
  }
  for (P& sum : t.log_sums) set_lane(sum, l, 0.0);
  const int count = static_cast<int>(t.columns.size()) / size;
  for (int c = 0; c < count; ++c) {
    for (int i = 0; i < size; ++i) {
      const double unit = options_.exponents ? scale(i) : 1.0;
      set_lane(t.columns[static_cast<size_t>(c * size + i)], l, i == c ? unit : 0.0);
    }
  }
  const double rate = fastest_mode(s);
  set_lane(t.fastest2, l, rate * rate);
  set_lane(t.trace, l, -s.D().trace());
  set_lane(t.divergence, l, 0.0);
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    const ReducedContact& c = s.contacts()[i];
    set_lane(t.gain[i], l, contact_gain(c));
  }
}

/// Limits the step where tangents move faster than the motion itself.
template <class P>
HWY_ATTR P Variation<P>::limit(const P& h) {
  Tangents<P>& t = tangents_;
  P square = t.fastest2, longest = h;
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.touching & m_.active) == 0) continue;
    t.slopes[i].find(c, N);
    const SeriesMatrix<P>&J = t.slopes[i].J, &H = t.slopes[i].H;
    P stiffness = J.size(0) + J.size(1) * h;
    if (t.slopes[i].J_t) stiffness = stiffness + t.slopes[i].J_t->size(0);
    const P damping = t.slopes[i].has_H ? t.gain[i] * H.size(0) : P(0.0);
    const P both_rates = fma(damping, damping, t.gain[i] * stiffness);
    square = square + select(c.in_touch, both_rates, P(0.0));
    if (!c.rows.is_analytic) {  // at a surface the slopes change faster than the force
      const P last = max(t.gain[i] * J.size(N), P(1e-280)) / (m_.clock.rate * P(N + 1.0));
      const P steep = rough_exp2(log2_step(P(log2_tolerance_), last, N + 1));
      longest = min(longest, select(c.in_touch, steep, h));
    }
  }
  find_film_slopes(h, square, longest);
  return min(longest, P(t.reach) / sqrt(max(square, P(1e-200))));
}

/// Coefficient k of the acceleration of both columns.
template <class P>
template <int Bodies>
HWY_ATTR inline void Variation<P>::accelerate_columns(int k, const P* forces, P* to_a, P* to_b) {
  auto& [first, second] = tangents_.tracks;
  const int n = Bodies > 0 ? 2 * Bodies : m_.n;
  const P *a = tangents_.term(first, k), *b = tangents_.term(second, k);
  const P *rate_a = a + n, *rate_b = b + n, *kd = m_.equations.K.data(),
          *dd = m_.equations.D.data();
  const P whole(k + 1.0);
  each<2 * Bodies>(n, [&](int i) HWY_ATTR {
    const P stiffness = kd[i], damping = whole * dd[i];
    to_a[i] = -fma(stiffness, a[i], damping * rate_a[i]);
    to_b[i] = -fma(stiffness, b[i], damping * rate_b[i]);
  });
  const size_t contacts = Bodies > 0 ? 1 : m_.contacts.size();
  for (size_t c = 0; c < contacts; ++c, forces += 4) {
    const ContactLanes<P>& contact = m_.contacts[c];
    if ((contact.touching & m_.active) == 0) continue;
    contact.template push<Bodies>(to_a, forces[0], forces[1]);
    contact.template push<Bodies>(to_b, forces[2], forces[3]);
    if (Bodies == 0 && contact.rub) {
      const P* friction = forces + 4 * contacts;
      contact.rub->push(to_a, friction[0], friction[1]);
      contact.rub->push(to_b, friction[2], friction[3]);
    }
  }
  if (Bodies > 0) return;
  m_.equations.template couple<P, P>(k, std::array{a, b}, std::array{rate_a, rate_b},
                                     std::array{to_a, to_b});
}

/// Moves all columns over the step h of the motion.
template <class P>
HWY_ATTR void Variation<P>::move(const P& h) {
  Tangents<P>& t = tangents_;
  const bool any_sticks = m_.any_sticks();
  if constexpr (!carries_slopes<P>) add_divergence(h);
  const size_t size = 2 * static_cast<size_t>(m_.n), count = t.columns.size() / size;
  for (size_t c = 0; c < count; c += 2) {
    P* y = t.columns.data() + c * size;
    if (m_.is_rotor_in_stator()) {
      move_columns<2>(y, any_sticks, h);
    } else {
      move_columns<0>(y, any_sticks, h);
    }
  }
}

/// Adds what the flow diverges by in the step h.
template <class P>
HWY_ATTR void Variation<P>::add_divergence(const P& h) {
  Tangents<P>& t = tangents_;
  const Mask active = mask_of<P>(m_.active);
  t.divergence = t.divergence + select(active, t.trace * h, P(0.0));
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.touching & m_.active) != 0 && (t.slopes[i].has_H || c.rows.is_limit)) {
      t.divergence =
          t.divergence + select(both(active, c.in_touch), contact_divergence(i, h), P(0.0));
    }
  }
  if (!m_.films.empty()) {
    t.divergence = t.divergence + select(active, film_divergence(h), P(0.0));
  }
}

/// Integral of -trace(H U B) over the step; of a limit, whose force follows rates as it follows
/// displacements, of -trace(J V B).
template <class P>
HWY_ATTR P Variation<P>::contact_divergence(size_t i, const P& h) {
  const ContactLanes<P>& c = m_.contacts[i];
  const SeriesMatrix<P>& H = c.rows.is_limit ? tangents_.slopes[i].J : tangents_.slopes[i].H;
  P xx(0.0), xy(0.0), yx(0.0), yy(0.0);  // of U B, or V B_t
  const auto effect = [&](const P& fx, const P& fy, P& to_x, P& to_y) HWY_ATTR {
    work_.assign(static_cast<size_t>(m_.n), P(0.0));
    if (c.rub) {
      c.rows.is_limit ? c.push(work_.data(), fx, fy) : c.rub->push(work_.data(), fx, fy);
      c.rub->lateral(work_.data(), to_x, to_y);
    } else {
      c.push(work_.data(), fx, fy);
      c.displacement(work_.data(), to_x, to_y);
    }
  };
  effect(P(-1.0), P(0.0), xx, yx);
  effect(P(0.0), P(-1.0), xy, yy);
  P integral(0.0);
  for (int k = N; k >= 0; --k) {
    const P trace = fma(H.xx[k], xx, fma(H.xy[k], yx, fma(H.yx[k], xy, H.yy[k] * yy)));
    integral = fma(integral, h, trace * inverse_of<P>(k + 1));
  }
  return -(integral * h);
}

/// Moves two columns, one after the other in memory; Bodies as in
/// MotionSeries::find_of_bodies, or 0.
template <class P>
template <int Bodies>
HWY_ATTR void Variation<P>::move_columns(P* columns, bool any_sticks, const P& h) {
  Tangents<P>& t = tangents_;
  auto& [first, second] = t.tracks;
  const int n = Bodies > 0 ? 2 * Bodies : m_.n;
  const size_t contacts = Bodies > 0 ? 1 : m_.contacts.size();
  const StateLayout layout(n);
  P* const next = layout.end(columns);
  std::copy(columns, next, first.terms.data());
  std::copy(next, layout.end(next), second.terms.data());
  P local_forces[4], local_a[Bodies > 0 ? 2 * Bodies : 1], local_b[Bodies > 0 ? 2 * Bodies : 1];
  P* forces = Bodies > 0 ? local_forces : t.forces.data();
  for (int k = 0; k <= N; ++k) {
    const P *now = t.term(first, k), *other = t.term(second, k);
    std::fill(forces, forces + (Bodies > 0 ? 4 : 8 * contacts), P(0.0));
    for (size_t i = 0; i < contacts; ++i) {
      const ContactLanes<P>& c = m_.contacts[i];
      if ((c.touching & m_.active) == 0) continue;
      const ContactSlopes<P>& slopes = t.slopes[i];
      auto &u = first.contacts[i], &w = second.contacts[i];
      c.template displacement<Bodies>(now, u.dx[k], u.dy[k]);
      c.template displacement<Bodies>(other, w.dx[k], w.dy[k]);
      if (Bodies == 0 && c.rows.is_limit) {
        add_rates(c, now + n, k, u);
        add_rates(c, other + n, k, w);
      }
      P* of_contact = forces + 4 * i;
      add_slope_forces(slopes.J, u.dx, u.dy, w.dx, w.dy, k, of_contact);
      if (Bodies == 0 && slopes.has_H) {
        const P whole(k + 1.0);
        for (auto [column, rate] : {std::pair(&u, now + n), std::pair(&w, other + n)}) {
          P vx, vy;
          c.rub ? c.rub->lateral(rate, vx, vy) : c.displacement(rate, vx, vy);
          column->vx[k] = whole * vx;
          column->vy[k] = whole * vy;
        }
        P* of_rate = c.rub ? of_contact + 4 * contacts : of_contact;
        add_slope_forces(slopes.H, u.vx, u.vy, w.vx, w.vy, k, of_rate);
      }
      if (Bodies == 0 && slopes.J_t) {
        add_slope_forces(*slopes.J_t, u.dx, u.dy, w.dx, w.dy, k, of_contact + 4 * contacts);
      }
    }
    P *next_a = t.term(first, k + 2), *next_b = t.term(second, k + 2);
    P *to_a = Bodies > 0 ? local_a : next_a, *to_b = Bodies > 0 ? local_b : next_b;
    accelerate_columns<Bodies>(k, forces, to_a, to_b);
    if constexpr (Bodies == 0) add_film_slopes(k, to_a, to_b);
    if (Bodies == 0 && any_sticks) {
      for (auto& track : t.tracks) sticking_.add_to_column(track, k);
    }
    const P scale(twice_integrated<P>(k));
    each<2 * Bodies>(n, [&](int i) HWY_ATTR {
      next_a[i] = to_a[i] * scale;
      next_b[i] = to_b[i] * scale;
    });
  }
  m_.template evaluate<Bodies>(first.terms.data(), h, columns);
  m_.template evaluate<Bodies>(second.terms.data(), h, next);
}

/// Makes the columns orthonormal by modified Gram-Schmidt and adds up their growth, in lanes that
/// are due.
template <class P>
HWY_ATTR void Variation<P>::orthonormalize(uint64_t due) {
  if (due == 0) return;
  Tangents<P>& t = tangents_;
  const Mask where = mask_of<P>(due);
  const auto size = static_cast<size_t>(m_.layout().size());
  const size_t count = t.log_sums.size();
  for (size_t c = 0; c < count; ++c) {
    P* a = t.columns.data() + c * size;
    P square(0.0);
    for (size_t i = 0; i < size; ++i) square = fma(t.weights[i] * a[i], a[i], square);
    square = max(square, P(1e-300));  // a column that sticking has made zero
    const P inverse = P(1.0) / sqrt(square);
    t.log_sums[c] = t.log_sums[c] + select(where, P(0.5) * log(square), P(0.0));
    for (size_t i = 0; i < size; ++i) {
      a[i] = select(where, a[i] * inverse, a[i]);
      t.weighted[i] = t.weights[i] * a[i];
    }
    for (size_t other = c + 1; other < count; ++other) {
      P* b = t.columns.data() + other * size;
      P dot(0.0);
      for (size_t i = 0; i < size; ++i) dot = fma(t.weighted[i], b[i], dot);
      dot = select(where, dot, P(0.0));
      for (size_t i = 0; i < size; ++i) b[i] = fnma(dot, a[i], b[i]);
    }
  }
}

/// Adds what the columns have grown by in a lane.
template <class P>
HWY_ATTR void Variation<P>::keep_growths(int l, std::vector<double>& growths) const {
  const auto wanted = static_cast<size_t>(columns_wanted());
  for (size_t c = 0; c < wanted; ++c) {
    growths.push_back(static_cast<double>(lane(tangents_.log_sums[c], l)));
  }
}

/// Lets the columns of a lane jump with the acceleration at an event.
template <class P>
HWY_ATTR void Variation<P>::jump(int l, const Saltation& s) {
  Tangents<P>& t = tangents_;
  const int size = m_.layout().size(), count = static_cast<int>(t.columns.size()) / size;
  for (int c = 0; c < count; ++c) {
    P* column = t.columns.data() + static_cast<size_t>(c) * static_cast<size_t>(size);
    double along = 0.0;
    for (int i = 0; i < size; ++i) along += s.gradient(i) * lane(column[i], l);
    for (int i = m_.layout().place_of_rate(0); i < size; ++i)
      set_lane(column[i], l, lane(column[i], l) + s.jump(i) * along);
  }
  set_lane(t.divergence, l, lane(t.divergence, l) + s.log_determinant());
}

template <class P>
HWY_ATTR void Variation<P>::unload(int l, double time, Trajectory& to) {
  Tangents<P>& t = tangents_;
  const int size = m_.layout().size();
  if (options_.tangent) {
    to.tangent.resize(size, size);
    for (int c = 0; c < size; ++c) {
      for (int i = 0; i < size; ++i)
        to.tangent(i, c) = lane(t.columns[static_cast<size_t>(c * size + i)], l);
    }
  } else if (time > 0.0) {  // else it failed at once, and there is nothing to tell
    orthonormalize(uint64_t{1} << l);
    to.exponents.resize(columns_wanted());
    for (int c = 0; c < to.exponents.size(); ++c)
      to.exponents(c) = lane(t.log_sums[static_cast<size_t>(c)], l) / time;
    std::sort(to.exponents.begin(), to.exponents.end(), std::greater<>());
  }
  if (time > 0.0) to.divergence = static_cast<double>(lane(t.divergence, l)) / time;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
