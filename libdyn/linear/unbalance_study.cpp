#include "libdyn/linear/unbalance_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/error.hpp"
#include "libbase/system/memory.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/lateral/lateral_rules.hpp"

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

/// Adds the speeds at which forces of other orders meet modes, with some across each peak.
void add_peaks_of_orders(const Assembler& assembler, std::vector<double>& speeds,
                         Failure& failure) {
  if (speeds.size() < 2) return;
  const double first = speeds.front(), last = speeds.back();
  for (const Excitation& load : other_excitations(assembler)) {
    if (!(load.order > 0.0)) continue;
    try {
      for (const Resonance& r : resonances_between(assembler, first, last, load.order)) {
        if (!(r.half_width > 0.0)) continue;
        for (const double widths : {-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0}) {
          const double speed = r.speed + widths * r.half_width;
          if (speed > first && speed < last) speeds.push_back(speed);
        }
      }
    } catch (const NumericalError& error) {
      failure = error.what();
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
}

/// Where the points of probes are, in their order.
std::vector<Point> points_of(const Assembler& assembler) {
  std::vector<Point> points;
  for (const Probe& probe : assembler.structure().probes) {
    points.push_back(assembler.point(probe.at));
  }
  return points;
}

/// Readings of the probes of a structure, of a response that is told at their points, too.
std::vector<CVec> readings_of(const UnbalanceResponse& response, const Assembler& assembler) {
  std::vector<CVec> all;
  for (const Probe& probe : assembler.structure().probes) {
    const auto i =
        std::find(response.points.begin(), response.points.end(), assembler.point(probe.at)) -
        response.points.begin();
    all.push_back(probe.reading([&](int c) -> CVec { return response.at(c).row(i).transpose(); }));
  }
  return all;
}

/// The same of any response that is bounded: it is solved again if it lacks one of the points or
/// the tilts.
std::vector<CVec> readings(const Assembler& assembler, const UnbalanceResponse& known) {
  const std::vector<Point> points = points_of(assembler);
  const std::vector<Probe>& probes = assembler.structure().probes;
  const bool needs_tilts = std::any_of(probes.begin(), probes.end(), std::mem_fn(&Probe::is_axial));
  const bool has_all = std::all_of(points.begin(), points.end(), [&](const Point& p) {
    return std::find(known.points.begin(), known.points.end(), p) != known.points.end();
  });
  const bool is_enough = has_all && (!needs_tilts || known.theta_x.size() > 0);
  return readings_of(is_enough ? known : unbalance_response(assembler, known.speeds, points),
                     assembler);
}

/// Tells the order or the frequency of a load; neither of one that changes with the speed.
void tell_frequency(const Excitation& load, auto& of) {
  if (load.order > 0.0) {
    of.order = load.order;
  } else if (load.frequency > 0.0) {
    of.frequency = load.frequency;
  }
}

/// Adds the responses to forces of other frequencies, of stations and along probes.
/// @param points  of the stations
void add_forced(const std::vector<NamedPoint>& stations, const Assembler& assembler,
                std::vector<Point> points, UnbalanceStudy& study) {
  const std::vector<Point> of_probes = points_of(assembler);
  points.insert(points.end(), of_probes.begin(), of_probes.end());
  for (const Excitation& load : other_excitations(assembler)) {
    const UnbalanceResponse found = oscillating_response(assembler, load, study.speeds, points);
    const auto name = [&](auto& of) {
      of.force = load.label();
      of.forces = load.names;
      tell_frequency(load, of);
    };
    for (StationResponse& at : station_responses(stations, found)) {
      ForcedResponse of{.node = at.node, .name = at.name};
      name(of);
      of.label = std::move(at.label);
      of.x = std::move(at.x);
      of.y = std::move(at.y);
      of.major = std::move(at.major);
      of.minor = std::move(at.minor);
      study.forced.push_back(std::move(of));
    }
    for (BearingResponse& at : bearing_responses(assembler, load, study.speeds)) {
      ForcedBearing of{std::move(at), load.label(), {}, {}};
      tell_frequency(load, of);
      study.forced_bearings.push_back(std::move(of));
    }
    const std::vector<CVec> told = readings_of(found, assembler);
    for (std::size_t i = 0; i < told.size(); ++i) {
      ForcedReading of{assembler.structure().probes[i], {}, {}, {}, told[i]};
      name(of);
      study.forced_probes.push_back(std::move(of));
    }
  }
}

/// The largest of the peaks and of the sizes at the speeds of a curve.
ProbePeak largest_of(const ResponseCurve& curve, const Vec& sizes,
                     const std::vector<ProbePeak>& peaks) {
  ProbePeak largest;
  if (sizes.size() == 0) return largest;
  Eigen::Index top = 0;
  largest.amplitude = sizes.maxCoeff(&top);
  largest.speed = curve.response.speeds[static_cast<std::size_t>(top)];
  for (const ProbePeak& peak : peaks) {
    if (peak.amplitude >= largest.amplitude) largest = peak;
  }
  return largest;
}

/// @param asked  the response at the speeds of the study
void add_probes(const Assembler& assembler, const ResponseCurve& curve,
                const UnbalanceResponse& asked, UnbalanceStudy& study) {
  const std::vector<Probe>& probes = assembler.structure().probes;
  if (probes.empty()) return;
  const bool has_curve = !study.curve_speeds.empty();
  const std::vector<CVec> curves = readings(assembler, curve.response);
  const std::vector<CVec> rows = has_curve ? readings(assembler, asked) : curves;
  UnbalanceSolver solver(assembler);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Point point = assembler.point(probes[i].at);
    const SizeAt size_at = [&](double Omega) {
      const auto u = solver.at(Omega);
      const auto of = [&](int c) { return (*u)(assembler.dofs().full_index(point, c)); };
      return u ? std::abs(probes[i].reading(of)) : INFINITY;
    };
    const Vec sizes = curves[i].cwiseAbs();
    ProbeResponse of{probes[i], rows[i], {}, {}, {}};
    if (has_curve) of.curve_amplitude = curves[i];
    for (ResponsePeak peak : refined_peaks(size_at, curve, sizes)) {
      peak.row = static_cast<Eigen::Index>(i);
      of.peaks.push_back({peak});
    }
    of.largest = largest_of(curve, sizes, of.peaks);
    study.probe_peaks.insert(study.probe_peaks.end(), of.peaks.begin(), of.peaks.end());
    study.probes.push_back(std::move(of));
  }
}

/// @param asked  the response at the speeds of the study
void add_bearings(const Assembler& assembler, const ResponseCurve& curve,
                  const UnbalanceResponse& asked, UnbalanceStudy& study) {
  study.bearings = bearing_responses(assembler, asked);
  if (study.curve_speeds.empty()) return;
  const std::vector<BearingResponse> curves = bearing_responses(assembler, curve.response);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    BearingResponse& of = study.bearings[i];
    of.curve_x = curves[i].x, of.curve_y = curves[i].y;
    if (curves[i].largest > of.largest) {
      of.largest = curves[i].largest, of.largest_at = curves[i].largest_at;
    }
  }
}

}  // namespace

