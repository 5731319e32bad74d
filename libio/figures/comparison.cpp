#include "libio/figures/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

namespace {

/// Kinds whose curves over each other tell nothing: drawings, stacks of shapes or spectra.
constexpr std::array<std::string_view, 5> alone{"layout", "modes", "waterfall", "cascade",
                                                "contact_angles"};

/// Title of an axis without its unit, and the unit.
std::pair<std::string, std::string> split_title(const std::string& title) {
  const auto bracket = title.rfind(" [");
  if (bracket == std::string::npos || !title.ends_with(']')) return {title, ""};
  return {title.substr(0, bracket), title.substr(bracket + 2, title.size() - bracket - 3)};
}

/// Factor from numbers along one axis to numbers along another one; nothing if they are not of the
/// same quantity.
std::optional<double> factor_between(const FigureAxis& from, const FigureAxis& to) {
  if (from.scale != to.scale) return std::nullopt;
  if (from.title == to.title) return 1.0;
  const auto [what, unit] = split_title(from.title);
  const auto [other, other_unit] = split_title(to.title);
  if (what != other) return std::nullopt;
  const auto a = parse_quantity("1 " + unit), b = parse_quantity("1 " + other_unit);
  if (!a || !b || a->dimension != b->dimension) return std::nullopt;
  return a->value / b->value;
}

/// A panel with its numbers times factors.
Panel times(Panel p, double fx, double fy) {
  for (Curve& c : p.curves) {
    c.x = scaled(std::move(c.x), fx);
    c.y = scaled(std::move(c.y), fy);
  }
  for (Rule& r : p.rules) {
    r.at *= r.kind == Rule::Kind::vertical ? fx : r.kind == Rule::Kind::horizontal ? fy : fy / fx;
  }
  for (Label& l : p.labels) l.x *= fx, l.y *= fy;
  p.x.first *= fx, p.x.last *= fx;
  p.y.first *= fy, p.y.last *= fy;
  return p;
}

/// What both axes want to be seen at first; all where one of them does not say.
void widen(FigureAxis& to, const FigureAxis& by) {
  to.first = std::isnan(by.first)   ? by.first
             : std::isnan(to.first) ? to.first
                                    : std::min(to.first, by.first);
  to.last = std::isnan(by.last)   ? by.last
            : std::isnan(to.last) ? to.last
                                  : std::max(to.last, by.last);
}

bool is_same(const Rule& a, const Rule& b) {
  return a.kind == b.kind && std::abs(a.at - b.at) <= 1e-9 * std::abs(a.at);
}

/// Takes the curves of another panel, in the color of its result.
void add(Panel& to, const Panel& from, const std::string& name, std::size_t number) {
  for (Curve c : from.curves) {
    const bool is_there = std::any_of(to.curves.begin(), to.curves.end(), [&](const Curve& known) {
      return known.paint == c.paint && known.x == c.x && known.y == c.y;
    });
    const bool is_background = !c.is_key || c.paint == Paint::stator || c.paint == Paint::gray;
    if (is_background && is_there) continue;
    if (!is_background) {
      c.paint = series_paint(number);
      c.name = c.name.empty() ? name : fmt::format("{}: {}", name, c.name);
    }
    to.curves.push_back(std::move(c));
  }
  for (Rule r : from.rules) {
    if (std::any_of(to.rules.begin(), to.rules.end(), [&](const Rule& k) { return is_same(k, r); }))
      continue;
    if (number > 0 && !r.name.empty()) r.name = fmt::format("{}: {}", name, r.name);
    to.rules.push_back(std::move(r));
  }
  for (Label l : from.labels) {
    const auto is_alike = [&](const Label& known) { return known.text == l.text; };
    if (std::any_of(to.labels.begin(), to.labels.end(), is_alike)) continue;
    l.paint = series_paint(number);
    to.labels.push_back(std::move(l));
  }
}

/// All values of a tree by their paths, in its order; elements of arrays by name or number.
void flatten(const ConfigNode& node, const std::string& path,
             std::vector<std::pair<std::string, std::string>>& to) {
  const bool has_tables = node.kind == ConfigNode::Kind::array && !node.items.empty() &&
                          node.items.front().kind == ConfigNode::Kind::table;
  if (node.kind == ConfigNode::Kind::table) {
    for (const auto& [key, value] : node.entries) {
      flatten(value, path.empty() ? key : path + "." + key, to);
    }
  } else if (has_tables) {
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const ConfigNode* name = node.items[i].find("name");
      const bool has_name = name && name->kind == ConfigNode::Kind::string && !name->text.empty();
      flatten(node.items[i],
              fmt::format("{}.{}", path, has_name ? name->text : std::to_string(i + 1)), to);
    }
  } else if (node.kind == ConfigNode::Kind::array) {
    std::string text;
    for (const ConfigNode& item : node.items) {
      text += (text.empty() ? "" : ", ") + item.as_written();
    }
    to.emplace_back(path, "[" + text + "]");
  } else {
    const bool is_short = node.kind == ConfigNode::Kind::string && node.text.size() <= 60;
    to.emplace_back(path, is_short ? node.text : node.as_written());
  }
}

}  // namespace

