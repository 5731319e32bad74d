#include "libio/figures/choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "libbase/error.hpp"
#include "libdata/measured/order_tracking.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/results/call.hpp"
#include "libio/text/nearest.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline io {

namespace {

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
    throw ModelError(
        {name}, "",
        near ? fmt::format("unknown kind of figure, did you mean \"{}\"?", *near)
             : fmt::format("unknown kind of figure; this result can be drawn as {}",
                           here.empty() ? "nothing" : fmt::format("{}", fmt::join(here, ", "))));
  }
  const FigureKind& kind = figure_kinds()[static_cast<std::size_t>(found - known.begin())];
  if (is_in(kind, result)) return kind;
  throw ModelError(
      {name}, "",
      fmt::format("the result does not hold what this figure needs; it can be "
                  "drawn as {}",
                  here.empty() ? "nothing" : fmt::format("{}", fmt::join(here, ", "))));
}

/// @throws ModelError  for a kind that shows no motion in time
void require_window(const FigureKind& kind) {
  if (kind.takes_window) return;
  std::vector<std::string_view> names;
  for (const FigureKind& other : figure_kinds()) {
    if (other.takes_window) names.push_back(other.name);
  }
  throw wrong_window(fmt::format("are of motions in time: {}", fmt::join(names, ", ")));
}

/// @throws ModelError  for an option of motions that a kind does not take
void require_view(const FigureKind& kind, const MotionView& view) {
  for (const auto& given : view.given) {
    const auto& [option, text] = given;
    const auto takes = [&given](const FigureKind& k) {
      return std::find(k.takes.begin(), k.takes.end(), given.first) != k.takes.end();
    };
    if (takes(kind)) continue;
    std::vector<std::string_view> names;
    for (const FigureKind& other : figure_kinds()) {
      if (takes(other)) names.push_back(other.name);
    }
    throw wrong_option(option, text, fmt::format("is for figures {}", fmt::join(names, ", ")));
  }
}

/// The figure of a probe: the first that shows what it reads, else that of the station where it is.
Figure* figure_with(std::vector<Figure>& figures, const Probe& probe, const ResultView& result) {
  for (Figure& f : figures) {
    if (std::find(f.probes.begin(), f.probes.end(), probe.name) != f.probes.end()) return &f;
  }
  for (Figure& f : figures) {
    const std::string station = f.variant.substr(0, f.variant.find(" ("));  // "7 ring (up)"
    if (f.probes.empty() && figures::is_at(result, probe.at, station)) return &f;
  }
  return nullptr;
}

Figure& variant_of(std::vector<Figure>& figures, const std::string& name,
                   const ResultView& result) {
  if (name.empty()) return figures.front();
  std::vector<std::string> names, probes;
  for (Figure& f : figures) {
    if (f.variant == name) return f;
    names.push_back(f.variant);
  }
  for (Figure& f : figures) {
    if (std::find(f.probes.begin(), f.probes.end(), name) != f.probes.end()) return f;
  }
  if (const Probe* probe = figures::probe_of(result, name)) {
    if (Figure* f = figure_with(figures, *probe, result)) return *f;
  }
  for (Figure& f : figures) {  // "ring" of "7 ring"
    if (f.variant.find(name) != std::string::npos) return f;
  }
  if (result.model) {
    for (const Probe& probe : result.model->structure.probes) {
      if (figure_with(figures, probe, result)) probes.push_back(probe.name);
    }
  }
  throw wrong_option(
      "which", name,
      fmt::format("there is no such figure; there are {}{}{}", fmt::join(names, " | "),
                  probes.empty() ? "" : "; of probes ", fmt::join(probes, " | ")));
}

}  // namespace

std::string probe_named(const ResultView& result, const std::string& name) {
  if (figures::probe_of(result, name)) return name;
  if (name.empty() || !result.file.has(dataset_of<OrderTracking>(&OrderCurve::name))) return "";
  const auto& curves = figures::result_of<OrderTracking>(result).curves;
  const bool is_measured = std::any_of(curves.begin(), curves.end(),
                                       [&](const OrderCurve& c) { return c.name == name; });
  return is_measured ? name : "";
}

