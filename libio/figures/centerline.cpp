// Shaft centerline: where a shaft runs on the average along a motion, in the clearance of its
// bearing.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/numerics/constants.hpp"
#include "libdata/measured/mean_path.hpp"
#include "libdata/measured/measured_identification.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/figures/turned_motion.hpp"
#include "libio/text/shown_units.hpp"

namespace whirl::inline io {

namespace {

using namespace figures;

/// A clearance that a shaft has beside a station.
struct Room {
  double clearance = 0.0;      ///< radial [m]
  Vec2 middle = Vec2::Zero();  ///< [m]
  std::string of;              ///< "bearing DE"
};

/// Where the probes of a record's station are; nothing: at a body, or the file does not say it.
std::optional<double> position_of_probes(const ResultView& result, const std::string& station) {
  const auto& measured = result_of<MeasuredIdentification>(result);
  for (std::size_t i = 0; i < measured.probes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (station.find(measured.probes[i].name) != 0 || row >= measured.probe_z.size()) continue;
    if (std::isfinite(measured.probe_z(row))) return measured.probe_z(row);
  }
  return std::nullopt;
}

/// The clearance that was asked for, or that of the bearing nearest to a station.
std::optional<Room> room_at(const ResultView& result, const DrawnMotion& m,
                            const std::string& station) {
  if (result.view.clearance) return Room{*result.view.clearance, Vec2::Zero(), "as given"};
  if (!result.model || !result.assembler) return std::nullopt;
  if (!m.is_measured) {
    const int contact = contact_at(result, station);
    if (contact >= 0) {
      const Contact& c = result.model->contacts[static_cast<std::size_t>(contact)];
      return Room{c.clearance, c.offset, "of contact " + c.name};
    }
  }
  const auto at = m.is_measured ? position_of_probes(result, station) : std::nullopt;
  std::optional<Room> nearest;
  double least = 1e300;
  for (const Connection& b : result.model->structure.bearings) {
    if (!(b.clearance > 0.0)) continue;
    const auto z = result.assembler->mesh().position_of(result.assembler->point(b.from));
    const bool is_here = is_at(result, b.from, station);
    if (!is_here && (!at || !z)) continue;
    const double distance = is_here ? 0.0 : std::abs(*z - *at);
    if (distance >= least) continue;
    least = distance;
    nearest = Room{b.clearance, Vec2::Zero(), "of bearing " + b.name};
    if (distance > 1e-9)
      nearest->of += fmt::format(", {} beside the probes", shown_value(distance, "mm", ".3g"));
  }
  return nearest;
}

/// The point that is a record's resting place: at the slow-roll speed, else the slowest one.
Eigen::Index reference_of(const ResultView& result, const MeanPath& path) {
  Eigen::Index at = 0;
  if (result.view.slow_roll) {
    (path.speed.array() - *result.view.slow_roll).abs().minCoeff(&at);
  } else {
    path.speed.minCoeff(&at);
  }
  return at;
}

/// Names of speeds, or of times of a steady motion, where the path has gone on.
void add_labels(const DrawnMotion& m, const MeanPath& path, const Curve& c, Panel& p) {
  double size = 0.0;
  for (std::size_t k = 1; k < c.x.size(); ++k) {
    size = std::max(size, std::hypot(c.x[k] - c.x[0], c.y[k] - c.y[0]));
  }
  if (!(size > 0.0)) return;  // a shaft that rests: its curve has a marker
  Curve marks{.paint = Paint::ink, .has_line = false};
  marks.has_marker = true;
  marks.size = 5.0;
  double x = 1e300, y = 1e300;
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    const bool is_last = k + 1 == c.x.size();
    const double apart = std::hypot(c.x[k] - x, c.y[k] - y);
    if (!is_last && apart < size / 6.0) continue;
    // the end has its name, and the one before it goes where both have no room
    if (is_last && apart < size / 8.0 && p.labels.size() > 1) p.labels.pop_back();
    x = c.x[k];
    y = c.y[k];
    marks.x.push_back(x);
    marks.y.push_back(y);
    if (!m.is_run_up() && !is_last && k > 0) continue;  // a steady one: where it begins and ends
    const auto i = static_cast<Eigen::Index>(k);
    const std::string text = m.is_run_up() ? shown_number(path.speed(i), "rpm", ".0f")
                                           : fmt::format("{:.3g} s", path.time(i));
    p.labels.push_back({x, y, text});
  }
  p.curves.push_back(std::move(marks));
}

/// Where the shaft is; of a steady record its means over a twelfth of it each, as beats and noise
/// are no path.
MeanPath path_of(const DrawnMotion& m, std::size_t station) {
  constexpr Eigen::Index most = 12;
  MeanPath path = mean_path(m.motion, station);
  const Eigen::Index count = path.x.size();
  if (!m.is_measured || m.is_run_up() || count <= most) return path;
  for (Vec* v : {&path.time, &path.speed, &path.x, &path.y}) {
    Vec means(most);
    for (Eigen::Index k = 0; k < most; ++k) {
      const Eigen::Index from = k * count / most, to = (k + 1) * count / most;
      means(k) = v->segment(from, to - from).mean();
    }
    *v = std::move(means);
  }
  return path;
}

std::optional<Figure> centerline(const ResultView& result, const DrawnMotion& m,
                                 std::size_t station) {
  const StationMotion& of = m.station(station);
  const MeanPath path = path_of(m, station);
  if (path.x.size() == 0) return std::nullopt;
  const std::vector<Probe> probes = probes_of_station(result, m, of.station);
  const auto room = room_at(result, m, of.station);
  Figure f{.variant = of.station, .width = 560.0, .height = 580.0};
  f.subtitle = fmt::format("{}: shaft centerline", of.station);
  // gaps say how the shaft moves, not where it is: it rests at the bottom of its clearance
  Vec2 shift = Vec2::Zero();
  if (m.is_measured) {
    const Eigen::Index at = reference_of(result, path);
    shift = -Vec2(path.x(at), path.y(at));
    std::string note =
        fmt::format("From the gaps, against {}", shown_value(path.speed(at), "rpm", ".4g"));
    if (room) {
      shift += room->middle - Vec2(0.0, room->clearance);
      note += ", where the shaft is taken to lie at the bottom of its clearance";
    }
    f.notes.push_back(note + ".");
  }
  double largest = room ? room->clearance : 0.0;
  for (Eigen::Index k = 0; k < path.x.size(); ++k) {
    largest = std::max(largest, std::hypot(path.x(k) + shift(0), path.y(k) + shift(1)));
  }
  const DisplayUnit unit = unit_of_station(probes, largest);
  Panel p;
  p.has_equal_scales = true;
  p.x.title = with_unit("x", unit);
  p.y.title = with_unit("y", unit);
  Curve c{.name = "mean position", .paint = Paint::forward};
  c.along_title = "time";
  c.width = 1.8;
  for (Eigen::Index k = 0; k < path.x.size(); ++k) {
    c.x.push_back(unit.factor * (path.x(k) + shift(0)));
    c.y.push_back(unit.factor * (path.y(k) + shift(1)));
    c.along.push_back(path.time(k));
    c.hover.push_back(shown_value(path.speed(k), "rpm", ".5g"));
  }
  if (room) {
    p.curves.push_back(circle("clearance", unit.factor * room->clearance,
                              unit.factor * room->middle(0), unit.factor * room->middle(1)));
    f.notes.push_back(fmt::format("Clearance {:.4g} {}, radial, {}.", unit.factor * room->clearance,
                                  unit.name, room->of));
  } else {
    f.notes.push_back("The clearance is not known: neither the model nor --clearance says it.");
  }
  c.has_marker = (path.x.array() == path.x(0)).all() && (path.y.array() == path.y(0)).all();
  add_labels(m, path, c, p);
  p.curves.push_back(std::move(c));
  f.panels.push_back(std::move(p));
  if (m.is_run_up())
    f.notes.push_back(shown_heading("Numbers along the path are speeds", "rpm") + ".");
  return f;
}

std::vector<Figure> centerline_figures(const ResultView& result) {
  const auto m = drawn_motion(result);
  if (!m) return {};
  std::vector<std::size_t> stations;
  for (std::size_t i = 0; i < m->motion.stations.size(); ++i) stations.push_back(i);
  if (!m->is_measured) stations = stations_by_interest(result, recorded_stations(result));
  constexpr std::size_t most = 4;
  if (!m->is_measured && result.view.given.empty() && stations.size() > most) stations.resize(most);
  std::vector<Figure> figures;
  for (const std::size_t i : stations) {
    if (auto f = centerline(result, *m, i)) figures.push_back(std::move(*f));
  }
  return figures;
}

}  // namespace

FigureKind centerline_kind() {
  return {
      .name = "centerline",
      .title = "Shaft centerline",
      .summary = "mean positions along a motion, from the gaps, in the clearance of the bearing",
      .needs_one = motion_datasets(),
      .make = centerline_figures,
      .takes = {"slow-roll", "clearance"},
  };
}

}  // namespace whirl::inline io
