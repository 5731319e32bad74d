#include "libfe/critical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libfe/base/error.hpp"
#include "libio/figures/all.hpp"

namespace whirl {

namespace {

using namespace figures;

constexpr int steps = 25;                         ///< stiffnesses that are computed
constexpr double softest = 1e-2, stiffest = 1e2;  ///< of the model's

/// A structure with the stiffness of its constant bearings multiplied.
Structure with_stiffness(Structure s, double factor) {
  for (Connection& b : s.bearings) {
    if (auto* constant = std::get_if<ConstantBearing>(&b.coefficients)) constant->value.K *= factor;
  }
  return s;
}

}  // namespace

// Critical speeds of one sense, counted from the lowest, go on smoothly as bearings get stiffer:
// where senses cross they do not mix, and within one sense they do not cross.
std::vector<Figure> critical_figures(const ResultView& result) {
  const Structure& s = result.model->structure;
  double stiffness = 0.0, other = INFINITY;  // largest and least
  for (const Connection& b : s.bearings) {
    const auto* constant = std::get_if<ConstantBearing>(&b.coefficients);
    if (b.is_rigid || b.is_clamped || constant == nullptr) continue;
    stiffness = std::max(stiffness, constant->value.K(0, 0));
    other = std::min(other, constant->value.K(0, 0));
  }
  const auto speeds = numbers(result.file.vector("/critical/speed"));
  if (!(stiffness > 0.0) || speeds.empty()) return {};
  const bool is_same = other > 0.999 * stiffness;
  const double order = result.file.number_attribute("/critical", "order");
  Figure f{.height = 500.0};
  f.subtitle = fmt::format("Undamped critical speeds of order {:g} over bearing stiffness", order);
  Panel p;
  const double unit = is_same ? stiffness : 1.0;
  p.x = {.title = is_same ? "stiffness of each bearing [N/m]" : "stiffness of the bearings, times",
         .scale = Scale::logarithmic};
  p.y = {.title = "critical speed [rpm]", .scale = Scale::logarithmic};
  struct Line {
    std::string whirl;
    Curve curve;
  };
  std::vector<Line> lines;
  const auto count = static_cast<int>(speeds.size());
  for (int k = 0; k < steps; ++k) {
    const double factor =
        softest * std::pow(stiffest / softest, static_cast<double>(k) / (steps - 1));
    std::vector<Critical> found;
    try {
      found =
          critical_speeds(Assembler(with_stiffness(s, factor)), {.count = count, .order = order});
    } catch (const NumericalError&) {
      continue;  // a gap in the map
    }
    std::vector<std::pair<std::string, int>> seen;
    for (const Critical& c : found) {
      const std::string sense{name_of(c.whirl)};
      auto counter =
          std::find_if(seen.begin(), seen.end(), [&](auto& e) { return e.first == sense; });
      if (counter == seen.end()) counter = seen.insert(seen.end(), {sense, 0});
      const std::string name = fmt::format("{}{}", ++counter->second, whirl_style(sense).letter);
      auto line = std::find_if(lines.begin(), lines.end(),
                               [&](const Line& l) { return l.curve.end_name == name; });
      if (line == lines.end()) {
        const WhirlStyle style = whirl_style(sense);
        Curve curve{.name = style.name, .end_name = name, .paint = style.paint};
        curve.width = 1.8;
        curve.dash = style.dash;
        curve.has_marker = true;
        curve.marker = style.marker;
        curve.marker_every = 6;
        line = lines.insert(lines.end(), {sense, curve});
      }
      line->curve.x.push_back(unit * factor);
      line->curve.y.push_back(c.speed / rpm);
    }
  }
  for (Line& l : lines) p.curves.push_back(std::move(l.curve));
  p.rules.push_back({Rule::Kind::vertical, unit, "of the model", Paint::gray, Dash::dashed});
  const double speed = speed_of(result) / rpm;
  if (std::isfinite(speed) && speed > 0.0) {
    p.rules.push_back({Rule::Kind::horizontal, speed, "operating", Paint::gray, Dash::dotted});
  }
  const auto whirl = result.file.strings("/critical/whirl");
  const auto damped = numbers(result.file.vector("/critical/damped_speed"));
  f.table.header = {"critical speed [rpm]", "whirl", "damped [rpm]"};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    f.table.rows.push_back(
        {fmt::format("{:.1f}", speeds[i] / rpm), whirl[i],
         std::isfinite(damped[i]) ? fmt::format("{:.1f}", damped[i] / rpm) : "-"});
  }
  f.panels.push_back(std::move(p));
  return {f};
}

}  // namespace whirl