DrawableKinds drawable_kinds(const ResultView& result) {
  DrawableKinds all;
  for (const FigureKind& kind : figure_kinds()) {
    try {
      const std::vector<Figure> figures = figures_of(kind, result);
      if (figures.empty()) continue;
      DrawableKind drawable{std::string(kind.name), std::string(kind.summary), {}};
      for (const Figure& f : figures) {
        if (!f.variant.empty()) drawable.variants.push_back(f.variant);
      }
      all.kinds.push_back(std::move(drawable));
    } catch (const std::exception& error) {  // what fails of one does not cost the others
      all.problems.push_back(fmt::format("{} cannot be drawn: {}", kind.name, error.what()));
    }
  }
  return all;
}

std::string text_of(const DrawableKinds& all, const std::string& file) {
  Table table({"kind", "shows", "--which"});
  for (const DrawableKind& kind : all.kinds) {
    table.row({kind.name, kind.summary, fmt::format("{}", fmt::join(kind.variants, " | "))});
  }
  std::string text = fmt::format("{} can be drawn as\n\n{}", file, table.text());
  for (const std::string& problem : all.problems) text += fmt::format("  {}\n", problem);
  return text + fmt::format("\n  whirl plot {} KIND --out FILE.svg\n", shell_word(file));
}

Figure chosen_figure(const ResultView& result, const FigureChoice& choice) {
  const FigureKind& kind = kind_of(choice.kind, result);
  if (result.window.is_given()) require_window(kind);
  require_view(kind, result.view);
  std::vector<Figure> figures = figures_of(kind, result);
  if (figures.empty()) {
    throw ModelError({choice.kind}, "", "there is nothing to draw in this result");
  }
  if (!choice.with.empty()) {
    const std::string problem = lay_over(figures, result, ResultView(choice.with),
                                         std::filesystem::path(choice.with).filename());
    if (!problem.empty()) throw wrong_option("with", choice.with, problem);
  }
  return std::move(variant_of(figures, choice.variant, result));
}

bool is_of_models(const std::string& kind) {
  return std::any_of(figure_kinds().begin(), figure_kinds().end(),
                     [&](const FigureKind& k) { return k.name == kind && k.of_model; });
}

Figure figure_of_model(const Model& model, const std::string& kind, const std::string& file) {
  for (const FigureKind& k : figure_kinds()) {
    if (k.name != kind || !k.of_model) continue;
    std::vector<Figure> figures = k.of_model(model, Assembler(linear_structure(model)));
    if (figures.empty()) break;
    Figure figure = std::move(figures.front());
    figure.kind = k.name;
    figure.heading = k.title;
    figure.subject = k.subject;
    if (figure.title.empty()) figure.title = model.title;
    if (figure.title.empty()) figure.title = std::filesystem::path(file).filename().string();
    return figure;
  }
  throw ModelError({kind}, "", "the model has neither a shaft nor contacts, which could be drawn");
}

std::string verb_for(std::string_view kind) {
  // results have a group by the name of the verb, with these exceptions
  static const std::map<std::string_view, std::string_view> others{
      {"trajectory", "simulate"}, {"spectra", "simulate"}, {"mac", "identify"},
      {"measured", "identify"},   {"orders", "identify"},  {"record", "identify"},
      {"trend", "identify"},      {"branch", "continue"},  {"border", "continue"}};
  for (const FigureKind& k : figure_kinds()) {
    if (k.name != kind || k.first_need().empty()) continue;
    const std::string first = k.first_need();
    const std::string_view path = first;
    const std::string_view group = path.substr(1, path.find('/', 1) - 1);
    const auto other = others.find(group);
    return std::string(other != others.end() ? other->second : group);
  }
  return "simulate";
}

}  // namespace whirl::inline io
