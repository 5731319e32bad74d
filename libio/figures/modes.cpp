#include "libfe/analyses/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "libbase/error.hpp"
#include "libdyn/motions/identify.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libdyn/system/stations.hpp"
#include "libio/figures/common.hpp"
#include "libio/figures/mac_panel.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/rotor_backdrop.hpp"
#include "libio/figures/shaft_shapes.hpp"

namespace whirl::inline io {

using namespace figures;

namespace {

/// What a mode is called, the most telling parts first.
std::string title_of(const ResultView& result, Eigen::Index k, double frequency, double decrement,
                     Whirl whirl) {
  return fmt::format("Mode {} | {:.4g} {} | {} | log dec {:.3g}", k + 1,
                     frequency * result.frequency.factor, result.frequency.name, name_of(whirl),
                     decrement);
}

Panel shape_panel(const ResultView& result, const ShaftShapes& shapes, Eigen::Index k,
                  Whirl whirl) {
  Panel p;
  p.x = shaft_axis(shapes);
  p.y = {.title = "displacement", .first = -1.15, .last = 1.15};
  add_rotor(p, result, 0.0, 0.5);
  // phases at which x, y are largest: their shapes are real then, nearly
  Curve x{.name = "x at its largest", .paint = Paint::series};
  Curve y{.name = "y at its largest", .paint = series_paint(1)};
  y.dash = Dash::dashed;
  const CVec a = shapes.x.col(k), b = shapes.y.col(k);
  const Vec major = 0.5 * ((a + Complex(0, 1) * b).cwiseAbs() + (a - Complex(0, 1) * b).cwiseAbs());
  const double largest = major.maxCoeff();
  if (!(largest > 0.0)) return {};
  const Complex turn_x = turn_of(a), turn_y = turn_of(b);
  const std::vector<double> z = scaled(shapes.z, per_mm());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto place = static_cast<Eigen::Index>(i);
    x.x.push_back(z[i]);
    y.x.push_back(z[i]);
    x.y.push_back((turn_x * a(place)).real() / largest);
    y.y.push_back((turn_y * b(place)).real() / largest);
    x.hover.push_back(shapes.names[i]);
    y.hover.push_back(shapes.names[i]);
  }
  for (std::size_t first = 0; first < z.size();) {  // shaft by shaft
    std::size_t end = first;
    while (end < z.size() && std::isfinite(z[end])) ++end;
    Curve outline{.name = fmt::format("envelope of the orbits: {}", name_of(whirl)),
                  .paint = whirl_style(whirl).paint};
    outline.has_line = false;
    outline.fill = 0.16;
    for (std::size_t i = first; i < end; ++i) {
      outline.x.push_back(z[i]);
      outline.y.push_back(major(static_cast<Eigen::Index>(i)) / largest);
    }
    for (std::size_t i = end; i-- > first;) {
      outline.x.push_back(z[i]);
      outline.y.push_back(-major(static_cast<Eigen::Index>(i)) / largest);
    }
    p.curves.push_back(std::move(outline));
    first = end + 1;
  }
  p.curves.insert(p.curves.end(), {x, y});
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::dash_dot});
  return p;
}

/// What a mode's damping means for a machine.
std::string remark_on(double damping_ratio) {
  constexpr double damped =
      2.5;  // amplification factor below which a peak counts for none, [API617]
  if (damping_ratio < 0.0) return "unstable";
  if (2.0 * damping_ratio * damped > 1.0) return "critically damped";
  return "";
}

FigureTable table_of(const Modes& modes, const ResultView& result) {
  const double speed = speed_of(result);
  const bool spins = std::isfinite(speed) && speed > 0.0;
  FigureTable t{.header = {"mode", with_unit("frequency", result.frequency), "damping ratio",
                           "log decrement", "whirl"}};
  if (spins) t.header.emplace_back("from the speed");
  t.header.emplace_back("remark");
  int number = 0;
  for (const Mode& mode : modes.oscillatory) {
    const double ratio = mode.damping_ratio();
    std::vector<std::string> row{fmt::format("{}", ++number),
                                 fmt::format("{:.5g}", mode.frequency() * result.frequency.factor),
                                 with_minus(fmt::format("{:.5f}", ratio)),
                                 with_minus(fmt::format("{:.4f}", mode.log_decrement())),
                                 std::string(name_of(mode.whirl))};
    if (spins) {
      const double off = mode.frequency() / speed - 1.0;
      row.push_back(
          fmt::format("{:.1f} % {}", 100.0 * std::abs(off), off < 0.0 ? "below" : "above"));
    }
    row.push_back(remark_on(ratio));
    t.rows.push_back(std::move(row));
  }
  const auto says_nothing = [](const auto& row) { return row.back().empty(); };
  if (std::all_of(t.rows.begin(), t.rows.end(), says_nothing)) {
    t.header.pop_back();
    for (auto& row : t.rows) row.pop_back();
  }
  return t;
}

