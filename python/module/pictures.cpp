#include "python/module/pictures.hpp"

#include <pybind11/stl.h>

#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/choice.hpp"
#include "libio/page/report_page.hpp"
#include "libverbs/command/version.hpp"

namespace whirl::inline python {

namespace py = pybind11;

struct Drawn::State {
  explicit State(const std::string& file) : view(file) {}
  ResultView view;
};

namespace {

py::dict axis_of(const FigureAxis& axis) {
  py::dict d;
  d["title"] = axis.title;
  d["is_log"] = axis.scale == Scale::logarithmic;
  d["first"] = axis.first;
  d["last"] = axis.last;
  return d;
}

const char* name_of_dash(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "--";
    case Dash::dotted:
      return ":";
    case Dash::dash_dot:
      return "-.";
    default:
      return "-";
  }
}

py::dict curve_of(const Curve& c) {
  py::dict d;
  d["name"] = c.name;
  d["color"] = paint_colors(c.paint).light;
  d["x"] = c.x;
  d["y"] = c.y;
  d["has_line"] = c.has_line;
  d["dash"] = name_of_dash(c.dash);
  d["has_marker"] = c.has_marker;
  d["size"] = c.size;
  return d;
}

py::dict cells_of(const Cells& cells) {
  py::dict d;
  d["x"] = cells.x;
  d["y"] = cells.y;
  d["values"] = cells.values;
  d["title"] = cells.title;
  py::list categories;
  for (const Category& c : cells.categories) {
    categories.append(py::make_tuple(c.name, paint_colors(c.paint).light));
  }
  d["categories"] = categories;
  d["first"] = cells.first;
  d["last"] = cells.last;
  d["is_diverging"] = cells.map == ColorMap::diverging;
  d["x_names"] = cells.x_names;
  d["y_names"] = cells.y_names;
  return d;
}

py::dict panel_of(const Panel& panel) {
  py::dict d;
  d["title"] = panel.title;
  d["x"] = axis_of(panel.x);
  d["y"] = axis_of(panel.y);
  d["has_equal_scales"] = panel.has_equal_scales;
  py::list curves;
  for (const Curve& c : panel.curves) curves.append(curve_of(c));
  d["curves"] = curves;
  d["cells"] = cells_of(panel.cells);
  py::list rules;
  for (const Rule& r : panel.rules) {
    const char* kind = r.kind == Rule::Kind::vertical     ? "vertical"
                       : r.kind == Rule::Kind::horizontal ? "horizontal"
                                                          : "slope";
    rules.append(
        py::make_tuple(kind, r.at, r.name, paint_colors(r.paint).light, name_of_dash(r.dash)));
  }
  d["rules"] = rules;
  py::list labels;
  for (const Label& l : panel.labels) labels.append(py::make_tuple(l.x, l.y, l.text));
  d["labels"] = labels;
  return d;
}

}  // namespace

Drawn::Drawn(const std::string& file) {
  const py::gil_scoped_release others_run;
  state_ = std::make_unique<State>(file);
}

Drawn::~Drawn() = default;

py::list Drawn::kinds() const {
  const DrawableKinds all = [&] {
    const py::gil_scoped_release others_run;
    return drawable_kinds(state_->view);
  }();
  py::list kinds;
  for (const DrawableKind& kind : all.kinds) {
    kinds.append(py::make_tuple(kind.name, kind.summary, kind.variants, verb_for(kind.name)));
  }
  return kinds;
}

std::string Drawn::svg(const std::string& kind, const std::string& variant) const {
  const py::gil_scoped_release others_run;
  return svg_of(chosen_figure(state_->view, {kind, variant}));
}

py::dict Drawn::figure(const std::string& kind, const std::string& variant) const {
  const Figure figure = chosen_figure(state_->view, {kind, variant});
  py::dict d;
  d["title"] = figure.title;
  d["subtitle"] = figure.subtitle;
  d["columns"] = figure.columns;
  d["width"] = figure.width;
  d["height"] = figure.height;
  d["notes"] = figure.notes;
  py::list panels;
  for (const Panel& panel : figure.panels) panels.append(panel_of(panel));
  d["panels"] = panels;
  return d;
}

std::string report_html(const std::vector<std::string>& files) {
  const py::gil_scoped_release others_run;
  std::vector<std::unique_ptr<ResultView>> results;
  for (const std::string& file : files) results.push_back(std::make_unique<ResultView>(file));
  return report_page(results, cover_of(results, version)).html;
}

}  // namespace whirl::inline python
