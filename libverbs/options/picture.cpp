#include "libverbs/options/picture.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "libio/drawing/figure_svg.hpp"
#include "libio/drawing/figure_view.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/result_input.hpp"

namespace whirl::inline cli {

namespace {

PictureFormat format_of(const PictureVerbOptions& options) {
  const std::string out = options.out.value_or("");
  if (options.format) {
    const std::string problem = ending_problem(out, fmt::format(".{}", name_of(*options.format)));
    if (!problem.empty()) throw options.out.wrong(problem);
    return *options.format;
  }
  return out.empty() ? PictureFormat::svg : parsed_option("out", out, picture_format_of);
}

FigureView view_of(const FigureViewOptions& options, double pixels_per_point) {
  const auto text = [](const Option<std::string>& option) {
    if (option.is_given && option.text.empty()) throw option.wrong("expected a value");
    return option.value_or("");
  };
  return {.panels = text(options.panels),
          .x_range = text(options.xlim),
          .y_range = text(options.ylim),
          .log = text(options.log),
          .x_label = text(options.xlabel),
          .y_label = text(options.ylabel),
          .labels = text(options.labels),
          .title = text(options.title),
          .marker = text(options.marker),
          .marker_size = options.marker_size.value_or(0.0) * pixels_per_point};
}

}  // namespace

Report write_figure(const Invocation& call, Figure figure, const PictureVerbOptions& options) {
  const PrintedSides sides = options.size.value_or({});
  const PictureSize size{sides.width, sides.height, options.font.value_or(0.0), !options.no_title};
  if (options.no_title && options.view.title) {
    throw options.view.title.wrong("does not go with --no-title");
  }
  std::vector<std::string> notes = figure.notes;
  const std::vector<std::string> told =
      change_view(figure, view_of(options.view, pixels_per_point(size)));
  notes.insert(notes.end(), told.begin(), told.end());
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
  report.notes = std::move(notes);
  report.text = fmt::format("  {}: {}\n", out, figure.subtitle);
  for (const std::string& what : picture.left_out) {
    report.text += fmt::format("  no room for {}; a larger --size shows it\n", what);
  }
  report.record.set("left_out", Record::Array(picture.left_out.begin(), picture.left_out.end()));
  return report;
}

}  // namespace whirl::inline cli
