#include "libio/figures/common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "libdata/measured/order_tracking.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/results/call.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io::figures {

std::vector<double> row(const Mat& m, Eigen::Index i) {
  std::vector<double> values(static_cast<std::size_t>(m.cols()));
  for (Eigen::Index j = 0; j < m.cols(); ++j) values[static_cast<std::size_t>(j)] = m(i, j);
  return values;
}

std::vector<double> numbers(const Vec& v) {
  return {v.begin(), v.end()};
}

std::vector<double> numbers(const Vec& v, const MotionSamples& samples) {
  return numbers(v.segment(samples.first, samples.size()));
}

double largest_displacement(const StationMotion& motion) {
  return std::max(motion.x.cwiseAbs().maxCoeff(), motion.y.cwiseAbs().maxCoeff());
}

double per_mm() {
  return 1.0 / shown_unit("mm").size;
}

double speed_of(const ResultView& result) {
  if (result.file.has_attribute("/", "speed")) return result.file.number_attribute("/", "speed");
  if (result.model && result.model->has_speed) return result.model->speed;
  return std::nan("");
}

std::string speed_text(const ResultView& result) {
  const double speed = speed_of(result);
  return std::isfinite(speed) && speed > 0.0 ? shown_value(speed, "rpm", ".6g") : "";
}

std::optional<SpeedRange> run_up_of(const ResultView& result) {
  if (!result.file.has(dataset_of<OrderTracking>(&OrderTracking::speed))) return std::nullopt;
  const Vec& speeds = result_of<OrderTracking>(result).speed;
  if (speeds.size() == 0) return std::nullopt;
  const SpeedRange range{speeds.minCoeff(), speeds.maxCoeff()};
  constexpr double steady = 0.1;  // of the fastest
  if (!(range.fastest - range.slowest > steady * range.fastest)) return std::nullopt;
  return range;
}

std::string at_speeds(const ResultView& result) {
  const auto range = run_up_of(result);
  if (!range) return at_speed(result);
  return fmt::format(" from {} to {}", shown_number(range->slowest, "rpm", ".0f"),
                     shown_value(range->fastest, "rpm", ".0f"));
}

std::string at_speed(const ResultView& result) {
  const std::string speed = speed_text(result);
  return speed.empty() ? "" : " at " + speed;
}

WhirlStyle whirl_style(Whirl whirl) {
  switch (whirl) {
    case Whirl::forward:
      return {Paint::forward, Dash::solid, Marker::triangle, "forward (F)", "F"};
    case Whirl::backward:
      return {Paint::backward, Dash::dashed, Marker::triangle_down, "backward (B)", "B"};
    case Whirl::mixed:
      return {Paint::mixed, Dash::dash_dot, Marker::circle, "mixed (M)", "M"};
    default:
      return {Paint::mixed, Dash::dotted, Marker::diamond, "planar (P)", "P"};
  }
}

Label label_outwards(Complex at, const std::string& text) {
  const double angle = std::arg(at), c = std::cos(angle);
  const Anchor anchor = c < -0.3 ? Anchor::end : c > 0.3 ? Anchor::start : Anchor::middle;
  return {at.real(), at.imag(), text, anchor, 8.0 * c, 4.0 - 13.0 * std::sin(angle)};
}

std::string show_decrements(Panel& panel) {
  double low = 0.0, high = 0.0;
  std::string hidden;
  for (Curve& c : panel.curves) {
    std::vector<double> told;
    std::ranges::copy_if(c.y, std::back_inserter(told), [](double y) { return std::isfinite(y); });
    if (told.empty()) continue;
    const auto [least, largest] = std::ranges::minmax(told);
    if (least > most_decrement) {
      c.is_key = false;
      hidden += (hidden.empty() ? "" : ", ") + c.end_name;
      continue;
    }
    low = std::min(low, least);
    high = std::max(high, std::min(largest, most_decrement));
  }
  if (low == high) return "";  // nothing is near the limit: all is shown
  const Axis range = axis_around({low, high}, Scale::linear);
  panel.y.first = range.first;
  panel.y.last = range.last;
  return hidden.empty()
             ? ""
             : fmt::format("Log decrements above {:g} are not shown: {}.", most_decrement, hidden);
}

