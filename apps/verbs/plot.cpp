#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/program.hpp"
#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/result_input.hpp"
#include "apps/version.hpp"
#include "libfe/base/error.hpp"
#include "libio/figure_svg.hpp"
#include "libio/figures.hpp"
#include "libio/nearest.hpp"
#include "libio/own_file.hpp"
#include "libio/replace_file.hpp"
#include "libio/table.hpp"

namespace whirl {

namespace {

namespace fs = std::filesystem;

ModelError wrong(const std::string& what, std::string message) {
  return ModelError({what}, "", std::move(message));
}

/// What a result can be drawn as, and for which stations, contacts or planes.
struct Choice {
  const FigureKind* kind;
  std::vector<std::string> variants;
};

std::vector<Choice> choices_of(const ResultView& result) {
  std::vector<Choice> choices;
  for (const FigureKind& kind : figure_kinds()) {
    Choice choice{&kind, {}};
    const auto figures = figures_of(kind, result);
    for (const Figure& f : figures) choice.variants.push_back(f.variant);
    if (!figures.empty()) choices.push_back(std::move(choice));
  }
  return choices;
}

Report list_of(const Invocation& call, const ResultView& result) {
  Report report;
  Table table({"kind", "shows", "--which"});
  Record kinds = Record::array();
  for (const Choice& c : choices_of(result)) {
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
  report.text = fmt::format("{} can be drawn as\n\n{}\n  whirl plot {} KIND --out FILE.svg\n",
                            call.file, table.text(), call.file);
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

/// Lets rsvg-convert make another format of an SVG file.
void convert(const fs::path& svg, const fs::path& to, const std::string& format) {
  std::vector<std::string> words{"rsvg-convert", "--format", format};
  if (format == "png") words.insert(words.end(), {"--zoom", "2"});
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

void write_picture(const std::string& svg, const fs::path& to, Replaces replaces) {
  const std::string ending = to.extension();
  if (ending == ".svg") return replace_file(to, svg, replaces);
  FileReplacement file(to, replaces);
  const fs::path source = to.string() + fmt::format(".{}.svg", ::getpid());
  std::error_code ignored;
  try {
    replace_file(source, svg);
    convert(source, file.temporary(), ending.substr(1));
    mark_as_own(file.temporary());
    file.commit();
  } catch (...) {
    fs::remove(source, ignored);
    throw;
  }
  fs::remove(source, ignored);
}

}  // namespace

Report run_plot(const Invocation& call) {
  require_result(call, call.words.empty() ? "" : call.words[0]);
  ResultView result(call.file);
  set_frequency_unit(call, result);
  if (call.words.size() > 1) throw wrong(call.words[1], "one kind of figure at a time");
  if (call.words.empty()) {
    for (const char* option : {"out", "with"}) {
      if (!call.has(option)) continue;
      throw wrong(fmt::format("--{} {}", option, call.given.at(option)), "which kind of figure?");
    }
    return list_of(call, result);
  }
  const FigureKind& kind = kind_of(call.words[0], result);
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
  const fs::path out = call.text(
      "out",
      fmt::format("{}_{}.svg", fs::path(call.file).replace_extension("").string(), kind.name));
  const std::string ending = out.extension();
  if (ending != ".svg" && ending != ".png" && ending != ".pdf") {
    throw wrong("--out " + out.string(), "expected a file that ends in .svg, .png or .pdf");
  }
  write_picture(svg_of(figure), out, call.picture_replaces());
  Report report;
  report.record.set("model", call.file).set("version", version);
  report.record.set("kind", kind.name).set("variant", figure.variant);
  Record files = Record::array();
  files.add(out.string());
  report.record.set("files", files);
  report.text = fmt::format("  {}: {}\n", out.string(), figure.subtitle);
  return report;
}

}  // namespace whirl
