#pragma once
/// Parts of studies beside their rows as bytes that go from one process to another, and back: see
/// libbase/structs/travel.hpp.

#include "libbase/structs/travel.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/row_travel.hpp"
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
void travel(Bytes& bytes, Is<Drift> auto& drift) {
  auto& [change, rate, left, spread] = drift;
  bytes(change, rate, left, spread);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ExponentPath> auto& path) {
  auto& [revolutions, exponents] = path;
  bytes(revolutions, exponents);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Classification> auto& found) {
  auto& [kind, period, period_time, exponents, path, is_proven, is_free, residual, zero, resolution,
         drift, settles_after, section_dimension, revolutions, transient, contacts, sections, end,
         outcome, failure] = found;
  bytes(kind, period, period_time, exponents, path, is_proven, is_free, residual, zero, resolution,
        drift, settles_after, section_dimension, revolutions, transient, contacts, sections, end,
        outcome, failure);
}

/// A motion without its model and scene, which the other process makes again, and without what is
/// remembered of that scene.
template <class Bytes>
void travel(Bytes& bytes, Is<StudyMotion> auto& motion) {
  auto& [model, scene, subject, failure] = motion;
  bytes(subject.found, failure);
}

}  // namespace whirl::inline dyn
