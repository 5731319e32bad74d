#include <fmt/format.h>

#include "libio/figures/choice.hpp"
#include "libio/results/columns.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/motion_view.hpp"
#include "libverbs/options/picture.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct PlotVerbOptions {
  Option<std::string> which{
      "which", "NAME",
      "of several of a kind: the station, probe, contact or plane; left out: the first"};
  Option<std::string> with = file_option(
      "with", "OTHER.h5",
      "branches over bifurcation, bifurcation curves over map, where both are of the same values");
  WindowVerbOptions window{
      .revolutions = {"revolutions", "N",
                      "revolutions of a motion, given alone: the last ones; left out: 8, orbit 48, "
                      "poincare all",
                      revolution_range}};
  MotionViewVerbOptions view{};
  Option<std::string> frequency = frequency_option();
  PictureVerbOptions picture{};
  auto fields() { return std::tie(which, with, window, view, frequency, picture); }
};

/// Refuses options of a picture where there is none.
void refuse(PictureVerbOptions options, const Option<std::string>& with) {
  const auto refuse_one = [](const auto& given) {
    if (given.is_given) throw given.wrong("which kind of figure?");
  };
  refuse_one(with);
  for_each_option(options, refuse_one);
}

/// What the result can be drawn as.
Report list_of(const Invocation& call, const PlotVerbOptions& options, const ResultView& result) {
  refuse(options.picture, options.with);
  const DrawableKinds all = drawable_kinds(result);
  Report report = begin_report(call);
  report.record.merge(record_of(all)).set("files", file_list({}));
  report.text = text_of(all, call.file);
  return report;
}

Report run_plot(const Invocation& call, const PlotVerbOptions& options) {
  const std::string kind = call.words.empty() ? "" : call.words[0];
  if (call.words.size() > 1) throw ModelError({call.words[1]}, "", "one kind of figure at a time");
  const std::string which = options.which.value_or("");
  if (is_model_file(call)) {
    if (!is_of_models(kind)) throw no_result(call, kind);
    for (const auto* given : {&options.which, &options.with}) {
      if (given->is_given) throw given->wrong("is for figures of results");
    }
    return write_figure(call, figure_of_model(call.model(), kind, call.file), options.picture);
  }
  ResultView result(call.file);
  call.adopt_units(result.model ? result.model->source : "");
  set_frequency_unit(options.frequency, result);
  if (kind.empty()) return list_of(call, options, result);
  result.window = window_of(options.window);
  result.view = view_of(options.view);
  result.probe = probe_named(result, which);
  return write_figure(call, chosen_figure(result, {kind, which, options.with.value_or("")}),
                      options.picture);
}

}  // namespace

Verb plot_verb() {
  return {
      .name = "plot",
      .group = "Results",
      .summary = "one figure of a result, or the layout of a model, ready for a paper",
      .takes = "FILE",
      .takes_more = "KIND",
      .takes_more_help = "what to draw; left out: lists what the result holds",
      .example = "whirl plot run.h5 orbit --out orbit.svg",
      .run = run_plot,
  };
}

}  // namespace whirl::inline cli
