// The linear part of the equations of motion in all lanes.

#if defined(WHIRL_EQUATION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_EQUATION_LANES_INL_H
#undef WHIRL_EQUATION_LANES_INL_H
#else
#define WHIRL_EQUATION_LANES_INL_H
#endif

#include <array>
#include <span>
#include <vector>

#include "libdyn/taylor/clock_lanes-inl.h"
#include "libdyn/taylor/pack-inl.h"
#include "libdyn/taylor/pattern.hpp"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// A load of another frequency than that of the speed.
template <class P>
struct OtherLoadLanes {
  P rate{0.0};            ///< of its angle [rad/s]
  P start{0.0};           ///< that angle at the start of the revolution [rad]
  std::vector<P> fc, fs;  ///< of the coordinates
};

/// Angle of such a load at the start of a revolution, and what it moves on in one [rad].
template <class P>
HWY_ATTR void start_revolution(const ReducedExcitation& from, typename P::Number rate_of_phase,
                               long revolution, int l, OtherLoadLanes<P>& to) {
  using Number = typename P::Number;
  Number ratio = from.ratio;
  if constexpr (!P::is_double) {
    ratio = from.order > 0.0 ? Number(from.order) : Number(from.frequency) / rate_of_phase;
  }
  set_lane(to.rate, l, ratio * rate_of_phase);
  set_start_angle(to.start, l, ratio, revolution);
}

/// Adds coefficients times numbers to the sums of rows, column after column.
///
/// @param entry  the first coefficient: column by column, one for every row
/// @param x      vectors of numbers
/// @param sums   of every vector and row
/// @return       where the coefficients end
template <class V, class P, size_t Vectors, size_t Rows>
HWY_ATTR HWY_INLINE const P* add_products(const P* entry, const std::vector<int>& columns,
                                          const std::array<const P*, Vectors>& x,
                                          P (&sums)[Vectors][Rows]) {
  for (const int j : columns) {
    for (size_t v = 0; v < Vectors; ++v) {
      for (size_t r = 0; r < Rows; ++r) sums[v][r] = fma(as<V>(entry[r]), x[v][j], sums[v][r]);
    }
    entry += Rows;
  }
  return entry;
}

/// eta'' = f0 + fc cos(phase) + fs sin(phase) - [K D] y - ..., with what is not zero in any lane.
template <class P>
struct EquationLanes {
  const Pattern& pattern;
  std::vector<P> K, D;  ///< diagonals
  std::vector<P> A;     ///< of [K D] beside them, as pattern.coupled
  std::vector<P> f0, fc, fs;
  std::vector<OtherLoadLanes<P>> other_loads;  ///< as many as any lane has
  int orders;                                  ///< of the series of the load, at most
  std::vector<P> load_terms;                   ///< its coefficients, order after order
  bool linear_is_flat = false;                 ///< no coefficient has slopes that numbers carry
  bool damping_is_flat = false;                ///< no coefficient of D has
  std::vector<P> damping;                      ///< (k + 1) D for k = 0, 1, ..., of Pattern::bodies

  explicit EquationLanes(const Pattern& of, int orders_of_load = 0)
      : pattern(of), orders(orders_of_load) {
    load_terms.assign(static_cast<size_t>(of.n) * static_cast<size_t>(orders), P(0.0));
    if (of.bodies > 0) damping = load_terms;
    for (std::vector<P>* v : {&K, &D, &f0, &fc, &fs}) v->assign(static_cast<size_t>(of.n), P(0.0));
    A.assign(static_cast<size_t>(of.off_diagonals), P(0.0));
    other_loads.resize(of.other_loads);
    for (OtherLoadLanes<P>& o : other_loads) {
      for (std::vector<P>* v : {&o.fc, &o.fs}) v->assign(static_cast<size_t>(of.n), P(0.0));
    }
  }

