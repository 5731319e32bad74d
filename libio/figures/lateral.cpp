#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/lateral_text.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// Minimum, maximum and trip speed across a figure over speed.
void add_speeds(const LateralReport& r, Figure& f, Panel& p) {
  const auto rule = [&](double speed, const char* name, Dash dash) {
    p.rules.push_back({Rule::Kind::vertical, speed / speed_unit().size, name, Paint::gray, dash});
  };
  rule(r.minimum_speed, "min", Dash::dashed);
  if (r.maximum_speed > r.minimum_speed) rule(r.maximum_speed, "max", Dash::dashed);
  if (r.trip_speed > r.maximum_speed) {
    rule(r.trip_speed, "", Dash::dotted);  // the name of the maximum is there
    f.notes.push_back(
        fmt::format("Dotted: trip speed, {}.", shown_value(r.trip_speed, "rpm", ".0f")));
  }
}

std::string case_name(int number) {
  return fmt::format("case {}", number + 1);
}

/// Speeds at which a peak of some amplification would be too near: an area around those of the
/// machine.
Curve forbidden_area(const LateralReport& r, double highest) {
  const OperatingRange range{r.minimum_speed, r.maximum_speed, r.trip_speed};
  constexpr double damped = least_amplification;
  constexpr int points = 60;
  Curve c{.name = "too near", .paint = Paint::alarm};
  c.width = 1.0;
  c.fill = 0.12;
  const auto peak = [](double speed, double AF) {
    return ResponsePeak{.speed = speed, .below = 0.0, .above = speed / AF};
  };
  for (int k = points; k >= 0; --k) {
    const double AF = damped + (highest - damped) * k / points;
    const double share = separation_margin(peak(0.5 * range.minimum, AF), range).required;
    c.x.push_back(range.minimum * (1.0 - share) / speed_unit().size);
    c.y.push_back(AF);
  }
  for (int k = 0; k <= points; ++k) {
    const double AF = damped + (highest - damped) * k / points;
    const double share = separation_margin(peak(2.0 * range.maximum, AF), range).required;
    c.x.push_back(range.maximum * (1.0 + share) / speed_unit().size);
    c.y.push_back(AF);
  }
  c.x.push_back(c.x.front());
  c.y.push_back(c.y.front());
  return c;
}

FigureTable check_table(const LateralReport& r) {
  FigureTable table{.header = check_header()};
  table.header.push_back("API 617");
  const VibrationUnit unit = vibration_unit(r);
  for (const LateralCheck& c : r.checks) {
    table.rows.push_back(check_cells(c, unit));
    table.rows.back().push_back(short_rule_text(c.rule, unit));
  }
  return table;
}

std::vector<Figure> lateral_figures(const ResultView& result) {
  const auto& r = result_of<LateralReport>(result);
  Figure f{.width = 960.0, .height = 340.0};
  f.subtitle = verdict_text(r);
  Panel p;
  p.x = {.title = shown_heading("speed", "rpm"),
         .first = r.speeds.front() / speed_unit().size,
         .last = r.speeds.back() / speed_unit().size};
  double highest = 10.0;
  for (const LateralPeak& peak : r.peaks) {
    if (std::isfinite(peak.amplification()))
      highest = std::max(highest, 1.1 * peak.amplification());
  }
  p.y = {.title = "amplification factor", .first = 0.0, .last = highest};
  p.curves.push_back(forbidden_area(r, highest));
  for (std::size_t c = 0; c < r.cases.size(); ++c) {
    const std::string& shaft = r.cases[c].shaft;
    Curve peaks{
        .name = case_name(static_cast<int>(c)) + (shaft.empty() ? "" : ", " + shaft_text(shaft)),
        .paint = series_paint(c),
        .has_line = false};
    peaks.has_marker = true;
    peaks.size = 9.0;
    for (const LateralPeak& peak : r.peaks) {
      if (peak.of_case != static_cast<int>(c) || !std::isfinite(peak.amplification())) continue;
      peaks.x.push_back(peak.speed / speed_unit().size);
      peaks.y.push_back(peak.amplification());
      peaks.hover.push_back(r.probes[static_cast<std::size_t>(peak.row)].station);
    }
    p.curves.push_back(std::move(peaks));
  }
  add_speeds(r, f, p);
  f.table = check_table(r);
  for (const std::string& remark : remarks_on(r)) f.notes.push_back(remark);
  for (const LateralRule rule : rules_of(r)) {
    f.notes.push_back(fmt::format("{}: {}.", name_of(rule), rule_text(rule)));
    f.notes.back().front() = static_cast<char>(std::toupper(f.notes.back().front()));
  }
  f.panels.push_back(std::move(p));
  return {f};
}

std::string planes_text(const LateralReport& r, int number) {
  std::string text;
  for (const LateralPlane& p : r.planes) {
    if (p.of_case != number) continue;
    text +=
        fmt::format("{}{} at {}{}", text.empty() ? "" : ", ", shown_value(p.moment, "g.mm", ".0f"),
                    p.station, p.phase > 0.0 ? " against it" : "");
  }
  return text;
}

