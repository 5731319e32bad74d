#include "libfe/critical.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "libio/hdf5.hpp"
#include "libio/table.hpp"

namespace whirl {

Report run_critical(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  CriticalOptions options;
  options.count = static_cast<int>(call.integer("modes", options.count));
  options.order = call.number("order", "", options.order);
  if (!(options.order > 0.0))
    throw ModelError({"--order " + call.text("order")}, "", "expected a number above zero");
  const std::vector<Critical> criticals = critical_speeds(assembler, options);

  Report report{.record = begin_record(call, model)};
  const std::string excitation = fmt::format("{:g}x", options.order);
  Record list = Record::array();
  Table table({"number", "speed [rpm]", "[Hz]", "damped [rpm]", "whirl", "excitation"});
  int number = 0;
  for (const Critical& c : criticals) {
    Record r;
    r.set("speed_rpm", c.speed / rpm).set("whirl", name_of(c.whirl)).set("excitation", excitation);
    r.set("damped_speed_rpm", c.damped_speed / rpm);
    if (!c.note.empty()) r.set("note", c.note);
    list.add(r);
    table.row({fmt::format("{}", ++number), fmt::format("{:.2f}", c.speed / rpm),
               fmt::format("{:.3f}", c.speed / rpm / 60.0),
               std::isfinite(c.damped_speed) ? fmt::format("{:.2f}", c.damped_speed / rpm) : "-",
               std::string(name_of(c.whirl)), excitation});
  }
  report.record.set("criticals", list);
  report.text =
      "Critical speeds: undamped, and where the damped frequency meets the excitation\n\n" +
      table.text();
  if (const auto file = call.result_file(model)) {
    std::vector<double> speed, damped;
    std::vector<std::string> whirl;
    for (const Critical& c : criticals) {
      speed.push_back(c.speed);
      damped.push_back(c.damped_speed);
      whirl.emplace_back(name_of(c.whirl));
    }
    file->dataset("/critical/speed", speed, {"rad/s", "undamped critical speed", {""}});
    file->dataset("/critical/damped_speed", damped, {"rad/s", "damped critical speed", {""}});
    file->dataset("/critical/whirl", whirl, {"", "sense of whirl", {""}});
    file->attribute("/critical", "order", options.order);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace whirl
