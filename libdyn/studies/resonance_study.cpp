#include "libdyn/studies/resonance_study.hpp"

#include <cmath>
#include <limits>

#include "libbase/numerics/constants.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/studies/orbit_travel.hpp"
#include "libdyn/studies/point_runner.hpp"

namespace whirl::inline dyn {

namespace {

/// The mode of a sense that is nearest to a frequency seen from the rotor; null: there is none.
const Mode* nearest_mode(const Modes& modes, Whirl whirl, double Omega, double seen) {
  const Mode* nearest = nullptr;
  double distance = std::numeric_limits<double>::infinity();
  const double sense = whirl == Whirl::backward ? -1.0 : 1.0;
  for (const Mode& m : modes.oscillatory) {
    const double off = std::abs(std::abs(Omega - sense * m.frequency()) - seen);
    if (m.whirl != whirl || off >= distance) continue;
    nearest = &m;
    distance = off;
  }
  return nearest;
}

/// Orbit of a mode in a contact, by the largest of the rotor.
double size_at(const Contact& contact, const Assembler& assembler, const System& system,
               const Mode* mode) {
  if (!mode) return nan;
  const Eigen::Vector2cd d =
      closing_rows(contact, assembler, system.dofs).cast<Complex>() * mode->shape;
  return Orbit(d(0), d(1)).major();
}

/// What was found near every resonance.
struct Confirmed {
  PointRows<std::optional<Bouncing>> points;
};

/// Looks for bouncing motions near all resonances.
void confirm(ResonanceStudy& study, const Model& model, const ResonanceOptions& options,
             const Monitor<ResonanceStudy>& monitor) {
  BouncingOptions search = options.search;
  search.is_stopped = monitor.stop_asked();
  PointWork<std::optional<Bouncing>> work{.most_together = 1, .threads = options.threads};
  work.compute = [&](const auto& piece, NothingGiven&) {
    return std::vector{find_bouncing([&](double speed) { return scene_at_speed(model, speed); },
                                     study.diagram, study.places[piece[0]], search)};
  };
  Confirmed confirmed;
  confirmed.points.resize(study.places.size());
  run_points(work, confirmed, monitor.of<Confirmed>());
  for (std::size_t i = 0; i < study.places.size(); ++i) {
    std::optional<std::optional<Bouncing>> found = confirmed.points[i];
    study.places[i].is_confirmed = found.has_value();
    if (found) study.places[i].bouncing = std::move(*found);
    study.is_whole = study.is_whole && found;
  }
}

}  // namespace

double ResonancePlace::bouncing_speed() const {
  return bouncing ? bouncing->speed : nan;
}

double ResonancePlace::bouncing_period() const {
  return bouncing ? bouncing->turns : nan;
}

int ResonancePlace::bouncing_stable() const {
  return !bouncing ? -1 : bouncing->cycle.is_stable() ? 1 : 0;
}

std::shared_ptr<const Scene> scene_at_speed(const Model& model, double speed) {
  Model at = model;
  at.speed = speed;
  at.has_speed = true;
  return std::make_shared<const Scene>(make_scene(at, ReductionEstimate::no));
}

ResonanceStudy resonance_study(const Model& model, const Assembler& assembler,
                               const ResonanceOptions& options,
                               const Monitor<ResonanceStudy>& monitor) {
  ResonanceStudy study{.diagram = campbell(assembler, options.speeds, options.modes),
                       .is_confirmed = options.confirms};
  const ModeFinder finder(assembler);
  for (const InternalResonance& r : internal_resonances(study.diagram, options.largest)) {
    ResonancePlace place{r, {}, {}};
    const Modes modes = finder.at(r.speed, options.modes + 2);
    const System system = finder.system(r.speed);
    const auto nearest = [&](int branch, double seen) {
      const Whirl whirl = study.diagram.branches[static_cast<std::size_t>(branch)].whirl;
      return nearest_mode(modes, whirl, r.speed, seen);
    };
    const Mode *fast = nearest(r.fast, r.p * r.frequency),
               *slow = nearest(r.slow, r.q * r.frequency);
    for (const Contact& c : model.contacts) {
      place.contacts.push_back(
          {c.name, size_at(c, assembler, system, fast), size_at(c, assembler, system, slow)});
    }
    study.places.push_back(std::move(place));
  }
  if (options.confirms) confirm(study, model, options, monitor);
  return study;
}

}  // namespace whirl::inline dyn
