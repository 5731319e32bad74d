#include "apps/verbs/common.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/progress.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libio/export/scene_source.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline cli {

Record begin_record(const Invocation& call, const Model& model) {
  Record record;
  record.set("model", call.file).set("version", version).set("speed_rpm", model.speed / rpm);
  return record;
}

Report begin_report(const Invocation& call, const Model& model, const Record& result) {
  return {.record = begin_record(call, model).merge(result), .text = ""};
}

std::function<void(long, long)> progress_of(const Invocation& call, std::string what) {
  return [shown = std::make_shared<std::optional<Progress>>(), what = std::move(what),
          shows = call.shows_progress](long done, long total) {
    if (!*shown) shown->emplace(what, total, shows);
    (*shown)->update(done);
  };
}

void set_frequency_unit(const Invocation& call, ResultView& result) {
  const std::string name = call.text("frequency");
  const auto unit = frequency_unit(name);
  if (!unit) throw ModelError({"--frequency " + name}, "", "expected Hz, cpm or rad/s");
  result.frequency = *unit;
}

MotionWindow window_of(const Invocation& call) {
  MotionWindow window;
  if (call.has("times")) {
    const std::string text = call.text("times");
    for (const char* other : {"from-revolution", "revolutions"}) {
      if (call.has(other)) {
        throw ModelError({"--times " + text}, "", fmt::format("does not go with --{}", other));
      }
    }
    const auto range = parse_range(text, "s");
    if (!range) throw ModelError({"--times " + text}, "", range.problem);
    if (range->step) throw ModelError({"--times " + text}, "", "expected two times, first:last");
    window.times = {range->first, range->last};
  }
  if (call.has("from-revolution")) {
    window.from_revolution = static_cast<double>(call.integer("from-revolution", 0));
  }
  if (call.has("revolutions")) {
    window.revolutions = static_cast<double>(call.integer("revolutions"));
  }
  return window;
}

void write_notes(ResultWriter& file, const Report& report) {
  if (report.notes.empty()) return;
  file.attribute("/", "notes", fmt::format("{}", fmt::join(report.notes, "\n")));
}

void commit(const Invocation& call, ResultWriter* file, Report& report) {
  if (!file) return;
  write_notes(*file, report);
  file->commit();
  report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
}

void write_file(const Invocation& call, const Model& model, Report& report,
                const std::function<void(ResultWriter&)>& write) {
  const auto file = call.result_file(model);
  if (file) write(*file);
  commit(call, file.get(), report);
}

SceneSource scene_source(const Invocation& call) {
  const std::string ending = std::filesystem::path(call.file).extension();
  if (ending != ".h5" && ending != ".hdf5") return SceneSource(call.model());
  return {open_result(call.file), call.file, call.sets};
}

}  // namespace whirl::inline cli
