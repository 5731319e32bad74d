#include "apps/verbs/orbits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/progress.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libio/results/result_schema.hpp"

namespace whirl::inline cli {

namespace {

constexpr long most_harmonics = 10000;

/// The choice that an option names.
/// @throws ModelError  if it is none
template <class Enum>
Enum choice_of(const Invocation& call, const std::string& option, const char* expected) {
  const std::string given = call.text(option);
  for (const auto& [name, value] : choices(Enum{})) {
    if (name == given) return value;
  }
  throw ModelError({"--" + option + " " + given}, "", expected);
}

}  // namespace

OrbitFrame orbit_frame(const Invocation& call) {
  return choice_of<OrbitFrame>(call, "frame", "expected stationary or rotating");
}

OrbitMethod orbit_method(const Invocation& call) {
  const auto method =
      choice_of<OrbitMethod>(call, "method", "expected shooting or harmonic-balance");
  for (const std::string option : {"harmonics", "verify"}) {
    if (method == OrbitMethod::harmonic_balance || !call.has(option)) continue;
    throw ModelError({"--" + option}, "", "goes with --method harmonic-balance");
  }
  return method;
}

int harmonics_of(const Invocation& call, int period) {
  if (!call.has("harmonics")) return 0;
  const long harmonics = call.integer("harmonics");
  if (harmonics < period || harmonics > most_harmonics) {
    throw ModelError({"--harmonics " + call.text("harmonics")}, "",
                     fmt::format("expected {} to {}: the speed is harmonic {} of the orbit", period,
                                 most_harmonics, period));
  }
  return static_cast<int>(harmonics);
}

Trajectory after_transient(const Invocation& call, const Model& model, const Scene& scene) {
  const long discard = call.has("from") && !call.has("discard") ? 0 : call.integer("discard", 0);
  const double tolerance = call.number("tolerance", "");
  require_tolerance(tolerance, "--tolerance " + call.text("tolerance"));
  Trajectory transient{.system = &scene.contacts, .state = starting_state(call, model, scene)};
  if (scene.contacts.coordinates() == 0) {
    throw NumericalError("nothing moves: the system has no freedoms");
  }
  // an orbit is shot from phase 0: what is left of a revolution is gone through first
  transient.revolutions = transient.state.phase > 0.0 ? std::max(1L, discard) : discard;
  Progress progress("going through the transient", transient.revolutions, call.shows_progress);
  install_interrupt_handler();
  if (transient.revolutions > 0) {
    integrate_single(transient, {.tolerance = tolerance, .watch = [&](long done) {
                                   progress.update(done);
                                   return !is_interrupted();
                                 }});
  }
  return transient;
}

std::optional<MotionState> settled_state(const Invocation& call, const Model& model,
                                         const Scene& scene) {
  const Trajectory transient = after_transient(call, model, scene);
  if (transient.outcome == Outcome::stopped_by_observer) return std::nullopt;
  if (transient.outcome == Outcome::reached_end) return transient.state;
  throw NumericalError(transient.diagnosis);
}

BranchStart branch_start(const Invocation& call) {
  const std::string option = "--point " + call.text("point");
  if (!call.has("from")) {
    throw ModelError({option}, "",
                     "of which branches? give the result of whirl continue with --from");
  }
  const auto file = open_result(call.text("from"));
  const long number = call.integer("point"), points = count_branch_points(*file);
  if (number <= points) return read_branch_point(*file, number);
  throw ModelError({option}, "", fmt::format("expected a number from 1 to {}", points));
}

}  // namespace whirl::inline cli
