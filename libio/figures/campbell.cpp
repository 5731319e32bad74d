#include "libfe/analyses/campbell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/interpolation.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// What both figures draw: branches over speed.
struct Branches {
  explicit Branches(const ResultView& result)
      : diagram(result_of<Campbell>(result)),
        speed(scaled(diagram.speeds, 1.0 / speed_unit().size)),
        unit(result.frequency),
        frequency(matrix(&CampbellBranch::frequency) * unit.factor),
        decrement(matrix(&CampbellBranch::log_decrement)) {}
  const Campbell& diagram;
  std::vector<double> speed;  ///< [speed_unit()]
  DisplayUnit unit;           ///< of frequencies
  Mat frequency, decrement;   ///< branches x speeds [unit], [-]

  const CampbellBranch& branch(Eigen::Index i) const {
    return diagram.branches[static_cast<std::size_t>(i)];
  }
  WhirlStyle style(Eigen::Index i) const { return whirl_style(branch(i).whirl); }
  std::string name(Eigen::Index i) const { return fmt::format("{}{}", i + 1, style(i).letter); }

 private:
  Mat matrix(std::vector<double> CampbellBranch::*member) const {
    Mat m(std::ssize(diagram.branches), std::ssize(diagram.speeds));
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      const std::vector<double>& values = branch(i).*member;
      m.row(i) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), m.cols());
    }
    return m;
  }
};

Curve curve_of(const Branches& b, Eigen::Index i, std::vector<double> y) {
  const WhirlStyle style = b.style(i);
  const std::size_t every = std::max<std::size_t>(1, b.speed.size() / 8);
  Curve c{.name = style.name, .end_name = b.name(i), .paint = style.paint, .x = b.speed};
  c.y = std::move(y);
  c.width = 1.8;
  c.dash = style.dash;
  c.has_marker = true;
  c.marker = style.marker;
  c.marker_every = every;
  for (std::size_t j = 0; j < c.x.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    c.hover.push_back(fmt::format("branch {}: {:.5g} {} ({}), log decrement {:.4g}", b.name(i),
                                  b.frequency(i, k), b.unit.name,
                                  shown_value(b.frequency(i, k) / b.unit.factor, "rpm", ".5g"),
                                  b.decrement(i, k)));
  }
  return c;
}

/// Speed of a shaft that is its own, over that of the first one.
Curve own_speed_curve(const Branches& b, const Rotor& rotor) {
  Curve c{.name = "speed of " + rotor.name, .paint = Paint::ink};
  c.dash = Dash::dash_dot;
  c.x = b.speed;
  for (const double speed : b.speed) {
    c.y.push_back(std::abs(rotor.speed_at(speed * speed_unit().size)) * b.unit.factor);
  }
  return c;
}

void mark_operation(const ResultView& result, Panel& panel) {
  const double speed = speed_of(result) / speed_unit().size;
  if (!std::isfinite(speed) || speed < panel.x.first || speed > panel.x.last) return;
  panel.rules.push_back(
      {Rule::Kind::vertical, speed, "operating speed", Paint::gray, Dash::dotted});
}

/// A number along a row at a place between its columns; NaN beyond them.
double between(const std::vector<double>& x, const Mat& m, Eigen::Index i, double at) {
  if (x.empty() || at < x.front() || at > x.back()) return std::nan("");
  const std::vector<double> row = numbers(Vec(m.row(i)));
  return interpolated(x, row, at, Interpolation::linear);
}

