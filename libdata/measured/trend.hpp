#pragma once
/// Trends: what probes read overall, of the speed, and on the average, along a record or from
/// record to record.

#include <optional>
#include <string>
#include <vector>

#include "libdata/measured/probe_readings.hpp"
#include "libdyn/system/probes.hpp"

namespace whirl::inline data {

/// What a probe reads along a trend.
struct TrendCurve : ProbeLabel {
  Vec gap;       ///< mean reading, per point [m]
  Vec overall;   ///< peak to peak of all that it reads, per point [m]
  CVec first;    ///< of the speed, reading = Re(first e^(i angle)), per point [m]
  Vec velocity;  ///< root of the mean square, of frequencies from 10 Hz (2 Hz below 600 rpm) to
                 ///< 1000 Hz, per point [m/s]

  static constexpr auto columns() {
    using T = TrendCurve;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("gap", &T::gap, "m", "mean reading").along("trend"),
            column("overall", &T::overall, "m", "peak to peak of the reading").along("trend"),
            column("first", &T::first, "m",
                   "complex reading of 1X, reading = Re(first e^(i angle)), angle of the rotor")
                .along("trend"),
            column("velocity", &T::velocity, "m/s",
                   "root of the mean square of the velocity, 10 to 1000 Hz")
                .along("trend")});
  }
};

/// A trend of all probes; group /trend.
struct Trend {
  std::vector<double> number;        ///< of the points, from 1
  Vec time;                          ///< middles of the points [s]; NaN of several records
  Vec speed;                         ///< [rad/s]
  std::vector<std::string> records;  ///< names; empty: points of one record
  std::vector<TrendCurve> probes;
  std::optional<double> alarm{}, trip{};  ///< limits of the overall reading, peak to peak [m]

  static constexpr std::string_view group = "/trend";
  static constexpr auto columns() {
    using T = Trend;
    return ColumnList{
        column("number", &T::number, "", "number of a point").axis("trend+"),
        column("time", &T::time, "s", "time of a point of one record").along("trend"),
        column("speed", &T::speed, "rad/s", "speed of the rotor").along("trend"),
        column("record", &T::records, "", "the record of a point, of several")
            .along("trend")
            .maybe(),
        rows(&T::probes, "trend_probes+").prefixed("probe_"),
        column("alarm", &T::alarm, "m", "limit of the overall reading, peak to peak").maybe(),
        column("trip", &T::trip, "m", "limit of the overall reading, peak to peak").maybe()};
  }
};

struct TrendOptions {
  double revolutions = 8.0;  ///< of a point
  std::size_t most = 400;    ///< points
  double speed = 0.0;        ///< of the rotor where there is no key-phasor [rad/s]
};

/// The trend of a record: points of some revolutions each, one after the other.
///
/// Overall readings are the largest less the smallest sample of a point, unfiltered; 1X is fitted
/// as track_orders does, the velocity follows from the spectrum under a Hann window.
///
/// @throws OptionError  for a record of fewer revolutions than a point has, and for a rotor without
///                      speed
Trend trend_of(const ProbeReadings& readings, const TrendOptions& options);

/// One point for each record: medians of the points of its trend, the mean of 1X.
/// @param names  of the records
/// @throws OptionError  for records whose probes differ
Trend trend_of_records(const std::vector<Trend>& records, const std::vector<std::string>& names);

}  // namespace whirl::inline data
