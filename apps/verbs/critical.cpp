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
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

Report run_critical(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  CriticalOptions options;
  options.count = static_cast<int>(call.integer("modes"));
  options.order = call.number("order", "");
  if (!(options.order > 0.0))
    throw ModelError({"--order " + call.text("order")}, "", "expected a number above zero");
  const std::vector<Critical> criticals = critical_speeds(assembler, options);

  Report report{.record = begin_record(call, model)};
  const std::string excitation = fmt::format("{:g}x", options.order);
  Record list = Record::array();
  Table table(
      {"number", "speed [rpm]", "[Hz]", "damped [rpm]", "damping ratio", "whirl", "excitation"});
  double lowest = model.speed, highest = model.speed;
  bool has_heavy = false;
  for (std::size_t i = 0; i < criticals.size(); ++i) {
    const Critical& c = criticals[i];
    const bool is_heavy = c.damping_ratio > heavy_damping, is_met = std::isfinite(c.damped_speed);
    has_heavy = has_heavy || is_heavy;
    lowest = i == 0 ? c.speed : std::min(lowest, c.speed);
    highest = i == 0 ? c.speed : std::max(highest, c.speed);
    Record r;
    r.set("speed_rpm", c.speed / rpm).set("whirl", name_of(c.whirl)).set("excitation", excitation);
    r.set("damped_speed_rpm", c.damped_speed / rpm);
    r.set("damping_ratio", c.damping_ratio).set("heavily_damped", is_heavy);
    if (!c.note.empty()) r.set("note", c.note);
    list.add(r);
    table.row({fmt::format("{}{}", i + 1, is_heavy ? heavy_mark : ""),
               fmt::format("{:.2f}", c.speed / rpm), fmt::format("{:.3f}", c.speed / rpm / 60.0),
               is_met ? fmt::format("{:.2f}", c.damped_speed / rpm) : "-",
               is_met ? fixed(c.damping_ratio, 5) : "-", std::string(name_of(c.whirl)),
               excitation});
  }
  report.record.set("criticals", list);
  report.text =
      "Critical speeds: undamped, and where the damped frequency meets the excitation\n\n" +
      table.text() + (has_heavy ? heavy_legend : "");
  note_left_out(model, report);
  note_tables(model, lowest, highest, report);
  if (const auto file = call.result_file(model)) {
    std::vector<double> speed, damped, damping;
    std::vector<std::string> whirl;
    for (const Critical& c : criticals) {
      speed.push_back(c.speed);
      damped.push_back(c.damped_speed);
      damping.push_back(c.damping_ratio);
      whirl.emplace_back(name_of(c.whirl));
    }
    file->dataset("/critical/speed", speed, {"rad/s", "undamped critical speed", {""}});
    file->dataset("/critical/damped_speed", damped, {"rad/s", "damped critical speed", {""}});
    file->dataset("/critical/damping_ratio", damping,
                  {"", "damping ratio at the damped critical speed", {""}});
    file->dataset("/critical/whirl", whirl, {"", "sense of whirl", {""}});
    file->attribute("/critical", "order", options.order);
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

}  // namespace whirl
