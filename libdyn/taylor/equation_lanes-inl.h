// The linear part of the equations of motion in all lanes.

#if defined(WHIRL_EQUATION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_EQUATION_LANES_INL_H
#undef WHIRL_EQUATION_LANES_INL_H
#else
#define WHIRL_EQUATION_LANES_INL_H
#endif

#include <vector>

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
  int orders;                                  ///< of series for which there is `damping`
  std::vector<P> damping;                      ///< (k + 1) D for k = 0, 1, ...

  explicit EquationLanes(const Pattern& of, int orders_of_damping = 0)
      : pattern(of), orders(orders_of_damping) {
    damping.assign(static_cast<size_t>(of.n) * static_cast<size_t>(orders), P(0.0));
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
    }
    for (size_t o = 0; o < other_loads.size(); ++o) {
      const bool has_it = o < s.other_loads().size();
      for (int i = 0; i < n; ++i) {
        const auto ui = static_cast<size_t>(i);
        set_lane(other_loads[o].fc[ui], l, has_it ? s.other_loads()[o].cosine(i) : 0.0);
        set_lane(other_loads[o].fs[ui], l, has_it ? s.other_loads()[o].sine(i) : 0.0);
      }
    }
    for (int k = 0; k < orders; ++k) {
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
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
