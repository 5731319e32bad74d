#include "libio/texts/modes_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/row_table.hpp"
#include "libio/texts/some_rows.hpp"

namespace whirl::inline io {

namespace {

/// Behind the number of a mode that hardly whirls, and what it means.
constexpr const char* heavy_mark = "*";
constexpr const char* heavy_legend =
    "\n  *: heavily damped, a damping ratio above 0.5; a mode of the bearings in most cases\n";

/// The number of a mode or critical speed, with its mark.
constexpr auto marked_number = [](const auto& m, int number) {
  return std::to_string(number) + (m.is_heavily_damped() ? heavy_mark : "");
};

std::string legend_of(const auto& modes) {
  const bool has_heavy =
      std::any_of(modes.begin(), modes.end(), [](const auto& m) { return m.is_heavily_damped(); });
  return has_heavy ? heavy_legend : "";
}

/// Logarithmic decrement of a mode that counts as heavily damped.
const double heavy_decrement =
    2.0 * std::numbers::pi * heavy_damping / std::sqrt(1.0 - heavy_damping * heavy_damping);

std::string mark_of(double log_decrement) {
  return log_decrement > heavy_decrement ? heavy_mark : "";
}

std::string crossings_text(const Campbell& diagram) {
  std::string text;
  if (diagram.crossings.empty()) {
    text += "\n  No branch meets the line frequency = speed in this range.\n";
  } else {
    text += shown_heading("\n  critical speeds (frequency = speed)", "rpm") + ":";
    for (const Crossing& c : diagram.crossings) {
      text += fmt::format(" {} ({})", shown_number(c.speed, "rpm", ".1f"), c.branch + 1);
    }
    text += "\n";
  }
  for (const Threshold& t : diagram.thresholds) {
    text += fmt::format("\n  threshold of instability: {}, where {} whirls at {}\n",
                        shown_value(t.speed, "rpm", ".2f"),
                        t.is_followed() ? fmt::format("mode {}", t.branch + 1) : "another mode",
                        shown_value(t.frequency, "rpm", ".2f"));
  }
  for (const CampbellGap& gap : diagram.gaps) {
    text +=
        fmt::format("\n  not computed at {}: {}\n", shown_value(gap.speed, "rpm", ".1f"), gap.why);
  }
  return text;
}

}  // namespace

std::string text_of(const Modes& modes) {
  std::string text =
      table_of(modes.oscillatory, in_both_units<Mode>({{"mode", marked_number},
                                                       shown("frequency", "rpm", ".1f"),
                                                       shown("frequency", "Hz", ".3f").as(""),
                                                       shown("log_decrement", "", ".4f"),
                                                       shown("damping_ratio", "", ".5f"),
                                                       shown("whirl"),
                                                       shown("kappa", "", ".3f")},
                                                      2)) +
      legend_of(modes.oscillatory);
  if (!modes.overdamped.empty()) {
    text += "\n  overdamped [1/s]:";
    for (const Complex& root : modes.overdamped) text += fmt::format(" {:.4g}", root.real());
    text += "\n";
  }
  if (!modes.rigid_body.empty()) {
    text += fmt::format("\n  {} rigid-body modes: the rotor is free\n", modes.rigid_body.size());
  }
  return text;
}

std::string text_of(const CriticalSpeeds& found) {
  const auto is_by_another = [](const Critical& c) { return c.shaft != Critical().shaft; };
  const bool tells_shaft = std::ranges::any_of(found.criticals, is_by_another);
  auto columns = in_both_units<Critical>({{"number", marked_number},
                                          shown("speed", "rpm", ".2f"),
                                          shown("speed", "Hz", ".3f").as(""),
                                          shown("damped_speed", "rpm", ".2f").as("damped"),
                                          shown("damping_ratio", "", ".5f"),
                                          shown("whirl"),
                                          shown("excitation")},
                                         2);
  if (tells_shaft) columns.push_back(shown("shaft").as("by"));
  return fmt::format(
      "Critical speeds{}: undamped, and where the damped frequency meets the "
      "excitation\n\n{}{}",
      tells_shaft ? " of the first shaft" : "", table_of(found.criticals, columns),
      legend_of(found.criticals));
}

std::string text_of(const Campbell& diagram) {
  const SomeRows speeds(diagram.speeds.size(), "speeds");
  TableColumns<std::size_t> frequencies{{shown_heading("speed", "rpm"), [&](std::size_t i) {
                                           return shown_number(diagram.speeds[i], "rpm", ".1f");
                                         }}};
  TableColumns<std::size_t> decrements = frequencies;
  for (const CampbellBranch& b : diagram.branches) {
    const std::string name = fmt::format("{} {}", frequencies.size(), name_of(b.whirl));
    frequencies.push_back({shown_heading(name, "rpm"), [&](std::size_t i) {
                             return shown_number(b.frequency[i], "rpm", ".1f") +
                                    mark_of(b.log_decrement[i]);
                           }});
    decrements.push_back({name, [&](std::size_t i) {
                            return texts::number_text(b.log_decrement[i], ".4f") +
                                   mark_of(b.log_decrement[i]);
                          }});
  }
  bool has_heavy = false;
  for (const std::size_t i : speeds.shown) {
    for (const CampbellBranch& b : diagram.branches) {
      has_heavy = has_heavy || b.log_decrement[i] > heavy_decrement;
    }
  }
  return fmt::format(
      "Campbell diagram: damped natural frequencies over speed ({})\n\n{}\nLogarithmic "
      "decrements, stable above zero\n\n{}{}{}",
      speeds.which, table_of(speeds.shown, frequencies), table_of(speeds.shown, decrements),
      has_heavy ? heavy_legend : "", crossings_text(diagram));
}

}  // namespace whirl::inline io
