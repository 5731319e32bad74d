#include "libdyn/motions/run_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/system/memory.hpp"
#include "libdyn/motions/late_loads.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline dyn {

namespace {

/// Bytes that a sample takes when most are in use: displacements and forces, the spectra of the
/// coordinates and what their transform takes, and of a result file the trajectory or spectra with
/// a copy of one dataset. Measured within 15 % for 4 and 8 coordinates, 2 to 13 stations.
double bytes_of_sample(int coordinates, std::size_t contacts, std::size_t written_stations) {
  constexpr double of_coordinate = 8.0 + 16.0, of_contact = 16.0, of_transform = 64.0;
  constexpr double of_station = 27.0;
  return of_coordinate * coordinates + of_contact * static_cast<double>(contacts) + of_transform +
         of_station * static_cast<double>(written_stations);
}

/// The method of a name; empty: the one that suits.
AnyMethod method_for(const ContactSystem& system, const std::string& name) {
  if (name.empty()) return suitable_method(system);
  const AnyMethod method = method_named(name);
  abilities_of(method).require(system);
  return method;
}

}  // namespace

Run run_model(const Model& model, const RunOptions& options,
              const std::optional<EarlierEnd>& earlier) {
  SimulationOptions simulated = options.simulation;
  Scene scene = make_scene(model);
  simulated.method = method_for(scene.contacts, options.method);
  std::vector<NamedPoint> stations = select_points(model, scene.assembler, options.stations);
  const Structure& s = model.structure;
  const std::size_t supports = s.bearings.size() + s.seals.size() + s.links.size() +
                               model.films.size() + rolling_bearings(model.contacts).size();
  // a probe or the force on a support takes no more than a station
  const std::size_t written_stations = stations.size() + s.probes.size() + supports;
  const double bytes = bytes_of_sample(scene.contacts.coordinates(), model.contacts.size(),
                                       options.is_written ? written_stations : 0);
  require_memory(
      "revolutions", bytes * simulated.samples * static_cast<double>(simulated.revolutions),
      fmt::format("{} revolutions with {} samples each", simulated.revolutions, simulated.samples),
      "record fewer, those that are discarded take no memory");
  const MotionState start = start_state(model, scene, earlier);
  if (start.phase > 0.0) {
    // samples begin with a revolution: what is left of this one is not recorded
    simulated.discard = std::max(1L, simulated.discard);
  }
  const auto is_stopped = [&] { return options.is_stopped && options.is_stopped(); };
  simulated.progress = [&](long done) {
    if (options.progress) options.progress(done, simulated.discard + simulated.revolutions);
    return !is_stopped();
  };
  // the revolution that has begun may end, if that takes no longer than this
  constexpr std::chrono::milliseconds patience(500);
  simulated.is_stopped = [&, asked =
                                 std::optional<std::chrono::steady_clock::time_point>()]() mutable {
    if (!is_stopped()) return false;
    const auto now = std::chrono::steady_clock::now();
    if (!asked) asked = now;
    return now - *asked > patience;
  };
  const SupportLoads loads(model, scene);
  const LateLoads late(model, scene);
  simulated.supports = &loads;
  simulated.stages = late.stages();
  Simulation simulation = simulate(scene, start, simulated);
  Run run{std::move(scene),
          std::move(simulation),
          std::move(stations),
          std::string(name_of_method(simulated.method)),
          nullptr,
          loads.parts()};
  if (run.has_motion()) {
    run.spectra = std::make_shared<const ResponseSpectra>(run.scene, run.simulation.recording);
  }
  return run;
}

}  // namespace whirl::inline dyn