std::string plain_number(double value) {
  const double size = std::abs(value);
  return size >= 100.0 && size < 1e7 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string speed_label(double shown) {
  return shown_number(shown * speed_unit().size, "rpm", ".0f");
}

std::string with_unit(const std::string& what, const DisplayUnit& unit) {
  return unit.name.empty() ? what : fmt::format("{} [{}]", what, unit.name);
}

namespace {

/// Of several values that go together the first, where all of them would be longer than an axis.
std::string short_path(const std::string& path) {
  constexpr std::size_t longest = 60;
  const auto more = std::ranges::count(path, ',');
  if (path.size() <= longest || more == 0) return path;
  return fmt::format("{} and {} more", path.substr(0, path.find(',')), more);
}

ShownAxis shown(StoredParameter parameter) {
  ShownAxis axis{.path = std::move(parameter.path),
                 .values = std::move(parameter.values),
                 .si_unit = std::move(parameter.unit)};
  const DisplayUnit unit = unit_for(largest_of(axis.values), axis.si_unit);
  axis.unit = unit.name;
  axis.title = with_unit(short_path(axis.path), unit);
  axis.factor = 1.0 / unit.factor;
  axis.values = scaled(std::move(axis.values), unit.factor);
  return axis;
}

}  // namespace

ShownAxis shown_axis(const ResultView& result, const std::string& path) {
  return shown(stored_parameter(result.file, path));
}

std::vector<ShownAxis> shown_axes(const ResultView& result, std::string_view group) {
  std::vector<ShownAxis> axes;
  std::vector<StoredParameter> parameters = stored_parameters(result.file, group);
  const CoarseGrid grid = drawn_grid(result.file, group);
  const std::size_t leading = grid.steps.size() - std::min(grid.steps.size(), parameters.size());
  for (StoredParameter& p : parameters) {
    const std::size_t axis = leading + axes.size();
    if (!grid.is_all()) p.values = drawn_values(grid, axis, p.values);
    axes.push_back(shown(std::move(p)));
  }
  return axes;
}

std::string without_places(std::string text) {
  for (auto at = text.find('{'); at != text.npos; at = text.find('{', at + 2))
    text.insert(at, 1, '{');
  return text;
}

std::string command_on_model(const ResultView& result, const std::string& verb,
                             const std::vector<std::string_view>& kept) {
  const Call call = read_call(result.file);
  std::vector<std::string> words{"whirl", verb, result.model_path};
  for (const std::string& set : call.sets) words.insert(words.end(), {"--set", set});
  for (const std::string& option : options_named(call.options, kept)) words.push_back(option);
  return without_places(shell_line(words));
}

namespace {

/// The value of a path that begins with a minus: "2" of "-2", "{-x}" of "{x}".
std::string negated(const std::string& value) {
  if (value.starts_with('-')) return value.substr(1);
  if (value.starts_with('{')) return "{-" + value.substr(1);
  return "-" + value;
}

}  // namespace

std::string set_command(const std::string& paths, const std::string& value,
                        const std::string& unit) {
  std::string text;
  for (std::size_t from = 0; from < paths.size();) {
    const std::size_t to = std::min(paths.find(',', from), paths.size());
    const bool is_negative = paths[from] == '-';
    const std::size_t start = from + (is_negative ? 1 : 0);
    text += " --set " + without_places(shell_word(paths.substr(start, to - start) + "="));
    text += is_negative ? negated(value) : value;
    if (!unit.empty()) text += shell_word(unit);
    from = to + 1;
  }
  return text;
}

bool is_at(const ResultView& result, const Station& station, const std::string& label) {
  const Point p = result.assembler->point(station);
  if (p.kind == Point::Kind::body) {
    const std::string name = result.model->structure.bodies[static_cast<std::size_t>(p.index)].name;
    return label == name || label.starts_with(name + " + ");
  }
  return label == fmt::format("{}", p.index + 1) ||
         label.starts_with(fmt::format("{} ", p.index + 1));
}

int contact_at(const ResultView& result, const std::string& station) {
  if (!result.model || !result.assembler) return -1;
  const auto& contacts = result.model->contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!contacts[i].limits && is_at(result, contacts[i].at, station)) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::size_t> stations_by_interest(const ResultView& result,
                                              const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  // what stays where it is, as in a rigid bearing, comes last
  std::vector<int> interest(names.size(), 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (contact_at(result, names[i]) >= 0) interest[i] = 2;
  }
  if (!names.empty() && recorded_stations(result) == names) {
    const std::vector<StationMotion>& stations = result_of<MotionRecord>(result).stations;
    constexpr double still = 1e-9;  // of the largest motion
    Vec most(std::ssize(stations));
    for (std::size_t i = 0; i < stations.size(); ++i) {
      most(static_cast<Eigen::Index>(i)) =
          stations[i].x.cwiseAbs().maxCoeff() + stations[i].y.cwiseAbs().maxCoeff();
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (most(static_cast<Eigen::Index>(i)) <= still * most.maxCoeff()) interest[i] = 0;
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return interest[a] > interest[b]; });
  return order;
}

Curve circle(const std::string& name, double radius, double x, double y) {
  return curve_around(name, [&](const Vec2&) { return radius; }, {x, y});
}

Curve curve_around(const std::string& name, const std::function<double(const Vec2&)>& reach,
                   const Vec2& middle) {
  Curve c{.name = name, .paint = Paint::stator, .dash = Dash::dashed};
  constexpr int points = 180;
  for (int i = 0; i <= points; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / points;
    const Vec2 along(std::cos(angle), std::sin(angle));
    const double radius = reach(along);
    c.x.push_back(middle(0) + radius * along(0));
    c.y.push_back(middle(1) + radius * along(1));
  }
  return c;
}

Curve line_across(const std::string& name, const Vec2& direction, double distance, double length,
                  const Vec2& from) {
  const Vec2 along(-direction(1), direction(0));
  Curve c{.name = name, .paint = Paint::stator, .dash = Dash::dashed};
  for (const double side : {-length, length}) {
    const Vec2 end = from + distance * direction + side * along;
    c.x.push_back(end(0));
    c.y.push_back(end(1));
  }
  return c;
}

Curve dots_of_revolutions() {
  Curve dots{.name = "once a revolution", .paint = Paint::alarm, .has_line = false};
  dots.has_marker = true;
  dots.size = 4.5;
  dots.along_title = "time";
  return dots;
}

void keep_room(FigureAxis& axis, const std::vector<double>& values, double room) {
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*high - *low <= room) axis.first = *low - room, axis.last = *high + room;
}

