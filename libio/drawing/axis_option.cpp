#include "libio/drawing/axis_option.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libio/text/option_values.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// One of the two directions of a figure, with its options.
struct Direction {
  FigureAxis Panel::*axis;
  const char *range, *name;  ///< of the options: "xlim", and "x"
  std::vector<double> Curve::*values;
  std::vector<double> Cells::*middles;
  Rule::Kind rule;  ///< of rules at a place of this axis
  bool is_x;
};
const Direction along{&Panel::x, "xlim", "x", &Curve::x, &Cells::x, Rule::Kind::vertical, true};
const Direction up{&Panel::y, "ylim", "y", &Curve::y, &Cells::y, Rule::Kind::horizontal, false};

/// The range of an axis as it is shown now.
Axis shown(const Panel& p, const Direction& d) {
  const PanelAxes axes = axes_of(p);
  return d.is_x ? axes.x : axes.y;
}

/// What an axis measures: "1 mm" of "x [mm]"; none for names without a unit that can be read.
std::optional<Quantity> unit_of(const FigureAxis& axis) {
  const auto bracket = axis.title.rfind(" [");
  if (bracket == std::string::npos || !axis.title.ends_with(']')) return std::nullopt;
  return parse_quantity("1 " + axis.title.substr(bracket + 2, axis.title.size() - bracket - 3))
      .value;
}

/// An end of a range; none: it is left open.
using End = std::optional<Quantity>;
struct Ends {
  End first, last;
  bool has_unit() const { return !(first ? first : last)->unit.empty(); }
};

Ends parse_ends(const Direction& d, const std::string& text) {
  const auto wrong = [&](const std::string& what) { return wrong_option(d.range, text, what); };
  const auto colon = text.find(':');
  const auto end = [&](std::string part) -> End {
    if (part.find_first_not_of(' ') == std::string::npos) return std::nullopt;
    const auto read = parse_quantity(part);
    if (!read) throw wrong(fmt::format("expected a range A:B, such as 0:10; {}", read.problem));
    return *read;
  };
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos) {
    throw wrong("expected a range A:B, A: or :B, such as 0:10");
  }
  Ends ends{end(text.substr(0, colon)), end(text.substr(colon + 1))};
  if (!ends.first && !ends.last) throw wrong("expected a range A:B, A: or :B, such as 0:10");
  if (ends.first && ends.last && ends.first->unit.empty() && !ends.last->unit.empty()) {
    const double one = parse_quantity("1 " + ends.last->unit)->value;
    ends.first = Quantity{ends.first->value * one, ends.last->dimension, ends.last->unit};
  }
  if (ends.first && ends.last && ends.last->unit.empty() && !ends.first->unit.empty()) {
    throw wrong("the unit stands at the end, such as 0:10mm");
  }
  return ends;
}

/// "speed [rpm]" of x and y of all panels, each once.
std::string axes_told(const Figure& f, const Direction& d) {
  std::vector<std::string> titles;
  for (const Panel& p : f.panels) {
    const std::string& title = (p.*d.axis).title;
    if (!title.empty() && std::find(titles.begin(), titles.end(), title) == titles.end()) {
      titles.push_back(title);
    }
  }
  return fmt::format("{}", fmt::join(titles, " | "));
}

/// A number of an end along an axis; none where the axis measures something else.
std::optional<double> number_on(const FigureAxis& axis, const Quantity& end) {
  if (end.unit.empty()) return end.value;
  const auto one = unit_of(axis);
  if (!one || !(one->dimension == end.dimension)) return std::nullopt;
  return end.value / one->value;
}

/// Whether a panel has anything between two numbers of an axis.
bool has_something(const Panel& p, const Direction& d, double first, double last) {
  double low = INFINITY, high = -INFINITY;
  const auto see = [&](const std::vector<double>& values) {
    for (const double v : values) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
  };
  for (const Curve& c : p.curves) see(c.*d.values);
  see(p.cells.*d.middles);
  return low > high || (first <= high && last >= low);
}

/// Gives the axis of a panel a range.
/// @return  false: the axis measures something else
bool set_range(Panel& p, const Direction& d, const Ends& ends, const std::string& text) {
  FigureAxis& axis = p.*d.axis;
  const auto wrong = [&](const std::string& what) { return wrong_option(d.range, text, what); };
  const Axis now = shown(p, d);
  double first = now.first, last = now.last;
  for (const auto& [end, to] : {std::pair{&ends.first, &first}, {&ends.last, &last}}) {
    if (!*end) continue;
    const auto number = number_on(axis, **end);
    if (!number) return false;
    *to = *number;
  }
  const bool is_log = axis.scale == Scale::logarithmic;
  const std::string range = fmt::format("{:.6g}:{:.6g}", now.first, now.last);
  if (is_log && !(first > 0.0)) {
    throw wrong(fmt::format("{} is logarithmic and begins above 0; all is {}", axis.title, range));
  }
  if (!can_be_drawn({axis.scale, first, last})) {
    throw wrong(fmt::format("expected A below B; of {} all is {}", axis.title, range));
  }
  if (!has_something(p, d, first, last)) {
    throw wrong(fmt::format("there is nothing; of {} all is {}", axis.title, range));
  }
  axis.first = first;
  axis.last = last;
  return true;
}

