#include "libverbs/options/study.hpp"

#include <fmt/format.h>

#include "libbase/system/processors.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libio/texts/study_text.hpp"
#include "libverbs/command/version.hpp"

namespace whirl::inline cli {

StudyPoints study_points(const Invocation& call, const AxesVerbOptions& axes,
                         const KeptVerbOptions& kept, std::size_t least, std::size_t most) {
  Model model = call.model();
  auto values = parse_axes(axes.over.values, axes.points.value_or(0), least, most);
  auto earlier = earlier_start(kept.from, model, call.ranks);
  if (kept.from) model.start.whirl.clear();  // it goes on as it was
  return {std::move(model), std::move(values), std::move(earlier)};
}

ClassifyOptions study_classify(const StudyVerbOptions& options) {
  return {.discard = *options.discard,
          .revolutions = *options.revolutions,
          .exponents = *options.exponents,
          .most_exponents = options.lyapunov.count.value_or(0),
          .resolution = options.lyapunov.resolution.value_or(0.0),
          .tolerance = *options.tolerance};
}

int study_threads(const Invocation& call) {
  return static_cast<int>(call.output.threads.value_or(usable_processors()));
}

StudyKeeping study_keeping(const Invocation& call, const Model& model,
                           const KeptVerbOptions& options, std::string what,
                           std::vector<std::string> notes) {
  const auto with_notes = [report = Report{.notes = std::move(notes)}](auto file) {
    if (file) write_notes(*file, report);
    return file;
  };
  const Stripe stripe = call.stripe();
  const bool leads = !call.ranks || call.ranks->leads();  // others have no file
  if (leads && !stripe.is_all() && !call.output.out) {
    throw wrong_option("part", call.text("part"), "needs --out, where the parts are joined");
  }
  return {.place = {.file = call.out_file(),
                    .joins = call.joins.value_or(std::vector<std::string>{}),
                    .restarts = options.restart,
                    .call = call.parts(),
                    .model = model.source,
                    .version = version,
                    .start_file = start_of(options.from, model).file,
                    .start = earlier_start(options.from, model, call.ranks)},
          .begin = [=, &call, &model] { return with_notes(call.saved_file(model)); },
          .begin_kept = [=, &call, &model] { return with_notes(call.kept_file(model)); },
          .progress = progress_of(call, std::move(what)),
          .is_stopped = [computes = !call.joins,
                         stops = call.stop_asked()] { return !computes || stops(); },
          .ranks = call.ranks,
          .stripe = stripe};
}

Report study_report(const Invocation& call, const StudyPoints& points, const StudyOutcome& outcome,
                    const Record& record, const std::string& text) {
  const Model& model = points.model();
  Report report = begin_report(call, model, record);
  report.record.merge(record_of(outcome));
  report.text = text + text_of(outcome, call.output.out.is_given);
  report.status = !outcome.is_whole()    ? exit_status::stopped
                  : outcome.has_failed() ? exit_status::failed
                                         : exit_status::done;
  if (report.status == exit_status::failed) report.failure = outcome.failure;
  tell_result(call, report);
  note_model(call, model, report);
  report.add_notes(touch_notes(
      outcome.hardest, [&](std::size_t i) { return points.model_at(i); },
      [&](std::size_t i) { return points.describe(i % points.grid().points()); }));
  return report;
}

}  // namespace whirl::inline cli
