#include "libverbs/command/reporting.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

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

void note_tables(const Invocation& call, const Model& model, Report& report) {
  report.add_notes(table_notes(model.structure, speeds_over(call.values("over"), model.speed)));
  report.add_notes(frequency_notes(model.structure));
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
