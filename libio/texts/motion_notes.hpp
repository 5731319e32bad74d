#pragma once
/// Notes on motions that no machine makes: something that the model leaves out would stop the
/// machine before.
///
/// Told are: a rotor that lies deeper in a contact than the clearance is wide, one that passes the
/// clearance of a bearing or seal, friction that would take the energy of the spin within a hundred
/// revolutions or takes megawatts, and displacements that are no longer small beside the shaft.

#include <functional>
#include <string>
#include <vector>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libdyn/system/hardest_touch.hpp"
#include "libio/measured/model_fit.hpp"

namespace whirl::inline io {

/// Notes on a recorded motion; none without a whole revolution.
std::vector<std::string> motion_notes(const Model& model, const Run& run);
std::vector<std::string> motion_notes(const Model& model, const Scene& scene,
                                      const Recording& recording);

/// Revolutions of a motion that notes are taken from where the motion is not recorded.
inline constexpr long noted_revolutions = 8;
/// Notes on the motion that goes on from a state, over so many revolutions. States of contacts that
/// are left out are those of a motion whose past is not known.
std::vector<std::string> motion_notes(const Model& model, const Scene& scene, MotionState start,
                                      long revolutions);

/// Notes on the motions that a fit found, over noted_revolutions. Where there are several records,
/// a note begins with the name of its record.
std::vector<std::string> motion_notes(const std::vector<FittedMotion>& found);

/// Notes on the bouncing motions that were found, each over its period.
std::vector<std::string> motion_notes(const Model& model, const ResonanceStudy& study);

/// Notes on many motions of which only the forces at the contacts are known: depths are computed
/// from the contact law.
/// @param model_of  the model of a motion
/// @param place_of  where a motion stands in the study, such as "operation.speed = 32 rad/s"; may
///                  be empty
std::vector<std::string> touch_notes(const HardestTouches& hardest,
                                     const std::function<Model(std::size_t)>& model_of,
                                     const std::function<std::string(std::size_t)>& place_of);

}  // namespace whirl::inline io
