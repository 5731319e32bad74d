#include "libio/texts/running_modes_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/table.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// "2.598 ± 0.003".
std::string with_deviation(double value, double deviation, double unit, const char* format) {
  const std::string text = texts::number_text(value / unit, format);
  if (!std::isfinite(deviation)) return text;
  return text + " ± " + texts::number_text(deviation / unit, format);
}

/// The modes of the model that running modes are most like.
std::string comparison(const std::vector<RunningMode>& modes) {
  using Mode = RunningMode;
  constexpr double seen = 0.005;  // MAC that is told
  const auto mac = [](const Mode& m, int i) { return m.mac[static_cast<std::size_t>(i)]; };
  const auto second = [=](const Mode& m) -> std::string {
    int next = -1;
    for (int i = 0; i < static_cast<int>(m.mac.size()); ++i) {
      if (i != m.model_mode && (next < 0 || mac(m, i) > mac(m, next))) next = i;
    }
    if (next < 0 || mac(m, next) < seen) return "-";
    return fmt::format("mode {} ({:.2f})", next + 1, mac(m, next));
  };
  const auto if_alike = [](auto text) {
    return [text](const Mode& m) { return m.model_mode < 0 ? std::string("-") : text(m); };
  };
  std::string table =
      table_of(modes, TableColumns<Mode>{row_number("running mode"),
                                         shown("whirl"),
                                         {"most like",
                                          [](const Mode& m) {
                                            return m.model_mode < 0
                                                       ? "none"
                                                       : fmt::format("mode {}", m.model_mode + 1);
                                          }},
                                         {"MAC", if_alike([=](const Mode& m) {
                                            return fmt::format("{:.2f}", mac(m, m.model_mode));
                                          })},
                                         {"shift", if_alike([](const Mode& m) {
                                            return fmt::format("{:+.1f} %", 100.0 * m.shift);
                                          })},
                                         {"next", second}});
  if (std::any_of(modes.begin(), modes.end(), [](const Mode& m) { return m.model_mode < 0; })) {
    table += fmt::format(
        "\n  none: of the {} modes of the model that are compared none looks like it at the "
        "probes; --modes N compares more\n",
        modes.front().mac.size());
  }
  return table;
}

}  // namespace

std::string text_of(const RunningModes& found) {
  std::string text = fmt::format(
      "Running modes from {} channel{}, {:.4g} s at {:.5g} samples per second: models up to order "
      "{}",
      found.channels.size(), found.channels.size() == 1 ? "" : "s", found.duration, found.rate,
      found.most_order);
  if (found.harmonics > 0) {
    text += fmt::format(", {} harmonics of {} {}", found.harmonics,
                        shown_value(found.speed, "rpm", ".5g"),
                        found.are_harmonics_removed ? "removed" : "marked");
  }
  text += "\n\n";
  if (found.modes.empty()) {
    return text +
           "  none: no pole is stable over enough model orders. A longer record, more block rows "
           "or wider limits may show some.\n";
  }
  using Mode = RunningMode;
  text +=
      table_of(found.modes,
               TableColumns<Mode>{
                   row_number("mode"),
                   {shown_heading("frequency", "Hz"),
                    [](const Mode& m) {
                      return with_deviation(m.frequency(), m.frequency_deviation, hertz, ".4f");
                    }},
                   shown("frequency", "rpm", ".1f").as("frequency"),
                   {"damping ratio [%]",
                    [](const Mode& m) {
                      return with_deviation(m.damping_ratio(), m.damping_deviation, 0.01, ".2f");
                    }},
                   shown("log_decrement", "", ".3f").as("log decrement"),
                   {shown_heading("decomposition", "Hz"),
                    [&](const Mode& m) {
                      const DecomposedMode* peak = found.peak_of(m);
                      return peak ? shown_number(peak->frequency(), "Hz", ".4f") : "-";
                    }},
                   {"its damping [%]",
                    [&](const Mode& m) {
                      const DecomposedMode* peak = found.peak_of(m);
                      return peak ? texts::number_text(100.0 * peak->damping_ratio(), ".2f") : "-";
                    }},
                   {"orders", [&](const Mode& m) {
                      return fmt::format("{} of {}", m.orders, found.most_order / 2);
                    }}});
  if (std::any_of(found.modes.begin(), found.modes.end(),
                  [](const Mode& m) { return std::isfinite(m.frequency_deviation); })) {
    text += "\n  ±: standard deviation, from stretches of the record\n";
  }
  if (!found.modes.front().mac.empty()) {
    text += "\nThe modes of the model that probes see them most like\n\n" + comparison(found.modes);
  }
  return text;
}

}  // namespace whirl::inline io
