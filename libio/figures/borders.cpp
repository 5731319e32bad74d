#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libio/figures/border_lines.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace figures {

namespace {

constexpr std::size_t most_names = 12;  ///< at the ends of curves

struct BorderStyle {
  BifurcationKind kind;
  const char* name;
  Paint paint;
  Dash dash;
};

const BorderStyle& style_of(BifurcationKind kind) {
  using enum BifurcationKind;
  static const std::vector<BorderStyle> styles{
      {fold, "fold", Paint::ink, Dash::solid},
      {period_doubling, "period doubling", Paint::alarm, Dash::dashed},
      {neimark_sacker, "Neimark-Sacker", Paint::longer, Dash::dash_dot},
      {grazing, "grazing", Paint::gray, Dash::dotted},
      {pitchfork, "border", Paint::gray, Dash::solid}};
  const auto known = std::find_if(styles.begin(), styles.end() - 1,
                                  [&](const BorderStyle& s) { return s.kind == kind; });
  return *known;
}

}  // namespace

BorderPoints::BorderPoints(const ResultView& result)
    : of(result_of<CurveResult>(result)),
      first(shown_axis(result, dataset_of<CurveResult>(&CurvePlace::first))),
      second(shown_axis(result, dataset_of<CurveResult>(&CurvePlace::second))) {
  for (std::size_t c = 0; c < of.curves.size(); ++c) {
    const CurveRow& curve = of.curves[c];
    // what failed, else the whole sentence, as in files of earlier versions
    const std::string end = curve.end_reason.empty() ? curve.end : curve.end_reason;
    Border border{.kind = curve.kind,
                  .contact = curve.contact,
                  .period = static_cast<double>(curve.period),
                  .ends = {end}};
    for (std::size_t i = 0; i < of.places.size(); ++i) {
      if (of.places[i].curve == static_cast<int>(c) + 1) border.points.push_back(i);
    }
    if (border.points.empty()) continue;
    const std::size_t begin = border.points.front();
    const bool is_other_way =
        !borders.empty() && borders.back().ends.size() == 1 && borders.back().kind == border.kind &&
        borders.back().contact == border.contact && borders.back().period == border.period &&
        first.values[borders.back().points.front()] == first.values[begin] &&
        second.values[borders.back().points.front()] == second.values[begin];
    if (is_other_way) {
      Border& known = borders.back();
      std::reverse(known.points.begin(), known.points.end());
      known.points.insert(known.points.end(), border.points.begin() + 1, border.points.end());
      known.ends.push_back(end);
    } else {
      borders.push_back(std::move(border));
    }
  }
  for (std::size_t k = 0; k < borders.size(); ++k) {
    Border& b = borders[k];
    b.name = fmt::format("{} {}{}", k + 1, style_of(b.kind).name,
                         b.contact.empty() ? "" : " of " + b.contact);
  }
}

std::vector<Curve> border_curves(const BorderPoints& all, const std::vector<double>& x,
                                 const std::vector<double>& y) {
  std::vector<Curve> curves;
  for (const Border& border : all.borders) {
    const BorderStyle& style = style_of(border.kind);
    std::array<Curve, 2> sides;  // thick, thin
    std::pair<double, std::size_t> rightmost{-INFINITY, 0};
    const auto add = [&](std::size_t side, std::size_t i) {
      Curve& c = sides[side];
      c.x.push_back(x[i]);
      c.y.push_back(y[i]);
      c.hover.push_back(
          fmt::format("{}, period {:.0f}{}", border.name, border.period,
                      all.is_thin(i) ? ", other multipliers are outside of the circle" : ""));
    };
    std::size_t last = 2;  // side of the point before; none
    for (const std::size_t i : border.points) {
      const std::size_t side = all.is_thin(i) ? 1 : 0;
      if (last < 2 && side != last) {
        add(last, i);  // what is before a change goes up to it
        Curve& c = sides[side];
        if (!c.x.empty()) {
          c.x.push_back(not_set);
          c.y.push_back(not_set);
          c.hover.emplace_back();
        }
      }
      add(side, i);
      last = side;
      rightmost = std::max(rightmost, {x[i], side});
    }
    for (const std::size_t side : {0, 1}) {
      Curve& c = sides[side];
      if (c.x.empty()) continue;
      c.name =
          side == 0 ? style.name : fmt::format("{}, other multipliers are outside", style.name);
      c.paint = style.paint;
      c.dash = style.dash;
      c.width = side == 0 ? 2.4 : 1.0;
      if (all.borders.size() <= most_names && side == rightmost.second) c.end_name = border.name;
      curves.push_back(std::move(c));
    }
  }
  return curves;
}

}  // namespace figures

using namespace figures;

namespace {

std::vector<Figure> border_figures(const ResultView& result) {
  const BorderPoints all(result);
  if (all.borders.empty()) return {};
  Figure f{.width = 780.0, .height = 580.0};
  f.subtitle = "Borders: where periodic orbits change";
  Panel p;
  p.x.title = all.first.title;
  p.y.title = all.second.title;
  p.curves = border_curves(all, all.first.values, all.second.values);
  f.panels.push_back(std::move(p));
  f.table.header = {"border", "period", "points", all.first.title, all.second.title};
  bool has_thin = false;
  for (const Border& b : all.borders) {
    const std::size_t from = b.points.front(), to = b.points.back();
    f.table.rows.push_back(
        {b.name, fmt::format("{:.0f}", b.period), std::to_string(b.points.size()),
         fmt::format("{:.5g} to {:.5g}", all.first.values[from], all.first.values[to]),
         fmt::format("{:.5g} to {:.5g}", all.second.values[from], all.second.values[to])});
    for (const std::size_t i : b.points) has_thin = has_thin || all.is_thin(i);
    constexpr std::size_t most_told = 6;
    if (all.borders.size() > most_told) continue;
    std::string why;
    for (const std::string& end : b.ends) {
      if (!end.empty() && end != why) why += (why.empty() ? "" : "; ") + end;
    }
    if (!why.empty()) f.notes.push_back(fmt::format("{}: {}.", b.name, why));
  }
  if (has_thin) {
    f.notes.push_back(
        "Thin: another multiplier is outside of the unit circle, the orbit is unstable "
        "on both sides.");
  }
  return {f};
}

}  // namespace

FigureKind borders_kind() {
  return {
      .name = "borders",
      .title = "Borders",
      .summary = "where periodic orbits change, in a plane of two parameters",
      .needs = {dataset_of<CurveResult>(&CurvePlace::second)},
      .make = border_figures,
  };
}

}  // namespace whirl::inline io