  HWY_ATTR void load(const ContactSystem& s, int l) {
    const int n = pattern.n;
    for (int i = 0; i < n; ++i) {
      const auto ui = static_cast<size_t>(i);
      set_lane(K[ui], l, s.K()(i, i));
      set_lane(D[ui], l, s.D()(i, i));
      set_lane(f0[ui], l, s.constant_load()(i));
      set_lane(fc[ui], l, s.synchronous_load().cosine(i));
      set_lane(fs[ui], l, s.synchronous_load().sine(i));
      if (orders > 0) set_lane(load_terms[ui], l, s.constant_load()(i));
    }
    for (size_t o = 0; o < other_loads.size(); ++o) {
      const bool has_it = o < s.other_loads().size();
      for (int i = 0; i < n; ++i) {
        const auto ui = static_cast<size_t>(i);
        set_lane(other_loads[o].fc[ui], l, has_it ? s.other_loads()[o].cosine(i) : 0.0);
        set_lane(other_loads[o].fs[ui], l, has_it ? s.other_loads()[o].sine(i) : 0.0);
      }
    }
    for (int k = 0; k < orders && !damping.empty(); ++k) {
      for (int i = 0; i < n; ++i) {
        set_lane(damping[static_cast<size_t>(k * n + i)], l,
                 typename P::Number(k + 1.0) * typename P::Number(s.D()(i, i)));
      }
    }
    for (const Pattern::CoupledRows& rows : pattern.coupled) {
      P* entry = A.data() + rows.begin;
      const auto load_columns = [&](const Mat& of, const std::vector<int>& columns) {
        for (const int j : columns) {
          for (const int i : rows.rows) set_lane(*entry++, l, i == j ? 0.0 : of(i, j));
        }
      };
      load_columns(s.K(), rows.of_x);
      load_columns(s.D(), rows.of_rate);
    }
  }

  HWY_ATTR void look_for_slopes(bool clock_is_flat);
  /// Tells the loads of other frequencies that a lane begins a revolution.
  HWY_ATTR void begin_revolution(const ContactSystem& s, typename P::Number rate_of_phase,
                                 long revolution, int l) {
    for (size_t o = 0; o < s.other_loads().size(); ++o) {
      start_revolution(s.other_loads()[o], rate_of_phase, revolution, l, other_loads[o]);
    }
  }

  template <class V>
  HWY_ATTR inline void oscillate(int terms, const V& rate, const V& angle,
                                 const std::vector<P>& cosines, const std::vector<P>& sines,
                                 const auto& put) const;
  template <class V>
  HWY_ATTR void find_load(const ClockLanes<P>& clock, int terms);
  template <class V, class W>
  HWY_ATTR inline void accelerate(int k, const P* now, const P* rate, P* to) const;
  template <class V, class W, size_t Vectors>
  HWY_ATTR inline void couple(int k, const std::array<const P*, Vectors>& now,
                              const std::array<const P*, Vectors>& rates,
                              const std::array<P*, Vectors>& to) const;

 private:
  template <size_t Rows, class V, class W, size_t Vectors>
  HWY_ATTR inline void couple_rows(const Pattern::CoupledRows& rows, int k,
                                   const std::array<const P*, Vectors>& now,
                                   const std::array<const P*, Vectors>& rates,
                                   const std::array<P*, Vectors>& to) const;
};

/// Finds what has no slopes.
///
/// @param clock_is_flat  whether the time has none
template <class P>
HWY_ATTR void EquationLanes<P>::look_for_slopes(bool clock_is_flat) {
  damping_is_flat = are_flat(D);
  linear_is_flat = clock_is_flat;
  for (const auto* v : {&K, &f0, &fc, &fs}) linear_is_flat = linear_is_flat && are_flat(*v);
  for (const OtherLoadLanes<P>& o : other_loads) {
    linear_is_flat = linear_is_flat && is_flat(o.rate) && are_flat(o.fc) && are_flat(o.fs);
  }
  for (const Pattern::CoupledRows& rows : pattern.coupled) {
    const auto begin = A.begin() + rows.begin;
    const auto of_rate = begin + static_cast<long>(rows.rows.size() * rows.of_x.size());
    linear_is_flat = linear_is_flat && are_flat(std::span<const P>(begin, of_rate));
    damping_is_flat =
        damping_is_flat && are_flat(std::span<const P>(of_rate, begin + rows.coefficients()));
  }
  linear_is_flat = linear_is_flat && damping_is_flat;
}

/// Coefficients of  fc cos(angle) + fs sin(angle),  whose angle moves at a rate:
///
///   f_{k+2} = -rate^2 f_k / ((k + 1) (k + 2))
///
/// @param terms           how many coefficients
/// @param cosines, sines  fc and fs of the coordinates
/// @param put             is called with a coordinate, an order and the coefficient
template <class P>
template <class V>
HWY_ATTR inline void EquationLanes<P>::oscillate(int terms, const V& rate, const V& angle,
                                                 const std::vector<P>& cosines,
                                                 const std::vector<P>& sines,
                                                 const auto& put) const {
  V sine, cosine;
  sin_cos(angle, sine, cosine);
  const V curvature = -(rate * rate);
  V factors[P::most_terms];
  for (int k = 0; k < terms - 1; ++k) factors[k] = PlainOf<V>(twice_integrated<V>(k)) * curvature;
  for (const int i : pattern.forced) {
    const V &of_cosine = as<V>(cosines[static_cast<size_t>(i)]),
            &of_sine = as<V>(sines[static_cast<size_t>(i)]);
    V now = fma(of_cosine, cosine, of_sine * sine);
    V next = rate * fma(of_sine, cosine, -(of_cosine * sine));
    put(i, 0, now);
    for (int k = 1; k < terms; ++k) {
      put(i, k, next);
      const V after = factors[k - 1] * now;
      now = next;
      next = after;
    }
  }
}

