#pragma once
/// What lines above a table say: how fast it was sampled, from when, and in which units.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/measured/csv_header.hpp"

namespace whirl::inline io {

struct CsvSettings {
  std::optional<double> rate{};  ///< [1/s]
  std::string doubt{};      ///< why the rate that a line says may be another; then there is none
  double start = 0.0;       ///< [s]
  std::string time_unit{};  ///< of "Horizontal Units"
  std::vector<std::string> units{};  ///< of "Vertical Units", one for all channels or one of each
  std::optional<double> length{};    ///< samples, as "Record Length" says
  std::vector<std::string> notes{};
};

/// Whether a line is a setting that is known: "Sample rate: 5 kHz", "Sample Interval,1e-05",
/// "X0=0".
bool is_csv_setting(std::string_view line);

/// Reads the lines above the numbers.
///
///   rate    "Sample rate: 5 kHz", "fs = 5000", "Sampling rate [kHz];5"
///   step    "Sample Interval,1e-05", "Delta_X 0.001", "dt: 0.2 ms"
///   start   "X0: 0.5", "XZERO,-1e-3"
///   units   "Horizontal Units,s", "Vertical Units,V"
///
/// A rate or a step without unit that nobody records with in seconds is doubtful.
///
/// @throws ModelError  for a unit that is none of rates or times, for marks of thousands, and for a
///                     rate and a step that contradict each other
CsvSettings csv_settings(const std::vector<CsvLine>& lines, const std::string& file);

}  // namespace whirl::inline io
