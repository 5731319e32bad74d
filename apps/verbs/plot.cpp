#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/result_input.hpp"
#include "apps/version.hpp"
#include "libbase/error.hpp"
#include "libbase/program.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/figures.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

namespace fs = std::filesystem;

ModelError wrong(const std::string& what, std::string message) {
  return ModelError({what}, "", std::move(message));
}

/// What a result can be drawn as, and for which stations, contacts or planes.
struct Choice {
  const FigureKind* kind;
  std::vector<std::string> variants;
  std::string problem = {};  ///< why it cannot be drawn; empty: it can
};

std::vector<Choice> choices_of(const ResultView& result) {
  std::vector<Choice> choices;
  for (const FigureKind& kind : figure_kinds()) {
    Choice choice{&kind, {}};
    try {
      for (const Figure& f : figures_of(kind, result)) choice.variants.push_back(f.variant);
    } catch (const std::exception& error) {  // what fails of one does not cost the others
      choice.problem = error.what();
    }
    if (!choice.variants.empty() || !choice.problem.empty()) choices.push_back(std::move(choice));
  }
  return choices;
}

Report list_of(const Invocation& call, const ResultView& result) {
  Report report;
  Table table({"kind", "shows", "--which"});
  Record kinds = Record::array();
  std::string problems;
  for (const Choice& c : choices_of(result)) {
    if (!c.problem.empty()) {
      problems += fmt::format("  {} cannot be drawn: {}\n", c.kind->name, c.problem);
      continue;
    }
    Record variants = Record::array();
    std::string names;
    for (const std::string& v : c.variants) {
      if (v.empty()) continue;
      variants.add(v);
      names += (names.empty() ? "" : " | ") + v;
    }
    table.row({std::string(c.kind->name), std::string(c.kind->summary), names});
    kinds.add(Record().set("kind", c.kind->name).set("variants", variants));
  }
  report.record.set("model", call.file).set("version", version).set("kinds", kinds);
  report.record.set("files", Record::array());
  report.text = fmt::format("{} can be drawn as\n\n{}{}\n  whirl plot {} KIND --out FILE.svg\n",
                            call.file, table.text(), problems, call.file);
  return report;
}

/// The kind of a name; wrong names are told with what there is.
const FigureKind& kind_of(const std::string& name, const ResultView& result) {
  std::vector<std::string> known, here;
  for (const FigureKind& kind : figure_kinds()) {
    known.emplace_back(kind.name);
    if (is_in(kind, result)) here.emplace_back(kind.name);
  }
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) {
    const auto near = nearest(name, known);
    throw wrong(name,
                near ? fmt::format("unknown kind of figure, did you mean \"{}\"?", *near)
                     : fmt::format("unknown kind of figure, there are {}", fmt::join(known, ", ")));
  }
  const FigureKind& kind = figure_kinds()[static_cast<std::size_t>(found - known.begin())];
  if (!is_in(kind, result)) {
    throw wrong(name,
                fmt::format("the result does not hold what this figure needs; it can be "
                            "drawn as {}",
                            here.empty() ? "nothing" : fmt::format("{}", fmt::join(here, ", "))));
  }
  return kind;
}

/// Kinds of which a stretch of the motion can be drawn.
std::vector<std::string_view> kinds_in_time() {
  std::vector<std::string_view> names;
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.takes_window) names.push_back(kind.name);
  }
  return names;
}

const Figure& chosen(const std::vector<Figure>& figures, const std::string& which) {
  if (which.empty()) return figures.front();
  std::vector<std::string> names;
  for (const Figure& f : figures) {
    if (f.variant == which) return f;
    names.push_back(f.variant);
  }
  for (const Figure& f : figures) {  // "ring" of "7 ring"
    if (f.variant.find(which) != std::string::npos) return f;
  }
  throw wrong("--which " + which,
              fmt::format("there is no such figure; there are {}", fmt::join(names, ", ")));
}

constexpr double least_size = 20.0, most_size = 2000.0;  ///< sides of a picture [mm]
constexpr double least_font = 4.0, most_font = 40.0;     ///< [pt]

/// A size such as 85x60mm: two numbers, and a unit of both or one of each.
/// @throws ModelError
PictureSize size_of(const Invocation& call) {
  PictureSize size{.has_title = !call.has("no-title")};
  if (call.has("font")) {
    const std::string text = call.text("font");
    size.font = std::strtod(text.c_str(), nullptr);
    if (text.find_first_not_of("0123456789.") != std::string::npos ||
        !(size.font >= least_font && size.font <= most_font)) {
      throw wrong("--font " + text,
                  fmt::format("expected points, {:g} to {:g}", least_font, most_font));
    }
  }
  if (!call.has("size")) return size;
  const std::string text = call.text("size");
  const std::regex pattern(R"(([0-9]*\.?[0-9]+)(mm|cm|in|pt)?x([0-9]*\.?[0-9]+)(mm|cm|in|pt))");
  const std::map<std::string, double> units{
      {"mm", 1.0}, {"cm", 10.0}, {"in", 25.4}, {"pt", 25.4 / 72.0}};
  std::smatch parts;
  if (std::regex_match(text, parts, pattern)) {
    const std::string unit = parts[4], first = parts[2].length() > 0 ? parts[2].str() : unit;
    size.width = std::stod(parts[1]) * units.at(first);
    size.height = std::stod(parts[3]) * units.at(unit);
  }
  const auto is_fit = [](double side) { return side >= least_size && side <= most_size; };
  if (!is_fit(size.width) || !is_fit(size.height)) {
    throw wrong("--size " + text,
                fmt::format("expected a size such as 85x60mm (mm, cm, in, pt), of {:g} to {:g} mm",
                            least_size, most_size));
  }
  return size;
}