std::vector<Figure> mode_figures(const ResultView& result) {
  const auto& modes = result_of<ModesAtPoints>(result);
  const ShaftShapes shapes = shaft_shapes(result, modes.shape);
  constexpr Eigen::Index most = 6;  // beside each other
  const std::string speed = at_speed(result);
  Figure all{.variant = "all", .subtitle = "Mode shapes" + speed, .width = 1080.0};
  all.table = table_of(modes, result);
  std::vector<Figure> singles;
  for (Eigen::Index k = 0; k < shapes.x.cols(); ++k) {
    const Mode& mode = modes.oscillatory.at(static_cast<std::size_t>(k));
    Panel p = shape_panel(result, shapes, k, mode.whirl);
    if (p.curves.empty()) continue;
    p.title = title_of(result, k, mode.frequency(), mode.log_decrement(), mode.whirl);
    Figure f{.variant = fmt::format("mode {}", k + 1), .height = 340.0};
    f.subtitle = "Mode shape" + speed;
    f.panels.push_back(p);
    singles.push_back(std::move(f));
    if (k < most) all.panels.push_back(std::move(p));
  }
  if (singles.empty()) return {};
  const std::size_t rows = (all.panels.size() + 1) / 2;
  all.columns = all.panels.size() > 1 ? 2 : 1;
  all.height = 80.0 + 200.0 * static_cast<double>(rows);
  std::vector<Figure> figures{std::move(all)};
  if (singles.size() > 1) std::move(singles.begin(), singles.end(), std::back_inserter(figures));
  return figures;
}

std::vector<Figure> mac_figures(const ResultView& result) {
  std::optional<Panel> p = mac_panel(result);
  if (!p) return {};
  Figure f;
  f.subtitle =
      "Modal assurance criterion: deflection shapes of the motion against modes" + at_speed(result);
  f.width = std::max(560.0, 200.0 + 80.0 * static_cast<double>(p->cells.x.size()));
  f.height = std::max(320.0, 150.0 + 34.0 * static_cast<double>(p->cells.y.size()));
  f.panels.push_back(std::move(*p));
  return {f};
}

/// How the exponents settle over the revolutions that they are averaged over; nothing: that is not
/// known.
std::optional<Figure> exponents_over_time(const ResultView& result) {
  const std::string path = "/classify/exponent_estimate";
  if (!result.file.has(path) || !result.file.has("/classify/averaged")) return std::nullopt;
  const Mat estimates = result.file.matrix(path);
  const std::vector<double> revolutions = result.file.numbers("/classify/averaged");
  if (estimates.cols() != std::ssize(revolutions) || revolutions.empty()) return std::nullopt;
  Figure f{.variant = "over time", .height = 420.0};
  f.subtitle = "Lyapunov exponents of the first revolutions alone" + at_speed(result);
  Panel p;
  p.x = {.title = "revolutions", .first = 0.0, .last = revolutions.back()};
  p.y.title = "exponent [1/s]";
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  for (Eigen::Index i = 0; i < estimates.rows(); ++i) {
    Curve c{.name = std::to_string(i + 1), .paint = series_paint(static_cast<std::size_t>(i))};
    c.x = revolutions;
    for (const double value : estimates.row(i)) c.y.push_back(value);
    if (i % 2 == 1) c.dash = Dash::dashed;
    p.curves.push_back(std::move(c));
  }
  f.panels.push_back(std::move(p));
  return f;
}

std::vector<Figure> exponent_figures(const ResultView& result) {
  using Result = ClassificationResult;
  const std::string group(Result::group);
  const Vec exponents = result.file.vector(dataset_of<Result>(&Result::exponents));
  Figure f{.height = 380.0};
  f.subtitle = "Lyapunov exponents";
  if (result.file.has_attribute(group, "motion")) {
    f.subtitle += ": " + result.file.string_attribute(group, "motion") + " motion";
  }
  f.subtitle += at_speed(result);
  Panel p;
  p.x = {.title = "number", .first = 0.0, .last = static_cast<double>(exponents.size()) + 1.0};
  p.y.title = "exponent [1/s]";
  p.rules.push_back({Rule::Kind::horizontal, 0.0, "", Paint::ink, Dash::solid});
  Curve c{.paint = Paint::forward, .has_line = false};
  c.has_marker = true;
  c.size = 9.0;
  for (Eigen::Index i = 0; i < exponents.size(); ++i) {
    const double x = static_cast<double>(i + 1);
    Curve stem{.paint = exponents(i) > 0.0 ? Paint::alarm : Paint::forward};
    stem.x = {x, x};
    stem.y = {0.0, exponents(i)};
    p.curves.push_back(stem);
    c.x.push_back(x);
    c.y.push_back(exponents(i));
  }
  p.curves.push_back(c);
  f.panels.push_back(std::move(p));
  std::vector<Figure> figures{std::move(f)};
  if (auto over_time = exponents_over_time(result)) figures.push_back(std::move(*over_time));
  return figures;
}

}  // namespace

FigureKind modes_kind() {
  return {
      .name = "modes",
      .title = "Mode shapes",
      .summary = "mode shapes along the rotor",
      .needs = {dataset_of<ModesAtPoints>(&ModesAtPoints::shape),
                dataset_of<PointNames>(&PointNames::z)},
      .make = mode_figures,
  };
}

FigureKind mac_kind() {
  return {
      .name = "mac",
      .title = "MAC",
      .summary = "which modes make up the peaks of the response",
      .needs = {dataset_of<Identification>(&IdentifiedPeak::mac)},
      .make = mac_figures,
  };
}

FigureKind exponents_kind() {
  return {
      .name = "exponents",
      .title = "Exponents",
      .summary = "Lyapunov exponents of the motion",
      .needs = {dataset_of<ClassificationResult>(&ClassificationResult::exponents)},
      .make = exponent_figures,
  };
}

}  // namespace whirl::inline io
