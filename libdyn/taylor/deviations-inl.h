// Deviations: columns of the variation whose slopes are carried along, for second derivatives.

#if defined(WHIRL_DEVIATIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_DEVIATIONS_INL_H
#undef WHIRL_DEVIATIONS_INL_H
#else
#define WHIRL_DEVIATIONS_INL_H
#endif

#include <cmath>
#include <limits>

#include "libdyn/taylor/slope_run.hpp"
#include "libdyn/taylor/variation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Columns of the variation with their slopes: how they jump at events, and where steps end for
/// them.
template <class P>
class Deviations {
 public:
  Deviations(MotionLanes<P>& of, Variation<P>& variation) : m_(of), variation_(variation) {}

  HWY_ATTR void load(const SlopeRun& run);
  HWY_ATTR void note_jump(size_t i, EventKind kind, const P& length);
  HWY_ATTR void jump();
  HWY_ATTR P to_same_depth(const P& h);
  HWY_ATTR void keep(SlopeRun& run);

 private:
  HWY_ATTR P along_event(const ContactLanes<P>& c, EventKind kind, const P* moved,
                         const P* rates) const;

  MotionLanes<P>& m_;
  Variation<P>& variation_;
  std::vector<P> before_;  // acceleration before a jump of it, until that is known after it
  std::vector<P> along_;   // per deviation, by how much earlier it meets the event
};

/// Begins with the deviations that are asked for.
template <class P>
HWY_ATTR void Deviations<P>::load(const SlopeRun& run) {
  const Mat& start = run.deviations;
  variation_.columns().assign(start.data(), start.data() + start.size());
  along_.clear();
}

/// The step to the depth of the contact that is closest to its surface, if one comes from there or
/// goes there.
template <class P>
HWY_ATTR P Deviations<P>::to_same_depth(const P& h) {
  const int N = m_.N;
  P to = h;
  double soonest = std::numeric_limits<double>::infinity();
  for (ContactLanes<P>& c : m_.contacts) {
    if ((c.touching & 1) == 0 || c.rows.is_analytic) continue;
    P value, rate;
    c.beyond_at(P(h.x), N + 2, value, rate);
    double bend = 0.0;
    for (int k = N + 2; k >= 2; --k) bend = bend * lane(h, 0) + k * (k - 1.0) * lane(c.s[k], 0);
    const double depth = std::abs(lane(value, 0)), speed = std::abs(lane(rate, 0));
    if (!(speed * speed > std::abs(bend) * depth) || !(depth < soonest * speed)) continue;
    soonest = depth / speed;
    to.s = -(value.s * wide(typename P::Value(1.0) / rate.x));
  }
  return to;
}

/// How the function of an event changes along a direction of the state: the distance of a touch
/// times what it is, and that times the slip.
///
/// @param moved, rates  the direction's displacements and velocities
template <class P>
HWY_ATTR P Deviations<P>::along_event(const ContactLanes<P>& c, EventKind kind, const P* moved,
                                      const P* rates) const {
  P x = c.dx[0], y = c.dy[0], u, v;
  if (!c.rows.is_plane) {
    c.displacement(m_.y.data(), x, y);
    x = x - c.offset_x;
    y = y - c.offset_y;
  }
  if (c.wall) {
    const WallGap<P> gap = c.wall->at(x, y);
    x = gap.nx;
    y = gap.ny;
  }
  c.displacement(moved, u, v);
  const P outward = fma(x, u, y * v);
  if (kind == EventKind::touch) return outward;
  const auto lateral = [&](const P* velocity, P& to_x, P& to_y) HWY_ATTR {
    c.rub ? c.rub->lateral(velocity, to_x, to_y) : c.displacement(velocity, to_x, to_y);
  };
  P a, b;
  lateral(rates, a, b);
  const P turned = fnma(y, a, x * b);
  if (c.rows.is_plane) return turned;
  lateral(m_.layout().rates_at(m_.y.data()), a, b);
  return turned + fma(u, b, fnma(v, a, c.rim * outward / sqrt(fma(x, x, y * y))));
}

/// Notes what a jump of the acceleration at an event of contact i does to deviations, as far as it
/// is known before the next step:  dy+ = dy- + (f+ - f-) (dg / dy dy-) / (dg / dt).
/// @param length  of this step
template <class P>
HWY_ATTR void Deviations<P>::note_jump(size_t i, EventKind kind, const P& length) {
  const int N = m_.N;
  const ContactLanes<P>& c = m_.contacts[i];
  before_.assign(static_cast<size_t>(m_.n), P(0.0));
  for (int k = N + 2; k >= 2; --k) {
    const P* x = m_.term(k);
    for (size_t j = 0; j < before_.size(); ++j) {
      before_[j] = fma(before_[j], length, P(k * (k - 1.0)) * x[j]);
    }
  }
  const P rate = along_event(c, kind, m_.layout().rates_at(m_.y.data()), before_.data());
  const auto& columns = variation_.columns();
  along_.clear();
  for (const P* dy = columns.data(); dy != columns.data() + columns.size();
       dy += m_.layout().size()) {
    along_.push_back(along_event(c, kind, dy, m_.layout().rates_at(dy)) / rate);
  }
}

/// Lets deviations jump, the acceleration after the event being known.
template <class P>
HWY_ATTR void Deviations<P>::jump() {
  if (along_.empty()) return;
  P* deviation = variation_.columns().data();
  for (size_t d = 0; d < along_.size(); ++d) {
    P* rates = m_.layout().rates_at(deviation);
    deviation = m_.layout().end(deviation);
    for (size_t j = 0; j < before_.size(); ++j) {
      const P jump = P(2.0) * m_.term(2)[j] - before_[j];
      rates[j] = fma(jump, along_[d], rates[j]);
    }
  }
  along_.clear();
}

/// Tells where deviations have got to, with their slopes.
template <class P>
HWY_ATTR void Deviations<P>::keep(SlopeRun& run) {
  for (Eigen::Index d = 0; d < run.deviations.cols(); ++d) {
    Mat& by = run.deviation_slopes.emplace_back(m_.layout().size(), std::ssize(run.columns));
    for (int i = 0; i < m_.layout().size(); ++i) {
      const P& number = variation_.columns()[static_cast<size_t>(m_.layout().size() * d + i)];
      run.deviations(i, d) = lane(number, 0);
      for (int c = 0; c < by.cols(); ++c) by(i, c) = lane(number.s, c);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