std::vector<Figure> response_figures(const ResultView& result) {
  const auto& r = result_of<LateralReport>(result);
  const VibrationUnit unit = vibration_unit(r);
  std::vector<Figure> figures;
  for (int number = 0; number < static_cast<int>(r.cases.size()); ++number) {
    Figure f{.variant = case_name(number), .height = 400.0};
    f.subtitle = "Response to " + planes_text(r, number);
    const std::string& shaft = r.cases[static_cast<std::size_t>(number)].shaft;
    if (!shaft.empty()) f.subtitle += " of " + shaft_text(shaft);
    const double allowed = allowed_vibration(r, number);
    Panel p;
    p.x = {.title = shown_heading("speed", "rpm"),
           .first = r.speeds.front() / speed_unit().size,
           .last = r.speeds.back() / speed_unit().size};
    p.y = {.title = fmt::format("peak to peak [{}]", unit.name), .first = 0.0};
    p.cursor = "speed";
    for (const LateralResponse& response : r.responses) {
      if (response.of_case != number) continue;
      const auto probe = static_cast<std::size_t>(response.probe);
      Curve c{.name = r.probes[probe].station, .paint = series_paint(probe)};
      c.dash = series_dash(probe);
      c.x = scaled(r.speeds, 1.0 / speed_unit().size);
      c.y = scaled(numbers(response.peak_to_peak), unit.factor);
      p.curves.push_back(std::move(c));
    }
    Curve limit{.name = "limit", .paint = Paint::alarm};
    limit.dash = Dash::dashed;
    limit.x = {r.minimum_speed / speed_unit().size, r.maximum_speed / speed_unit().size};
    limit.y = {unit.factor * allowed, unit.factor * allowed};
    if (r.minimum_speed < r.maximum_speed) p.curves.push_back(std::move(limit));
    add_speeds(r, f, p);
    f.notes.push_back(fmt::format("Allowed from minimum to maximum speed: {:.{}f} {} peak to peak.",
                                  unit.factor * allowed, unit.factor < 1e6 ? 3 : 1, unit.name));
    f.panels.push_back(std::move(p));
    figures.push_back(std::move(f));
  }
  return figures;
}

std::vector<Figure> stability_figures(const ResultView& result) {
  const auto& r = result_of<LateralReport>(result);
  Figure f{.height = 380.0};
  f.subtitle = fmt::format("Cross-coupled stiffness at {}, {}", r.coupled_station,
                           shown_value(r.maximum_speed, "rpm", ".0f"));
  Panel p;
  const double per_stiffness = 1.0 / shown_unit("MN/m").size;
  p.x = {.title = shown_heading("cross-coupled stiffness", "MN/m")};
  p.y = {.title = "logarithmic decrement"};
  const auto add = [&](const CoupledMode& m, Curve& c) {
    c.x.push_back(per_stiffness * m.coupling);
    c.y.push_back(m.log_decrement);
    c.hover.push_back(fmt::format("whirls at {}", shown_value(m.frequency, "rpm", ".1f")));
  };
  const auto& states = result_of<LateralParts>(result).coupled;
  if (states.empty()) {
    Curve c{.name = "least damped mode", .paint = Paint::forward};
    for (const CoupledMode& m : r.coupled_modes) add(m, c);
    p.curves.push_back(std::move(c));
  } else {
    f.notes.push_back(
        states.front().shaft.empty()
            ? "The least damped mode of the model and of each variant; Q0 is that of the worst."
            : "The least damped mode of each shaft; Q0 is that of the one with the stiffness.");
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i == 0 || states[i].variant != states[i - 1].variant ||
        states[i].shaft != states[i - 1].shaft) {
      const std::string name = state_name(states[i].variant, states[i].shaft);
      p.curves.push_back({.name = name, .paint = series_paint(p.curves.size())});
    }
    add(states[i], p.curves.back());
  }
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "stable above", Paint::gray, Dash::solid});
  p.rules.push_back(
      {Rule::Kind::horizontal, least_log_decrement, "0.1", Paint::alarm, Dash::dashed});
  if (std::isfinite(r.limit)) {
    p.rules.push_back(
        {Rule::Kind::vertical, per_stiffness * r.limit, "Q0", Paint::ink, Dash::dotted});
  }
  if (r.anticipated > 0.0) {
    p.rules.push_back(
        {Rule::Kind::vertical, per_stiffness * r.anticipated, "QA", Paint::ink, Dash::dotted});
  }
  f.panels.push_back(std::move(p));
  return {f};
}

}  // namespace

FigureKind lateral_kind() {
  return {
      .name = "lateral",
      .title = "Lateral analysis: passes and failures",
      .summary = "amplification factors beside separation margins, and the table of checks",
      .needs = {dataset_of<LateralReport>(&LateralCase::mode_speed),
                dataset_of<LateralReport>(&LateralReport::speeds)},
      .make = lateral_figures,
  };
}

FigureKind lateral_response_kind() {
  return {
      .name = "lateral_response",
      .title = "Unbalance at antinodes and overhung ends",
      .summary = "vibration of probes over speed beside its limit, a case of unbalance each",
      .needs = {dataset_of<LateralReport>(&LateralResponse::peak_to_peak)},
      .make = response_figures,
  };
}

FigureKind coupling_kind() {
  return {
      .name = "coupling",
      .title = "Stability",
      .summary = "logarithmic decrement over cross-coupled stiffness",
      .needs = {dataset_of<LateralReport>(&CoupledMode::log_decrement)},
      .make = stability_figures,
  };
}

}  // namespace whirl::inline io
