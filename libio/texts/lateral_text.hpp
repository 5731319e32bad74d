#pragma once
/// The report of a lateral analysis for people.

#include <string>
#include <vector>

#include "libdyn/linear/lateral_report.hpp"

namespace whirl::inline io {

/// The unit that people are told vibration in: the unit of the model's probes.
struct VibrationUnit {
  std::string name = "um";
  double factor = 1e6;  ///< of a length in SI
};
/// @throws FileError  for a report of a file, if the unit is no length
VibrationUnit vibration_unit(const LateralReport& report);

/// A shaft of a machine that has several, as its rows name it: "first shaft", "hp"; empty: of one
/// that has one.
inline std::string shaft_text(const std::string& shaft) {
  return shaft == "shaft" ? "first shaft" : shaft;
}

/// Name of a state of the machine: "the model itself", that of a variant, of a shaft or of both.
inline std::string state_name(const std::string& variant, const std::string& shaft = "") {
  if (shaft.empty()) return variant.empty() ? "the model itself" : variant;
  return variant.empty() ? shaft_text(shaft) : variant + ", " + shaft_text(shaft);
}

/// Number of a case from 1, of a machine with several shafts with that of its unbalance: "3 (hp)".
std::string case_with_shaft(const LateralReport& report, int of_case);

/// Vibration that is allowed at the probe where a case has most of it [m].
double allowed_vibration(const LateralReport& report, int of_case);

/// The own speed of the shaft of a case where the first one has a speed [rad/s].
std::string own_speed_text(const LateralReport& report, int of_case, double speed);

/// Cells of the table of passes and failures, with its header.
std::vector<std::string> check_header();
std::vector<std::string> check_cells(const LateralCheck& check, const VibrationUnit& unit);

/// What a rule says, and where it stands: "17 (1 - 1 / (AF - 1.5)) % ... [API 617]".
std::string rule_text(LateralRule rule);
/// The same in a cell of a table: "17 (1 - 1 / (AF - 1.5)) %".
std::string short_rule_text(LateralRule rule, const VibrationUnit& unit);
/// What a reader has to know of amplification factors: which are estimated, and which peaks are no
/// critical speeds.
std::vector<std::string> remarks_on(const LateralReport& report);
/// The rules that a report was checked by, each once.
std::vector<LateralRule> rules_of(const LateralReport& report);

/// "9 of 12 checks passed, 2 failed, 1 unknown"
std::string verdict_text(const LateralReport& report);

/// The whole report.
std::string text_of(const LateralStudy& study);

}  // namespace whirl::inline io
