// Events and grazes of a motion with slopes: what nearly happens, or nearly does not.

#if defined(WHIRL_GRAZE_FINDER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_GRAZE_FINDER_INL_H
#undef WHIRL_GRAZE_FINDER_INL_H
#else
#define WHIRL_GRAZE_FINDER_INL_H
#endif

#include <algorithm>
#include <limits>
#include <vector>

#include "libdyn/taylor/motion_lanes-inl.h"
#include "libdyn/taylor/slope_run.hpp"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Tells the events of a motion with slopes, and where it nearly has one or nearly has none.
template <class P>
class GrazeFinder {
 public:
  GrazeFinder(const MotionLanes<P>& of, SlopeRun& run) : m_(of), run_(run) {}

  /// @param time  at the start of the step [s]
  HWY_ATTR void find(const P& h, double time);
  void tell_event(size_t i, EventKind kind, bool jumps, double time);

 private:
  HWY_ATTR void find_one(const P* g, const P& first, int degree, double sign, double scale,
                         double h, size_t i, EventKind kind, double time);

  const MotionLanes<P>& m_;
  SlopeRun& run_;
  std::vector<double> passed_;  // per contact, Graze::margin if its event happens
};

/// Notes an event of contact i, and whether the motion grazes there.
template <class P>
void GrazeFinder<P>::tell_event(size_t i, EventKind kind, bool jumps, double time) {
  run_.events.push_back({time, static_cast<int>(i), kind, jumps});
  const double margin = passed_[i];
  if (jumps && margin <= run_.near) {
    run_.grazes.push_back({time, static_cast<int>(i), kind, true, margin});
  }
}

/// Extreme of a function of an event within a step: how far it stays from zero, or goes beyond.
///
/// @param g      coefficients; sign times them is positive before the event
/// @param first  number 0 of them, which may stand elsewhere
/// @param scale  of the margin
template <class P>
HWY_ATTR void GrazeFinder<P>::find_one(const P* g, const P& first, int degree, double sign,
                                       double scale, double h, size_t i, EventKind kind,
                                       double time) {
  const auto at = [&](double t, int derivatives) {
    double sum = 0.0;
    for (int k = degree; k >= derivatives; --k) {
      double factor = sign;
      for (int d = 0; d < derivatives; ++d) factor *= k - d;
      sum = sum * t + factor * lane(k == 0 ? first : g[k], 0);
    }
    return sum;
  };
  // were the event not to happen, the function would bend back so far below zero
  const double rate = at(h, 1), bend = at(h, 2);
  passed_[i] =
      bend > 0.0 ? rate * rate / (2.0 * bend) / scale : std::numeric_limits<double>::infinity();
  if (!(at(0.0, 1) < 0.0 && rate > 0.0)) return;  // one that begins flat has just ended sticking
  double low = 0.0, high = h;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (at(middle, 1) <= 0.0 ? low : high) = middle;
  }
  const double margin = at(low, 0) / scale;
  if (margin > run_.near) return;
  run_.grazes.push_back({time + low, static_cast<int>(i), kind, false, std::max(margin, 0.0)});
}

/// Looks for grazes in a step of length h: of surfaces where a damped law would begin to push, and
/// of stops of slip.
template <class P>
HWY_ATTR void GrazeFinder<P>::find(const P& h, double time) {
  passed_.assign(m_.contacts.size(), std::numeric_limits<double>::infinity());
  const int N = m_.N;
  const double length = lane(h, 0);
  if (!(length > 0.0)) return;
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    const bool is_apart = ((c.touching | c.receding) & 1) == 0;
    if (is_apart && (c.continuous & 1) == 0 && !c.disk) {
      const double scale = lane(c.distance_scale, 0) * (c.rows.is_plane ? 1.0 : 2.0);
      find_one(c.s, c.beyond(), N + 2, -1.0, scale, length, i, EventKind::touch, time);
    }
    if ((c.touching & c.exact & ~c.sticking & 1) != 0 && c.slip_is_known) {
      find_one(c.slip, c.slip[0], N, lane(c.sign, 0), lane(c.slip_scale, 0), length, i,
               EventKind::slip_stop, time);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
