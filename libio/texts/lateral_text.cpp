#include "libio/texts/lateral_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"
#include "libio/text/units.hpp"
#include "libio/texts/modes_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// A number of a check in the unit that people use for its rule.
/// @param unit  of vibration
std::string amount_text(LateralRule rule, double value, const VibrationUnit& unit = {}) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0.0 ? "∞" : "-∞";
  switch (rule) {
    case LateralRule::separation_margin:
    case LateralRule::running_clearance:
      return fmt::format("{:.1f} %", 100.0 * value);
    case LateralRule::vibration:
      return fmt::format("{:.{}f} {}", unit.factor * value, unit.factor < 1e6 ? 3 : 1, unit.name);
    case LateralRule::log_decrement:
      return fmt::format("{:.3f}", value);
    case LateralRule::level_two:
      return fmt::format("{:.3f}", value);
    case LateralRule::coupling_ratio:
    case LateralRule::stability_region:
      break;
  }
  return fmt::format("{:.2f}", value);
}

/// "≥", at least, or "≤", at most.
const char* sense_of(LateralRule rule) {
  const bool is_most = rule == LateralRule::vibration || rule == LateralRule::running_clearance;
  return is_most ? "≤" : "≥";
}

/// "≥ 8.9 %"; of a peak that needs no margin, "none".
std::string limit_text(const LateralCheck& c, const VibrationUnit& unit) {
  if (!std::isfinite(c.limit)) return "-";
  if (c.rule == LateralRule::separation_margin && c.limit == 0.0) return "none";
  return fmt::format("{} {}", sense_of(c.rule), amount_text(c.rule, c.limit, unit));
}

/// Where the rotor and its gas are in the screening of level I.
std::string region_text(const LateralReport& r) {
  if (!std::isfinite(r.rigid_critical_speed)) return "";
  const std::string ratio = fmt::format(
      "\n  Critical speed ratio {:.2f}: {} over {}, the first critical speed on rigid supports",
      r.critical_speed_ratio(), shown_value(r.maximum_speed, "rpm", ".0f"),
      shown_value(r.rigid_critical_speed, "rpm", ".1f"));
  const auto region = r.region();
  if (!region) return ratio + ".\n";
  return fmt::format("{}; with {:.3g} kg/m^3 of gas in region {}, where it may be {:.2f}.\n", ratio,
                     r.gas_density, name_of(*region), largest_speed_ratio(r.gas_density));
}

std::string decrement_text(double log_decrement) {
  if (std::isfinite(log_decrement) || std::isnan(log_decrement)) {
    return "logarithmic decrement " + texts::number_text(log_decrement, ".4f");
  }
  return log_decrement > 0.0 ? "no mode oscillates" : "the rotor leaves its place without a whirl";
}

/// Level I of the model and its variants, and of each shaft, where there are any.
std::string level_one_text(const LateralParts& parts) {
  if (parts.level_one.empty()) return "";
  const char* what = parts.shafts.empty()
                         ? "state by state; what is told above is that of the worst"
                         : "shaft by shaft; what is told above is that of the worst state of the "
                           "shaft with the stiffness";
  return fmt::format("\nLevel I, {}\n\n", what) +
         table_of(parts.level_one,
                  {{"state", [](const LevelOneState& s) { return state_name(s.variant, s.shaft); }},
                   shown("log_decrement", "", ".4f"),
                   {"bears Q0 of", [](const LevelOneState& s) {
                      return s.limit == 0.0           ? "0, unstable"
                             : std::isfinite(s.limit) ? format_engineering(s.limit, "N/m")
                                                      : "any";
                    }}});
}

std::string coupling_text(const LateralReport& r) {
  const std::string limit =
      r.limit == 0.0           ? "a mode grows without any: the rotor is unstable, Q0 is 0"
      : std::isfinite(r.limit) ? fmt::format("the rotor bears {} there before it whirls by itself",
                                             format_engineering(r.limit, "N/m"))
                               : "no cross-coupled stiffness there makes the rotor whirl by itself";
  const std::string told = r.anticipated > 0.0
                               ? fmt::format("with the {} that are to be expected",
                                             format_engineering(r.anticipated, "N/m"))
                               : "without any cross-coupled stiffness beside that of the model";
  return fmt::format("\n  Stability at {}, level I, cross-coupled stiffness at {}:\n  {} {}; {}.\n",
                     shown_value(r.maximum_speed, "rpm", ".0f"), r.coupled_station,
                     decrement_text(r.log_decrement), told, limit);
}

/// By which sides of a peak its amplification factor is known.
std::string sides_text(const LateralPeak& p) {
  if (p.is_one_sided()) return "one side";
  return p.sides == PeakSides::both ? "both sides" : "-";
}

