// Orbits of a station at chosen moments, side by side: as they are, of an order, of a band of
// frequencies, averaged; with the mark of the key-phasor.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/figures/probes.hpp"
#include "libio/figures/turned_motion.hpp"
#include "libio/text/option_values.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

constexpr double usual_revolutions = 8.0;
constexpr std::size_t moments_of_run_up = 6;
constexpr std::size_t most_panels = 24;
constexpr std::size_t most_stations = 4;  ///< of a simulation, in which all of a rotor may move
constexpr double blank = 0.03;  ///< of a closed path, left out before the mark to show its sense

/// When the motion is looked at, where nobody says it: along a run-up, else at its end.
std::vector<double> usual_moments(const DrawnMotion& m, double revolutions) {
  if (!m.is_run_up()) return {m.end() - 0.5 * revolutions * turn / m.motion.clock.mean_speed()};
  std::vector<double> moments;
  const double range = m.fastest - m.slowest;
  const double round_to =
      std::pow(10.0, std::floor(std::log10(0.1 * range / speed_unit().size))) * speed_unit().size;
  for (std::size_t i = 0; i < moments_of_run_up; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(moments_of_run_up);
    const double speed = m.slowest + part * range;
    moments.push_back(moment_of_speed(m.motion.clock, round_to * std::round(speed / round_to)));
  }
  return moments;
}

std::vector<double> moments_of(const ResultView& result, const DrawnMotion& m, double revolutions) {
  const Moments& asked = result.view.at;
  if (!asked.times.empty()) return asked.times;
  if (asked.speeds.empty()) {
    if (result.window.times) {
      return {0.5 * (result.window.times->first + result.window.times->second)};
    }
    return usual_moments(m, revolutions);
  }
  std::vector<double> moments;
  for (const double speed : asked.speeds) moments.push_back(moment_of_speed(m.motion.clock, speed));
  return moments;
}

/// What is shown of each moment.
std::vector<OrbitFilter> filters_of(const ResultView& result, const DrawnMotion& m,
                                    double revolutions) {
  const MotionView& view = result.view;
  OrbitFilter plain{.revolutions = revolutions, .slow_roll = view.slow_roll};
  std::vector<OrbitFilter> filters;
  for (const double order : view.orders) {
    filters.push_back(plain);
    filters.back().order = order;
  }
  if (view.band) {
    filters.push_back(plain);
    filters.back().band = view.band;
  }
  if (view.is_averaged) {
    filters.push_back(plain);
    filters.back().is_averaged = true;
  }
  if (!filters.empty()) return filters;
  filters.push_back(plain);
  if (m.is_run_up() || !view.at.empty() || revolutions < fewest_orbit_revolutions) return filters;
  for (const double order : {1.0, 2.0}) {  // of a steady motion, what it is made of
    filters.push_back(plain);
    filters.back().order = order;
  }
  return filters;
}

Panel orbit_panel(const StationOrbit& orbit, const OrbitFilter& filter, const DisplayUnit& unit,
                  const DrawnMotion& m) {
  Panel p;
  p.title = fmt::format("{}, {}", shown_value(orbit.speed, "rpm", ".0f"), filter.text());
  p.has_equal_scales = true;
  p.x.title = with_unit("x", unit);
  p.y.title = with_unit("y", unit);
  const bool is_closed = filter.order || filter.is_averaged;
  Eigen::Index count = orbit.x.size();
  if (is_closed && m.motion.has_marks) {
    count -= static_cast<Eigen::Index>(blank * static_cast<double>(count));
  }
  Curve c{.name = "path", .paint = Paint::forward};
  c.x = scaled(numbers(Vec(orbit.x.head(count))), unit.factor);
  c.y = scaled(numbers(Vec(orbit.y.head(count))), unit.factor);
  c.along = numbers(Vec(orbit.t.head(count)));
  c.along_title = "time";
  c.width = is_closed ? 1.8 : 1.0;
  p.curves.push_back(std::move(c));
  if (orbit.marks.empty()) return p;
  Curve marks{.name = "key-phasor", .paint = Paint::alarm, .has_line = false};
  marks.has_marker = true;
  marks.size = is_closed ? 8.0 : 5.0;
  for (const Complex& mark : orbit.marks) {
    marks.x.push_back(unit.factor * mark.real());
    marks.y.push_back(unit.factor * mark.imag());
  }
  p.curves.push_back(std::move(marks));
  return p;
}

/// Peak to peak along each probe, or along x and y.
std::string sizes_text(const StationOrbit& orbit, const std::vector<Probe>& probes,
                       const DisplayUnit& unit) {
  const auto size = [&](double angle) {
    const Vec reading = std::cos(angle) * orbit.x + std::sin(angle) * orbit.y;
    return plain_number(unit.factor * (reading.maxCoeff() - reading.minCoeff()));
  };
  if (probes.empty()) return size(0.0) + ", " + size(0.5 * std::numbers::pi);
  std::string text;
  for (const Probe& probe : probes) text += (text.empty() ? "" : ", ") + size(probe.angle);
  return text;
}

