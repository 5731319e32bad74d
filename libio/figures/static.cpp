#include "libfe/analyses/static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libdyn/system/running_film.hpp"
#include "libfe/analyses/bending.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/rotor_backdrop.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

using namespace figures;

namespace {

constexpr double still = 1e-6;  ///< of the largest: a plane in which nothing happens

/// Lines along the shaft in both planes, and what they are called.
struct Line {
  std::string what, si_unit;
  Mat values;  ///< places x 2
};

/// The two planes, that of gravity first.
struct Plane {
  Eigen::Index column;
  const char* name;
  Paint paint;
  Dash dash;
};
constexpr std::array<Plane, 2> planes{
    {{1, "y", Paint::series, Dash::solid}, {0, "x", series_paint(1), Dash::dashed}}};

/// A label at the largest magnitude of a column.
void label_largest(Panel& p, const Vec& z, const Vec& values, const DisplayUnit& unit) {
  Eigen::Index at = 0;
  values.cwiseAbs().maxCoeff(&at);
  const double top = unit.factor * values(at), place = per_mm() * z(at);
  const double middle = 0.5 * per_mm() * (z(0) + z(z.size() - 1));
  Label l{place, top, with_minus(fmt::format("{:.4g} {}", top, unit.name))};
  l.anchor = place > middle ? Anchor::end : Anchor::start;
  l.dx = place > middle ? -6.0 : 6.0;
  l.dy = top < 0.0 ? 14.0 : -6.0;
  p.labels.push_back(l);
}

/// Where each shaft begins among positions, and where it ends: positions ascend along a shaft.
std::vector<std::pair<Eigen::Index, Eigen::Index>> shafts_along(const Vec& z) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> all;
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i <= z.size(); ++i) {
    if (i < z.size() && z(i) >= z(i - 1)) continue;
    all.emplace_back(first, i);
    first = i;
  }
  return all;
}

Panel panel_of(const Vec& z, const Line& line, bool is_filled) {
  Panel p;
  const double length = per_mm() * (z.maxCoeff() - z.minCoeff()), room = 0.03 * length;
  p.x = {.title = shown_heading("position along the shaft", "mm"),
         .first = per_mm() * z.minCoeff() - room,
         .last = per_mm() * z.maxCoeff() + room};
  const double largest = line.values.cwiseAbs().maxCoeff();
  const ShownUnit moment = shown_unit("N.m");
  const DisplayUnit unit =
      line.si_unit == "N.m"
          ? DisplayUnit{moment.name == "N.m" ? "N·m" : moment.name, 1.0 / moment.size}
          : unit_for(largest, line.si_unit);
  p.y.title = with_unit(line.what, unit);
  for (const Plane& plane : planes) {
    const Vec values = line.values.col(plane.column);
    if (plane.column == 0 && values.cwiseAbs().maxCoeff() <= still * largest) continue;
    Curve c{.name = plane.column == 0 ? "in the x-z plane" : "in the y-z plane",
            .paint = plane.paint};
    c.dash = plane.dash;
    c.width = 1.8;
    for (const auto& [first, end] : shafts_along(z)) {
      Curve under{.paint = plane.paint, .has_line = false};
      under.fill = 0.13;
      const auto add = [&](Curve& to, double x, double y) {
        to.x.push_back(x);
        to.y.push_back(y);
      };
      if (first > 0) add(c, not_set, not_set);
      add(under, per_mm() * z(first), 0.0);
      for (Eigen::Index i = first; i < end; ++i) {
        for (Curve* to : {&c, &under}) add(*to, per_mm() * z(i), unit.factor * values(i));
      }
      add(under, per_mm() * z(end - 1), 0.0);
      if (is_filled && plane.column == 1) p.curves.push_back(std::move(under));
    }
    p.curves.push_back(std::move(c));
  }
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::dash_dot});
  label_largest(p, z, line.values.col(1), unit);
  return p;
}

/// What carries the rotor: a bearing, a seal or an oil film.
struct Support {
  std::string name;
  Vec2 load;                    ///< of the rotor on it [N]
  const Station* at = nullptr;  ///< null: the model does not have it
  Paint paint = Paint::bearing;
};

std::vector<Support> supports_of(const ResultView& result) {
  std::vector<Support> all;
  const Model* model = result.model ? &*result.model : nullptr;
  for (const BearingLoad& b : result_of<StaticEquilibrium>(result).bearings) {
    Support support{b.name, b.force};
    if (model) {
      const Structure& s = model->structure;
      const std::size_t i = all.size(), seal = i - std::min(i, s.bearings.size());
      if (i < s.bearings.size()) {
        support.at = &s.bearings[i].from;
      } else if (seal < s.seals.size()) {  // they follow the bearings
        support.at = &s.seals[seal].from;
        support.paint = Paint::seal;
      }
    }
    all.push_back(support);
  }
  if (!result.file.has(dataset_of<RunningFilms>(&RunningFilm::name))) return all;
  for (const RunningFilm& film : result_of<RunningFilms>(result).films) {
    Support support{film.name, film.load};
    for (std::size_t i = 0; model && i < model->films.size(); ++i) {
      if (model->films[i].name == film.name) support.at = &model->films[i].at;
    }
    all.push_back(support);
  }
  return all;
}