std::string case_text(const LateralReport& r, int of_case) {
  const LateralCase& c = r.cases[static_cast<std::size_t>(of_case)];
  return c.variant.empty() && c.shaft.empty()
             ? std::to_string(of_case + 1)
             : fmt::format("{} ({})", of_case + 1, state_name(c.variant, c.shaft));
}

bool has_several_shafts(const LateralReport& r) {
  return !r.cases.empty() && !r.cases.front().shaft.empty();
}

/// The shafts of a machine that has several; all other speeds are those of the first one.
std::string shafts_text(const LateralReport& r, const LateralParts& parts) {
  if (parts.shafts.empty()) return "";
  const VibrationUnit unit = vibration_unit(r);
  return "\nShafts by their own speeds; all other speeds are those of the first shaft, but where "
         "they are called own\n\n" +
         table_of(parts.shafts,
                  {{"shaft", [](const LateralShaft& s) { return shaft_text(s.name); }},
                   shown("ratio", "", ".6g"),
                   shown("minimum_speed", "rpm", ".0f").as("from"),
                   shown("maximum_speed", "rpm", ".0f").as("to"),
                   shown("trip_speed", "rpm", ".0f").as("trip"),
                   {"vibration [" + unit.name + "]",
                    [=](const LateralShaft& s) {
                      return fmt::format("{:.{}f}", unit.factor * s.vibration_limit,
                                         unit.factor < 1e6 ? 3 : 1);
                    }},
                   shown("rigid_critical_speed", "rpm", ".1f").as("on rigid supports"),
                   shown("coupled_station").as("Q acts at")});
}

std::string cases_text(const LateralReport& r) {
  const auto of = [&](const LateralPlane& p) -> const LateralCase& {
    return r.cases[static_cast<std::size_t>(p.of_case)];
  };
  TableColumns<LateralPlane> columns{
      {"case", [&](const LateralPlane& p) { return case_text(r, p.of_case); }},
      {"placed at", [&](const LateralPlane& p) { return std::string(name_of(of(p).places)); }},
      {shown_heading("for the mode at", "rpm"),
       [&](const LateralPlane& p) { return shown_number(of(p).mode_speed, "rpm", ".1f"); }},
      shown("station").as("unbalance at"),
      shown("moment", "g.mm", ".1f").as("unbalance"),
      {"phase [deg]",
       [](const LateralPlane& p) { return fmt::format("{:.0f}", p.phase / degree); }}};
  if (has_several_shafts(r)) {
    columns.insert(columns.begin() + 3, {shown_heading("own", "rpm"), [&](const LateralPlane& p) {
                                           return own_speed_text(r, p.of_case, of(p).mode_speed);
                                         }});
  }
  return table_of(r.planes, columns);
}

std::string peaks_text(const LateralReport& r) {
  if (r.peaks.empty()) return "  The responses have no peaks.\n";
  const VibrationUnit unit = vibration_unit(r);
  TableColumns<LateralPeak> columns{
      {"case", [&](const LateralPeak& p) { return case_text(r, p.of_case); }},
      {shown_heading("peak", "rpm"),
       [](const LateralPeak& p) { return shown_number(p.speed, "rpm", ".1f"); }},
      {"probe",
       [&](const LateralPeak& p) { return r.probes[static_cast<std::size_t>(p.row)].station; }},
      {"peak to peak [" + unit.name + "]",
       [=](const LateralPeak& p) {
         return fmt::format("{:.{}f}", 2.0 * unit.factor * p.amplitude, unit.factor < 1e6 ? 4 : 2);
       }},
      {"amplification",
       [](const LateralPeak& p) { return texts::number_text(p.amplification(), ".2f"); }},
      {"from", [](const LateralPeak& p) { return sides_text(p); }},
      {"margin",
       [](const LateralPeak& p) {
         return amount_text(LateralRule::separation_margin, p.margin.actual);
       }},
      {"required", [](const LateralPeak& p) {
         if (p.margin.required == 0.0) return std::string("none");
         return amount_text(LateralRule::separation_margin, p.margin.required);
       }}};
  if (has_several_shafts(r)) {
    columns.insert(columns.begin() + 2, {shown_heading("own", "rpm"), [&](const LateralPeak& p) {
                                           return own_speed_text(r, p.of_case, p.speed);
                                         }});
  }
  return table_of(r.peaks, columns);
}

/// "minimum clearance: 5 seal", "hp: 5 seal".
std::string place_text(const LateralCheck& c) {
  const std::string place =
      c.missing.empty() ? c.place : fmt::format("not checked: {} not given", c.missing);
  if (c.variant.empty() && c.shaft.empty()) return place;
  return fmt::format("{}: {}", state_name(c.variant, c.shaft), place);
}

