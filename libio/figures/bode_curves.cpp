#include "libio/figures/bode_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline io::figures {

namespace {

/// Phases that go on across +-180 degrees [deg].
std::vector<double> continuous_phase(const CMat& a, Eigen::Index i) {
  std::vector<double> phase;
  double turns = 0.0, before = std::nan("");
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    double now = std::abs(a(i, k)) > 0.0 ? std::arg(a(i, k)) / degree : std::nan("");
    if (std::isfinite(now)) {
      now += turns;
      while (now - before > 180.0) now -= 360.0, turns -= 360.0;
      while (now - before < -180.0) now += 360.0, turns += 360.0;
      before = now;
    }
    phase.push_back(now);
  }
  // at the start as near to zero as may be
  double first = 0.0;
  for (const double p : phase) {
    if (std::isfinite(p)) {
      first = p;
      break;
    }
  }
  const double shift = 360.0 * std::round(first / 360.0);
  for (double& p : phase) p -= shift;
  return phase;
}

void mark_operation(const ResultView& result, const std::vector<double>& speeds, Panel& panel) {
  const double speed = speed_of(result) / rpm;
  if (!std::isfinite(speed) || speed < speeds.front() || speed > speeds.back()) return;
  panel.rules.push_back(
      {Rule::Kind::vertical, speed, "operating speed", Paint::gray, Dash::dotted});
}

/// Quarters of a turn around all phases.
void show_quarters(Panel& phase) {
  double low = 0.0, high = 0.0;
  for (const Curve& c : phase.curves) {
    for (const double v : c.y) {
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
  }
  phase.y.first = 90.0 * std::floor(low / 90.0 - 1e-6);
  phase.y.last = 90.0 * std::ceil(high / 90.0 + 1e-6);
}

}  // namespace

void add_reading(const ProbeLabel& probe, const CVec& reading, std::vector<BodeCurves>& to) {
  auto group = std::find_if(to.begin(), to.end(),
                            [&](const BodeCurves& b) { return b.unit.name == probe.unit; });
  if (group == to.end()) group = to.insert(to.end(), {{}, {}, unit_of(probe), {}});
  const auto count = std::ssize(group->names);
  group->names.push_back(probe_name(probe));
  group->probes.push_back(probe.name);
  group->a.conservativeResize(count + 1, reading.size());
  group->a.row(count) = reading.transpose();
}

std::vector<Eigen::Index> named_rows(const std::vector<std::string>& stations) {
  std::vector<Eigen::Index> list;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (stations[i].find_first_not_of("0123456789") != std::string::npos) {
      list.push_back(static_cast<Eigen::Index>(i));
    }
  }
  for (std::size_t i = 0; list.empty() && i < stations.size(); ++i) {
    list.push_back(static_cast<Eigen::Index>(i));
  }
  return list;
}

Figure bode_figure(const ResultView& result, const std::vector<double>& speed,
                   const BodeCurves& shown) {
  Figure f{.height = 560.0};
  Panel amplitude, phase;
  for (Panel* p : {&amplitude, &phase}) {
    p->x = {.title = "speed [rpm]", .first = speed.front(), .last = speed.back()};
    p->cursor = "speed";
    mark_operation(result, speed, *p);
  }
  phase.rules.clear();
  amplitude.share = 1.5;
  amplitude.y = {.title = with_unit("amplitude p-p", shown.unit), .first = 0.0};
  phase.y = {.title = "phase [deg]", .step = 90.0};
  for (std::size_t number = 0; number < shown.names.size(); ++number) {
    const auto i = static_cast<Eigen::Index>(number);
    Curve c{.name = shown.names[number], .paint = series_paint(number), .x = speed};
    c.width = 1.8;
    constexpr Dash dashes[] = {Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
    c.dash = dashes[number % 4];
    Curve lag = c;
    for (Eigen::Index k = 0; k < shown.a.cols(); ++k) {
      c.y.push_back(2.0 * shown.unit.factor * std::abs(shown.a(i, k)));
    }
    lag.y = continuous_phase(shown.a, i);
    amplitude.curves.push_back(std::move(c));
    phase.curves.push_back(std::move(lag));
  }
  show_quarters(phase);
  f.panels = {amplitude, phase};
  return f;
}

Figure polar_figure(const std::vector<double>& speed, const std::string& name, const CVec& a,
                    const DisplayUnit& unit) {
  Figure f{.variant = name, .width = 560.0, .height = 560.0};
  const double largest = 2.0 * a.cwiseAbs().maxCoeff();
  Panel p;
  p.has_equal_scales = true;
  p.x.title = with_unit("in phase", unit);
  p.y.title = with_unit("90° ahead", unit);
  Curve c{.paint = Paint::forward};
  c.width = 1.8;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    c.x.push_back(2.0 * unit.factor * a(k).real());
    c.y.push_back(2.0 * unit.factor * a(k).imag());
    c.hover.push_back(
        fmt::format("{:.5g} rpm: {:.4g} {}, {:.1f}°", speed[static_cast<std::size_t>(k)],
                    2.0 * unit.factor * std::abs(a(k)), unit.name, std::arg(a(k)) / degree));
  }
  c.along = speed;
  c.along_title = "speed";
  // round speeds, where the loop has gone on by a twelfth of its size
  Curve marks{.paint = Paint::ink, .has_line = false};
  marks.has_marker = true;
  marks.size = 5.0;
  double x = 1e300, y = 1e300;
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    if (std::hypot(c.x[k] - x, c.y[k] - y) < largest * unit.factor / 6.0) continue;
    x = c.x[k];
    y = c.y[k];
    marks.x.push_back(x);
    marks.y.push_back(y);
    const double angle = std::atan2(y, x);
    p.labels.push_back({x, y, fmt::format("{:.0f}", speed[k]),
                        std::cos(angle) < -0.3  ? Anchor::end
                        : std::cos(angle) > 0.3 ? Anchor::start
                                                : Anchor::middle,
                        8.0 * std::cos(angle), 4.0 - 13.0 * std::sin(angle)});
  }
  p.rules = {{Rule::Kind::horizontal, 0.0, "", Paint::gray, Dash::solid},
             {Rule::Kind::vertical, 0.0, "", Paint::gray, Dash::solid}};
  p.curves = {c, marks};
  f.panels.push_back(p);
  f.notes = {"Numbers along the loop are speeds [rpm]."};
  return f;
}

}  // namespace whirl::inline io::figures
