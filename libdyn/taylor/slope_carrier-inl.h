// A motion over numbers that carry derivatives, sampled at given times.

#if defined(WHIRL_SLOPE_CARRIER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SLOPE_CARRIER_INL_H
#undef WHIRL_SLOPE_CARRIER_INL_H
#else
#define WHIRL_SLOPE_CARRIER_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <memory>

#include "libdyn/taylor/deviations-inl.h"
#include "libdyn/taylor/engine-inl.h"
#include "libdyn/taylor/graze_finder-inl.h"
#include "libdyn/taylor/lane_record.hpp"
#include "libdyn/taylor/slope_limit-inl.h"
#include "libdyn/taylor/slope_run.hpp"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// The part of the engine for numbers with slopes; the motion is in lane 0.
template <class P>
class SlopeCarrier<P, true> {
 public:
  /// @param variation  with deviations; else null
  SlopeCarrier(MotionLanes<P>& of, Variation<P>* variation, const BatchOptions& options,
               SlopeRun& run)
      : m_(of), run_(run), limit_(of, options.tolerance), grazes_(of, run) {
    if (variation) deviations_ = std::make_unique<Deviations<P>>(of, *variation);
  }

  HWY_ATTR void load(const LaneRecord& record);
  HWY_ATTR void begin_revolution(long revolution);
  /// Before the series of a step.
  void choose_order() { limit_.choose_order(); }
  /// Once the series of a step are known.
  HWY_ATTR void begin_step() {
    if (deviations_) deviations_->jump();
  }
  HWY_ATTR P limit(const P& h) { return limit_.find(h); }
  HWY_ATTR P end_of_step(const P& h, uint64_t& fell, uint64_t ends);
  /// An event of contact i that jumps, or does not.
  HWY_ATTR void tell_event(size_t i, EventKind kind, const Saltation* s) {
    if (s && deviations_) deviations_->note_jump(i, kind, length_);
    if (s && !deviations_) jump(i, kind, *s);
    grazes_.tell_event(i, kind, s != nullptr, elapsed());
  }
  bool is_done() const { return run_.is_done(); }
  /// Tells where deviations have got to, with their slopes.
  HWY_ATTR void finish() {
    if (deviations_) deviations_->keep(run_);
  }

 private:
  HWY_ATTR P to_fixed_phase(const P& h) const;
  HWY_ATTR double elapsed() const;
  HWY_ATTR void take_samples(const P& h);
  HWY_ATTR void jump(size_t i, EventKind kind, const Saltation& s);

  MotionLanes<P>& m_;
  SlopeRun& run_;
  const LaneRecord* record_ = nullptr;
  SlopeLimit<P> limit_;
  typename P::Slopes stretch_;  // -rate' / rate of the phase: of times at fixed phase
  std::vector<P> sample_;
  GrazeFinder<P> grazes_;
  // of deviations, whose steps end at the instants of events
  std::unique_ptr<Deviations<P>> deviations_;
  typename P::Slopes moved_{0.0};  // of the time beyond those at fixed phase
  P length_;                       // of the step
};

/// Gives the numbers of a loaded system the slopes that its neighbors tell, and states their own.
template <class P>
HWY_ATTR void SlopeCarrier<P, true>::load(const LaneRecord& record) {
  record_ = &record;
  const Trajectory& t = *record.trajectory;
  const ContactSystem& s = *t.system;
  for (size_t c = 0; c < run_.columns.size(); ++c) {
    const SlopeColumn& column = run_.columns[c];
    const int number = static_cast<int>(c);
    if (!column.parameter) {
      set_lane(m_.y[static_cast<size_t>(column.start)].s, number, 1.0);
      continue;
    }
    for (size_t j = 0; j < column.parameter->neighbors.size(); ++j) {
      const ContactSystem& neighbor = column.parameter->neighbors[j];
      const int l = lane_of_neighbor(number, static_cast<int>(j));
      m_.load_system(neighbor, t.state, l);
      for (size_t i = 0; i < m_.contacts.size(); ++i) {
        m_.contacts[i].load_numbers(neighbor.contacts()[i], l, neighbor.phase_rate());
      }
    }
  }
  m_.equations.look_for_slopes(!deviations_ && is_flat(m_.clock.rate));
  for (ContactLanes<P>& c : m_.contacts) {
    c.rows_are_flat = are_flat(c.ux) && are_flat(c.uy) && are_flat(c.bx) && are_flat(c.by);
  }
  limit_.load(s, run_.fastest);
  stretch_ = -(m_.clock.rate.s * wide(typename P::Value(1.0) / m_.clock.rate.x));
  if (deviations_) deviations_->load(run_);
}

/// Tells the loads of other frequencies what a revolution begins with beside the system.
template <class P>
HWY_ATTR void SlopeCarrier<P, true>::begin_revolution(long revolution) {
  const auto& columns = run_.columns;
  for (size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].parameter) continue;
    const auto& neighbors = columns[c].parameter->neighbors;
    for (size_t j = 0; j < neighbors.size(); ++j) {
      tell_revolution(m_, neighbors[j], neighbors[j].phase_rate(), revolution,
                      lane_of_neighbor(static_cast<int>(c), static_cast<int>(j)));
    }
  }
}