void set_ranges(Figure& f, const Direction& d, const std::string& text) {
  if (text.empty()) return;
  const std::vector<std::string> parts = split(text, ',');
  const auto no_such_unit = [&](const std::string& unit) {
    return wrong_option(d.range, text,
                        fmt::format("no axis is in {}; {} is {}", unit, d.name, axes_told(f, d)));
  };
  const auto unit = [](const Ends& ends) { return (ends.last ? ends.last : ends.first)->unit; };
  if (parts.size() > 1) {
    if (parts.size() > f.panels.size()) {
      throw wrong_option(d.range, text,
                         fmt::format("{} ranges for {} panels", parts.size(), f.panels.size()));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].empty()) continue;
      const Ends ends = parse_ends(d, parts[i]);
      if (!set_range(f.panels[i], d, ends, text)) throw no_such_unit(unit(ends));
    }
    return;
  }
  const Ends ends = parse_ends(d, text);
  const std::string first = (f.panels.front().*d.axis).title;
  bool is_set = false;
  for (Panel& p : f.panels) {
    if (!ends.has_unit() && (p.*d.axis).title != first) continue;
    is_set |= set_range(p, d, ends, text);
  }
  if (!is_set) throw no_such_unit(unit(ends));
}

/// Lines of one slope are curves on other scales.
void make_slopes_curves(Panel& p) {
  if (p.x.scale == p.y.scale) return;
  const Axis x = axes_of(p).x;
  constexpr int points = 200;
  for (const Rule& r : p.rules) {
    if (r.kind != Rule::Kind::slope) continue;
    Curve c{.end_name = r.name, .paint = r.paint};
    for (int i = 0; i <= points; ++i) {
      const double share = static_cast<double>(i) / points;
      c.x.push_back(x.scale == Scale::logarithmic ? x.first * std::pow(x.last / x.first, share)
                                                  : x.first + share * (x.last - x.first));
      c.y.push_back(r.at * c.x.back());
    }
    c.dash = r.dash;
    c.width = 1.1;
    c.is_key = false;
    p.curves.push_back(std::move(c));
  }
  std::erase_if(p.rules, [](const Rule& r) { return r.kind == Rule::Kind::slope; });
}

/// Makes an axis of a panel logarithmic; what has no place on it goes.
/// @return  points that are left out, as they are at 0
long make_logarithmic(Panel& p, const Direction& d, const std::string& log, bool has_range) {
  FigureAxis& axis = p.*d.axis;
  const std::string what = axis.title.empty() ? d.name : axis.title;
  const auto wrong = [&](const std::string& why) { return wrong_option("log", log, why); };
  if (p.has_equal_scales) {
    throw wrong(fmt::format("x and y of \"{}\" are equally scaled, and so linear", what));
  }
  double least = INFINITY, largest = -INFINITY;
  long at_zero = 0;
  const auto see = [&](double v) {
    if (!std::isfinite(v)) return;
    at_zero += v == 0.0 ? 1 : 0;
    least = std::min(least, v);
    largest = std::max(largest, v);
  };
  for (const Curve& c : p.curves) {
    if (c.is_key) std::for_each((c.*d.values).begin(), (c.*d.values).end(), see);
  }
  const std::vector<double>& middles = p.cells.*d.middles;
  if (middles.size() > 1) see(1.5 * middles[0] - 0.5 * middles[1]);  // the edge of the first cell
  if (least < 0.0 && (!has_range || !middles.empty() || !(largest > 0.0))) {
    throw wrong(
        fmt::format("{} goes down to {:.4g}, and a logarithmic axis shows only what is "
                    "above 0; with --{} A:B, A above 0, it shows that part",
                    what, least, d.range));
  }
  if (!(largest > 0.0) && least <= 0.0) throw wrong(fmt::format("nothing of {} is above 0", what));
  axis.scale = Scale::logarithmic;
  axis.step = not_set;
  if (!(axis.first > 0.0)) axis.first = not_set;
  std::erase_if(p.rules, [&](const Rule& r) { return r.kind == d.rule && !(r.at > 0.0); });
  return at_zero;
}

void set_scales(Figure& f, const AxisWishes& wishes, std::vector<std::string>& notes) {
  if (wishes.log.empty()) return;
  const bool is_none = wishes.log == "none";
  if (!is_none && wishes.log != "x" && wishes.log != "y" && wishes.log != "xy") {
    throw wrong_option("log", wishes.log, "expected x, y or xy, or none for linear axes");
  }
  for (const Direction* d : {&along, &up}) {
    const std::string first = (f.panels.front().*(d->axis)).title;
    for (Panel& p : f.panels) {
      if (is_none) (p.*(d->axis)).scale = Scale::linear;
      if (is_none || wishes.log.find(d->name) == std::string::npos) continue;
      if ((p.*(d->axis)).title != first) continue;
      const std::string& range = d->is_x ? wishes.x_range : wishes.y_range;
      const long left_out = make_logarithmic(p, *d, wishes.log, !range.empty());
      if (left_out > 0) {
        notes.push_back(fmt::format("{} points at 0 have no place on the logarithmic axis of {}",
                                    left_out, (p.*(d->axis)).title));
      }
    }
  }
}

}  // namespace

std::vector<std::string> split(const std::string& text, char sign) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(sign, from), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', from), to);
    std::string part = text.substr(first, to - first);
    while (part.ends_with(' ')) part.pop_back();
    parts.push_back(std::move(part));
    from = to + 1;
  }
  return parts;
}

void change_axes(Figure& f, const AxisWishes& wishes, std::vector<std::string>& notes) {
  set_scales(f, wishes, notes);
  set_ranges(f, along, wishes.x_range);
  set_ranges(f, up, wishes.y_range);
  if (wishes.log.empty()) return;
  for (Panel& p : f.panels) make_slopes_curves(p);
}

}  // namespace whirl::inline io
