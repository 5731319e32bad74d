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

/// eta'' = f0 + fc cos(phase) + fs sin(phase) - [K D] y - ..., with what is not zero in any lane.
template <class P>
struct EquationLanes {
  const Pattern& pattern;
  std::vector<P> K, D;  ///< diagonals
  std::vector<P> A;     ///< of [K D] beside them, as pattern.off_diagonal
  std::vector<P> f0, fc, fs;
  int orders;              ///< of series for which there is `damping`
  std::vector<P> damping;  ///< (k + 1) D for k = 0, 1, ...

  explicit EquationLanes(const Pattern& of, int orders_of_damping = 0)
      : pattern(of), orders(orders_of_damping) {
    damping.assign(static_cast<size_t>(of.n) * static_cast<size_t>(orders), P(0.0));
    for (std::vector<P>* v : {&K, &D, &f0, &fc, &fs}) v->assign(static_cast<size_t>(of.n), P(0.0));
    A.assign(static_cast<size_t>(of.off_diagonals), P(0.0));
  }

  HWY_ATTR void load(const ContactSystem& s, int l) {
    const int n = pattern.n;
    for (int i = 0; i < n; ++i) {
      const auto ui = static_cast<size_t>(i);
      set_lane(K[ui], l, s.K()(i, i));
      set_lane(D[ui], l, s.D()(i, i));
      set_lane(f0[ui], l, s.constant_load()(i));
      set_lane(fc[ui], l, s.cosine_load()(i));
      set_lane(fs[ui], l, s.sine_load()(i));
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
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
