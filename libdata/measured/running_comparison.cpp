#include "libdata/measured/running_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "libdata/measured/station_motion.hpp"

namespace whirl::inline data {

namespace {

/// Sense of whirl of readings; "" where every station is seen in one direction only.
std::string sense_of(const CVec& readings, const std::vector<ProbedStation>& stations) {
  std::vector<Orbit> orbits;
  for (const ProbedStation& station : stations) {
    if (station.is_planar) continue;
    Complex x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < station.probes.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      x += station.to_plane(0, c) * readings(station.probes[i]);
      y += station.to_plane(1, c) * readings(station.probes[i]);
    }
    orbits.emplace_back(x, y);
  }
  return orbits.empty() ? "" : std::string(name_of(whirl_of(orbits)));
}

/// The mode with the largest MAC; of several that probes cannot tell from it, the nearest in
/// frequency.
/// @return  -1 where none is alike
int most_like(const RunningMode& running, const std::vector<Mode>& modes) {
  constexpr double same = 0.05;  // difference of MACs
  const double largest = *std::max_element(running.mac.begin(), running.mac.end());
  if (!(largest >= least_likeness)) return -1;
  int nearest = -1;
  double least = HUGE_VAL;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const double away = std::abs(std::log(modes[m].frequency() / running.frequency()));
    if (running.mac[m] < largest - same || away >= least) continue;
    least = away;
    nearest = static_cast<int>(m);
  }
  return nearest;
}

}  // namespace

RunningModes running_modes(const ProbeReadings& readings, RunningModesOptions options) {
  options.channels.clear();
  for (const Probe& probe : readings.probes) options.channels.push_back(probe.name);
  Eigen::Index first = 0, count = readings.displacement.rows();
  if (readings.clock) {
    while (count > 0 && readings.time(first) < readings.clock->first()) ++first, --count;
    while (count > 0 && readings.time(first + count - 1) > readings.clock->last()) --count;
    options.phase = Vec::NullaryExpr(
        count, [&](Eigen::Index i) { return readings.clock->angle(readings.time(first + i)); });
  }
  return running_modes(readings.displacement.middleRows(first, count), 1.0 / readings.rate,
                       options);
}

void compare(RunningModes& found, const MeasuredIdentification& measured,
             const ProbeReadings& readings, const Assembler& assembler) {
  const std::vector<ProbedStation> stations = probed_stations(readings.probes, assembler);
  for (RunningMode& mode : found.modes) {
    mode.whirl = sense_of(mode.shape, stations);
    mode.mac.clear();
    for (Eigen::Index m = 0; m < measured.mode_readings.rows(); ++m) {
      mode.mac.push_back(channel_mac(mode.shape, measured.mode_readings.row(m).transpose()));
    }
    if (mode.mac.empty()) continue;
    mode.model_mode = most_like(mode, measured.found.modes);
    if (mode.model_mode < 0) continue;
    const Mode& like = measured.found.modes[static_cast<std::size_t>(mode.model_mode)];
    mode.shift = mode.frequency() / like.frequency() - 1.0;
  }
}

}  // namespace whirl::inline data
