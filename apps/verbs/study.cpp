#include "apps/verbs/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/program.hpp"
#include "apps/verbs/options.hpp"
#include "libio/texts/study_text.hpp"

namespace whirl::inline cli {

std::vector<OptionSpec> study_options(std::vector<OptionSpec> own) {
  const std::vector<OptionSpec> shared{
      {"revolutions", "N", "revolutions that are measured", "1000"},
      {"exponents", "N", "of these, over which Lyapunov exponents are averaged at most", "1000"},
      discard_option,
      tolerance_option,
      from_option,
      restart_option};
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

StudyPoints study_points(const Invocation& call, std::size_t least, std::size_t most) {
  Model model = call.model();
  auto axes = parse_axes(call.over, static_cast<int>(call.integer_or("points", 0, 2)), least, most);
  auto earlier = earlier_start(call, model);
  if (call.has("from")) model.start.whirl.clear();  // it goes on as it was
  return {std::move(model), std::move(axes), std::move(earlier)};
}

ClassifyOptions study_classify(const Invocation& call) {
  return {.discard = call.integer("discard", 0),
          .revolutions = call.integer("revolutions"),
          .exponents = call.integer("exponents"),
          .tolerance = call.parsed("tolerance", parse_tolerance)};
}

int study_threads(const Invocation& call) {
  const long processors = std::max(1u, std::thread::hardware_concurrency());
  return static_cast<int>(call.integer_or("threads", processors));
}

StudyKeeping study_keeping(const Invocation& call, const Model& model,
                           std::optional<EarlierEnd> start, std::string what,
                           std::vector<std::string> notes) {
  install_interrupt_handler();
  return {.place = {.file = call.text("out"),
                    .restarts = call.has("restart"),
                    .call = call.parts(),
                    .model = model.source,
                    .version = version,
                    .start_file = start_of(call, model).file,
                    .start = std::move(start)},
          .begin =
              [&call, &model, report = Report{.notes = std::move(notes)}] {
                auto file = call.result_file(model);
                write_notes(*file, report);
                return file;
              },
          .progress = progress_of(call, std::move(what)),
          .is_stopped = is_interrupted};
}

Report study_report(const Invocation& call, const Model& model, const StudyOutcome& outcome,
                    const Record& record, const std::string& text) {
  Report report = begin_report(call, model, record);
  report.record.merge(record_of(outcome));
  report.text = text + text_of(outcome, call.has("out"));
  report.status = !outcome.is_whole() ? 130 : outcome.has_failed() ? 3 : 0;
  if (report.status == 3) report.failure = outcome.failure;
  tell_result(call, report);
  note_tables(call, model, report);
  return report;
}

}  // namespace whirl::inline cli
