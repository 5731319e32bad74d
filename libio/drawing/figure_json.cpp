#include "libio/drawing/figure_json.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

#include "libio/drawing/panel_layout.hpp"
#include "libio/drawing/panel_svg.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t exact = 4096;  ///< up to so many numbers in float64

const char* name_of(Dash dash) {
  constexpr const char* names[] = {"solid", "dashed", "dotted", "dash_dot"};
  return names[static_cast<int>(dash)];
}

const char* name_of(Marker marker) {
  constexpr const char* names[] = {"circle",   "square",        "diamond",
                                   "triangle", "triangle_down", "cross"};
  return names[static_cast<int>(marker)];
}

const char* name_of(Anchor anchor) {
  constexpr const char* names[] = {"start", "middle", "end"};
  return names[static_cast<int>(anchor)];
}

Record texts(const std::vector<std::string>& list) {
  Record array = Record::array();
  for (const std::string& text : list) array.add(text);
  return array;
}

Record record_of(const FigureAxis& axis, const Axis& range) {
  Record r;
  r.set("title", axis.title).set("log", axis.scale == Scale::logarithmic);
  r.set("first", range.first).set("last", range.last);
  if (std::isfinite(axis.step)) r.set("step", axis.step);
  if (!axis.also_unit.empty()) r.set("also", axis.also_unit).set("also_factor", axis.also_factor);
  return r;
}

Record record_of(const Curve& c, ArrayStore& arrays) {
  Record r;
  r.set("name", c.name).set("end_name", c.end_name).set("paint", paint_colors(c.paint).name);
  r.set("x", arrays.add(c.x)).set("y", arrays.add(c.y));
  if (c.has_line) r.set("line", c.width).set("dash", name_of(c.dash));
  if (c.has_marker) r.set("marker", name_of(c.marker)).set("size", c.size);
  if (c.marker_every > 1) r.set("every", static_cast<long>(c.marker_every));
  if (c.fill > 0.0) r.set("fill", c.fill);
  if (!c.hover.empty()) r.set("hover", texts(c.hover));
  if (!c.along.empty()) r.set("along", arrays.add(c.along)).set("along_title", c.along_title);
  if (!c.is_key) r.set("is_key", false);
  if (!c.details.empty()) r.set("details", texts(c.details)).set("command", c.command);
  return r;
}

Record record_of(const Cells& cells, ArrayStore& arrays) {
  Record r;
  r.set("x", arrays.add(cells.x)).set("y", arrays.add(cells.y));
  r.set("values", arrays.add(cells.values)).set("title", cells.title);
  if (cells.categories.empty()) {
    r.set("map", cells.map == ColorMap::sequential ? "sequential" : "diverging");
    r.set("first", cells.first).set("last", cells.last);
  } else {
    Record list = Record::array();
    for (const Category& c : cells.categories) {
      list.add(Record().set("name", c.name).set("paint", paint_colors(c.paint).name));
    }
    r.set("categories", list);
  }
  if (cells.prints_values) r.set("prints_values", true);
  if (!cells.x_names.empty()) r.set("x_names", texts(cells.x_names));
  if (!cells.y_names.empty()) r.set("y_names", texts(cells.y_names));
  if (!cells.command.empty()) {
    r.set("command", cells.command).set("x_factor", cells.x_factor).set("y_factor", cells.y_factor);
  }
  return r;
}

Record record_of(const Panel& p, ArrayStore& arrays) {
  const PanelAxes axes = axes_of(p);
  Record r;
  r.set("title", p.title).set("x", record_of(p.x, axes.x)).set("y", record_of(p.y, axes.y));
  r.set("share", p.share).set("cursor", p.cursor);
  if (p.has_equal_scales) r.set("equal", true);
  if (!p.has_frame) r.set("frame", false);
  Record curves = Record::array(), rules = Record::array(), labels = Record::array();
  for (const Curve& c : p.curves) curves.add(record_of(c, arrays));
  for (const Rule& rule : p.rules) {
    constexpr const char* kinds[] = {"vertical", "horizontal", "slope"};
    Record entry;
    entry.set("kind", kinds[static_cast<int>(rule.kind)]).set("at", rule.at);
    entry.set("name", rule.name).set("paint", paint_colors(rule.paint).name);
    rules.add(entry.set("dash", name_of(rule.dash)));
  }
  for (const Label& l : p.labels) {
    Record entry;
    entry.set("x", l.x).set("y", l.y).set("text", l.text).set("anchor", name_of(l.anchor));
    labels.add(entry.set("dx", l.dx).set("dy", l.dy).set("paint", paint_colors(l.paint).name));
  }
  r.set("curves", curves).set("rules", rules).set("labels", labels);
  if (!p.cells.empty()) r.set("cells", record_of(p.cells, arrays));
  return r;
}

}  // namespace

