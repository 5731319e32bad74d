#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libio/figures/bifurcation_curve_lines.hpp"
#include "libio/figures/result_of.hpp"

namespace whirl::inline io {

namespace figures {

namespace {

constexpr std::size_t most_names = 12;  ///< at the ends of curves

struct BifurcationStyle {
  BifurcationKind kind;
  const char* name;
  Paint paint;
  Dash dash;
};

const BifurcationStyle& style_of(BifurcationKind kind) {
  using enum BifurcationKind;
  static const std::vector<BifurcationStyle> styles{
      {fold, "fold", Paint::ink, Dash::solid},
      {period_doubling, "period doubling", Paint::alarm, Dash::dashed},
      {neimark_sacker, "Neimark-Sacker", Paint::longer, Dash::dash_dot},
      {grazing, "grazing", Paint::gray, Dash::dotted},
      {pitchfork, "bifurcation", Paint::gray, Dash::solid}};
  const auto known = std::find_if(styles.begin(), styles.end() - 1,
                                  [&](const BifurcationStyle& s) { return s.kind == kind; });
  return *known;
}

}  // namespace

BifurcationCurvePoints::BifurcationCurvePoints(const ResultView& result)
    : of(result_of<CurveResult>(result)),
      first(shown_axis(result, dataset_of<CurveResult>(&CurvePlace::first))),
      second(shown_axis(result, dataset_of<CurveResult>(&CurvePlace::second))) {
  for (std::size_t c = 0; c < of.curves.size(); ++c) {
    const CurveRow& curve = of.curves[c];
    // what failed, else the whole sentence, as in files of earlier versions
    const std::string end = curve.end_reason.empty() ? curve.end : curve.end_reason;
    BifurcationCurve line{.kind = curve.kind,
                          .contact = curve.contact,
                          .period = static_cast<double>(curve.period),
                          .ends = {end}};
    for (std::size_t i = 0; i < of.places.size(); ++i) {
      if (of.places[i].curve == static_cast<int>(c) + 1) line.points.push_back(i);
    }
    if (line.points.empty()) continue;
    const std::size_t begin = line.points.front();
    const bool is_other_way =
        !curves.empty() && curves.back().ends.size() == 1 && curves.back().kind == line.kind &&
        curves.back().contact == line.contact && curves.back().period == line.period &&
        first.values[curves.back().points.front()] == first.values[begin] &&
        second.values[curves.back().points.front()] == second.values[begin];
    if (is_other_way) {
      BifurcationCurve& known = curves.back();
      std::reverse(known.points.begin(), known.points.end());
      known.points.insert(known.points.end(), line.points.begin() + 1, line.points.end());
      known.ends.push_back(end);
    } else {
      curves.push_back(std::move(line));
    }
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    BifurcationCurve& b = curves[k];
    b.name = fmt::format("{} {}{}", k + 1, style_of(b.kind).name,
                         b.contact.empty() ? "" : " of " + b.contact);
  }
}

std::vector<Curve> bifurcation_curve_lines(const BifurcationCurvePoints& all,
                                           const std::vector<double>& x,
                                           const std::vector<double>& y) {
  std::vector<Curve> curves;
  for (const BifurcationCurve& line : all.curves) {
    const BifurcationStyle& style = style_of(line.kind);
    std::array<Curve, 2> sides;  // thick, thin
    std::pair<double, std::size_t> rightmost{-INFINITY, 0};
    const auto add = [&](std::size_t side, std::size_t i) {
      Curve& c = sides[side];
      c.x.push_back(x[i]);
      c.y.push_back(y[i]);
      c.hover.push_back(
          fmt::format("{}, period {:.0f}{}", line.name, line.period,
                      all.is_thin(i) ? ", other multipliers are outside of the circle" : ""));
    };
    std::size_t last = 2;  // side of the point before; none
    for (const std::size_t i : line.points) {
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
      if (all.curves.size() <= most_names && side == rightmost.second) c.end_name = line.name;
      curves.push_back(std::move(c));
    }
  }
  return curves;
}

}  // namespace figures

using namespace figures;

namespace {

std::vector<Figure> bifurcation_curve_figures(const ResultView& result) {
  const BifurcationCurvePoints all(result);
  if (all.curves.empty()) return {};
  Figure f{.width = 780.0, .height = 580.0};
  f.subtitle = "Bifurcation curves: where periodic orbits change";
  Panel p;
  p.x.title = all.first.title;
  p.y.title = all.second.title;
  p.curves = bifurcation_curve_lines(all, all.first.values, all.second.values);
  f.panels.push_back(std::move(p));
  f.table.header = {"bifurcation", "period", "points", all.first.title, all.second.title};
  bool has_thin = false;
  for (const BifurcationCurve& b : all.curves) {
    const std::size_t from = b.points.front(), to = b.points.back();
    f.table.rows.push_back(
        {b.name, fmt::format("{:.0f}", b.period), std::to_string(b.points.size()),
         fmt::format("{:.5g} to {:.5g}", all.first.values[from], all.first.values[to]),
         fmt::format("{:.5g} to {:.5g}", all.second.values[from], all.second.values[to])});
    for (const std::size_t i : b.points) has_thin = has_thin || all.is_thin(i);
    constexpr std::size_t most_told = 6;
    if (all.curves.size() > most_told) continue;
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
      .title = "Bifurcation curves",
      .summary = "where periodic orbits change, in a plane of two parameters",
      .needs = {dataset_of<CurveResult>(&CurvePlace::second)},
      .make = bifurcation_curve_figures,
  };
}

}  // namespace whirl::inline io
