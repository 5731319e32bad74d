#include "libverbs/command/reporting.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>

#include "libio/figures/comparison.hpp"
#include "libio/results/call.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/progress_line.hpp"
#include "libverbs/command/version.hpp"

namespace whirl::inline cli {

Report begin_report(const Invocation& call) {
  Report report;
  report.record.set("model", call.file).set("version", version);
  return report;
}

Report begin_report(const Invocation& call, const Model& model, const Record& result) {
  Report report = begin_report(call);
  report.record.set("speed_rpm", model.speed / rpm).merge(result);
  return report;
}

std::function<void(long, long)> progress_of(const Invocation& call, std::string what) {
  if (call.progress) {
    return [show = call.progress, what = std::move(what)](long done, long total) {
      show(what, done, total);
    };
  }
  const bool shows = !call.output.quiet;
  return [line = std::make_shared<ProgressLine>(std::move(what), shows)](long done, long total) {
    line->update(done, total);
  };
}

namespace {

/// Says that the motion whose end is the start is of a model with other values, and which.
std::vector<std::string> notes_on_start(const std::string& file, const Model& model) {
  constexpr std::size_t most = 3;
  const auto result = open_result(file);
  const auto rows = differences({stored_model(*result), model.source}, {"there", "here"}).rows;
  if (rows.empty()) return {};
  std::vector<std::string> values;
  for (const auto& row : rows) {
    if (values.size() == most) break;
    values.push_back(fmt::format("{} {} there, {} here", row[0], row[1], row[2]));
  }
  return {fmt::format("the start is a motion of a model with {} other value{}: {}{}", rows.size(),
                      rows.size() == 1 ? "" : "s", fmt::join(values, "; "),
                      rows.size() > most ? "; ..." : "")};
}

}  // namespace

void note_model(const Invocation& call, const Model& model, Report& report) {
  const bool leads = !call.ranks || call.ranks->leads();  // others may not have the file
  if (const std::string from = call.text("from"); leads && !from.empty()) {
    report.add_notes(notes_on_start(from, model));
  }
  report.add_notes(table_notes(model.structure, speeds_over(call.values("over"), model.speed)));
  report.add_notes(frequency_notes(model.structure));
  report.add_notes(speed_notes(model));
}

void write_notes(ResultWriter& file, const Report& report) {
  if (report.notes.empty()) return;
  file.attribute("/", "notes", fmt::format("{}", fmt::join(report.notes, "\n")));
}

void tell_result(const Invocation& call, Report& report) {
  if (call.output.out) report.text += fmt::format("\n  result: {}\n", call.out_file());
}

void commit(const Invocation& call, ResultWriter* file, Report& report) {
  if (!file) return;
  write_notes(*file, report);
  file->commit();
  tell_result(call, report);
}

void write_file(const Invocation& call, const Model& model, Report& report,
                const std::function<void(ResultWriter&)>& write) {
  const auto file = call.result_file(model);
  if (file) write(*file);
  commit(call, file.get(), report);
}

}  // namespace whirl::inline cli