/// A step to a fixed phase: what changes the speed changes how long it takes,
/// h' = -h rate' / rate. Slopes are then those at fixed phase; the time of a state has slopes, too.
template <class P>
HWY_ATTR P SlopeCarrier<P, true>::to_fixed_phase(const P& h) const {
  return {h.x, wide(h.x) * stretch_ - moved_};
}

/// Time since the start [s].
template <class P>
HWY_ATTR double SlopeCarrier<P, true>::elapsed() const {
  const LaneRecord& record = *record_;
  return static_cast<double>(record.revolution - record.first_revolution) *
             lane(m_.clock.period, 0) +
         (lane(m_.clock.time, 0) - record.first_phase / record.trajectory->system->phase_rate());
}

/// Takes the samples within a step of length h.
template <class P>
HWY_ATTR void SlopeCarrier<P, true>::take_samples(const P& h) {
  const LaneRecord& record = *record_;
  const ContactSystem& s = *record.trajectory->system;
  const double period = lane(m_.clock.period, 0), length = lane(h, 0);
  const double before = elapsed();
  while (!run_.is_done()) {
    double into = run_.times[run_.states.size()] - before;
    if (!(into <= length + 1e-14 * period)) return;
    into = std::clamp(into, 0.0, length);
    P place = to_fixed_phase(P(into));
    if (run_.held == HeldSample::time) {  // the time before this step, which stretched, is made up
      place.s = -(wide(typename P::Value(before)) * stretch_) - moved_;
    }
    length_ = place;
    sample_ = m_.y;
    m_.template evaluate<0>(m_.terms.data(), place, sample_.data());
    Vec y(m_.layout().size());
    Mat by(m_.layout().size(), static_cast<Eigen::Index>(run_.columns.size()));
    for (int i = 0; i < m_.layout().size(); ++i) {
      const P& number = sample_[static_cast<size_t>(i)];
      y(i) = lane(number, 0);
      for (int c = 0; c < by.cols(); ++c) by(i, c) = lane(number.s, c);
    }
    const double time = lane(m_.clock.time, 0) + into;
    const bool turns_over = time >= period * (1.0 - 1e-14);
    run_.end = {record.revolution + (turns_over ? 1 : 0), turns_over ? 0.0 : time * s.phase_rate(),
                y, m_.contacts_of(0)};
    run_.states.push_back(std::move(y));
    run_.slopes.push_back(std::move(by));
  }
}

/// Lets slopes jump with the acceleration at an event of contact i, by how the function of the
/// event changes at its phase: the depth, or the slip.
template <class P>
HWY_ATTR void SlopeCarrier<P, true>::jump(size_t i, EventKind kind, const Saltation& s) {
  const ContactLanes<P>& c = m_.contacts[i];
  P x = c.dx[0], y = c.dy[0], r(1.0), u, v;
  if (!c.rows.is_plane) {
    c.displacement(m_.y.data(), x, y);
    x = x - c.offset_x;
    y = y - c.offset_y;
    r = sqrt(fma(x, x, y * y));
  }
  P function;
  if (kind == EventKind::touch) {
    if (c.rows.is_plane) {
      c.displacement(m_.y.data(), u, v);
      function = fma(x, u, y * v) - c.plane_at;
    } else {
      function = c.wall ? c.wall->at(x, y).depth : r - c.clearance;
    }
  } else {
    if (c.rub) {
      c.rub->lateral(m_.layout().rates_at(m_.y.data()), u, v);
    } else {
      c.displacement(m_.layout().rates_at(m_.y.data()), u, v);
    }
    function = c.rim + fnma(y, u, x * v) / r;
  }
  for (int j = m_.layout().place_of_rate(0); j < m_.layout().size(); ++j) {
    P& number = m_.y[static_cast<size_t>(j)];
    number.s = fma(typename P::Slopes(s.jump(j)), function.s, number.s);
  }
}

/// Looks at a step of length h, and says how slopes move its end: to fixed phase, but with
/// deviations
///
/// - to the instant of an event. Their rate jumps there, and so would they beside that instant;
/// - to the same depth close to the surface of a law that has no Taylor series there, unless a
///   revolution ends: second derivatives of its force grow without bound, but not beside motions
///   that are equally deep;
/// - to the last sample, before any event.
template <class P>
HWY_ATTR P SlopeCarrier<P, true>::end_of_step(const P& h, uint64_t& fell, uint64_t ends) {
  const P fixed = to_fixed_phase(h);
  grazes_.find(fixed, elapsed());
  take_samples(fixed);
  if (!deviations_) return fixed;
  if (run_.is_done()) {
    fell = 0;
    return length_;
  }
  length_ = fell != 0 ? h : ends != 0 || m_.is_analytic ? fixed : deviations_->to_same_depth(fixed);
  moved_ = length_.s - fixed.s;
  return length_;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
