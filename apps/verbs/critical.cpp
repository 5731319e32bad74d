#include "libfe/critical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "libbase/error.hpp"
#include "libfe/modes.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

std::string criticals_text(const std::vector<Critical>& criticals) {
  Table table(
      {"number", "speed [rpm]", "[Hz]", "damped [rpm]", "damping ratio", "whirl", "excitation"});
  int number = 0;
  bool has_heavy = false;
  for (const Critical& c : criticals) {
    const bool is_met = std::isfinite(c.damped_speed);
    has_heavy = has_heavy || c.is_heavily_damped();
    table.row({fmt::format("{}{}", ++number, c.is_heavily_damped() ? heavy_mark : ""),
               fmt::format("{:.2f}", c.speed / rpm), fmt::format("{:.3f}", c.speed / rpm / 60.0),
               is_met ? fmt::format("{:.2f}", c.damped_speed / rpm) : "-",
               is_met ? fixed(c.damping_ratio, 5) : "-", std::string(name_of(c.whirl)),
               c.excitation()});
  }
  return "Critical speeds: undamped, and where the damped frequency meets the excitation\n\n" +
         table.text() + (has_heavy ? heavy_legend : "");
}

CriticalOptions options_of(const Invocation& call) {
  CriticalOptions options;
  options.count = static_cast<int>(call.integer("modes"));
  options.order = call.number("order", "");
  if (!(options.order > 0.0))
    throw ModelError({"--order " + call.text("order")}, "", "expected a number above zero");
  return options;
}

Report run_critical(const Invocation& call) {
  const Model model = call.model();
  const CriticalOptions options = options_of(call);
  const CriticalSpeeds found{critical_speeds(Assembler(model.structure), options), options.order};

  Report report{.record = begin_record(call, model)};
  report.record.merge(record_of(found));
  report.text = criticals_text(found.criticals);
  note_left_out(model, report);
  double lowest = model.speed, highest = model.speed;
  if (!found.criticals.empty()) {
    const auto [low, high] =
        std::minmax_element(found.criticals.begin(), found.criticals.end(),
                            [](const Critical& a, const Critical& b) { return a.speed < b.speed; });
    lowest = low->speed;
    highest = high->speed;
  }
  note_tables(model, lowest, highest, report);
  if (const auto file = call.result_file(model)) {
    write_result(*file, found);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb critical_verb() {
  return {
      .name = "critical",
      .group = "Linear rotordynamics",
      .summary = "critical speeds, directly",
      .example = "whirl critical models/two_disk_mac.toml",
      .options = {{"modes", "N", "how many critical speeds", "6"},
                  {"order", "N", "excitation frequency over speed", "1"}},
      .run = run_critical,
  };
}

}  // namespace whirl::inline cli
