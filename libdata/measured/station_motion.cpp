#include "libdata/measured/station_motion.hpp"

#include <algorithm>
#include <cmath>

namespace whirl::inline data {

namespace {

constexpr double parallel = 0.1;  ///< sine of an angle below which two probes see one direction

/// Directions of probes as rows.
Mat directions_of(const std::vector<int>& numbers, const std::vector<Probe>& probes) {
  Mat n(std::ssize(numbers), 2);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double a = probes[static_cast<std::size_t>(numbers[i])].angle;
    n.row(static_cast<Eigen::Index>(i)) << std::cos(a), std::sin(a);
  }
  return n;
}

}  // namespace

std::vector<ProbedStation> probed_stations(const std::vector<Probe>& probes,
                                           const Assembler& assembler) {
  std::vector<ProbedStation> stations;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Point point = assembler.point(probes[i].at);
    const double radius = probes[i].face_radius;
    auto found = std::find_if(stations.begin(), stations.end(), [&](const ProbedStation& s) {
      return s.point == point && s.face_radius == radius;
    });
    if (found == stations.end()) {
      found = stations.insert(stations.end(), ProbedStation{point, radius});
    }
    found->name += (found->name.empty() ? "" : " + ") + probes[i].name;
    found->probes.push_back(static_cast<int>(i));
  }
  for (ProbedStation& s : stations) {
    const Mat n = directions_of(s.probes, probes);
    double widest = 0.0;
    for (Eigen::Index i = 1; i < n.rows(); ++i) {
      widest = std::max(widest, std::abs(n(0, 0) * n(i, 1) - n(0, 1) * n(i, 0)));
    }
    s.is_planar = widest < parallel;
    if (s.is_planar) {
      // along the first; a probe opposite to it reads the other way round
      const Vec along = n * n.row(0).transpose();
      s.to_plane = n.row(0).transpose() * along.transpose() / along.squaredNorm();
    } else {
      const Mat2 square = n.transpose() * n;
      Mat2 adjugate;
      adjugate << square(1, 1), -square(0, 1), -square(1, 0), square(0, 0);
      s.to_plane =
          adjugate * n.transpose() / (square(0, 0) * square(1, 1) - square(0, 1) * square(1, 0));
    }
  }
  return stations;
}

StationRecord station_record(const ProbeReadings& readings, const Assembler& assembler) {
  StationRecord record;
  const Eigen::Index n = readings.displacement.rows();
  record.time.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) record.time(j) = readings.time(j);
  for (const ProbedStation& s : probed_stations(readings.probes, assembler)) {
    StationMotion motion{s.name, Vec::Zero(n), Vec::Zero(n)};
    for (std::size_t i = 0; i < s.probes.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      motion.x += s.to_plane(0, column) * readings.displacement.col(s.probes[i]);
      motion.y += s.to_plane(1, column) * readings.displacement.col(s.probes[i]);
    }
    record.stations.push_back(std::move(motion));
  }
  if (readings.clock) record.turns = readings.clock->turns();
  return record;
}

}  // namespace whirl::inline data
