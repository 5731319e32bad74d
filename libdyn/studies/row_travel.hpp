#pragma once
/// What rows of studies are made of, as bytes: see libbase/structs/travel.hpp.

#include "libbase/structs/travel.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/studies/classified_motion.hpp"
#include "libdyn/studies/portrait.hpp"

namespace whirl::inline dyn {

template <class Bytes>
void travel(Bytes& bytes, Is<FullState> auto& state) {
  auto& [displacement, velocity] = state;
  bytes(displacement, velocity);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ContactDoing> auto& doing) {
  auto& [regime, duty, impacts_per_rev, sticking, max_normal, max_tangential] = doing;
  bytes(regime, duty, impacts_per_rev, sticking, max_normal, max_tangential);
}

template <class Bytes>
void travel(Bytes& bytes, Is<ClassifiedMotion> auto& motion) {
  auto& [kind, period, is_proven, transient, revolutions, resolution, section_dimension, exponents,
         contacts, settles_after, failure] = motion;
  bytes(kind, period, is_proven, transient, revolutions, resolution, section_dimension, exponents,
        contacts, settles_after, failure);
}

template <class Bytes>
void travel(Bytes& bytes, Is<Portrait> auto& portrait) {
  auto& [poincare_x, poincare_y, max_radius, spectrum, contact_angle, probe_sections, probe_mean,
         probe_peak_to_peak, probe_spectrum, support_largest, support_mean_x, support_mean_y] =
      portrait;
  bytes(poincare_x, poincare_y, max_radius, spectrum, contact_angle, probe_sections, probe_mean,
        probe_peak_to_peak, probe_spectrum, support_largest, support_mean_x, support_mean_y);
}

}  // namespace whirl::inline dyn
