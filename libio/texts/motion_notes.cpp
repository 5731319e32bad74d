#include "libio/texts/motion_notes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/names.hpp"
#include "libdyn/motions/simulate.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/stability_text.hpp"

namespace whirl::inline io {

namespace {

using Notes = std::vector<std::string>;

constexpr double deep = 1.0;      ///< clearances
constexpr double soon = 100.0;    ///< revolutions
constexpr double powerful = 1e6;  ///< [W]
constexpr double long_way = 0.1;  ///< shaft's lengths
constexpr double far_away = 1e4;  ///< length scales, of a rotor without a shaft

/// "3.2", "1140", "1.6e+134"
std::string times_text(double ratio) {
  return ratio < 1e6 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.1e}", ratio);
}

std::string at_place(const std::string& place) {
  return place.empty() ? "" : "at " + place + ": ";
}

void note_depth(Notes& notes, const std::string& place, const std::string& contact, double depth,
                double clearance) {
  if (!(depth > deep * clearance)) return;
  notes.push_back(fmt::format(
      "{}the rotor lies {} deep in {}, {} times its clearance: the law of a contact has no end, a "
      "stator has",
      at_place(place), format_length(depth), contact, times_text(depth / clearance)));
}

void note_friction(Notes& notes, const std::string& place, const Model& model,
                   const Contact& contact, double rubbing) {
  const FrictionPower friction = friction_power(model, contact, rubbing);
  const bool stops = friction.revolutions < soon;
  if (!stops && !(friction.power > powerful)) return;
  notes.push_back(fmt::format(
      "{}friction at {} takes up to {}{}: the speed is kept, which no drive could", at_place(place),
      named("contact", contact.name), format_engineering(friction.power, "W", 3),
      stops ? fmt::format(", the energy of the rotor's spin in {:.2g} revolutions",
                          friction.revolutions)
            : ""));
}

/// The largest distance of any point from where it is without motion, if it is above a limit [m];
/// else something below that.
double farthest_beyond(double limit, const Scene& scene, const Mat& coordinates) {
  const Mat map = scene.displacement_map();
  const DofMap& dofs = scene.reduced.dofs;
  const Vec most = coordinates.cwiseAbs().rowwise().maxCoeff();
  double largest = 0.0;
  for (const Point& point : dofs.points()) {
    Mat rows(2, map.cols());
    rows << map.row(dofs.full_index(point, X)), map.row(dofs.full_index(point, Y));
    if ((rows.cwiseAbs() * most).norm() <= limit) continue;  // it cannot get there
    largest = std::max(largest, (rows * coordinates).colwise().norm().maxCoeff());
  }
  return largest;
}

}  // namespace

Notes motion_notes(const Model& model, const Scene& scene, const Recording& recording) {
  if (recording.revolutions == 0) return {};
  Notes notes;
  const auto distances =
      largest_distances(model, scene.assembler, scene.displacement_map(), recording.eta);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const RunningClearance& gap = distances[i];
    if (i < stator_contacts(model.contacts).size()) {
      note_depth(notes, "", gap.name, -gap.left(), gap.clearance);
    } else if (gap.left() < 0.0) {
      notes.push_back(fmt::format(
          "the rotor moves {} from the middle of {}, {} times its clearance, which the "
          "motion passes as if nothing were there",
          format_length(gap.distance), gap.name, times_text(gap.distance / gap.clearance)));
    }
  }
  HardestTouches touches;
  touches.add(0, recording.contacts);
  for (std::size_t i = 0; i < touches.contacts().size(); ++i) {
    note_friction(notes, "", model, model.contacts[i], touches.contacts()[i].rubbing);
  }
  const double length = model.structure.length();
  const double limit = length > 0.0 ? long_way * length : far_away * scene.contacts.length_scale();
  const double far = farthest_beyond(limit, scene, recording.eta);
  if (!(far <= limit)) {
    notes.push_back(fmt::format(
        "the rotor moves {:.3g} m aside{}: the equations hold for displacements that are small "
        "beside the shaft",
        far, length > 0.0 ? fmt::format(", {} times its length", times_text(far / length)) : ""));
    for (std::string& note : unstable_notes(Assembler(linear_structure(model)), {model.speed})) {
      notes.push_back(std::move(note));
    }
  }
  return notes;
}

Notes motion_notes(const Model& model, const Run& run) {
  return motion_notes(model, run.scene, run.simulation.recording);
}

Notes motion_notes(const Model& model, const Scene& scene, MotionState start, long revolutions) {
  return motion_notes(model, scene, recorded_from(scene, std::move(start), revolutions));
}

Notes motion_notes(const std::vector<FittedMotion>& found) {
  Notes all;
  for (const FittedMotion& motion : found) {
    for (const std::string& note :
         motion_notes(motion.model, motion.scene, motion.start, noted_revolutions)) {
      all.push_back(found.size() > 1 ? motion.record + ": " + note : note);
    }
  }
  return all;
}

Notes motion_notes(const Model& model, const ResonanceStudy& study) {
  Notes all;
  for (const ResonancePlace& place : study.places) {
    if (!place.bouncing) continue;
    const Bouncing& bouncing = *place.bouncing;
    Model there = model;
    there.speed = bouncing.speed;
    const auto scene = scene_at_speed(model, bouncing.speed);
    for (const std::string& note : motion_notes(there, *scene, {.y = bouncing.cycle.state},
                                                std::lround(std::ceil(bouncing.turns)))) {
      all.push_back(
          fmt::format("bouncing at {}: {}", shown_value(bouncing.speed, "rpm", ".6g"), note));
    }
  }
  return all;
}

Notes touch_notes(const HardestTouches& hardest, const std::function<Model(std::size_t)>& model_of,
                  const std::function<std::string(std::size_t)>& place_of) {
  Notes notes;
  for (std::size_t i = 0; i < hardest.contacts().size(); ++i) {
    const HardestTouch& touch = hardest.contacts()[i];
    if (touch.normal > 0.0) {
      const Model model = model_of(touch.pressed);
      const Contact& contact = model.contacts[i];
      if (contact.limits) continue;
      note_depth(notes, place_of(touch.pressed), named("contact", contact.name),
                 depth_under(contact.law, touch.normal), contact.clearance);
    }
    if (touch.rubbing > 0.0) {
      const Model model = model_of(touch.rubbed);
      note_friction(notes, place_of(touch.rubbed), model, model.contacts[i], touch.rubbing);
    }
  }
  return notes;
}

}  // namespace whirl::inline io
