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

/// Name of a state of the machine: "the model itself", or that of a variant.
inline std::string state_name(const std::string& variant) {
  return variant.empty() ? "the model itself" : variant;
}

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
