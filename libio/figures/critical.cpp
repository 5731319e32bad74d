#include "libfe/critical.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "libfe/base/error.hpp"
#include "libio/figures/all.hpp"

namespace whirl {

namespace {

using namespace figures;

constexpr int steps_per_decade = 6;
constexpr double beyond = 1e2;  ///< the map goes from the softest stiffness over this to the
                                ///< stiffest times this

/// How a bearing's stiffness enters the map.
using ChangeStiffness = std::function<void(BearingCoefficients&)>;

bool is_flexible(const Connection& b) {
  return !b.is_rigid && !b.is_clamped;
}

void change(AnyBearing& bearing, const ChangeStiffness& how) {
  if (auto* constant = std::get_if<ConstantBearing>(&bearing)) how(constant->value);
  if (auto* table = std::get_if<TableBearing>(&bearing)) {
    for (BearingCoefficients& row : table->rows) how(row);
  }
}

/// Critical speeds with changed bearings; none where they cannot be found.
std::vector<Critical> criticals_with(Structure s, const ChangeStiffness& how,
                                     const CriticalOptions& options) {
  for (Connection& b : s.bearings) {
    if (is_flexible(b)) change(b.coefficients, how);
  }
  try {
    return critical_speeds(Assembler(s), options);
  } catch (const NumericalError&) {
    return {};  // a gap in the map
  }
}

/// Stiffness of a bearing in one direction, whatever the speed is.
struct StiffnessCurve {
  std::string name;
  AnyBearing bearing;
  Eigen::Index direction = 0;  ///< 0: Kxx, 1: Kyy

  double at(double Omega) const { return coefficients(bearing, Omega).K(direction, direction); }
};

/// A curve for every stiffness that is not like another one at these speeds [rad/s].
std::vector<StiffnessCurve> stiffness_curves(const Structure& s,
                                             const std::vector<double>& speeds) {
  constexpr double same = 1e-9;
  struct Group {
    StiffnessCurve curve;
    std::vector<std::string> bearings, directions;
  };
  std::vector<Group> groups;
  for (const Connection& b : s.bearings) {
    if (!is_flexible(b)) continue;
    for (const Eigen::Index direction : {0, 1}) {
      const StiffnessCurve c{"", b.coefficients, direction};
      auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
        return std::all_of(speeds.begin(), speeds.end(), [&](double Omega) {
          return std::abs(c.at(Omega) - g.curve.at(Omega)) <= same * std::abs(c.at(Omega));
        });
      });
      if (group == groups.end()) group = groups.insert(groups.end(), Group{c, {}, {}});
      const auto add = [](std::vector<std::string>& list, const std::string& name) {
        if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
      };
      add(group->bearings, b.name);
      add(group->directions, direction == 0 ? "Kxx" : "Kyy");
    }
  }
  const auto count =
      static_cast<std::size_t>(std::count_if(s.bearings.begin(), s.bearings.end(), is_flexible));
  std::vector<StiffnessCurve> curves;
  for (Group& g : groups) {
    g.curve.name = fmt::format("{}", fmt::join(g.directions, ", "));
    if (g.bearings.size() < count) {
      g.curve.name += fmt::format(" of {}", fmt::join(g.bearings, ", "));
    }
    curves.push_back(std::move(g.curve));
  }
  return curves;
}

/// Critical speeds of one sense, counted from the lowest, go on smoothly as bearings get stiffer:
/// where senses cross they do not mix, and within one sense they do not cross.
class CriticalLines {
 public:
  void add(double x, const std::vector<Critical>& found) {
    std::map<std::string, int> seen;
    for (const Critical& c : found) {
      const std::string sense{name_of(c.whirl)};
      const WhirlStyle style = whirl_style(sense);
      const std::string name = fmt::format("{}{}", ++seen[sense], style.letter);
      auto line = std::find_if(curves_.begin(), curves_.end(),
                               [&](const Curve& curve) { return curve.end_name == name; });
      if (line == curves_.end()) {
        Curve curve{.name = style.name, .end_name = name, .paint = style.paint};
        curve.width = 1.8;
        curve.dash = style.dash;
        curve.has_marker = true;
        curve.marker = style.marker;
        curve.marker_every = 6;
        line = curves_.insert(curves_.end(), std::move(curve));
      }
      line->x.push_back(x);
      line->y.push_back(c.speed / rpm);
    }
  }
  const std::vector<Curve>& curves() const { return curves_; }

 private:
  std::vector<Curve> curves_;
};

/// Numbers at equal ratios.
std::vector<double> from_to(double first, double last) {
  const int steps = static_cast<int>(std::ceil(steps_per_decade * std::log10(last / first)));
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k) {
    values.push_back(first * std::pow(last / first, static_cast<double>(k) / std::max(steps, 1)));
  }
  return values;
}