/// Marks of internal resonances, a line between both branches, and their table. Those at which
/// bouncing was found are named.
void add_resonances(const ResultView& result, const Branches& b, Figure& f) {
  constexpr std::size_t most = 10;  // that are named and told although nothing was found there
  const std::vector<ResonancePlace>& places = result_of<ResonanceStudy>(result).places;
  // of a bouncing motion files have these numbers alone
  const auto numbers_of = [&](auto member) {
    return result.file.numbers(dataset_of<ResonanceStudy>(member));
  };
  const auto bouncing = numbers_of(&ResonancePlace::bouncing_speed),
             revolutions = numbers_of(&ResonancePlace::bouncing_period),
             stable = numbers_of(&ResonancePlace::bouncing_stable);
  Panel& panel = f.panels.at(0);
  Curve possible{.name = "p:q resonance seen from the rotor", .paint = Paint::gray};
  possible.width = 0.8;
  possible.dash = Dash::dotted;
  possible.has_marker = true;
  possible.size = 4.0;
  Curve found{.name = "resonance above which bouncing was found", .paint = Paint::alarm};
  found.width = 2.0;
  found.has_marker = true;
  found.marker = Marker::diamond;
  found.size = 9.0;
  f.table.header = {shown_heading("resonance", "rpm"),
                    "ratio",
                    "modes",
                    shown_heading("from the rotor", "rpm"),
                    shown_heading("bouncing at", "rpm"),
                    "period [rev]"};
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ResonancePlace& at = places[i];
    const double speed = at.speed / speed_unit().size, seen = at.frequency / speed_unit().size;
    const Eigen::Index branches[] = {at.fast, at.slow};
    const std::string ratio = fmt::format("{}:{}", at.p, at.q);
    const bool is_found = stable[i] >= 0.0;
    const std::string motion =
        is_found
            ? fmt::format("{} at {}, {:.4f} revolutions", stable[i] > 0.0 ? "stable" : "unstable",
                          shown_value(bouncing[i], "rpm", ".1f"), revolutions[i])
            : "none found";
    Curve& c = is_found ? found : possible;
    double top = not_set;
    for (const Eigen::Index k : branches) {
      c.x.push_back(speed);
      c.y.push_back(between(b.speed, b.frequency, k, speed));
      top = std::fmax(top, c.y.back());
      c.hover.push_back(fmt::format("{} of {} and {} at {}; bouncing: {}", ratio,
                                    b.name(branches[0]), b.name(branches[1]),
                                    shown_value(at.speed, "rpm", ".1f"), motion));
    }
    c.x.push_back(not_set);  // the next one is a line of its own
    c.y.push_back(not_set);
    c.hover.emplace_back();
    if (!is_found && places.size() > most) {
      ++left_out;
      continue;
    }
    Label label{speed, top, ratio, Anchor::end, -6.0, -6.0};
    label.paint = is_found ? Paint::alarm : Paint::gray;
    if (top <= panel.y.last) panel.labels.push_back(label);
    f.table.rows.push_back({fmt::format("{:.1f}", speed), ratio,
                            fmt::format("{}, {}", b.name(branches[0]), b.name(branches[1])),
                            speed_label(at.p * seen) + ", " + speed_label(at.q * seen),
                            is_found ? fmt::format("{:.1f}, {}", bouncing[i] / speed_unit().size,
                                                   stable[i] > 0.0 ? "stable" : "unstable")
                                     : "none found",
                            is_found ? fmt::format("{:.4f}", revolutions[i]) : ""});
  }
  for (Curve* c : {&possible, &found}) {
    if (!c->x.empty()) panel.curves.push_back(std::move(*c));
  }
  if (left_out > 0) {
    f.notes.push_back(fmt::format(
        "{} more resonances, at which no bouncing was found, are drawn without a name.", left_out));
  }
}

std::vector<Figure> campbell_figures(const ResultView& result) {
  const Branches b(result);
  Figure f{.height = 520.0};
  f.subtitle = "Campbell diagram";
  Panel p;
  p.x = {.title = shown_heading("speed", "rpm"), .first = b.speed.front(), .last = b.speed.back()};
  p.y.title = with_unit("natural frequency", b.unit);
  p.y.first = 0.0;
  // branches far above the second harmonic would press the others together
  const double per_speed = speed_unit().size * b.unit.factor;
  const double twice = 2.4 * b.speed.back() * per_speed;
  double low = 0.0, all = 0.0;
  for (Eigen::Index i = 0; i < b.frequency.rows(); ++i) {
    const double top = largest_of(row(b.frequency, i));
    all = std::max(all, top);
    if (i < 2 || top < twice) low = std::max(low, top);
  }
  p.y.last =
      axis_around({0.0, std::min(all, std::max(low, 0.5 * twice)) * 1.04}, Scale::linear).last;
  for (Eigen::Index i = 0; i < b.frequency.rows(); ++i) {
    p.curves.push_back(curve_of(b, i, row(b.frequency, i)));
  }
  p.rules.push_back({Rule::Kind::slope, per_speed, "1X", Paint::ink, Dash::dash_dot});
  p.rules.push_back({Rule::Kind::slope, 2.0 * per_speed, "2X", Paint::gray, Dash::dotted});
  p.rules.push_back({Rule::Kind::slope, 0.5 * per_speed, "½X", Paint::gray, Dash::dotted});
  if (result.model) {
    for (const Rotor& rotor : result.model->structure.rotors) {
      if (rotor.has_own_speed()) {
        p.curves.push_back(own_speed_curve(b, rotor));
        continue;
      }
      const double ratio = std::abs(rotor.ratio);
      if (ratio == 0.0 || ratio == 0.5 || ratio == 1.0 || ratio == 2.0) continue;
      p.rules.push_back({Rule::Kind::slope, ratio * per_speed, fmt::format("{:.4g}X", ratio),
                         Paint::ink, Dash::dash_dot});
    }
  }
  mark_operation(result, p);
  if (!b.diagram.crossings.empty()) {
    Curve c{.name = "critical speed", .paint = Paint::ink, .has_line = false};
    c.has_marker = true;
    c.marker = Marker::cross;
    c.size = 9.0;
    f.table.header = {shown_heading("critical speed", "rpm"), "[" + b.unit.name + "]", "branch",
                      "whirl", "log decrement"};
    for (const Crossing& crossing : b.diagram.crossings) {
      const auto k = static_cast<Eigen::Index>(crossing.branch);
      const double speed = crossing.speed / speed_unit().size;
      c.x.push_back(speed);
      c.y.push_back(speed * per_speed);
      c.hover.push_back(fmt::format("critical speed {} of branch {}",
                                    shown_value(crossing.speed, "rpm", ".1f"), b.name(k)));
      const double decrement = between(b.speed, b.decrement, k, speed);
      f.table.rows.push_back(
          {fmt::format("{:.1f}", speed), fmt::format("{:.2f}", speed * per_speed), b.name(k),
           std::string(name_of(b.branch(k).whirl)), fmt::format("{:.4f}", decrement)});
    }
    p.curves.push_back(c);
  }
  p.cursor = "speed";
  f.panels.push_back(p);
  if (!result.file.has(dataset_of<ResonanceStudy>(&ResonancePlace::speed))) return {f};
  Figure resonances = f;
  resonances.variant = "resonances";
  resonances.subtitle = "Campbell diagram with the internal resonances seen from the rotor";
  resonances.table = {};
  add_resonances(result, b, resonances);
  return {resonances, f};
}

