#pragma once
/// What of studies goes from one process to another, and back: see libbase/travel.hpp.

#include "libbase/travel.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/portrait.hpp"
#include "libdyn/studies/study_models.hpp"
#include "libdyn/studies/sweep.hpp"

namespace whirl::inline dyn {

template <class Bytes>
void travel(Bytes& bytes, Is<ContactState> auto& state) {
  auto& [touch, sign] = state;
  bytes(touch, sign);
}

template <class Bytes>
void travel(Bytes& bytes, Is<MotionState> auto& state) {
  auto& [revolution, phase, y, contacts] = state;
  bytes(revolution, phase, y, contacts);
}

template <class Bytes>
void travel(Bytes& bytes, Is<FullState> auto& state) {
  auto& [displacement, velocity] = state;
  bytes(displacement, velocity);
}

template <class Bytes>
void travel(Bytes& bytes, Is<EarlierEnd> auto& end) {
  auto& [state, phase, revolution] = end;
  bytes(state, phase, revolution);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ContactMeasure> auto& measure) {
  auto& [name, duty, impacts, sticking, max_normal, max_tangential, mean_slip, touch_time] =
      measure;
  bytes(name, duty, impacts, sticking, max_normal, max_tangential, mean_slip, touch_time);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ContactDoing> auto& doing) {
  auto& [regime, duty, impacts_per_rev, sticking, max_normal, max_tangential] = doing;
  bytes(regime, duty, impacts_per_rev, sticking, max_normal, max_tangential);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Drift> auto& drift) {
  auto& [change, rate, left, spread] = drift;
  bytes(change, rate, left, spread);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Classification> auto& found) {
  auto& [kind, period, period_time, exponents, is_proven, is_free, residual, zero, resolution,
         drift, settles_after, section_dimension, revolutions, transient, contacts, sections, end,
         outcome, failure] = found;
  bytes(kind, period, period_time, exponents, is_proven, is_free, residual, zero, resolution, drift,
        settles_after, section_dimension, revolutions, transient, contacts, sections, end, outcome,
        failure);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ClassifiedMotion> auto& motion) {
  auto& [kind, period, is_proven, transient, revolutions, resolution, section_dimension, exponents,
         contacts, settles_after, failure] = motion;
  bytes(kind, period, is_proven, transient, revolutions, resolution, section_dimension, exponents,
        contacts, settles_after, failure);
}

/// Without its scene, which the other process makes again, and what is remembered of that.
template <class Bytes>
void travel(Bytes& bytes, Is<StudyMotion> auto& motion) {
  auto& [scene, subject, failure] = motion;
  bytes(subject.found, failure);
}

template <class Bytes>
void travel(Bytes& bytes, Is<BasinsPoint> auto& point) {
  auto& [motion, start, sections] = point;
  bytes(motion, start, sections);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Portrait> auto& portrait) {
  auto& [poincare_x, poincare_y, max_radius, spectrum, contact_angle, probe_sections, probe_mean,
         probe_peak_to_peak, probe_spectrum] = portrait;
  bytes(poincare_x, poincare_y, max_radius, spectrum, contact_angle, probe_sections, probe_mean,
        probe_peak_to_peak, probe_spectrum);
}

template <class Bytes>
void travel(Bytes& bytes, Is<SweepEnd> auto& end) {
  bytes(end.displacement, end.velocity, end.revolution);
}

template <class Bytes>
void travel(Bytes& bytes, Is<SweepPoint> auto& point) {
  auto& [motion, end, portrait] = point;
  bytes(motion, end, portrait);
}

}  // namespace whirl::inline dyn