std::vector<std::string> row_of(const StationOrbit& orbit, const OrbitFilter& filter,
                                const std::vector<Probe>& probes, const DisplayUnit& unit) {
  return {shown_number(orbit.speed, "rpm", ".1f"),
          fmt::format("{:.4g}", orbit.time),
          filter.text(),
          sizes_text(orbit, probes, unit),
          filter.order ? plain_number(unit.factor * orbit.forward()) : "-",
          filter.order ? plain_number(unit.factor * orbit.backward()) : "-",
          with_minus(plain_number(unit.factor * orbit.gap.real()) + ", " +
                     plain_number(unit.factor * orbit.gap.imag()))};
}

/// @param is_closed  whether the orbits begin and end at one place
std::vector<std::string> notes_of(const DrawnMotion& m, const StationOrbit& orbit, bool is_closed) {
  std::vector<std::string> notes{
      fmt::format("{:g} revolutions about each moment; the mean position (gap) is taken off.",
                  orbit.revolutions)};
  if (orbit.slow_roll) {
    notes.push_back(fmt::format("Slow roll, the motion at {}, is taken off.",
                                shown_value(*orbit.slow_roll, "rpm", ".4g")));
  }
  if (m.motion.has_marks) {
    notes.push_back(is_closed ? "The path goes from the mark of the key-phasor away from "
                                "the blank."
                              : "Marks are those of the key-phasor.");
  } else {
    notes.push_back("No key-phasor: orders are those of the speed that was given.");
  }
  return notes;
}

Figure orbits_of(const ResultView& result, const DrawnMotion& m, std::size_t station,
                 const std::vector<double>& moments, const std::vector<OrbitFilter>& filters) {
  const StationMotion& of = m.station(station);
  const std::vector<Probe> probes = probes_of_station(result, m, of.station);
  std::vector<StationOrbit> orbits;
  double largest = 0.0;
  for (const double at : moments) {
    for (const OrbitFilter& filter : filters) {
      orbits.push_back(orbit_at(m.motion, station, at, filter));
      largest = std::max(
          {largest, orbits.back().x.cwiseAbs().maxCoeff(), orbits.back().y.cwiseAbs().maxCoeff()});
    }
  }
  const DisplayUnit unit = unit_of_station(probes, largest);
  Figure f{.variant = of.station};
  f.subtitle = fmt::format("{}: orbits", of.station);
  std::string directions;
  for (const Probe& probe : probes) directions += (directions.empty() ? "" : ", ") + probe.name;
  f.table.header = {shown_heading("speed", "rpm"),
                    "time [s]",
                    "shown",
                    fmt::format("p-p {} [{}]", directions.empty() ? "x, y" : directions, unit.name),
                    fmt::format("forward [{}]", unit.name),
                    fmt::format("backward [{}]", unit.name),
                    fmt::format("gap x, y [{}]", unit.name)};
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    const OrbitFilter& filter = filters[i % filters.size()];
    Panel p = orbit_panel(orbits[i], filter, unit, m);
    const double size =
        std::max(orbits[i].x.cwiseAbs().maxCoeff(), orbits[i].y.cwiseAbs().maxCoeff());
    if (i == 0) add_probes(probes, size, unit.factor, p);
    f.panels.push_back(std::move(p));
    f.table.rows.push_back(row_of(orbits[i], filter, probes, unit));
  }
  const std::size_t wide =
      filters.size() > 1 ? filters.size() : std::min<std::size_t>(3, moments.size());
  f.columns = static_cast<int>(std::min<std::size_t>(wide, 4));
  const std::size_t high = (f.panels.size() + static_cast<std::size_t>(f.columns) - 1) /
                           static_cast<std::size_t>(f.columns);
  f.width = f.columns == 1 ? 520.0 : 320.0 * f.columns;
  f.height = 90.0 + (f.columns == 1 ? 450.0 : 290.0) * static_cast<double>(high);
  f.notes = notes_of(m, orbits.front(), std::ranges::all_of(filters, [](const OrbitFilter& filter) {
                       return filter.order || filter.is_averaged;
                     }));
  return f;
}

std::vector<Figure> orbits_figures(const ResultView& result) {
  const auto m = drawn_motion(result);
  if (!m) return {};
  const double all = static_cast<double>(m->motion.clock.turns().size() - 1);
  const double revolutions = std::min(result.window.revolutions.value_or(usual_revolutions), all);
  const std::vector<double> moments = moments_of(result, *m, revolutions);
  const std::vector<OrbitFilter> filters = filters_of(result, *m, revolutions);
  if (moments.size() * filters.size() > most_panels) {
    throw wrong_option("at", "",
                       fmt::format("makes {} panels, {} are room enough for a figure",
                                   moments.size() * filters.size(), most_panels));
  }
  std::vector<std::size_t> stations;
  if (m->is_measured) {
    for (std::size_t i = 0; i < m->motion.stations.size(); ++i) stations.push_back(i);
  } else {
    stations = stations_by_interest(result, recorded_stations(result));
    if (result.view.given.empty() && stations.size() > most_stations) {
      stations.resize(most_stations);
    }
  }
  std::vector<Figure> figures;
  for (const std::size_t i : stations) {
    figures.push_back(orbits_of(result, *m, i, moments, filters));
  }
  return figures;
}

}  // namespace

FigureKind orbits_kind() {
  return {
      .name = "orbits",
      .title = "Orbits at moments",
      .summary =
          "orbits at chosen speeds or times without the gap: raw, an order, a band, averaged",
      .needs_one = motion_datasets(),
      .make = orbits_figures,
      .takes_window = true,
      .takes = {"at", "order", "band", "average", "slow-roll"},
  };
}

}  // namespace whirl::inline io