std::vector<Figure> log_decrement_figures(const ResultView& result) {
  const Branches b(result);
  Figure f{.height = 420.0};
  f.subtitle = "Logarithmic decrement, stable above zero";
  Panel p;
  p.x = {.title = shown_heading("speed", "rpm"), .first = b.speed.front(), .last = b.speed.back()};
  p.y.title = "log decrement";
  for (Eigen::Index i = 0; i < b.decrement.rows(); ++i) {
    p.curves.push_back(curve_of(b, i, row(b.decrement, i)));
  }
  if (std::string note = show_decrements(p); !note.empty()) f.notes.push_back(std::move(note));
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  if (result.file.has(dataset_of<LateralReport>(&LateralReport::speeds))) {
    p.rules.push_back({Rule::Kind::horizontal, least_log_decrement,
                       fmt::format("{:g}, API 617", least_log_decrement), Paint::alarm,
                       Dash::dashed});
  }
  mark_operation(result, p);
  // where a branch loses its damping
  for (Eigen::Index i = 0; i < b.decrement.rows(); ++i) {
    for (Eigen::Index k = 1; k < b.decrement.cols(); ++k) {
      const double before = b.decrement(i, k - 1), now = b.decrement(i, k);
      if (!(before > 1e-9 && now < -1e-9)) continue;
      const auto j = static_cast<std::size_t>(k);
      double speed = b.speed[j - 1] + (b.speed[j] - b.speed[j - 1]) * before / (before - now);
      for (const Threshold& t : b.diagram.thresholds) {  // of older files there are none
        const bool is_here = t.speed >= b.diagram.speeds[j - 1] && t.speed <= b.diagram.speeds[j];
        if (t.branch == i && is_here) speed = t.speed / speed_unit().size;
      }
      p.rules.push_back(
          {Rule::Kind::vertical, speed,
           fmt::format("{} unstable from {:.4g} {}", b.name(i), speed, speed_unit().name),
           Paint::alarm, Dash::dashed});
    }
  }
  p.cursor = "speed";
  f.panels.push_back(p);
  return {f};
}

}  // namespace

FigureKind campbell_kind() {
  return {
      .name = "campbell",
      .title = "Campbell",
      .summary = "natural frequencies over speed, with the critical speeds",
      .needs = {dataset_of<Campbell>(&CampbellBranch::frequency)},
      .make = campbell_figures,
  };
}

FigureKind log_decrement_kind() {
  return {
      .name = "log_decrement",
      .title = "Log decrement",
      .summary = "logarithmic decrements over speed, with the limit of stability",
      .needs = {dataset_of<Campbell>(&CampbellBranch::log_decrement)},
      .make = log_decrement_figures,
  };
}

}  // namespace whirl::inline io