std::optional<SeparationMargin> machine_margin(const Model& model, const ResponsePeak& peak) {
  const MachineSpeeds& machine = model.machine;
  if (machine.minimum > 0.0 && machine.maximum > 0.0) {
    return separation_margin(peak, OperatingRange{machine.minimum, machine.maximum, machine.trip});
  }
  if (!model.has_speed || !(model.speed > 0.0)) return {};
  return separation_margin(peak, model.speed);
}

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
  constexpr double of_value = 1200.0;  // bytes of a station at a speed, with their JSON; measured
  require_memory(
      "speeds",
      of_value * static_cast<double>(points.size()) * static_cast<double>(options.speeds.size()),
      fmt::format("the motion of {} stations at {} speeds", points.size(), options.speeds.size()),
      "give fewer speeds, or fewer stations");
  UnbalanceResponse rows;
  if (options.has_given_speeds) rows = unbalance_response(assembler, options.speeds, points);
  std::vector<double> speeds = options.speeds;
  Failure failure;
  if (!options.has_given_speeds) add_peaks_of_orders(assembler, speeds, failure);
  const ResponseCurve curve = response_curve(assembler, speeds, points);
  if (!options.has_given_speeds) rows = curve.response;

  UnbalanceStudy study{.speeds = rows.speeds,
                       .stations = station_responses(options.stations, rows),
                       .unbounded = curve.unbounded,
                       .largest = largest_responses(curve.response),
                       .failure = curve.failure ? curve.failure : failure};
  if (options.has_given_speeds) add_curves(curve.response, study);
  for (const ResponsePeak& peak : curve.peaks) {
    const StationResponse& at = study.stations[static_cast<std::size_t>(peak.row)];
    study.peaks.push_back({peak, at.node, at.name, machine_margin(model, peak)});
  }
  add_probes(assembler, curve, rows, study);
  if (!options.tells_all) return study;
  add_bearings(assembler, curve, rows, study);
  add_forced(options.stations, assembler, points, study);
  study.clearances = clearance_uses(model, assembler, curve.response.speeds);
  return study;
}

}  // namespace whirl::inline dyn
