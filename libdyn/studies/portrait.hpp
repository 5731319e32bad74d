#pragma once
/// What is seen of a classified motion: sections and spectra at stations, how far stations move,
/// and where contacts touch.

#include <tuple>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/column.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/probes.hpp"
#include "libdyn/system/scene.hpp"
#include "libdyn/system/stations.hpp"

namespace whirl::inline dyn {

struct PortraitOptions {
  std::vector<NamedPoint> stations{};
  long spectrum_revolutions = 32;  ///< whose spectra are taken; 0: sections only
};

/// Sections and spectra of a motion; what is not known is NaN.
struct Portrait {
  Mat poincare_x, poincare_y;  ///< at phase 0, the last sections: stations x sections [m]
  Vec max_radius;              ///< largest distance from the axis, per station [m]
  /// Radius of the circle that turns with an order of the speed: stations x portrait_orders [m].
  Mat spectrum;
  Mat contact_angle;  ///< share of the time in touch: contacts x portrait_sectors
  /// What the probes of the model read at phase 0, the last sections: probes x sections [m].
  Mat probe_sections;
  Vec probe_mean, probe_peak_to_peak;  ///< of the readings of each probe [m]
  /// Peak to peak of what turns with an order of the speed: probes x probe_orders [m].
  Mat probe_spectrum;
  Vec support_largest;                 ///< force on each part of SupportLoads [N]
  Vec support_mean_x, support_mean_y;  ///< of these forces [N]
};

/// Orders of a portrait's spectra: signed frequency over speed, forward > 0.
Vec portrait_orders(long spectrum_revolutions);
/// Orders of the spectra of probes, from 0.
Vec probe_orders(long spectrum_revolutions);
/// Middles of the sectors around a stator, from x to y [rad].
Vec portrait_sectors();

/// Looks at a motion, from a state on it.
///
/// @param model      of the scene
/// @param found      with its last sections
/// @param sections   of the portrait; NaN beyond those that were found
/// @param tolerance  of a step
Portrait portrait_of(const Model& model, const Scene& scene, const Classification& found,
                     long sections, double tolerance, const PortraitOptions& options);

}  // namespace whirl::inline dyn
