// The linear part of the equations of motion in all lanes.

#if defined(WHIRL_EQUATION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_EQUATION_LANES_INL_H
#undef WHIRL_EQUATION_LANES_INL_H
#else
#define WHIRL_EQUATION_LANES_INL_H
#endif

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
  if constexpr (P::is_double) {
    const bool is_neighbor = carries_slopes<P> && l > 0;  // whose angle must not wrap
    const double turned = 2.0 * P::pi * static_cast<double>(revolution);
    set_lane(to.rate, l, from.ratio * rate_of_phase);
    set_lane(to.start, l, is_neighbor ? from.ratio * turned : from.start_angle(revolution));
  } else {
    const Number ratio =
        from.order > 0.0 ? Number(from.order) : Number(from.frequency) / rate_of_phase;
    const Number turns = ratio * Number(static_cast<double>(revolution));
    const Number whole = Number(static_cast<double>(static_cast<int64_t>(turns)));
    set_lane(to.rate, l, ratio * rate_of_phase);
    set_lane(to.start, l, Number(2.0) * P::pi * (turns - whole));
  }
}

/// eta'' = f0 + fc cos(phase) + fs sin(phase) - [K D] y - ..., with what is not zero in any lane.
template <class P>
struct EquationLanes {
  const Pattern& pattern;
  std::vector<P> K, D;  ///< diagonals
  std::vector<P> A;     ///< of [K D] beside them, as pattern.off_diagonal
  std::vector<P> f0, fc, fs;
  std::vector<OtherLoadLanes<P>> other_loads;  ///< as many as any lane has
  int orders;                                  ///< of the series of the load
  std::vector<P> load_terms;                   ///< its coefficients, order after order
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
    for (const Pattern::OffDiagonal& row : pattern.off_diagonal) {
      P* entry = A.data() + row.begin;
      for (const int j : row.of_x) set_lane(*entry++, l, s.K()(row.i, j));
      for (const int j : row.of_rate) set_lane(*entry++, l, s.D()(row.i, j));
    }
  }

  /// Tells the loads of other frequencies that a lane begins a revolution.
  HWY_ATTR void begin_revolution(const ContactSystem& s, typename P::Number rate_of_phase,
                                 long revolution, int l) {
    for (size_t o = 0; o < s.other_loads().size(); ++o) {
      start_revolution(s.other_loads()[o], rate_of_phase, revolution, l, other_loads[o]);
    }
  }

  template <class V>
  HWY_ATTR inline void oscillate(const V& rate, const V& angle, const std::vector<P>& cosines,
                                 const std::vector<P>& sines, const auto& put) const;
  template <class V>
  HWY_ATTR void find_load(const ClockLanes<P>& clock);
  template <class V>
  HWY_ATTR inline void accelerate(int k, const P* now, const P* rate, P* to) const;
};

/// Coefficients of  fc cos(angle) + fs sin(angle),  whose angle moves at a rate:
///
///   f_{k+2} = -rate^2 f_k / ((k + 1) (k + 2))
///
/// @param cosines, sines  fc and fs of the coordinates
/// @param put             is called with a coordinate, an order and the coefficient
template <class P>
template <class V>
HWY_ATTR inline void EquationLanes<P>::oscillate(const V& rate, const V& angle,
                                                 const std::vector<P>& cosines,
                                                 const std::vector<P>& sines,
                                                 const auto& put) const {
  V sine, cosine;
  sin_cos(angle, sine, cosine);
  const V curvature = -(rate * rate);
  V factors[P::most_terms];
  for (int k = 0; k < orders - 1; ++k) factors[k] = PlainOf<V>(twice_integrated<V>(k)) * curvature;
  for (const int i : pattern.forced) {
    const V &of_cosine = as<V>(cosines[static_cast<size_t>(i)]),
            &of_sine = as<V>(sines[static_cast<size_t>(i)]);
    V now = fma(of_cosine, cosine, of_sine * sine);
    V next = rate * fma(of_sine, cosine, -(of_cosine * sine));
    put(i, 0, now);
    for (int k = 1; k < orders; ++k) {
      put(i, k, next);
      const V after = factors[k - 1] * now;
      now = next;
      next = after;
    }
  }
}

/// Coefficients of the load; where it does not turn they are zero from the second on.
///
/// @tparam V  P, or its value alone: slopes are left as they are
template <class P>
template <class V>
HWY_ATTR void EquationLanes<P>::find_load(const ClockLanes<P>& clock) {
  const auto load = [&](int i, int k) HWY_ATTR -> V& {
    return as<V>(load_terms[static_cast<size_t>(k * pattern.n + i)]);
  };
  oscillate<V>(as<V>(clock.rate), clock.template angle<V>(), fc, fs,
               [&](int i, int k, const V& f)
                   HWY_ATTR { load(i, k) = k == 0 ? f + as<V>(f0[static_cast<size_t>(i)]) : f; });
  for (const OtherLoadLanes<P>& o : other_loads) {
    oscillate<V>(as<V>(o.rate), fma(as<V>(o.rate), as<V>(clock.time), as<V>(o.start)), o.fc, o.fs,
                 [&](int i, int k, const V& f) HWY_ATTR { load(i, k) = load(i, k) + f; });
  }
}

/// Coefficient k of the acceleration, contacts and films apart.
///
/// @param now, rate  coefficients k and k + 1 of the coordinates: x' has (k + 1) x_{k+1}
/// @tparam V         P, or its value alone where the linear part has no slopes
template <class P>
template <class V>
HWY_ATTR inline void EquationLanes<P>::accelerate(int k, const P* now, const P* rate, P* to) const {
  const P *kd = K.data(), *dd = D.data(), *load = load_terms.data() + k * pattern.n;
  const PlainOf<P> whole(k + 1.0);
  for (int i = 0; i < pattern.n; ++i) {
    to[i] = fnma(whole * as<V>(dd[i]), rate[i], fnma(as<V>(kd[i]), now[i], load[i]));
  }
  for (const Pattern::OffDiagonal& row : pattern.off_diagonal) {
    const P* a = A.data() + row.begin;
    P of_x(0.0), of_rate(0.0);
    for (const int j : row.of_x) of_x = fma(as<V>(*a++), now[j], of_x);
    for (const int j : row.of_rate) of_rate = fma(as<V>(*a++), rate[j], of_rate);
    to[row.i] = to[row.i] - fma(whole, of_rate, of_x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
