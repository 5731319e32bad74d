#pragma once
/// Motion of stations in their plane, from what the probes there read.

#include <string>
#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/motions/run_result.hpp"

namespace whirl::inline data {

/// The probes of one station, and what takes their readings to its displacement.
///
/// Axial probes at one face are a station of their own. Their readings at the angles a,
/// (-r theta_y) cos a + (r theta_x) sin a, are as if x were -r theta_y and y were r theta_x. This
/// motion (x, y) whirls as the tilts do.
struct ProbedStation {
  Point point;
  double face_radius = 0.0;  ///< r of axial probes [m]; 0: they look across the shaft
  std::string name;          ///< names of its probes, joined by " + "
  std::vector<int> probes;   ///< numbers from 0
  /// (x, y) = to_plane * readings, by least squares for more than two probes. For probes along one
  /// line, (x, y) is the motion along that line.
  Mat to_plane;
  bool is_planar = false;  ///< whether the probes see one direction only
};

/// Stations of probes, in the order of their first probes.
/// @throws ModelError  for a probe at a station that there is not
std::vector<ProbedStation> probed_stations(const std::vector<Probe>& probes,
                                           const Assembler& assembler);

/// Motion of the stations of probes along a record; group /record.
struct StationRecord {
  Vec time;                             ///< of the samples [s]
  std::vector<StationMotion> stations;  ///< named by their probes
  std::vector<double> turns;            ///< times of the key-phasor, one a revolution [s]

  static constexpr std::string_view group = "/record";
  static constexpr auto columns() {
    using S = StationRecord;
    return ColumnList{
        column("time", &S::time, "s", "time of the samples").axis("samples+").within(valid::finite),
        rows(&S::stations, "stations+"),
        column("turn_time", &S::turns, "s", "times of the key-phasor, one a revolution")
            .along("turns")
            .within(valid::finite)
            .maybe()};
  }
};
StationRecord station_record(const ProbeReadings& readings, const Assembler& assembler);

}  // namespace whirl::inline data