std::string forces_text(const LateralReport& r, const LateralParts& parts) {
  if (parts.forces.empty()) return "";
  return "\nForces of the unbalance on supports up to the trip speed\n\n" +
         table_of(parts.forces,
                  {{"case", [&](const LateralForce& f) { return case_text(r, f.of_case); }},
                   shown("name").as("support"),
                   shown("kind").as(""),
                   shown("force", "N", ".4g").as("largest"),
                   shown("speed", "rpm", ".1f").as("at")});
}

std::string level_two_text(const LateralParts& parts) {
  if (parts.level_two.empty()) return "";
  return "\nLevel II: logarithmic decrement at the maximum speed, seal by seal\n\n" +
         table_of(parts.level_two, {{"the rotor",
                                     [](const LevelTwoStep& s) {
                                       if (s.variant.empty() && s.shaft.empty()) return s.parts;
                                       return state_name(s.variant, s.shaft) + ": " + s.parts;
                                     }},
                                    shown("log_decrement", "", ".4f"),
                                    shown("frequency", "rpm", ".1f").as("of the mode at")});
}

}  // namespace

std::string case_with_shaft(const LateralReport& report, int of_case) {
  const std::string& shaft = report.cases[static_cast<std::size_t>(of_case)].shaft;
  return shaft.empty() ? std::to_string(of_case + 1)
                       : fmt::format("{} ({})", of_case + 1, shaft_text(shaft));
}

double allowed_vibration(const LateralReport& report, int of_case) {
  for (const LateralCheck& c : report.checks) {
    if (c.rule == LateralRule::vibration && c.of_case == of_case) return c.limit;
  }
  return report.vibration_limit;
}

std::string own_speed_text(const LateralReport& report, int of_case, double speed) {
  return shown_number(report.cases[static_cast<std::size_t>(of_case)].order * speed, "rpm", ".1f");
}

std::vector<std::string> check_header() {
  return {"rule", "case", "where", shown_heading("at", "rpm"), "found", "asked for", "verdict"};
}

VibrationUnit vibration_unit(const LateralReport& report) {
  if (report.vibration_unit.empty()) {
    const ShownUnit unit = shown_unit("um");
    return {unit.name, 1.0 / unit.size};
  }
  const auto one = parse_as("1 " + report.vibration_unit, "m");
  if (!one) throw FileError("the unit of vibration: " + one.problem);
  return {report.vibration_unit, 1.0 / *one};
}

std::vector<std::string> check_cells(const LateralCheck& c, const VibrationUnit& unit) {
  return {std::string(name_of(c.rule)),
          c.of_case < 0 ? "-" : std::to_string(c.of_case + 1),
          place_text(c),
          shown_number(c.speed, "rpm", ".0f"),
          amount_text(c.rule, c.found, unit),
          limit_text(c, unit),
          c.verdict == Verdict::failed ? "FAILED" : std::string(name_of(c.verdict))};
}

std::string rule_text(LateralRule rule) {
  switch (rule) {
    case LateralRule::separation_margin:
      return "17 (1 - 1 / (AF - 1.5)) %, at most 16 %, of the minimum speed below it; 10 % more, "
             "at most 26 %, of the maximum speed above it; none if the amplification factor is "
             "below 2.5 [API 617]";
    case LateralRule::vibration:
      return "the less of 25.4 um (1 mil) and 25.4 sqrt(12 000 / N) um, peak to peak at probes "
             "from "
             "minimum to maximum speed, N the maximum [rpm] [API 617]";
    case LateralRule::running_clearance:
      return "75 % of the running clearance up to the trip speed, with unbalance that brings the "
             "probes to the vibration limit, at most six times as much [API 617]";
    case LateralRule::log_decrement:
      return "0.1 at the maximum speed with the cross-coupled stiffness to be expected, level I "
             "[API 617]; of every mode up to that speed, and of each that grows";
    case LateralRule::coupling_ratio:
      return "cross-coupled stiffness that the rotor bears over that to be expected, Q0 / QA, "
             "level I [API 617]";
    case LateralRule::level_two:
      return "0.1 at the maximum speed with all seals of the model, whose coefficients stand for "
             "everything that may drive a whirl, level II [API 617]";
    case LateralRule::stability_region:
      break;
  }
  return "Q0 / QA of 2 in region A and of 10 in region B, else an analysis of level II; B is where "
         "the critical speed ratio is above 2.5 or 2.69 - 0.0115 rho, or the gas denser than 60 "
         "kg/m^3, rho the average density [API 617]";
}

