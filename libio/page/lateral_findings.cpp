#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/findings.hpp"
#include "libio/text/format.hpp"
#include "libio/texts/lateral_text.hpp"

namespace whirl::inline io {

namespace {

using figures::result_of;

/// How many checks of a rule came out how.
struct Tally {
  int passed = 0, failed = 0, unknown = 0;

  void add(Verdict v) {
    ++(v == Verdict::passed ? passed : v == Verdict::failed ? failed : unknown);
  }
  int all() const { return passed + failed + unknown; }
  const char* verdict() const {
    if (failed > 0) return "FAILED";
    if (unknown == 0) return "passed";
    return passed > 0 ? "passed in part" : "not checked";
  }
};

FigureTable rules_table(const LateralReport& r) {
  FigureTable table{.header = {"rule", "checks", "passed", "failed", "not checked", "verdict"}};
  for (const LateralRule rule : rules_of(r)) {
    Tally tally;
    for (const LateralCheck& c : r.checks) {
      if (c.rule == rule) tally.add(c.verdict);
    }
    table.rows.push_back({std::string(name_of(rule)), std::to_string(tally.all()),
                          std::to_string(tally.passed), std::to_string(tally.failed),
                          std::to_string(tally.unknown), tally.verdict()});
  }
  return table;
}

/// Every check, those of all cases, with what each rule says below.
Sheet checks_sheet(const LateralReport& r) {
  Sheet sheet{"All checks of all cases", {.header = check_header()}};
  const VibrationUnit unit = vibration_unit(r);
  for (const LateralCheck& c : r.checks) sheet.table.rows.push_back(check_cells(c, unit));
  for (const std::string& remark : remarks_on(r)) sheet.notes.push_back(remark);
  for (const LateralRule rule : rules_of(r)) {
    sheet.notes.push_back(fmt::format("{}: {}.", name_of(rule), rule_text(rule)));
  }
  return sheet;
}

Sheet planes_sheet(const LateralReport& r) {
  const auto mode = [&](const LateralPlane& p) -> const LateralCase& {
    return r.cases[static_cast<std::size_t>(p.of_case)];
  };
  return {
      "Cases of unbalance: twice 6350 W / N at antinodes of modes and overhung ends",
      sheet_table(
          r.planes,
          {{"case", [&](const LateralPlane& p) { return case_with_shaft(r, p.of_case); }},
           {"placed at",
            [=](const LateralPlane& p) { return std::string(name_of(mode(p).places)); }},
           {shown_heading("mode at", "rpm"),
            [=](const LateralPlane& p) { return rpm_text(mode(p).mode_speed); }},
           {"whirl", [=](const LateralPlane& p) { return std::string(name_of(mode(p).whirl)); }},
           shown("station").as("unbalance at"),
           shown("moment", "g.mm", ".1f").as("unbalance"),
           {"phase [deg]",
            [](const LateralPlane& p) { return fmt::format("{:.0f}", p.phase / degree); }}})};
}

Sheet vibration_sheet(const LateralReport& r) {
  const VibrationUnit unit = vibration_unit(r);
  const auto vibration = [=](double value) {
    return texts::number_text(unit.factor * value, unit.factor < 1e6 ? ".3f" : ".2f");
  };
  Sheet sheet{
      "Largest vibration at probes from minimum to maximum speed, case by case",
      sheet_table(
          r.cases,
          {{"case", [&](const LateralCase&, int number) { return case_with_shaft(r, number - 1); }},
           {"probe",
            [&](const LateralCase& c) {
              return r.probes[static_cast<std::size_t>(c.probe)].station;
            }},
           {shown_heading("at", "rpm"),
            [](const LateralCase& c) { return rpm_text(c.vibration_speed); }},
           {fmt::format("peak to peak [{}]", unit.name),
            [=](const LateralCase& c) { return vibration(c.vibration); }},
           {fmt::format("allowed [{}]", unit.name),
            [&](const LateralCase&, int number) {
              return vibration(allowed_vibration(r, number - 1));
            }},
           {"scaling for clearances",
            [](const LateralCase& c) { return texts::number_text(c.scaling, ".3g"); }}})};
  return sheet;
}

/// Peaks with their margins, which files do not hold.
std::vector<LateralPeak> peaks_of(const LateralReport& r) {
  const OperatingRange range{r.minimum_speed, r.maximum_speed, r.trip_speed};
  std::vector<LateralPeak> peaks = r.peaks;
  for (LateralPeak& p : peaks) p.margin = separation_margin(p, range);
  return peaks;
}

Sheet peaks_sheet(const LateralReport& r) {
  const VibrationUnit unit = vibration_unit(r);
  return {
      "Peaks of the vibration at probes",
      sheet_table(
          peaks_of(r),
          {{"case", [&](const LateralPeak& p) { return case_with_shaft(r, p.of_case); }},
           {shown_heading("peak", "rpm"), [](const LateralPeak& p) { return rpm_text(p.speed); }},
           {"probe",
            [&](const LateralPeak& p) {
              return r.probes[static_cast<std::size_t>(p.row)].station;
            }},
           {fmt::format("peak to peak [{}]", unit.name),
            [=](const LateralPeak& p) {
              return texts::number_text(2.0 * unit.factor * p.amplitude,
                                        unit.factor < 1e6 ? ".4f" : ".2f");
            }},
           {"amplification factor",
            [](const LateralPeak& p) { return texts::number_text(p.amplification(), ".2f"); }},
           {"is", [](const LateralPeak& p) { return std::string(name_of(p.kind())); }},
           {"margin", [](const LateralPeak& p) { return percent_text(p.margin.actual); }},
           {"required", [](const LateralPeak& p) {
              return p.margin.required == 0.0 ? "none" : percent_text(p.margin.required);
            }}})};
}

Sheet scaled_clearances_sheet(const LateralReport& r) {
  return {"Running clearances beside the scaled response up to the trip speed",
          sheet_table(
              r.clearances,
              {{"case", [&](const LateralClearance& c) { return case_with_shaft(r, c.of_case); }},
               shown("name").as("clearance of"),
               shown("left", "mm", ".4f").as("beside the rotor at rest"),
               shown("largest", "mm", ".4f").as("scaled response"),
               {shown_heading("at", "rpm"),
                [](const LateralClearance& c) { return rpm_text(c.speed); }},
               {"share", [](const LateralClearance& c) {
                  return std::isfinite(c.share()) ? fmt::format("{:.1f} %", 100.0 * c.share())
                                                  : std::string("touches at rest");
                }}})};
}

Sheet stability_sheet(const LateralReport& r) {
  FigureTable table{.header = {"stability, level I", "value"}};
  const auto add = [&](const char* what, const std::string& value) {
    table.rows.push_back({what, value});
  };
  const auto stiffness = [](double Q) {
    return std::isfinite(Q) ? format_engineering(Q, "N/m") : std::string("-");
  };
  add("cross-coupled stiffness acts at", r.coupled_station);
  add("cross-coupled stiffness to be expected, QA",
      std::isfinite(r.anticipated) ? stiffness(r.anticipated) : "not given");
  add("cross-coupled stiffness that the rotor bears, Q0",
      std::isfinite(r.limit) ? stiffness(r.limit) : "no limit was found");
  add("least logarithmic decrement", texts::number_text(r.log_decrement, ".4f"));
  add("first critical speed on rigid supports", speed_text(r.rigid_critical_speed));
  add("critical speed ratio", texts::number_text(r.critical_speed_ratio(), ".3f"));
  add("average gas density",
      std::isfinite(r.gas_density) ? format_engineering(r.gas_density, "kg/m^3") : "not given");
  add("region of the screening", r.region() ? std::string(name_of(*r.region())) : "not known");
  return {"Stability", table};
}

/// Level I of every state, where the model has variants or several shafts.
Sheet states_sheet(const LateralParts& parts) {
  return {
      parts.shafts.empty()
          ? "Stability, level I, state by state; the table above has the worst"
          : "Stability, level I, shaft by shaft; the table above has the worst state of the one "
            "with the cross-coupled stiffness",
      sheet_table(parts.level_one,
                  {{"state", [](const LevelOneState& s) { return state_name(s.variant, s.shaft); }},
                   shown("log_decrement", "", ".4f"),
                   {"bears Q0 of", [](const LevelOneState& s) {
                      return s.limit == 0.0           ? std::string("0, unstable")
                             : std::isfinite(s.limit) ? format_engineering(s.limit, "N/m")
                                                      : std::string("any");
                    }}})};
}

Sheet level_two_sheet(const LateralParts& parts) {
  return {"Stability, level II: seals put in one by one, each with those before it",
          sheet_table(parts.level_two, {{"the rotor",
                                         [](const LevelTwoStep& s) {
                                           if (s.variant.empty() && s.shaft.empty()) return s.parts;
                                           return state_name(s.variant, s.shaft) + ": " + s.parts;
                                         }},
                                        shown("log_decrement", "", ".4f"),
                                        shown("frequency", "rpm", ".1f").as("of the mode at")})};
}

/// Shafts of a machine that has several.
Sheet shafts_sheet(const LateralReport& r, const LateralParts& parts) {
  const VibrationUnit unit = vibration_unit(r);
  Sheet sheet{"Shafts by their own speeds",
              sheet_table(parts.shafts,
                          {{"shaft", [](const LateralShaft& s) { return shaft_text(s.name); }},
                           shown("ratio", "", ".6g"),
                           {shown_heading("from", "rpm"),
                            [](const LateralShaft& s) { return rpm_text(s.minimum_speed); }},
                           {shown_heading("to", "rpm"),
                            [](const LateralShaft& s) { return rpm_text(s.maximum_speed); }},
                           {shown_heading("trip", "rpm"),
                            [](const LateralShaft& s) { return rpm_text(s.trip_speed); }},
                           {fmt::format("allowed vibration [{}]", unit.name),
                            [=](const LateralShaft& s) {
                              return texts::number_text(unit.factor * s.vibration_limit,
                                                        unit.factor < 1e6 ? ".3f" : ".1f");
                            }},
                           {shown_heading("critical on rigid supports", "rpm"),
                            [](const LateralShaft& s) { return rpm_text(s.rigid_critical_speed); }},
                           shown("coupled_station").as("cross-coupled stiffness at")})};
  sheet.notes.emplace_back(
      "All other speeds of this report are those of the first shaft; margins are the same by "
      "both.");
  return sheet;
}

Sheet forces_sheet(const LateralReport& r, const LateralParts& parts) {
  return {
      "Largest forces of the unbalance on supports up to the trip speed",
      sheet_table(parts.forces,
                  {{"case", [&](const LateralForce& f) { return case_with_shaft(r, f.of_case); }},
                   shown("kind"),
                   shown("name").as("support"),
                   shown("force", "N", ".4g"),
                   shown("speed", "rpm", ".1f").as("at")})};
}

/// The conditions under which the machine runs.
std::string conditions(const LateralReport& r) {
  const VibrationUnit unit = vibration_unit(r);
  return fmt::format(
      "Conditions: {} to {} continuously, trip at {}; allowed vibration {} {} "
      "peak to peak; {} cases of unbalance at {} probes.",
      speed_text(r.minimum_speed), speed_text(r.maximum_speed), speed_text(r.trip_speed),
      texts::number_text(unit.factor * r.vibration_limit, unit.factor < 1e6 ? ".3f" : ".1f"),
      unit.name, r.cases.size(), r.probes.size());
}

}  // namespace

Findings lateral_findings(const ResultView& result) {
  const auto& r = result_of<LateralReport>(result);
  Tally tally;
  for (const LateralCheck& c : r.checks) tally.add(c.verdict);
  Findings f;
  if (tally.failed > 0) {
    f.standing = Standing::failed;
    f.headline = fmt::format("FAILED: {} of {} checks", tally.failed, tally.all());
  } else if (tally.unknown > 0 || tally.all() == 0) {
    f.standing = Standing::open;
    f.headline = fmt::format("Not complete: {} of {} checks passed, {} could not be made",
                             tally.passed, tally.all(), tally.unknown);
  } else {
    f.standing = Standing::passed;
    f.headline = fmt::format("PASSED: all {} checks", tally.all());
  }
  f.sentences.push_back("Lateral analysis after API 617 and API 684. " + verdict_text(r) + ".");
  f.sentences.push_back(conditions(r));
  for (const Threshold& t : result_of<Campbell>(result).thresholds) {
    f.sentences.push_back(fmt::format("Threshold of instability: {}, whirling at {}.",
                                      speed_text(t.speed), speed_text(t.frequency)));
  }
  f.summary = rules_table(r);
  f.first.push_back(checks_sheet(r));
  const auto& parts = result_of<LateralParts>(result);
  if (!parts.shafts.empty()) f.sheets.push_back(shafts_sheet(r, parts));
  f.sheets.push_back(planes_sheet(r));
  f.sheets.push_back(vibration_sheet(r));
  if (!r.peaks.empty()) f.sheets.push_back(peaks_sheet(r));
  if (!r.clearances.empty()) f.sheets.push_back(scaled_clearances_sheet(r));
  f.sheets.push_back(stability_sheet(r));
  if (!parts.level_one.empty()) f.sheets.push_back(states_sheet(parts));
  if (!parts.level_two.empty()) f.sheets.push_back(level_two_sheet(parts));
  if (!parts.forces.empty()) f.sheets.push_back(forces_sheet(r, parts));
  for (const auto& sheets : {critical_sheets(result), rest_sheets(result)}) {
    f.sheets.insert(f.sheets.end(), sheets.begin(), sheets.end());
  }
  return f;
}

}  // namespace whirl::inline io
