#include "libdata/measured/run_readings.hpp"

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"

namespace whirl::inline data {

namespace {

/// Probes along x and y at a station.
std::vector<Probe> pair_at(const NamedPoint& station) {
  std::vector<Probe> pair;
  for (const auto& [letter, angle] : {std::pair{" x", 0.0}, {" y", 0.25 * turn}}) {
    Probe probe;
    probe.name = station.label() + letter;
    probe.angle = angle;
    pair.push_back(std::move(probe));
  }
  return pair;
}

}  // namespace

ProbeReadings readings_of(const Model& model, const Run& run) {
  const Recording& recording = run.simulation.recording;
  ProbeReadings readings{.rate = 1.0 / recording.spacing(), .start = recording.time(0)};
  std::vector<Vec> signals;
  for (const Probe& probe : model.structure.probes) {
    readings.probes.push_back(probe);
    signals.push_back(reading_of(run, probe));
  }
  if (readings.probes.empty()) {
    for (const NamedPoint& station : run.stations) {
      const Mat motion = motion_of(run, station.point);
      for (Probe& probe : pair_at(station)) {
        signals.push_back(std::cos(probe.angle) * motion.col(0) +
                          std::sin(probe.angle) * motion.col(1));
        readings.probes.push_back(std::move(probe));
      }
    }
  }
  readings.displacement.resize(recording.time.size(), std::ssize(signals));
  for (std::size_t i = 0; i < signals.size(); ++i) {
    readings.displacement.col(static_cast<Eigen::Index>(i)) = signals[i];
  }
  readings.missing.resize(signals.size());
  constexpr long fewest = 3;
  if (!(recording.speed() > 0.0) || recording.revolutions < fewest) return readings;
  std::vector<double> pulses;
  const double period = recording.clock.period();
  for (Eigen::Index j = 0; j < recording.time.size(); j += recording.samples) {
    pulses.push_back(recording.time(j));
  }
  pulses.push_back(pulses.back() + period);
  readings.clock.emplace(std::move(pulses), KeyPhasor{}, readings.notes);
  return readings;
}

}  // namespace whirl::inline data
