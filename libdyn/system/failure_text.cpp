#include "libdyn/system/failure_text.hpp"

#include <fmt/format.h>

#include <limits>
#include <numbers>

namespace whirl::inline dyn {

namespace {

/// The place of a contact that is farthest out.
int deepest_place(const ContactSystem& system, const MotionState& state, int owner) {
  int deepest = 0;
  double depth = -std::numeric_limits<double>::infinity();
  for (const ReducedContact& c : system.contacts()) {
    if (c.owner != owner) continue;
    const double d =
        kinematics(c, {state.phase, state.revolution}, state.y.data(), system.layout()).depth;
    if (d <= depth) continue;
    depth = d;
    deepest = c.place;
  }
  return deepest;
}

}  // namespace

std::string failure_text(const ContactSystem& system, const MotionState& state,
                         std::string_view what) {
  constexpr const char* words[] = {"apart", "receding", "sliding", "sticking"};
  std::string contacts;
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    const ReducedContact& c = system.contacts()[i];
    if (c.turns() && c.place != deepest_place(system, state, c.owner)) continue;
    const ContactForces f =
        kinematics(c, {state.phase, state.revolution}, state.y.data(), system.layout());
    // inside a wall neither depth nor normal is told by a distance from it
    const bool is_inside = is_wall(c.geometry) && state.contacts[i].touch == Touch::apart;
    const double out = is_inside ? f.r / c.clearance : 1.0 + f.depth / c.clearance;
    contacts += fmt::format("; contact \"{}\" {}, {:.4g} clearances from its center", c.name,
                            words[static_cast<int>(state.contacts[i].touch)], out);
    if (!is_inside) contacts += fmt::format(", slip {:.3g} m/s", f.slip);
  }
  for (const ReducedFilm& film : system.films()) {
    contacts += fmt::format("; journal of oil film \"{}\" at {:.8g} of its clearance", film.name,
                            eccentricity(film, state.y.data(), system.layout()));
  }
  return fmt::format(
      "{} in revolution {} at {:.3f} of it{}; largest coordinate {:.3g} scales", what,
      state.revolution, state.phase / (2.0 * std::numbers::pi), contacts,
      (state.y.array() / system.state_scale().array()).abs().maxCoeff<Eigen::PropagateNaN>());
}

std::string left_bearing_text(const ReducedFilm& film) {
  return fmt::format("the journal of oil film \"{}\" is not inside its bearing", film.name);
}

bool is_boundless(const ContactSystem& system, const Eigen::Ref<const Vec>& y) {
  const StateLayout layout = system.layout();
  const auto sizes = layout.eta(y).array() / layout.eta(system.state_scale()).array();
  return !(sizes.abs() < boundless).all();  // maxCoeff() may pass over NaN
}

void fail(Integration& result, const ContactSystem& system, const MotionState& state,
          Outcome outcome, std::string_view what) {
  const ReducedFilm* film = system.left_bearing(state.y.data());
  result.outcome = film ? Outcome::left_bearing : outcome;
  result.failure = failure_text(system, state, film ? left_bearing_text(*film) : what);
}

}  // namespace whirl::inline dyn
