#include "libfe/campbell.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "libio/hdf5.hpp"
#include "libio/table.hpp"

namespace whirl {

void write_campbell(ResultWriter& file, const Campbell& diagram) {
  const auto nb = static_cast<Eigen::Index>(diagram.branches.size());
  const auto ns = static_cast<Eigen::Index>(diagram.speeds.size());
  Mat frequency(nb, ns), decrement(nb, ns);
  std::vector<std::string> whirl;
  std::vector<int> numbers, crossing_branch;
  std::vector<double> crossing_speed;
  for (Eigen::Index b = 0; b < nb; ++b) {
    const CampbellBranch& branch = diagram.branches[static_cast<std::size_t>(b)];
    frequency.row(b) = Eigen::Map<const Eigen::RowVectorXd>(branch.frequency.data(), ns);
    decrement.row(b) = Eigen::Map<const Eigen::RowVectorXd>(branch.log_decrement.data(), ns);
    whirl.emplace_back(name_of(branch.whirl));
    numbers.push_back(static_cast<int>(b) + 1);
  }
  for (const Crossing& c : diagram.crossings) {
    crossing_speed.push_back(c.speed);
    crossing_branch.push_back(c.branch + 1);
  }
  file.dataset("/campbell/speed", diagram.speeds, {"rad/s", "rotor speed", {""}});
  file.dataset("/campbell/branch", numbers, {"", "branch", {""}});
  const std::vector<std::string> axes{"/campbell/branch", "/campbell/speed"};
  file.dataset("/campbell/frequency", frequency, {"rad/s", "damped natural frequency", axes});
  file.dataset("/campbell/log_decrement", decrement, {"", "logarithmic decrement", axes});
  file.dataset("/campbell/whirl", whirl, {"", "sense of whirl", {"/campbell/branch"}});
  if (!crossing_speed.empty()) {
    file.dataset("/campbell/critical_speed", crossing_speed, {"rad/s", "critical speed", {""}});
    file.dataset("/campbell/critical_branch", crossing_branch,
                 {"", "branch that is critical", {""}});
  }
}

Report run_campbell(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const std::vector<double> speeds = call.speeds(model);
  const int count = static_cast<int>(call.integer("modes", 8));
  const Campbell diagram = campbell(assembler, speeds, count);

  Report report{.record = begin_record(call, model)};
  const auto in_rpm = [](std::vector<double> values) {
    for (double& v : values) v /= rpm;
    return values;
  };
  Record branches = Record::array(), criticals = Record::array();
  std::vector<std::string> head{"speed [rpm]"};
  int number = 0;
  for (const CampbellBranch& b : diagram.branches) {
    Record branch;
    branch.set("number", ++number).set("whirl", name_of(b.whirl));
    branch.set("frequency_rpm", in_rpm(b.frequency)).set("log_decrement", b.log_decrement);
    branches.add(branch);
    head.push_back(fmt::format("{} {} [rpm]", number, name_of(b.whirl)));
  }
  for (const Crossing& c : diagram.crossings) criticals.add(c.speed / rpm);
  report.record.set("speeds_rpm", in_rpm(speeds))
      .set("branches", branches)
      .set("criticals_rpm", criticals);
  Record gaps = Record::array();
  for (const CampbellGap& gap : diagram.gaps) {
    Record r;
    r.set("speed_rpm", gap.speed / rpm).set("why", gap.why);
    gaps.add(r);
  }
  if (!diagram.gaps.empty()) report.record.set("gaps", gaps);

  // a table of at most about twenty speeds; the whole is in the JSON and the result file
  Table table(head);
  const std::size_t stride = std::max<std::size_t>(1, (speeds.size() + 19) / 20);
  for (std::size_t i = 0; i < speeds.size(); i += stride) {
    std::vector<std::string> cells{fmt::format("{:.1f}", speeds[i] / rpm)};
    for (const CampbellBranch& b : diagram.branches) {
      cells.push_back(std::isfinite(b.frequency[i]) ? fmt::format("{:.1f}", b.frequency[i] / rpm)
                                                    : "-");
    }
    table.row(cells);
  }
  report.text = "Campbell diagram: damped natural frequencies over speed\n\n" + table.text();
  if (diagram.crossings.empty()) {
    report.text += "\n  No branch meets the line frequency = speed in this range.\n";
  } else {
    report.text += "\n  critical speeds (frequency = speed) [rpm]:";
    for (const Crossing& c : diagram.crossings) {
      report.text += fmt::format(" {:.1f} ({})", c.speed / rpm, c.branch + 1);
    }
    report.text += "\n";
  }
  for (const CampbellGap& gap : diagram.gaps) {
    report.text += fmt::format("\n  not computed at {:.1f} rpm: {}\n", gap.speed / rpm, gap.why);
  }
  if (const auto file = call.result_file(model)) {
    write_campbell(*file, diagram);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace whirl