std::string base64(const void* bytes, std::size_t size) {
  constexpr const char* signs = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const unsigned char*>(bytes);
  std::string out;
  out.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::uint32_t b = i + 1 < size ? in[i + 1] : 0u, c = i + 2 < size ? in[i + 2] : 0u;
    const std::uint32_t bits = static_cast<std::uint32_t>(in[i]) << 16u | b << 8u | c;
    out += signs[bits >> 18u];
    out += signs[bits >> 12u & 63u];
    out += i + 1 < size ? signs[bits >> 6u & 63u] : '=';
    out += i + 2 < size ? signs[bits & 63u] : '=';
  }
  return out;
}

int ArrayStore::add(const std::vector<double>& values) {
  std::string text;
  if (values.size() <= exact) {
    text = "f64:" + base64(values.data(), values.size() * sizeof(double));
  } else {
    const std::vector<float> small(values.begin(), values.end());
    text = "f32:" + base64(small.data(), small.size() * sizeof(float));
  }
  const auto [place, is_new] = numbers_.try_emplace(text, static_cast<int>(texts_.size()));
  if (is_new) texts_.push_back(std::move(text));
  return place->second;
}

Record ArrayStore::record() const {
  return texts(texts_);
}

Record record_of(const Figure& figure, ArrayStore& arrays) {
  Record r;
  r.set("kind", figure.kind).set("heading", figure.heading).set("variant", figure.variant);
  constexpr const char* subjects[] = {"numbers", "rotor", "orbit"};
  r.set("subject", subjects[static_cast<int>(figure.subject)]);
  r.set("title", figure.title).set("subtitle", figure.subtitle);
  r.set("columns", figure.columns).set("width", figure.width).set("height", figure.height);
  Record panels = Record::array();
  for (const Panel& p : figure.panels) panels.add(record_of(p, arrays));
  r.set("panels", panels);
  Record rows = Record::array();
  for (const auto& row : figure.table.rows) rows.add(texts(row));
  r.set("table", Record().set("header", texts(figure.table.header)).set("rows", rows));
  return r.set("notes", texts(figure.notes));
}

Record color_record() {
  Record paints, maps;
  for (int i = 0; i < paint_count(); ++i) {
    const PaintColors& p = paint_colors(static_cast<Paint>(i));
    Record list = Record::array();
    for (const char* color : {p.light, p.light_text, p.dark}) list.add(color);
    paints.set(p.name, list);
  }
  for (const ColorMap map : {ColorMap::sequential, ColorMap::diverging}) {
    Record stops = Record::array();
    for (const Rgb& c : color_stops(map)) {
      Record rgb = Record::array();
      for (const int part : {c.r, c.g, c.b}) rgb.add(part);
      stops.add(rgb);
    }
    maps.set(map == ColorMap::sequential ? "sequential" : "diverging", stops);
  }
  return Record().set("paints", paints).set("maps", maps);
}

Record style_record() {
  const figure_style::Rooms& rooms = figure_style::wide;
  Record r, dashes;
  r.set("left", rooms.left).set("under", rooms.under).set("above", rooms.above);
  r.set("between", rooms.between).set("title", rooms.title).set("tick_label", rooms.tick_label);
  r.set("axis_title", rooms.axis_title).set("name", rooms.name).set("leader", rooms.leader);
  r.set("bar", rooms.bar).set("bar_width", rooms.bar_width).set("bar_room", rooms.bar_room);
  r.set("per_label_x", rooms.per_label_x).set("per_label_y", rooms.per_label_y);
  for (const Dash dash : {Dash::solid, Dash::dashed, Dash::dotted, Dash::dash_dot}) {
    Record lengths = Record::array();
    std::istringstream text(figure_style::dashes_of(dash));
    for (double length = 0.0; text >> length;) lengths.add(length);
    dashes.set(name_of(dash), lengths);
  }
  return r.set("dashes", dashes);
}

}  // namespace whirl::inline io
