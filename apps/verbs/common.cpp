#include "apps/verbs/common.hpp"

#include <fmt/format.h>

#include "apps/verbs/notes.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libfe/modes.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"
#include "libio/text/value_range.hpp"

namespace whirl::inline cli {

Record begin_record(const Invocation& call, const Model& model) {
  Record record;
  record.set("model", call.file).set("version", version).set("speed_rpm", model.speed / rpm);
  return record;
}

std::string fixed(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  const bool is_zero = text.find_first_of("123456789ni") == std::string::npos;
  return is_zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string modes_table(const Modes& modes) {
  Table table(
      {"mode", "frequency [rpm]", "[Hz]", "log decrement", "damping ratio", "whirl", "kappa"});
  int number = 0;
  bool has_heavy = false;
  for (const Mode& m : modes.oscillatory) {
    const bool is_heavy = m.damping_ratio() > heavy_damping;
    has_heavy = has_heavy || is_heavy;
    table.row({fmt::format("{}{}", ++number, is_heavy ? heavy_mark : ""),
               fmt::format("{:.1f}", m.frequency() / rpm),
               fmt::format("{:.3f}", m.frequency() / rpm / 60.0), fixed(m.log_decrement(), 4),
               fixed(m.damping_ratio(), 5), std::string(name_of(m.whirl)), fixed(m.kappa, 3)});
  }
  std::string text = table.text();
  if (has_heavy) text += heavy_legend;
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

void write_points(ResultWriter& file, const Model& model, const Assembler& assembler) {
  write_result(file, point_names(model, assembler));
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

}  // namespace whirl::inline cli
