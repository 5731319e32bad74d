#include "libdyn/motions/unbalance_study.hpp"

#include <cmath>
#include <utility>

#include "libfe/modes.hpp"

namespace whirl::inline dyn {

namespace {

/// What is asked of every orbit, stations x speeds [m].
template <class Ask>
Mat of_orbits(const UnbalanceResponse& response, const Ask& ask) {
  return response.x.binaryExpr(response.y, [&](Complex x, Complex y) { return ask(Orbit(x, y)); });
}

Mat major_of(const UnbalanceResponse& response) {
  return of_orbits(response, [](const Orbit& o) { return o.major(); });
}

std::vector<StationResponse> station_responses(const std::vector<NamedPoint>& stations,
                                               const UnbalanceResponse& response) {
  const Mat major = major_of(response);
  const Mat minor = of_orbits(response, [](const Orbit& o) { return o.forward - o.backward; });
  std::vector<StationResponse> all;
  for (const NamedPoint& p : stations) {
    const auto i = static_cast<Eigen::Index>(all.size());
    StationResponse of{.name = p.name, .label = p.label()};
    if (p.node() > 0) of.node = p.node();
    of.x = response.x.row(i).transpose();
    of.y = response.y.row(i).transpose();
    of.major = major.row(i).transpose();
    of.minor = minor.row(i).transpose();
    all.push_back(std::move(of));
  }
  return all;
}

void add_curves(const UnbalanceResponse& curve, UnbalanceStudy& study) {
  study.curve_speeds = curve.speeds;
  const Mat major = major_of(curve);
  for (Eigen::Index i = 0; i < major.rows(); ++i) {
    StationResponse& of = study.stations[static_cast<std::size_t>(i)];
    of.curve_x = curve.x.row(i).transpose();
    of.curve_y = curve.y.row(i).transpose();
    of.curve_major = major.row(i).transpose();
  }
}

/// Responses to forces of other frequencies.
std::vector<ForcedResponse> forced_responses(const std::vector<NamedPoint>& stations,
                                             const Assembler& assembler,
                                             const std::vector<double>& speeds,
                                             const std::vector<Point>& points) {
  std::vector<ForcedResponse> all;
  for (const OscillatingLoad& load : oscillating_loads(assembler)) {
    const UnbalanceResponse found = oscillating_response(assembler, load, speeds, points);
    for (StationResponse& at : station_responses(stations, found)) {
      ForcedResponse of{.force = load.label(), .node = at.node, .name = at.name};
      (load.order > 0.0 ? of.order : of.frequency) = load.order > 0.0 ? load.order : load.frequency;
      of.label = std::move(at.label);
      of.x = std::move(at.x);
      of.y = std::move(at.y);
      of.major = std::move(at.major);
      of.minor = std::move(at.minor);
      all.push_back(std::move(of));
    }
  }
  return all;
}

}  // namespace

std::optional<std::string> StationPeak::side() const {
  if (!separation) return {};
  return separation->is_below ? "below" : "above";
}

std::optional<bool> StationPeak::is_kept() const {
  if (!separation || !std::isfinite(separation->required)) return {};
  return separation->is_kept();
}

UnbalanceStudy unbalance_study(const Model& model, const Assembler& assembler,
                               const UnbalanceOptions& options) {
  std::vector<Point> points;
  for (const NamedPoint& p : options.stations) points.push_back(p.point);
  UnbalanceResponse rows;
  if (options.has_given_speeds) rows = unbalance_response(assembler, options.speeds, points);
  const ResponseCurve curve = response_curve(assembler, options.speeds, points);
  if (!options.has_given_speeds) rows = curve.response;

  UnbalanceStudy study{.speeds = rows.speeds,
                       .stations = station_responses(options.stations, rows),
                       .unbounded = curve.unbounded,
                       .largest = largest_responses(curve.response),
                       .forced = forced_responses(options.stations, assembler, rows.speeds, points),
                       .failure = curve.failure};
  if (options.has_given_speeds) add_curves(curve.response, study);
  for (const ResponsePeak& peak : curve.peaks) {
    const StationResponse& at = study.stations[static_cast<std::size_t>(peak.row)];
    StationPeak of{peak, at.node, at.name, {}};
    if (model.has_speed && model.speed > 0.0) of.separation = separation_margin(peak, model.speed);
    study.peaks.push_back(std::move(of));
  }
  study.clearances = clearance_uses(model, assembler, curve.response.speeds);
  return study;
}

}  // namespace whirl::inline dyn
