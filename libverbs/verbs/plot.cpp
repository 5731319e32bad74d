#include <fmt/format.h>

#include "libio/drawing/figure_svg.hpp"
#include "libio/drawing/picture_file.hpp"
#include "libio/figures/choice.hpp"
#include "libio/results/columns.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

struct PlotVerbOptions {
  Option<std::string> out =
      output_option("out", "FILE", "picture, .svg, .png or .pdf; left out: .svg beside the result");
  Option<std::string> which{
      "which", "NAME",
      "of several of a kind: the station, probe, contact or plane; left out: the first"};
  Option<std::string> with = file_option(
      "with", "OTHER.h5",
      "branches over bifurcation, bifurcation curves over map, where both are of the same values");
  Option<PrintedSides> size{
      "size", "WxHmm", "of the printed picture, such as 85x60mm; cm, in and pt too", parse_sides};
  Option<double> font{
      "font", "PT", "letters of axes and legend in points; left out: 9, with --size 8", parse_font};
  Flag no_title{"no-title", "without title and subtitle, for a caption below"};
  Option<PictureFormat> format{"format", "F",
                               "svg, png or pdf, where --out does not end in one of them"};
  WindowVerbOptions window{
      .revolutions = {"revolutions", "N",
                      "revolutions of a motion, given alone: the last ones; left out: 8, orbit 48, "
                      "poincare all",
                      revolution_range}};
  Option<std::string> frequency = frequency_option();
  auto fields() {
    return std::tie(out, which, with, size, font, no_title, format, window, frequency);
  }
};

/// What the result can be drawn as.
Report list_of(const Invocation& call, const PlotVerbOptions& options, const ResultView& result) {
  const auto refuse = [](const auto&... given) {
    ((given.is_given ? throw given.wrong("which kind of figure?") : void()), ...);
  };
  refuse(options.out, options.with, options.size, options.font, options.format, options.no_title);
  const DrawableKinds all = drawable_kinds(result);
  Report report = begin_report(call);
  report.record.merge(record_of(all)).set("files", file_list({}));
  report.text = text_of(all, call.file);
  return report;
}

PictureFormat format_of(const PlotVerbOptions& options) {
  const std::string out = options.out.value_or("");
  if (options.format) {
    const std::string problem = ending_problem(out, fmt::format(".{}", name_of(*options.format)));
    if (!problem.empty()) throw options.out.wrong(problem);
    return *options.format;
  }
  return out.empty() ? PictureFormat::svg : parsed_option("out", out, picture_format_of);
}

Report run_plot(const Invocation& call, const PlotVerbOptions& options) {
  require_result(call, call.words.empty() ? "" : call.words[0]);
  ResultView result(call.file);
  set_frequency_unit(options.frequency, result);
  if (call.words.size() > 1) throw ModelError({call.words[1]}, "", "one kind of figure at a time");
  if (call.words.empty()) return list_of(call, options, result);
  result.window = window_of(options.window);
  result.probe = probe_named(result, options.which.value_or(""));
  const Figure figure =
      chosen_figure(result, {call.words[0], options.which.value_or(""), options.with.value_or("")});
  const PrintedSides sides = options.size.value_or({});
  const PictureSize size{sides.width, sides.height, options.font.value_or(0.0), !options.no_title};
  const PictureFormat format = format_of(options);
  const std::string stem = std::filesystem::path(call.file).replace_extension("").string();
  const std::string out =
      options.out.value_or(fmt::format("{}_{}.{}", stem, figure.kind, name_of(format)));
  const Picture picture = picture_of(figure, size);
  write_picture(picture.svg, out,
                {.format = format,
                 .is_printed = size.is_given() || size.font > 0.0,
                 .replaces = call.picture_replaces()});

  Report report = begin_report(call);
  report.record.set("kind", figure.kind).set("variant", figure.variant);
  report.record.set("files", file_list({out}));
  report.notes = figure.notes;
  report.text = fmt::format("  {}: {}\n", out, figure.subtitle);
  for (const std::string& what : picture.left_out) {
    report.text += fmt::format("  no room for {}; a larger --size shows it\n", what);
  }
  report.record.set("left_out", Record::Array(picture.left_out.begin(), picture.left_out.end()));
  return report;
}

}  // namespace

Verb plot_verb() {
  return {
      .name = "plot",
      .group = "Results",
      .summary = "one figure of a result, ready for a paper",
      .takes = "RESULT.h5",
      .takes_more = "KIND",
      .takes_more_help = "what to draw; left out: lists what the result holds",
      .example = "whirl plot run.h5 orbit --out orbit.svg",
      .run = run_plot,
  };
}

}  // namespace whirl::inline cli