/// Coefficients of the load; where it does not turn they are zero from the second on.
///
/// @param terms  how many, up to `orders`
/// @tparam V  P, or its value alone: slopes are left as they are
template <class P>
template <class V>
HWY_ATTR void EquationLanes<P>::find_load(const ClockLanes<P>& clock, int terms) {
  const auto load = [&](int i, int k) HWY_ATTR -> V& {
    return as<V>(load_terms[static_cast<size_t>(k * pattern.n + i)]);
  };
  oscillate<V>(terms, as<V>(clock.rate), clock.template angle<V>(), fc, fs,
               [&](int i, int k, const V& f)
                   HWY_ATTR { load(i, k) = k == 0 ? f + as<V>(f0[static_cast<size_t>(i)]) : f; });
  for (const OtherLoadLanes<P>& o : other_loads) {
    oscillate<V>(terms, as<V>(o.rate), fma(as<V>(o.rate), as<V>(clock.time), as<V>(o.start)), o.fc,
                 o.fs, [&](int i, int k, const V& f) HWY_ATTR { load(i, k) = load(i, k) + f; });
  }
}

/// Coefficient k of the acceleration, contacts and films apart.
///
/// @param now, rate  coefficients k and k + 1 of the coordinates: x' has (k + 1) x_{k+1}
/// @tparam V, W      P, or its value alone where K, D have no slopes
template <class P>
template <class V, class W>
HWY_ATTR inline void EquationLanes<P>::accelerate(int k, const P* now, const P* rate, P* to) const {
  const P *kd = K.data(), *dd = D.data(), *load = load_terms.data() + k * pattern.n;
  const PlainOf<P> whole(k + 1.0);
  for (int i = 0; i < pattern.n; ++i) {
    to[i] = fnma(whole * as<W>(dd[i]), rate[i], fnma(as<V>(kd[i]), now[i], load[i]));
  }
  couple<V, W>(k, std::array{now}, std::array{rate}, std::array{to});
}

/// What coefficients beside the diagonals do to coefficient k of the acceleration.
///
/// @param now, rates  coefficients k and k + 1 of the coordinates, of one motion or several columns
/// @param to          accelerations of the same
template <class P>
template <class V, class W, size_t Vectors>
HWY_ATTR inline void EquationLanes<P>::couple(int k, const std::array<const P*, Vectors>& now,
                                              const std::array<const P*, Vectors>& rates,
                                              const std::array<P*, Vectors>& to) const {
  for (const Pattern::CoupledRows& rows : pattern.coupled) {
    rows.rows.size() == 1
        ? couple_rows<1, V, W>(rows, k, now, rates, to)
        : couple_rows<Pattern::CoupledRows::side_by_side, V, W>(rows, k, now, rates, to);
  }
}

/// The same of some rows, whose number the compiler knows.
template <class P>
template <size_t Rows, class V, class W, size_t Vectors>
HWY_ATTR inline void EquationLanes<P>::couple_rows(const Pattern::CoupledRows& rows, int k,
                                                   const std::array<const P*, Vectors>& now,
                                                   const std::array<const P*, Vectors>& rates,
                                                   const std::array<P*, Vectors>& to) const {
  const PlainOf<P> whole(k + 1.0);
  P of_x[Vectors][Rows], of_rate[Vectors][Rows];
  for (size_t v = 0; v < Vectors; ++v) {
    for (size_t r = 0; r < Rows; ++r) of_x[v][r] = of_rate[v][r] = P(0.0);
  }
  const P* entry = A.data() + rows.begin;
  entry = add_products<V>(entry, rows.of_x, now, of_x);
  add_products<W>(entry, rows.of_rate, rates, of_rate);
  for (size_t v = 0; v < Vectors; ++v) {
    for (size_t r = 0; r < Rows; ++r) {
      P& sum = to[v][rows.rows[r]];
      sum = sum - fma(whole, of_rate[v][r], of_x[v][r]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