/// Stiffness of the bearings over speed, and where it crosses the critical speeds of the map.
void draw_bearings(const Structure& s, const CriticalOptions& options,
                   const std::vector<Curve>& lines, Panel& p) {
  double low = INFINITY, high = 0.0;  // speeds of the map [rad/s]
  for (const Curve& line : lines) {
    for (const double speed : line.y) {
      low = std::min(low, rpm * speed);
      high = std::max(high, rpm * speed);
    }
  }
  if (!(high > low)) return;
  std::vector<double> speeds;
  constexpr int points = 200;
  for (int k = 0; k <= points; ++k) {
    speeds.push_back(low * std::pow(high / low, static_cast<double>(k) / points));
  }
  Curve crossings{.name = "crossings", .paint = Paint::ink, .has_line = false};
  crossings.has_marker = true;
  crossings.marker = Marker::cross;
  crossings.size = 9.0;
  std::size_t number = 0;
  for (const StiffnessCurve& stiffness : stiffness_curves(s, speeds)) {
    Curve c{.name = stiffness.name, .paint = series_paint(number + 1)};
    constexpr Dash dashes[] = {Dash::solid, Dash::dashed, Dash::dash_dot, Dash::dotted};
    c.dash = dashes[number++ % 4];
    c.width = 1.4;
    for (const double Omega : speeds) {
      c.x.push_back(stiffness.at(Omega) > 0.0 ? stiffness.at(Omega) : std::nan(""));
      c.y.push_back(Omega / rpm);
    }
    p.curves.push_back(std::move(c));
    // every bearing with this stiffness, in all directions
    Structure alike = s;
    for (Connection& b : alike.bearings) {
      if (is_flexible(b)) b.coefficients = stiffness.bearing;
    }
    const auto direction = stiffness.direction;
    const auto isotropic = [&](BearingCoefficients& b) {
      b.K = Mat2::Identity() * b.K(direction, direction);
    };
    for (const Critical& at : criticals_with(alike, isotropic, options)) {
      const double k = stiffness.at(at.speed);
      if (!(k > 0.0)) continue;
      crossings.x.push_back(k);
      crossings.y.push_back(at.speed / rpm);
      crossings.hover.push_back(
          fmt::format("{}: {} at {:.1f} rpm", stiffness.name, name_of(at.whirl), at.speed / rpm));
    }
  }
  p.curves.push_back(std::move(crossings));
}

}  // namespace

// With bearings that are alike, or that change with speed: over a stiffness that all of them have in
// all directions, with their own stiffness on top, so that critical speeds are where these cross
// [API684]. With bearings that differ: over a factor of all of them, where the model is at 1.
std::vector<Figure> critical_figures(const ResultView& result) {
  const Structure& s = result.model->structure;
  std::vector<double> stiffness;  // all that occur [N/m]
  bool has_table = false, is_same = true;
  double first = 0.0;  // Kxx of the first bearing
  for (const Connection& b : s.bearings) {
    if (!is_flexible(b)) continue;
    AnyBearing copy = b.coefficients;
    change(copy, [&](const BearingCoefficients& c) {
      for (const Eigen::Index i : {0, 1}) {
        if (c.K(i, i) > 0.0) stiffness.push_back(c.K(i, i));
      }
    });
    const double k = coefficients(b.coefficients, 0.0).K(0, 0);
    if (first == 0.0) first = k;
    is_same = is_same && std::abs(k - first) <= 1e-3 * std::abs(first);
    has_table = has_table || depends_on_speed(b.coefficients);
  }
  const auto speeds = numbers(result.file.vector("/critical/speed"));
  if (stiffness.empty() || speeds.empty()) return {};
  const CriticalOptions options{.count = static_cast<int>(speeds.size()),
                                .order = result.file.number_attribute("/critical", "order"),
                                .has_damped = false};
  const bool is_common = has_table || is_same;
  Figure f{.height = 500.0};
  f.subtitle =
      fmt::format("Undamped critical speeds of order {:g} over bearing stiffness", options.order);
  Panel p;
  p.x = {
      .title = is_common ? "stiffness of each bearing [N/m]" : "stiffness of the bearings, times",
      .scale = Scale::logarithmic};
  p.y = {.title = "critical speed [rpm]", .scale = Scale::logarithmic};
  CriticalLines lines;
  if (is_common) {
    const auto [softest, stiffest] = std::minmax_element(stiffness.begin(), stiffness.end());
    for (const double k : from_to(*softest / beyond, *stiffest * beyond)) {
      lines.add(k, criticals_with(
                       s, [&](BearingCoefficients& b) { b.K = Mat2::Identity() * k; }, options));
    }
  } else {
    for (const double factor : from_to(1.0 / beyond, beyond)) {
      lines.add(factor, criticals_with(
                            s, [&](BearingCoefficients& b) { b.K *= factor; }, options));
    }
    p.rules.push_back({Rule::Kind::vertical, 1.0, "of the model", Paint::gray, Dash::dashed});
  }
  p.curves = lines.curves();
  if (is_common) draw_bearings(s, options, lines.curves(), p);
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