std::vector<std::string> names_of(const std::vector<std::unique_ptr<ResultView>>& results) {
  std::vector<std::string> stems, paths;
  for (const auto& result : results) {
    stems.push_back(std::filesystem::path(result->path).stem());
    paths.push_back(result->path);
  }
  const bool is_enough = std::set<std::string>(stems.begin(), stems.end()).size() == stems.size();
  return is_enough ? stems : paths;
}

std::optional<Figure> overlay(const std::vector<const Figure*>& figures,
                              const std::vector<std::string>& names) {
  const Figure& first = *figures.front();
  if (std::find(alone.begin(), alone.end(), first.kind) != alone.end()) return std::nullopt;
  Figure f = first;
  f.title = fmt::format("{}", names.front());
  f.notes.clear();
  f.table = {};
  for (Panel& p : f.panels) {
    if (!p.cells.empty()) return std::nullopt;
    p.curves.clear();
    p.rules.clear();
    p.labels.clear();
  }
  for (std::size_t n = 0; n < figures.size(); ++n) {
    const Figure& other = *figures[n];
    if (other.panels.size() != f.panels.size()) return std::nullopt;
    for (std::size_t i = 0; i < f.panels.size(); ++i) {
      Panel& to = f.panels[i];
      const auto fx = factor_between(other.panels[i].x, to.x),
                 fy = factor_between(other.panels[i].y, to.y);
      if (!fx || !fy || !other.panels[i].cells.empty()) return std::nullopt;
      const Panel from = times(other.panels[i], *fx, *fy);
      widen(to.x, from.x);
      widen(to.y, from.y);
      add(to, from, names[n], n);
    }
    if (n > 0) f.title += fmt::format(" and {}", names[n]);
    for (const auto& row : other.table.rows) {
      if (f.table.header.empty()) {
        f.table.header = other.table.header;
        f.table.header.insert(f.table.header.begin(), "result");
      }
      if (row.size() + 1 > f.table.header.size()) continue;
      f.table.rows.push_back(row);
      f.table.rows.back().insert(f.table.rows.back().begin(), names[n]);
    }
  }
  return f;
}

FigureTable differences(const std::vector<std::string>& texts,
                        const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  std::set<std::string> known;
  std::vector<std::map<std::string, std::string>> values;
  for (const std::string& text : texts) {
    std::vector<std::pair<std::string, std::string>> all;
    try {
      flatten(parse_toml(text, "model"), "", all);
    } catch (const ModelError&) {
      return {};  // a result of a version that wrote models otherwise
    }
    for (const auto& [path, value] : all) {
      if (known.insert(path).second) paths.push_back(path);
    }
    values.emplace_back(all.begin(), all.end());
  }
  FigureTable t{.header = {"model"}};
  t.header.insert(t.header.end(), names.begin(), names.end());
  for (const std::string& path : paths) {
    std::vector<std::string> row{path};
    for (const auto& model : values) {
      const auto found = model.find(path);
      row.push_back(found == model.end() ? "–" : found->second);
    }
    const bool is_same = std::all_of(row.begin() + 1, row.end(),
                                     [&](const std::string& text) { return text == row[1]; });
    if (!is_same) t.rows.push_back(std::move(row));
  }
  return t;
}

}  // namespace whirl::inline io
