#include "libio/texts/over_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"
#include "libio/texts/some_rows.hpp"

namespace whirl::inline io {

namespace {

using ValueColumns = TableColumns<std::size_t>;

std::string axis_value(double value, const ParameterAxis& axis) {
  return fmt::format("{:.6g}", value / axis.shown_scale);
}

/// A column with the values, to which others are added.
ValueColumns value_column(const OverValues& found, const ParameterAxis& axis) {
  return {{axis.title(), [&](std::size_t i) { return axis_value(found.values[i], axis); }}};
}

/// @param unit  as of shown_number
std::string number_at(const Vec& values, std::size_t i, const char* unit, const char* format) {
  return shown_number(values(static_cast<Eigen::Index>(i)), unit, format);
}

/// "kxy = 4 MN/m".
std::string place_text(double value, const ParameterAxis& axis) {
  return fmt::format("{} = {}{}{}", axis.path, axis_value(value, axis),
                     axis.shown_unit.empty() ? "" : " ", axis.shown_unit);
}

std::string gaps_text(const std::vector<ValueGap>& gaps, const ParameterAxis& axis) {
  std::string text;
  for (const ValueGap& gap : gaps) {
    text += fmt::format("\n  not computed at {}: {}\n", place_text(gap.value, axis), gap.why);
  }
  return text;
}

/// Speeds of a further shaft at which it excites; empty: the values are none of one.
std::string own_branches_text(const CriticalOver& found) {
  if (found.own_branches.empty()) return {};
  const SomeRows rows(found.lead_speeds.size(), "speeds");
  ValueColumns speeds{{shown_heading("first shaft", "rpm"), [&](std::size_t i) {
                         return shown_number(found.lead_speeds[i], "rpm", ".1f");
                       }}};
  for (const OwnSpeedBranch& b : found.own_branches) {
    speeds.push_back({shown_heading(fmt::format("{} {}", speeds.size(), name_of(b.whirl)), "rpm"),
                      [&](std::size_t i) { return number_at(b.speed, i, "rpm", ".2f"); }});
  }
  return fmt::format("\nSpeeds of {} at which it excites a natural frequency, undamped ({})\n\n{}",
                     found.shaft, rows.which, table_of(rows.shown, speeds));
}

}  // namespace

std::string text_of(const ModesOver& found, const ParameterAxis& axis) {
  const SomeRows rows(found.values.size(), "values");
  ValueColumns frequencies = value_column(found, axis), decrements = frequencies;
  for (const ModesOverBranch& b : found.branches) {
    const std::string name = fmt::format("{} {}", frequencies.size(), name_of(b.whirl));
    frequencies.push_back({shown_heading(name, "rpm"),
                           [&](std::size_t i) { return number_at(b.frequency, i, "rpm", ".1f"); }});
    decrements.push_back({name, [&](std::size_t i) {
                            return texts::number_text(b.log_decrement(static_cast<Eigen::Index>(i)),
                                                      ".4f");
                          }});
  }
  std::string text = fmt::format(
      "Damped natural frequencies ({})\n\n{}\nLogarithmic decrements, stable above zero\n\n{}",
      rows.which, table_of(rows.shown, frequencies), table_of(rows.shown, decrements));
  for (const ModesOverThreshold& t : found.thresholds) {
    text += fmt::format("\n  threshold of instability: {}, where mode {} whirls at {}\n",
                        place_text(t.value, axis), t.branch + 1,
                        shown_value(t.frequency, "rpm", ".2f"));
  }
  return text + gaps_text(found.gaps, axis);
}

std::string text_of(const CriticalOver& found, const ParameterAxis& axis) {
  const SomeRows rows(found.values.size(), "values");
  ValueColumns undamped = value_column(found, axis), damped = undamped;
  for (const CriticalOverBranch& b : found.branches) {
    const bool is_by_first = b.shaft == Critical().shaft;
    const std::string name = shown_heading(fmt::format("{} {}{}", undamped.size(), name_of(b.whirl),
                                                       is_by_first ? "" : " by " + b.shaft),
                                           "rpm");
    undamped.push_back({name, [&](std::size_t i) { return number_at(b.speed, i, "rpm", ".2f"); }});
    damped.push_back(
        {name, [&](std::size_t i) { return number_at(b.damped_speed, i, "rpm", ".2f"); }});
  }
  return fmt::format(
             "Undamped critical speeds ({})\n\n{}\nWhere the damped frequency meets the "
             "excitation\n\n{}",
             rows.which, table_of(rows.shown, undamped), table_of(rows.shown, damped)) +
         own_branches_text(found) + gaps_text(found.gaps, axis);
}

std::vector<std::string> notes_of_unbalance_over(const Model& model) {
  if (!has_oscillating_force(model.structure)) return {};
  return {
      "over a value the response is that at the frequency of the speed alone, without that to "
      "forces of other frequencies; without --over whirl unbalance tells both"};
}

std::string text_of(const UnbalanceOver& found, const ParameterAxis& axis) {
  const SomeRows rows(found.values.size(), "values");
  ValueColumns largest = value_column(found, axis);
  for (const UnbalanceOverStation& s : found.stations) {
    largest.push_back({shown_heading(s.station, "um"),
                       [&](std::size_t i) { return number_at(s.largest, i, "um", ".3f"); }});
  }
  std::string text =
      fmt::format("Unbalance response: the largest over all speeds, major semi-axes ({})\n\n{}",
                  rows.which, table_of(rows.shown, largest));
  if (!found.probes.empty()) {
    ValueColumns readings = value_column(found, axis);
    for (const UnbalanceOverProbe& p : found.probes) {
      readings.push_back({p.name, [&](std::size_t i) {
                            const double reading = p.largest(static_cast<Eigen::Index>(i));
                            return std::isfinite(reading) ? reading_text(reading, p) : "-";
                          }});
    }
    text += "\nLargest readings of the probes, peak to peak\n\n" + table_of(rows.shown, readings);
  }
  std::vector<const UnbalanceOverPeak*> peaks;
  for (const UnbalanceOverPeak& peak : found.peaks) {
    const bool is_shown = std::any_of(rows.shown.begin(), rows.shown.end(),
                                      [&](std::size_t i) { return found.values[i] == peak.value; });
    if (is_shown) peaks.push_back(&peak);
  }
  using Peak = const UnbalanceOverPeak*;
  if (!peaks.empty()) {
    text += "\nPeaks of the largest response\n\n" +
            table_of(peaks, {{axis.title(), [&](Peak p) { return axis_value(p->value, axis); }},
                             {shown_heading("peak", "rpm"),
                              [](Peak p) { return shown_number(p->speed, "rpm", ".1f"); }},
                             {shown_heading("", "um"),
                              [](Peak p) { return shown_number(p->amplitude, "um", ".3f"); }},
                             {"amplification", [](Peak p) {
                                return texts::number_text(p->amplification(), ".4g");
                              }}});
  }
  return text + gaps_text(found.gaps, axis);
}

}  // namespace whirl::inline io