/// "svg", "png" or "pdf", of --format or of the file's name.
std::string format_of(const Invocation& call) {
  const fs::path out = call.text("out");
  std::string format = call.text("format");
  const std::vector<std::string> known{"svg", "png", "pdf"};
  const auto is_known = [&] {
    return std::find(known.begin(), known.end(), format) != known.end();
  };
  if (!format.empty() || call.has("format")) {
    if (!is_known()) throw wrong("--format " + format, "expected svg, png or pdf");
    return format;
  }
  if (out.empty()) return "svg";
  const std::string ending = out.extension();
  format = ending.empty() ? "" : ending.substr(1);
  if (!is_known()) {
    throw wrong("--out " + out.string(),
                "expected a file that ends in .svg, .png or .pdf, or --format");
  }
  return format;
}

/// Lets rsvg-convert make another format of an SVG file.
void convert(const fs::path& svg, const fs::path& to, const std::string& format, bool is_printed) {
  std::vector<std::string> words{"rsvg-convert", "--format", format};
  if (format == "png" && is_printed) {
    words.insert(words.end(), {"--dpi-x", "600", "--dpi-y", "600"});
  } else if (format == "png") {
    words.insert(words.end(), {"--zoom", "2"});
  } else {  // a pixel is 1/96 inch, as in browsers
    words.insert(words.end(), {"--dpi-x", "96", "--dpi-y", "96"});
  }
  // absolute, so that no name is taken for an option
  words.insert(words.end(), {"--output", fs::absolute(to).string(), fs::absolute(svg).string()});
  const std::optional<int> status = run_program(words);
  if (!status) {
    throw FileError(fmt::format(
        "cannot write {}: this needs rsvg-convert, of the Debian package librsvg2-bin (or write an "
        ".svg)",
        to.string()));
  }
  if (*status != 0) {
    throw FileError(fmt::format("cannot write {}: rsvg-convert failed", to.string()));
  }
}

/// @param is_printed  whether its size is one on paper
void write_picture(const std::string& svg, const fs::path& to, const std::string& format,
                   bool is_printed, Replaces replaces) {
  if (format == "svg") return replace_file(to, svg, replaces);
  FileReplacement file(to, replaces);
  const fs::path source = to.string() + fmt::format(".{}.svg", ::getpid());
  std::error_code ignored;
  try {
    replace_file(source, svg);
    convert(source, file.temporary(), format, is_printed);
    mark_as_own(file.temporary());
    file.commit();
  } catch (...) {
    fs::remove(source, ignored);
    throw;
  }
  fs::remove(source, ignored);
}

Report run_plot(const Invocation& call) {
  require_result(call, call.words.empty() ? "" : call.words[0]);
  ResultView result(call.file);
  set_frequency_unit(call, result);
  if (call.words.size() > 1) throw wrong(call.words[1], "one kind of figure at a time");
  if (call.words.empty()) {
    for (const char* option : {"out", "with", "size", "font", "format", "no-title"}) {
      if (!call.has(option)) continue;
      throw wrong(fmt::format("--{} {}", option, call.given.at(option)), "which kind of figure?");
    }
    return list_of(call, result);
  }
  const FigureKind& kind = kind_of(call.words[0], result);
  result.window = window_of(call);
  if (result.window.is_given() && !kind.takes_window) {
    throw wrong("--revolutions, --from-revolution, --times",
                fmt::format("are of motions in time: {}", fmt::join(kinds_in_time(), ", ")));
  }
  auto figures = figures_of(kind, result);
  if (figures.empty()) {
    throw wrong(call.words[0], "there is nothing to draw in this result");
  }
  if (const std::string with = call.text("with"); !with.empty()) {
    const std::string problem =
        lay_over(figures, result, ResultView(with), fs::path(with).filename());
    if (!problem.empty()) throw wrong("--with " + with, problem);
  }
  const Figure& figure = chosen(figures, call.text("which"));
  const PictureSize size = size_of(call);
  const std::string format = format_of(call);
  const fs::path out = call.text_or(
      "out", fmt::format("{}_{}.{}", fs::path(call.file).replace_extension("").string(), kind.name,
                         format));
  const Picture picture = picture_of(figure, size);
  write_picture(picture.svg, out, format, size.is_given() || size.font > 0.0,
                call.picture_replaces());
  Report report;
  report.record.set("model", call.file).set("version", version);
  report.record.set("kind", kind.name).set("variant", figure.variant);
  Record files = Record::array();
  files.add(out.string());
  report.record.set("files", files);
  report.notes = figure.notes;
  report.text = fmt::format("  {}: {}\n", out.string(), figure.subtitle);
  Record left_out = Record::array();
  for (const std::string& what : picture.left_out) {
    left_out.add(what);
    report.text += fmt::format("  no room for {}; a larger --size shows it\n", what);
  }
  report.record.set("left_out", left_out);
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
      .options =
          {{"out", "FILE", "picture, .svg, .png or .pdf; left out: .svg beside the result"},
           {"which", "NAME",
            "of several of a kind: the station, contact or plane; left out: the first"},
           {"with", "OTHER.h5",
            "branches over bifurcation, borders over map, where both are of the same values"},
           {"size", "WxHmm", "of the printed picture, such as 85x60mm; cm, in and pt too"},
           {"font", "PT", "letters of axes and legend in points; left out: 9, with --size 8"},
           {"no-title", "", "without title and subtitle, for a caption below"},
           {"format", "F", "svg, png or pdf, whatever --out ends in"},
           from_revolution_option,
           {"revolutions", "N",
            "revolutions of a motion, given alone: the last ones; left out: 8, orbit 48, poincare "
            "all"},
           times_option,
           frequency_option},
      .run = run_plot,
  };
}

}  // namespace whirl::inline cli