std::vector<std::string> recorded_stations(const ResultView& result) {
  std::vector<std::string> names;
  for (const StationMotion& s : result_of<MotionRecord>(result).stations) {
    names.push_back(s.station);
  }
  return names;
}

Motion::Motion(const ResultView& result)
    : RecordedMotion(recorded_motion(result.file)),
      record(result_of<MotionRecord>(result)),
      stations(recorded_stations(result)),
      window(result.window) {
  const double speed = speed_of(result);
  spins = std::isfinite(speed) && speed > 0.0;
}

double Motion::phase(Eigen::Index i) const {
  // times are counted in whole revolutions since phase 0
  return spins && period > 0.0 ? 2.0 * std::numbers::pi * time(i) / period : 0.0;
}

bool Motion::ends_revolution(Eigen::Index i) const {
  const double turns = phase(i) / (2.0 * std::numbers::pi);
  return spins && std::abs(turns - std::round(turns)) * static_cast<double>(per_revolution) < 0.5;
}

MotionSamples Motion::shown(double revolutions) const {
  return samples_of(window, *this, revolutions);
}

MotionSamples Motion::drawn(double revolutions) const {
  return window.is_given() ? shown(revolutions) : MotionSamples{0, size() - 1, ""};
}

std::vector<std::string> Motion::notes(double revolutions) const {
  if (window.is_given()) {
    std::string text = shown(revolutions).text;
    text[0] = static_cast<char>(std::toupper(text[0]));
    return {text + "."};
  }
  if (shown(revolutions).first == 0) return {};
  return {fmt::format("The last {:g} revolutions.", revolutions)};
}

void Motion::show_over_time(Panel& p, double revolutions) const {
  constexpr double before = 4.0, after = 12.0;  // revolutions
  const MotionSamples seen = shown(revolutions);
  p.x.first = time(seen.first);
  p.x.last = time(seen.last);
  p.x.title = "time [s]";
  p.cursor = "time";
  for (const double t : record.begins) {
    p.rules.push_back({Rule::Kind::vertical, t, "", Paint::alarm, Dash::dashed});
  }
  if (record.begins.empty() || window.is_given()) return;
  p.x.first = std::max(time(0), record.begins.front() - before * period);
  p.x.last = std::min(time(size() - 1), record.begins.front() + after * period);
}

std::vector<std::string> Motion::time_notes(double revolutions) const {
  if (window.is_given() || record.begins.empty()) return notes(revolutions);
  return {"About the instant at which a load begins, the broken line."};
}

SealShape seal_shape(double at, double half, double tip, double top) {
  constexpr int teeth = 4;
  const double root = 0.5 * (tip + top);
  const double pitch = 2.0 * half / (2 * teeth - 1);  // teeth are as wide as what is between them
  SealShape shape{{at - half}, {top}};
  for (int i = 0; i < teeth; ++i) {
    const double from = at - half + 2 * i * pitch, to = from + pitch;
    if (i > 0) {
      shape.x.push_back(from);
      shape.y.push_back(root);
    }
    shape.x.insert(shape.x.end(), {from, to});
    shape.y.insert(shape.y.end(), {tip, tip});
    if (i + 1 < teeth) {
      shape.x.push_back(to);
      shape.y.push_back(root);
    }
  }
  shape.x.insert(shape.x.end(), {at + half, at - half});
  shape.y.insert(shape.y.end(), {top, top});
  return shape;
}

}  // namespace whirl::inline io::figures
