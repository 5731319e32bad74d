#pragma once
/// The steady response to unbalance over a value of the model.

#include <functional>
#include <vector>

#include "libdyn/linear/model_at.hpp"
#include "libdyn/linear/unbalance_study.hpp"

namespace whirl::inline dyn {

/// The response of a station over the values; NaN where nothing can be computed.
struct UnbalanceOverStation {
  std::string station;
  Vec largest;        ///< major semi-axis over all speeds, per value [m]
  Vec largest_speed;  ///< speed of the largest one [rad/s]
  Vec at_operation;   ///< major semi-axis at the operating speed, NaN without one [m]

  static constexpr auto columns() {
    using S = UnbalanceOverStation;
    return ColumnList{
        column("station", &S::station, "", "station").axis(),
        column("largest", &S::largest, "m", "largest major semi-axis").along("values"),
        column("largest_speed", &S::largest_speed, "rad/s", "speed of the largest one")
            .along("values"),
        column("at_operation", &S::at_operation, "m", "major semi-axis at the operating speed")
            .along("values")};
  }
};

/// The reading of a probe over the values; NaN where nothing can be computed.
struct UnbalanceOverProbe : ProbeLabel {
  Vec largest;        ///< reading over all speeds, peak to peak, per value [m]
  Vec largest_speed;  ///< speed of the largest one [rad/s]
  Vec at_operation;   ///< reading at the operating speed, peak to peak [m]

  static constexpr auto columns() {
    using P = UnbalanceOverProbe;
    return joined(
        ProbeLabel::columns(),
        ColumnList{
            column("largest", &P::largest, "m", "largest reading, peak to peak").along("values"),
            column("largest_speed", &P::largest_speed, "rad/s", "speed of the largest one")
                .along("values"),
            column("at_operation", &P::at_operation, "m",
                   "reading at the operating speed, peak to peak")
                .along("values")});
  }
};

/// A peak of the largest response of all stations, at one of the values.
struct UnbalanceOverPeak : StationPeak {
  double value = 0.0;  ///< of the parameter [SI]

  static constexpr auto columns() {
    using P = UnbalanceOverPeak;
    return ColumnList{
        column("value", &P::value, unit_of_parameter, "of the parameter"),
        column("speed", &P::speed, "rad/s", "speed of a peak"),
        column("amplitude", &P::amplitude, "m", "major semi-axis there"),
        column("amplification", &P::amplification, "", "factor"),
        column("margin", &P::margin, "", "to the operating speed").only(Written::in_json),
        column("required_margin", &P::required_margin, "", "[API617]").only(Written::in_json)};
  }
};

/// Responses over a value; group /unbalance_over.
struct UnbalanceOver : OverValues {
  std::vector<UnbalanceOverStation> stations;
  std::vector<UnbalanceOverProbe> probes;
  std::vector<UnbalanceOverPeak> peaks;  ///< value by value
  std::vector<ValueGap> gaps;

  static constexpr std::string_view group = "/unbalance_over";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    using U = UnbalanceOver;
    using enum Written;
    return joined(OverValues::columns(),
                  ColumnList{rows(&U::stations, "stations+"),
                             rows(&U::probes, "probes").prefixed("probe_").maybe().only(in_file),
                             rows(&U::probes, "probes").maybe().only(in_json),
                             rows(&U::peaks, "peaks").prefixed("peak_").maybe(),
                             rows(&U::gaps, "gaps").maybe().only(in_json)});
  }
};

/// What the response is computed with, at every value.
struct UnbalanceOverOptions {
  /// Speeds of a model, ascending; only their range counts, see response_curve [rad/s].
  std::function<std::vector<double>(const Model&)> speeds;
  std::string stations;  ///< as select_points
};

/// Responses at values; a value whose response cannot be computed becomes a gap.
/// @param values  ascending, one at least [SI]
/// @throws NumericalError, ModelError  if the first model has no such stations, or no value can be
///                                     computed
UnbalanceOver unbalance_over(const ModelAt& model_at, ParameterName parameter,
                             const std::vector<double>& values,
                             const UnbalanceOverOptions& options);

}  // namespace whirl::inline dyn