/// An arrow with what a support pushes the rotor up or down by.
/// @param height  of the label in the panel
void add_reaction(Panel& p, const ResultView& result, const Support& support,
                  const DisplayUnit& unit, double height) {
  if (!result.assembler || !support.at) return;
  const auto at = result.assembler->mesh().position_of(result.assembler->point(*support.at));
  if (!at) return;
  const double z = per_mm() * *at;
  const double reaction = -unit.factor * support.load(1);
  Label l{z, height,
          fmt::format("{} {:.4g} {}", reaction < 0.0 ? "↓" : "↑", std::abs(reaction), unit.name)};
  const double along = (z - p.x.first) / (p.x.last - p.x.first);
  l.anchor = along < 0.1 ? Anchor::start : along > 0.9 ? Anchor::end : Anchor::middle;
  l.dx = l.dy = 0.0;
  l.paint = support.paint;
  p.labels.push_back(l);
}

/// The rotor behind its sag, and what its supports bear.
void add_rotor_and_reactions(Panel& p, const ResultView& result, FigureTable& table) {
  constexpr double small = 0.05;  // of the largest load: told in the table only
  double low = 0.0, high = 0.0;
  for (const Curve& c : p.curves) {
    for (const double v : c.y) low = std::min(low, v), high = std::max(high, v);
  }
  const double span = high - low;
  p.y.first = low - 0.22 * span;
  p.y.last = high + 0.48 * span;
  Panel behind;
  add_rotor(behind, result, 0.0, 0.22 * span);
  p.curves.insert(p.curves.begin(), behind.curves.begin(), behind.curves.end());
  const std::vector<Support> supports = supports_of(result);
  if (supports.empty()) return;
  double largest = 0.0;
  for (const Support& s : supports) largest = std::max(largest, s.load.cwiseAbs().maxCoeff());
  const DisplayUnit unit = unit_for(largest, "N");
  table.header = {"bearing", with_unit("load x", unit), with_unit("load y", unit)};
  for (const Support& s : supports) {
    const auto text = [&](double force) {
      const double shown = unit.factor * force;
      return with_minus(fmt::format("{:.4g}", std::abs(force) > still * largest ? shown : 0.0));
    };
    table.rows.push_back({s.name, text(s.load(0)), text(s.load(1))});
    if (std::abs(s.load(1)) >= small * largest) add_reaction(p, result, s, unit, high + 0.3 * span);
  }
}

/// Nominal stresses along the shafts.
Panel stress_panel(const BendingLine& line, const FigureAxis& along) {
  const ShownUnit unit = shown_unit("MPa");
  Panel p;
  p.x = along;
  p.y.title = shown_heading("nominal stress", "MPa");
  p.y.first = 0.0;
  for (const auto& [name, values, number] :
       {std::tuple{"bending", &line.bending_stress, 1}, {"shear", &line.shear_stress, 4}}) {
    Curve c{.name = name, .paint = series_paint(static_cast<std::size_t>(number))};
    c.width = 1.6;
    for (const auto& [first, end] : shafts_along(line.z)) {
      if (first > 0) c.x.push_back(not_set), c.y.push_back(not_set);
      for (Eigen::Index i = first; i < end; ++i) {
        c.x.push_back(per_mm() * line.z(i));
        c.y.push_back((*values)(i) / unit.size);
      }
    }
    p.curves.push_back(std::move(c));
  }
  return p;
}

/// What bends the rotor of a result.
std::string loads_of(const ResultView& result) {
  if (!result.model || !has_constant_force(result.model->structure)) return "gravity";
  return result.model->structure.gravity == 0.0 ? "constant forces" : "gravity and constant forces";
}

std::vector<Figure> static_figures(const ResultView& result) {
  const auto& of = result_of<BendingLine>(result);
  const Vec& z = of.z;
  const std::array<Line, 3> lines{{{"deflection", "m", of.deflection},
                                   {"bending moment", "N.m", of.moment},
                                   {"shear force", "N", of.shear}}};
  if (z.size() < 2 || lines[0].values.isZero(0.0)) return {};  // nothing has a weight
  Figure f{.subtitle = fmt::format(
               "Static deflection under {}, with the reactions of the bearings; bending moment and "
               "shear force",
               loads_of(result)),
           .height = 640.0};
  for (const Line& line : lines) f.panels.push_back(panel_of(z, line, &line != lines.data()));
  if (of.bending_stress.size() == z.size()) {
    f.panels.push_back(stress_panel(of, f.panels.front().x));
    f.height += 130.0;
    f.notes.push_back("The stress is nominal: steps and keyways raise it.");
  }
  f.panels.front().share = 1.3;
  add_rotor_and_reactions(f.panels.front(), result, f.table);
  f.notes.insert(
      f.notes.begin(),
      "Loads are forces of the rotor on its bearings, arrows those of the bearings on the "
      "rotor; y points up. A shaft that sags between bearings has a moment above zero.");
  return {f};
}

}  // namespace

FigureKind static_kind() {
  return {
      .name = "static",
      .title = "Sag and bending",
      .summary =
          "sag under gravity and constant forces, bearing loads, bending moment and shear force",
      .needs = {dataset_of<BendingLine>(&BendingLine::z),
                dataset_of<BendingLine>(&BendingLine::deflection),
                dataset_of<BendingLine>(&BendingLine::moment),
                dataset_of<BendingLine>(&BendingLine::shear)},
      .make = static_figures,
  };
}

}  // namespace whirl::inline io
