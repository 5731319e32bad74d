#include "libio/figures/turned_motion.hpp"

#include <algorithm>
#include <cmath>

#include "libdata/measured/measured_identification.hpp"
#include "libdata/measured/station_motion.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io::figures {

namespace {

constexpr std::size_t fewest_turns = 4;  ///< pulses, of three revolutions

/// Times at which a rotor of a speed has turned by whole revolutions, within a motion.
std::vector<double> even_turns(const Vec& time, double period) {
  std::vector<double> turns;
  const double last = time(time.size() - 1) + 1e-9 * period;
  // a file may say anything: not more revolutions than samples
  constexpr double most = 1e9;  // revolutions before
  const bool is_shown = period > 0.0 && std::abs(time(0)) < most * period &&
                        last - time(0) < period * static_cast<double>(time.size());
  if (!is_shown) return turns;
  for (double k = std::ceil(time(0) / period - 1e-9); k * period <= last; ++k) {
    turns.push_back(k * period);
  }
  return turns;
}

std::vector<const StationMotion*> pointers_to(const std::vector<StationMotion>& stations,
                                              Eigen::Index samples) {
  std::vector<const StationMotion*> all;
  for (const StationMotion& s : stations) {
    if (s.x.size() != samples || s.y.size() != samples) {
      throw FileError("the measured motion is not of its times");
    }
    all.push_back(&s);
  }
  return all;
}

std::optional<DrawnMotion> motion_of(const Vec& time, const std::vector<StationMotion>& stations,
                                     const std::vector<double>& turns, bool has_marks) {
  if (time.size() < 2 || turns.size() < fewest_turns) return std::nullopt;
  if (!(time(time.size() - 1) > time(0)) || !std::is_sorted(turns.begin(), turns.end())) {
    throw FileError("the times of the motion do not ascend");
  }
  std::vector<std::string> notes;  // were told when the record was read
  DrawnMotion m{{time, pointers_to(stations, time.size()), TurnClock(turns, {}, notes), has_marks}};
  m.slowest = m.fastest = m.motion.clock.mean_speed();
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double speed = turn / (turns[i + 1] - turns[i]);
    m.slowest = std::min(m.slowest, speed);
    m.fastest = std::max(m.fastest, speed);
  }
  return m;
}

}  // namespace

std::optional<DrawnMotion> drawn_motion(const ResultView& result) {
  const double speed = speed_of(result);
  const bool spins = std::isfinite(speed) && speed > 0.0;
  if (result.file.has(dataset_of<StationRecord>(&StationMotion::x))) {
    const auto& record = result_of<StationRecord>(result);
    const bool has_marks = record.turns.size() >= fewest_turns;
    if (!has_marks && !spins) return std::nullopt;
    auto m = motion_of(record.time, record.stations,
                       has_marks ? record.turns : even_turns(record.time, turn / speed), has_marks);
    if (m) m->is_measured = true;
    return m;
  }
  if (!result.file.has(dataset_of<MotionRecord>(&StationMotion::x)) || !spins) return std::nullopt;
  const auto& record = result_of<MotionRecord>(result);
  const RecordedMotion times = recorded_motion(result.file);
  return motion_of(record.time, record.stations, even_turns(record.time, times.period), true);
}

std::vector<Probe> probes_of_station(const ResultView& result, const DrawnMotion& motion,
                                     const std::string& station) {
  if (!motion.is_measured) return probes_at(result, station);
  std::vector<Probe> there;
  for (const ProbeLabel& p : result_of<MeasuredIdentification>(result).probes) {
    const std::string among = " + " + station + " + ";
    if (among.find(" + " + p.name + " + ") == std::string::npos) continue;
    Probe probe;
    probe.name = p.name;
    probe.angle = p.angle;
    probe.face_radius = p.face_radius;
    probe.unit = p.unit;
    there.push_back(std::move(probe));
  }
  return there;
}

DisplayUnit unit_of_station(const std::vector<Probe>& probes, double largest) {
  return probes.empty() ? unit_for(largest, "m") : unit_of(ProbeLabel(probes.front()));
}

std::vector<std::string> motion_datasets() {
  return {dataset_of<MotionRecord>(&StationMotion::x),
          dataset_of<StationRecord>(&StationMotion::x)};
}

}  // namespace whirl::inline io::figures
