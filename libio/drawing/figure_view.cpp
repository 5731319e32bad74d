#include "libio/drawing/figure_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "libio/drawing/axis_option.hpp"
#include "libio/text/option_values.hpp"

namespace whirl::inline io {

namespace {

/// Name of a panel for people: its title, or what goes up in it.
std::string name_of(const Panel& p) {
  const std::string title = p.title.substr(0, p.title.find(" | "));
  return title.empty() ? p.y.title : title;
}

/// The panel that a word of --panels means, from 0.
std::size_t panel_of(const Figure& f, const std::string& word, const std::string& text) {
  std::vector<std::string> names;
  for (const Panel& p : f.panels)
    names.push_back(fmt::format("{} {}", names.size() + 1, name_of(p)));
  if (const auto number = parse_whole(word, 1, std::ssize(f.panels))) {
    return static_cast<std::size_t>(*number - 1);
  }
  const bool is_name = !word.empty() && word.find_first_not_of("0123456789") != word.npos;
  for (std::size_t i = 0; is_name && i < f.panels.size(); ++i) {
    if (name_of(f.panels[i]).find(word) != std::string::npos) return i;
  }
  throw wrong_option("panels", text, fmt::format("the figure has {}", fmt::join(names, " | ")));
}

/// Keeps some panels, and of the height what these have.
void keep_panels(Figure& f, const std::string& text) {
  constexpr double around = 90.0, least = 300.0;  // titles and names of axes; a whole figure
  if (text.empty()) return;
  const auto shares = [](const Figure& of) {
    double sum = 0.0;
    for (std::size_t i = 0; i < of.panels.size(); i += static_cast<std::size_t>(of.columns)) {
      sum += of.panels[i].share;
    }
    return sum;
  };
  f.columns = std::max(1, f.columns);
  std::vector<Panel> kept;
  for (const std::string& word : split(text, ','))
    kept.push_back(f.panels[panel_of(f, word, text)]);
  const double all = shares(f);
  f.panels = std::move(kept);
  const int columns = std::min(f.columns, static_cast<int>(f.panels.size()));
  if (columns < f.columns) f.width = std::max(460.0, f.width * columns / f.columns);
  f.columns = columns;
  f.height = std::min(f.height, std::max(least, around + (f.height - around) * shares(f) / all));
}

/// Renames what has a name in a figure; whether there is such a name.
bool rename(Figure& f, const std::string& from, const std::string& to) {
  bool is_there = false;
  const auto change = [&](std::string& name) {
    if (name != from) return;
    name = to;
    is_there = true;
  };
  for (Panel& p : f.panels) {
    change(p.title);
    for (Curve& c : p.curves) change(c.name), change(c.end_name);
    for (Category& c : p.cells.categories) change(c.name);
    if (!p.cells.empty()) change(p.cells.title);
    for (Rule& r : p.rules) change(r.name);
    for (Label& l : p.labels) change(l.text);
  }
  return is_there;
}

void rename_all(Figure& f, const std::string& text) {
  if (text.empty()) return;
  std::vector<std::string> names;
  for (const LegendEntry& e : legend_of(f)) names.push_back(e.name());
  std::vector<std::pair<std::string, std::string>> pairs;
  std::size_t place = 0;
  for (const std::string& part : split(text, ';')) {
    const auto equals = part.find('=');
    Figure copy = f;
    if (equals != part.npos && rename(copy, part.substr(0, equals), "")) {
      pairs.emplace_back(part.substr(0, equals), part.substr(equals + 1));
      continue;
    }
    if (place >= names.size()) {
      throw wrong_option("labels", text,
                         names.empty() ? "the figure has no legend; OLD=NEW changes other names"
                                       : fmt::format("expected names for {}, or OLD=NEW",
                                                     fmt::join(names, " | ")));
    }
    if (!part.empty()) pairs.emplace_back(names[place], part);
    ++place;
  }
  // by way of names that nothing has, so that two names can change places
  const auto held = [](std::size_t i) { return fmt::format("\x01{}", i); };
  for (std::size_t i = 0; i < pairs.size(); ++i) rename(f, pairs[i].first, held(i));
  for (std::size_t i = 0; i < pairs.size(); ++i) rename(f, held(i), pairs[i].second);
}

void name_axis(Figure& f, FigureAxis Panel::*axis, const std::string& option,
               const std::string& text) {
  if (text.empty()) return;
  const std::vector<std::string> names = split(text, ';');
  if (names.size() == 1) {
    const std::string first = (f.panels.front().*axis).title;
    for (Panel& p : f.panels) {
      if ((p.*axis).title == first) (p.*axis).title = text;
    }
    return;
  }
  if (names.size() > f.panels.size()) {
    throw wrong_option(option, text,
                       fmt::format("{} names for {} panels", names.size(), f.panels.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) (f.panels[i].*axis).title = names[i];
  }
}

void change_markers(Figure& f, const FigureView& view) {
  struct Name {
    std::string_view name, sign;
    Marker marker;
  };
  constexpr std::array<Name, markers> known{{{"circle", "o", Marker::circle},
                                             {"square", "s", Marker::square},
                                             {"diamond", "D", Marker::diamond},
                                             {"triangle", "^", Marker::triangle},
                                             {"triangle_down", "v", Marker::triangle_down},
                                             {"cross", "+", Marker::cross}}};
  std::optional<Marker> shape;
  std::vector<std::string_view> names;
  for (const Name& n : known) {
    names.push_back(n.name);
    if (view.marker == n.name || view.marker == n.sign) shape = n.marker;
  }
  if (!view.marker.empty() && !shape) {
    throw wrong_option("marker", view.marker, expected_one_of(names));
  }
  constexpr double shaped = 3.0;  // below, points are drawn as dots
  for (Panel& p : f.panels) {
    for (Curve& c : p.curves) {
      if (!c.has_marker) continue;
      if (shape) c.marker = *shape, c.size = std::max(c.size, shaped);
      if (view.marker_size > 0.0) c.size = view.marker_size;
    }
  }
}

}  // namespace

std::vector<std::string> change_view(Figure& f, const FigureView& view) {
  if (f.panels.empty()) return {};
  keep_panels(f, view.panels);
  std::vector<std::string> notes;
  change_axes(f, {view.x_range, view.y_range, view.log}, notes);
  name_axis(f, &Panel::x, "xlabel", view.x_label);
  name_axis(f, &Panel::y, "ylabel", view.y_label);
  rename_all(f, view.labels);
  if (!view.title.empty()) f.title = view.title;
  change_markers(f, view);
  return notes;
}

}  // namespace whirl::inline io