std::string short_rule_text(LateralRule rule, const VibrationUnit& unit) {
  switch (rule) {
    case LateralRule::separation_margin:
      return "17 (1 - 1 / (AF - 1.5)) %";
    case LateralRule::vibration:
      return unit.name == "mil" ? "1 mil, sqrt(12 000 / N) mil"
                                : "25.4 um, 25.4 sqrt(12 000 / N) um";
    case LateralRule::running_clearance:
      return "75 %, scaled";
    case LateralRule::log_decrement:
      return "0.1 with QA, level I";
    case LateralRule::coupling_ratio:
      return "Q0 / QA of 2, level I";
    case LateralRule::level_two:
      return "0.1 with all seals, level II";
    case LateralRule::stability_region:
      break;
  }
  return "2, in region B 10, level I";
}

std::vector<std::string> remarks_on(const LateralReport& report) {
  std::vector<std::string> one_sided, damped;
  for (const LateralPeak& p : report.peaks) {
    const std::string speed = shown_value(p.speed, "rpm", ".0f");
    if (p.is_one_sided()) one_sided.push_back(speed);
    if (p.kind() == PeakKind::critically_damped) damped.push_back(speed);
  }
  std::vector<std::string> remarks;
  if (!one_sided.empty()) {
    remarks.push_back(
        fmt::format("Estimated: the amplification factor at {}, where 0.707 of the peak is reached "
                    "on one side only, "
                    "and the other is taken to be as far.",
                    fmt::join(one_sided, ", ")));
  }
  if (!damped.empty()) {
    remarks.push_back(fmt::format(
        "No critical speed: {}, critically damped, as the amplification factor is below {}.",
        fmt::join(damped, ", "), least_amplification));
  }
  return remarks;
}

std::vector<LateralRule> rules_of(const LateralReport& report) {
  std::vector<LateralRule> rules;
  for (const LateralCheck& c : report.checks) {
    if (std::find(rules.begin(), rules.end(), c.rule) == rules.end()) rules.push_back(c.rule);
  }
  return rules;
}

std::string verdict_text(const LateralReport& report) {
  const auto count = [&](Verdict v) {
    return std::count_if(report.checks.begin(), report.checks.end(),
                         [v](const LateralCheck& c) { return c.verdict == v; });
  };
  return fmt::format("{} of {} checks passed, {} failed, {} unknown", count(Verdict::passed),
                     report.checks.size(), count(Verdict::failed), count(Verdict::unknown));
}

std::string text_of(const LateralStudy& study) {
  const LateralReport& r = study.report;
  std::string text = fmt::format(
      "Lateral analysis after API 617 and API 684: {} to {}, trip at {}\n\n",
      shown_number(r.minimum_speed, "rpm", ".0f"), shown_value(r.maximum_speed, "rpm", ".0f"),
      shown_value(r.trip_speed, "rpm", ".0f"));
  TableColumns<LateralJournal> journal_columns{shown("name").as("journal"),
                                               shown("mass", "kg", ".2f").as("carries")};
  if (has_several_shafts(r)) {
    journal_columns.push_back({"of", [](const LateralJournal& j) { return shaft_text(j.shaft); }});
  }
  text += table_of(r.journals, journal_columns) + shafts_text(r, study.parts);
  text += "\n" + text_of(study.criticals);
  const auto is_of_variant = [](const LevelOneState& s) { return !s.variant.empty(); };
  if (std::ranges::any_of(study.parts.level_one, is_of_variant)) {
    text +=
        "\n  Critical speeds and the Campbell diagram are those of the model itself, without its "
        "variants.\n";
  }
  text +=
      "\nUnbalance, twice 6350 W / N, at antinodes of modes and overhung ends\n\n" + cases_text(r);
  text += "\nPeaks of the vibration at probes\n\n" + peaks_text(r);
  for (const Threshold& t : study.campbell.thresholds) {
    text += fmt::format("\n  threshold of instability: {}, whirling at {}\n",
                        shown_value(t.speed, "rpm", ".1f"), shown_value(t.frequency, "rpm", ".1f"));
  }
  text += forces_text(r, study.parts) + coupling_text(r) + level_one_text(study.parts) +
          region_text(r) + level_two_text(study.parts);
  Table checks(check_header());
  for (const LateralCheck& c : r.checks) checks.row(check_cells(c, vibration_unit(r)));
  text += fmt::format("\nChecks: {}\n\n{}\n", verdict_text(r), checks.text());
  for (const std::string& remark : remarks_on(r)) text += fmt::format("  {}\n", remark);
  for (const LateralRule rule : rules_of(r)) {
    text += fmt::format("  {}: {}\n", name_of(rule), rule_text(rule));
  }
  return text;
}

}  // namespace whirl::inline io
