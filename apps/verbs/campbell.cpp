#include "libfe/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "libfe/modes.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

/// Logarithmic decrement of a mode that counts as heavily damped.
const double heavy_decrement =
    2.0 * std::numbers::pi * heavy_damping / std::sqrt(1.0 - heavy_damping * heavy_damping);

/// Speeds of the tables for people: some twenty, the first and the last among them.
std::vector<std::size_t> shown_speeds(std::size_t size, std::size_t stride) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < size; i += stride) shown.push_back(i);
  if (shown.back() + 1 < size) shown.push_back(size - 1);
  return shown;
}

/// Frequencies and logarithmic decrements of the branches, a table each.
std::string campbell_text(const Campbell& diagram) {
  constexpr std::size_t most = 21;
  const std::size_t size = diagram.speeds.size(),
                    stride = std::max<std::size_t>(1, size / (most - 1));
  std::vector<std::string> head{"speed [rpm]"}, decrements{"speed [rpm]"};
  bool has_heavy = false;
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    const CampbellBranch& branch = diagram.branches[b];
    head.push_back(fmt::format("{} {} [rpm]", b + 1, name_of(branch.whirl)));
    decrements.push_back(fmt::format("{} {}", b + 1, name_of(branch.whirl)));
  }
  Table frequency(head), decrement(decrements);
  for (const std::size_t i : shown_speeds(size, stride)) {
    std::vector<std::string> speeds{fmt::format("{:.1f}", diagram.speeds[i] / rpm)};
    std::vector<std::string> damping = speeds;
    for (const CampbellBranch& b : diagram.branches) {
      const bool is_heavy = b.log_decrement[i] > heavy_decrement;
      has_heavy = has_heavy || is_heavy;
      const bool is_there = std::isfinite(b.frequency[i]);
      speeds.push_back(
          is_there ? fmt::format("{:.1f}{}", b.frequency[i] / rpm, is_heavy ? heavy_mark : "")
                   : "-");
      damping.push_back(is_there ? fixed(b.log_decrement[i], 4) + (is_heavy ? heavy_mark : "")
                                 : "-");
    }
    frequency.row(speeds);
    decrement.row(damping);
  }
  const std::string which =
      stride == 1 ? "all speeds"
                  : fmt::format("every {} of {} speeds and the last; --json and --out have all",
                                stride == 2   ? "second"
                                : stride == 3 ? "third"
                                              : fmt::format("{}th", stride),
                                size);
  return fmt::format(
      "Campbell diagram: damped natural frequencies over speed ({})\n\n{}\nLogarithmic "
      "decrements, stable above zero\n\n{}{}",
      which, frequency.text(), decrement.text(), has_heavy ? heavy_legend : "");
}

Report run_campbell(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const std::vector<double> speeds = call.speeds(model);
  const int count = static_cast<int>(call.integer("modes"));
  const Campbell diagram = campbell(assembler, speeds, count);

  Report report{.record = begin_record(call, model)};
  report.record.merge(record_of(diagram));
  report.text = campbell_text(diagram);
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
  note_left_out(model, report);
  note_tables(model, speeds.front(), speeds.back(), report);
  if (const auto file = call.result_file(model)) {
    write_result(*file, diagram);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb campbell_verb() {
  return {
      .name = "campbell",
      .group = "Linear rotordynamics",
      .summary = "modes followed over speeds, with the critical speeds",
      .example = "whirl campbell models/two_disk_mac.toml --speeds 0:8000:50rpm",
      .options = {{"modes", "N", "how many modes", "8"}, speeds_option},
      .run = run_campbell,
  };
}

}  // namespace whirl::inline cli
