#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/linear/bearing_response.hpp"
#include "libdyn/linear/lateral_machine.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libfe/lateral/rigid_supports.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int campbell_speeds = 51;

PeakSides sides_of(const ResponsePeak& peak) {
  const bool has_below = std::isfinite(peak.below), has_above = std::isfinite(peak.above);
  if (has_below == has_above) return has_below ? PeakSides::both : PeakSides::none;
  return has_below ? PeakSides::below : PeakSides::above;
}

/// Where 0.707 of a peak is reached on one side only, as it is where another peak is near or
/// damping is heavy, the other side is taken to be as far: an estimate, as the standard asks for
/// both.
LateralPeak lateral_peak(ResponsePeak peak, int of_case, const OperatingRange& range) {
  const PeakSides sides = sides_of(peak);
  if (sides == PeakSides::above) peak.below = 2.0 * peak.speed - peak.above;
  if (sides == PeakSides::below) peak.above = 2.0 * peak.speed - peak.below;
  LateralPeak told{peak, of_case, separation_margin(peak, range)};
  told.sides = sides;
  return told;
}

void add_all(const std::vector<double>& these, std::vector<double>& to) {
  to.insert(to.end(), these.begin(), these.end());
}

/// Peaks of every case of a machine.
void add_peaks(Machine& machine, LateralReport& report, CurvesOfShafts& curves) {
  const Lateral& lateral = machine.lateral;
  const std::vector<double> landmarks = lateral.landmarks();
  std::map<double, std::vector<Resonance>> resonances;  // of orders: unbalance changes none
  int number = machine.first_case;
  for (const UnbalancedRotor& rotor : machine.unbalanced) {
    const JournaledShaft& shaft = lateral.shafts[rotor.shaft];
    const double order = shaft.of.order();
    if (!resonances.contains(order)) {
      resonances[order] =
          resonances_between(lateral.assembler, landmarks.front(), landmarks.back(), order);
    }
    ResponseCurveOptions how;
    how.resonances = resonances[order];
    how.load = rotor.load;
    const ResponseCurve curve = response_curve(rotor.assembler, landmarks, lateral.points(), how);
    machine.speeds.push_back(curve.response.speeds);
    for (const ResponsePeak& found : curve.peaks) {
      report.peaks.push_back(lateral_peak(found, number, lateral.options.range));
      report.peaks.back().shaft = shaft.name;
    }
    ShaftCurves& own = curves[shaft.of.number];
    add_all(curve.unbounded, own.unbounded);
    add_all(curve.response.speeds, own.speeds);
    ++number;
  }
}

/// The response to the unbalance of a case.
/// @throws NumericalError  at a speed where it is unbounded
UnbalanceResponse response_of(const UnbalancedRotor& rotor, const std::vector<double>& speeds,
                              const std::vector<Point>& points) {
  if (!rotor.load) return unbalance_response(rotor.assembler, speeds, points);
  UnbalanceResponse found = oscillating_response(rotor.assembler, *rotor.load, speeds, points);
  if (found.x.allFinite() && found.y.allFinite()) return found;
  throw NumericalError(
      "the response to the unbalance of a shaft is unbounded at one of the speeds");
}

/// A response at some of its speeds.
/// @param some  ascending
UnbalanceResponse at_some_speeds(const UnbalanceResponse& all, const std::vector<double>& some) {
  std::vector<Eigen::Index> columns;
  UnbalanceResponse picked{{}, all.points, {}, {}, {}, {}};
  for (std::size_t k = 0; k < all.speeds.size(); ++k) {
    if (!std::ranges::binary_search(some, all.speeds[k])) continue;
    picked.speeds.push_back(all.speeds[k]);
    columns.push_back(static_cast<Eigen::Index>(k));
  }
  picked.x = all.x(Eigen::all, columns), picked.y = all.y(Eigen::all, columns);
  picked.theta_x = all.theta_x(Eigen::all, columns);
  picked.theta_y = all.theta_y(Eigen::all, columns);
  return picked;
}

/// Forces of one case on supports up to the trip speed. What another shaft alone moves is not told.
/// @param found  its response at the speeds of its shaft
void add_forces(const Lateral& lateral, const UnbalancedRotor& rotor, int number,
                const UnbalanceResponse& found, LateralStudy& study) {
  std::vector<double> speeds = found.speeds;
  std::erase_if(speeds, [&](double s) { return s > study.report.trip_speed; });
  const auto responses = rotor.load
                             ? bearing_responses(rotor.assembler, *rotor.load, speeds)
                             : bearing_responses(rotor.assembler, at_some_speeds(found, speeds));
  for (const BearingResponse& b : responses) {
    if (lateral.has_several() && b.largest == 0.0) continue;
    study.parts.forces.push_back(
        {number, b.kind, b.name, b.largest, b.largest_at, lateral.shafts[rotor.shaft].name});
  }
}

/// Vibration of one case at all probes, and where it is largest at operating speeds, beside what is
/// allowed there.
/// @param speeds  of the responses of its shaft, ascending
void add_responses(const Lateral& lateral, const UnbalancedRotor& rotor, int number,
                   const std::vector<double>& speeds, LateralStudy& study) {
  LateralReport& report = study.report;
  const UnbalanceResponse found = response_of(rotor, report.speeds, lateral.points());
  LateralCase& of = report.cases[static_cast<std::size_t>(number)];
  double allowed = lateral.vibration_limit_at(found.points.front());  // at the probe of the case
  for (Eigen::Index p = 0; p < found.x.rows(); ++p) {
    const double limit = lateral.vibration_limit_at(found.points[static_cast<std::size_t>(p)]);
    LateralResponse response{number, static_cast<int>(p), Vec(found.x.cols())};
    for (Eigen::Index k = 0; k < found.x.cols(); ++k) {
      const double size = 2.0 * Orbit(found.x(p, k), found.y(p, k)).major();
      response.peak_to_peak(k) = size;
      const double Omega = report.speeds[static_cast<std::size_t>(k)];
      if (Omega < report.minimum_speed || Omega > report.maximum_speed) continue;
      const bool is_larger =
          limit == allowed ? size > of.vibration : size * allowed > of.vibration * limit;
      if (!is_larger || !std::ranges::binary_search(speeds, Omega)) continue;
      of.vibration = size, of.probe = static_cast<int>(p), of.vibration_speed = Omega;
      allowed = limit;
    }
    report.responses.push_back(std::move(response));
  }
  add_forces(lateral, rotor, number, at_some_speeds(found, speeds), study);
  of.scaling = most_scaling;
  if (of.vibration > 0.0) of.scaling = std::min(most_scaling, allowed / of.vibration);
}

/// The largest responses at clearances up to the trip speed, scaled.
void add_clearances(const Lateral& lateral, const UnbalancedRotor& rotor, int number,
                    std::vector<double> speeds, const std::vector<RunningClearance>& running,
                    LateralReport& report) {
  Model centered = lateral.model;  // responses are those about the place where the rotor rests
  for (Contact& c : centered.contacts) c.offset.setZero();
  for (OilFilm& f : centered.films) f.offset.setZero();
  std::erase_if(speeds, [&](double s) { return s > report.trip_speed; });
  const double scaling = report.cases[static_cast<std::size_t>(number)].scaling;
  for (const ClearanceUse& use :
       clearance_uses(centered, rotor.assembler, speeds, rotor.load_or_null())) {
    if (lateral.has_several() && use.largest == 0.0) continue;  // on another shaft
    const auto rest = std::find_if(running.begin(), running.end(),
                                   [&](const RunningClearance& r) { return r.name == use.name; });
    report.clearances.push_back({number, use.name, rest->left(), scaling * use.largest, use.at,
                                 lateral.shafts[rotor.shaft].name});
  }
}

/// Where a mode begins or ceases to grow at speeds up to the trip speed, a part of them is
/// unstable.
void add_thresholds(const Machine& machine, LateralReport& report) {
  for (const Threshold& t : machine.campbell.thresholds) {
    if (t.speed < report.minimum_speed || t.speed > report.trip_speed) continue;
    report.checks.push_back({.rule = LateralRule::log_decrement,
                             .place = "threshold of instability",
                             .speed = t.speed,
                             .found = 0.0,
                             .limit = least_log_decrement,
                             .verdict = Verdict::failed,
                             .variant = machine.variant});
  }
}

void add_checks(const Lateral& lateral, const CurvesOfShafts& curves, LateralReport& report) {
  const auto probe = [&](Eigen::Index i) {
    return report.probes[static_cast<std::size_t>(i)].station;
  };
  const auto add = [&](LateralCheck check, bool is_least) {
    check.verdict = verdict_of(check.found, check.limit, is_least);
    if (check.of_case >= 0) {
      check.variant = report.cases[static_cast<std::size_t>(check.of_case)].variant;
      check.shaft = report.cases[static_cast<std::size_t>(check.of_case)].shaft;
    }
    report.checks.push_back(std::move(check));
  };
  for (const LateralPeak& p : report.peaks) {
    add({LateralRule::separation_margin, p.of_case, probe(p.row), p.speed, p.margin.actual,
         p.margin.required},
        true);
  }
  for (const JournaledShaft& shaft : lateral.shafts) {
    const auto own = curves.find(shaft.of.number);
    if (own == curves.end()) continue;
    for (const double speed : own->second.unbounded) {  // without damping: as sharp as can be
      const ResponsePeak sharp{
          .speed = speed, .below = (1.0 - 1e-9) * speed, .above = (1.0 + 1e-9) * speed};
      const SeparationMargin margin = separation_margin(sharp, lateral.options.range);
      add({.rule = LateralRule::separation_margin,
           .place = "undamped resonance",
           .speed = speed,
           .found = margin.actual,
           .limit = margin.required,
           .shaft = shaft.name},
          true);
    }
  }
  for (std::size_t c = 0; c < report.cases.size(); ++c) {
    const LateralCase& of = report.cases[c];
    const Point& point = lateral.probes[static_cast<std::size_t>(of.probe)].point;
    add({LateralRule::vibration, static_cast<int>(c), probe(of.probe), of.vibration_speed,
         of.vibration, lateral.vibration_limit_at(point)},
        false);
  }
  for (const LateralClearance& c : report.clearances) {
    add({LateralRule::running_clearance, c.of_case, c.name, c.speed, c.share(), clearance_share},
        false);
  }
}

/// Equal steps from a tenth of the maximum speed to the end of the responses.
std::vector<double> campbell_range(const Lateral& lateral) {
  const double first = lateral.landmarks().front(), last = lateral.landmarks().back();
  std::vector<double> speeds;
  for (int k = 0; k < campbell_speeds; ++k) {
    speeds.push_back(first + (last - first) * k / (campbell_speeds - 1));
  }
  return speeds;
}

/// Checks that a variant has vibration told where the model has.
/// @throws ModelError  naming the variant
void require_probes_of(const Lateral& model, const Machine& machine) {
  const auto label = [](const NamedPoint& p) { return p.label(); };
  if (std::ranges::equal(machine.lateral.probes, model.probes, {}, label, label)) return;
  throw ModelError({}, "variant " + machine.variant,
                   "vibration is told at other stations than those of the model: a variant may "
                   "change values, but neither probes nor, without probes, bearings");
}

/// Cases of one shaft of a machine, and its rotor with the unbalance of each.
/// @param criticals  by the order of this shaft
void add_cases_of(std::size_t shaft, const std::vector<Critical>& criticals, Machine& machine,
                  LateralReport& report) {
  const Lateral& lateral = machine.lateral;
  const double maximum = lateral.options.range.maximum;
  const JournaledShaft& own = lateral.shafts[shaft];
  for (const UnbalanceCase& c : unbalance_cases(lateral.assembler, criticals, own.journals, maximum,
                                                last_lateral_speed * maximum, own.of)) {
    const int number = static_cast<int>(report.cases.size());
    report.cases.push_back({.variant = machine.variant,
                            .mode_speed = c.mode.speed,
                            .whirl = c.mode.whirl,
                            .places = c.places,
                            .shaft = own.name,
                            .order = own.of.order()});
    for (const UnbalancePlane& p : c.planes) {
      report.planes.push_back({number, lateral.label_of(p.node), p.moment, p.phase, own.name});
    }
    machine.unbalanced.push_back(lateral.unbalanced(c, shaft));
  }
}

/// Cases of all shafts of a machine, with their critical speeds by the unbalance of each.
/// @return  those critical speeds, as many of each shaft as are looked for
std::vector<Critical> add_cases(Machine& machine, LateralReport& report) {
  const Lateral& lateral = machine.lateral;
  machine.first_case = static_cast<int>(report.cases.size());
  const int count = lateral.options.criticals;
  std::vector<Critical> all;
  for (std::size_t k = 0; k < lateral.shafts.size(); ++k) {
    const TurningShaft& of = lateral.shafts[k].of;
    // among them are those that move other shafts
    std::vector<Critical> criticals = critical_speeds(
        lateral.assembler, {.count = count * static_cast<int>(lateral.shafts.size()),
                            .order = of.order(),
                            .start = lateral.options.range.maximum});
    add_cases_of(k, criticals, machine, report);
    if (std::ssize(criticals) > count) criticals.erase(criticals.begin() + count, criticals.end());
    for (Critical& c : criticals) {
      if (lateral.has_several()) c.shaft = lateral.shafts[k].name;
      all.push_back(std::move(c));
    }
  }
  if (machine.unbalanced.empty())
    throw NumericalError("no critical speed was found that unbalance could excite");
  return all;
}

/// The shafts of a machine that has several, by their own speeds.
void add_shafts(const Lateral& lateral, std::vector<LateralShaft>& to) {
  const OperatingRange& range = lateral.options.range;
  for (const JournaledShaft& shaft : lateral.shafts) {
    const double order = shaft.of.order();
    to.push_back({.name = shaft.name,
                  .ratio = shaft.of.ratio,
                  .minimum_speed = order * range.minimum,
                  .maximum_speed = order * range.maximum,
                  .trip_speed = order * range.trip,
                  .vibration_limit = vibration_limit(order * range.maximum),
                  .coupled_station = lateral.label_of(lateral.middle_node(shaft))});
    try {
      to.back().rigid_critical_speed =
          order * critical_on_rigid_supports(lateral.structure, shaft.of);
    } catch (const NumericalError&) {
      // it stays unknown
    }
  }
}

/// Responses and clearances of a machine at the speeds of the report.
void add_motions(const Machine& machine, const CurvesOfShafts& curves, LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const Assembler own(lateral.model.structure);
  const RestingRotor rest = resting_rotor(lateral.model, own, lateral.options.range.maximum);
  const auto running = running_clearances(lateral.model, own, rest.at_rest.displacement);
  for (std::size_t c = 0; c < machine.unbalanced.size(); ++c) {
    const int number = machine.first_case + static_cast<int>(c);
    const UnbalancedRotor& rotor = machine.unbalanced[c];
    const int shaft = lateral.shafts[rotor.shaft].of.number;
    add_responses(lateral, rotor, number, curves.at(shaft).speeds, study);
    add_clearances(lateral, rotor, number, machine.speeds[c], running, report);
  }
}

}  // namespace

OperatingRange operating_range(const Model& model, double maximum) {
  const MachineSpeeds& told = model.machine;
  OperatingRange range;
  range.maximum = maximum > 0.0 ? maximum : told.maximum > 0.0 ? told.maximum : model.speed;
  const double least = told.minimum > 0.0 ? told.minimum : model.speed;
  range.minimum = least > 0.0 ? std::min(least, range.maximum) : range.maximum;
  range.trip = told.trip >= range.maximum ? told.trip : 1.05 * range.maximum;
  return range;
}

PeakKind LateralPeak::kind() const {
  const double AF = amplification();
  if (!std::isfinite(AF)) return PeakKind::unknown;
  return AF < least_amplification ? PeakKind::critically_damped : PeakKind::critical_speed;
}

std::optional<StabilityRegion> LateralReport::region() const {
  if (!std::isfinite(gas_density) || !std::isfinite(rigid_critical_speed)) return {};
  return stability_region(critical_speed_ratio(), gas_density);
}

bool LateralReport::is_passed() const {
  return std::none_of(checks.begin(), checks.end(),
                      [](const LateralCheck& c) { return c.verdict == Verdict::failed; });
}

LateralStudy lateral_report(const Model& model, const LateralOptions& options,
                            const std::vector<LateralVariant>& variants) {
  std::vector<Machine> machines;
  machines.push_back({"", Lateral(model, options)});
  for (const LateralVariant& v : variants) machines.push_back({v.name, Lateral(v.model, options)});
  const Lateral& lateral = machines.front().lateral;
  const OperatingRange& range = options.range;
  LateralStudy study;
  LateralReport& report = study.report;
  report.minimum_speed = range.minimum;
  report.maximum_speed = range.maximum;
  report.trip_speed = range.trip;
  report.vibration_limit = vibration_limit(range.maximum);
  report.vibration_unit = lateral.probe_unit();
  for (const JournaledShaft& shaft : lateral.shafts) {
    for (const Journal& j : shaft.journals) {
      report.journals.push_back({j.name, j.mass, shaft.name});
    }
  }
  for (const NamedPoint& p : lateral.probes) {
    report.probes.push_back({p.label(), lateral.shaft_at(p.point)});
  }
  if (lateral.has_several()) add_shafts(lateral, study.parts.shafts);
  CurvesOfShafts curves;
  for (Machine& machine : machines) {
    require_probes_of(lateral, machine);
    machine.campbell =
        campbell(machine.lateral.assembler, campbell_range(machine.lateral), options.modes);
    std::vector<Critical> criticals = add_cases(machine, report);
    if (machine.variant.empty()) study.criticals.criticals = std::move(criticals);
    add_peaks(machine, report, curves);
  }
  for (auto& [shaft, own] : curves) {
    sort_out(own.speeds), sort_out(own.unbounded);
    add_all(own.speeds, report.speeds), add_all(own.unbounded, report.unbounded);
  }
  sort_out(report.speeds), sort_out(report.unbounded);
  for (const Machine& machine : machines) add_motions(machine, curves, study);
  add_checks(lateral, curves, report);
  for (const Machine& machine : machines) {
    add_stability(machine, &machine == &machines.front(), study);
  }
  if (variants.empty() && !lateral.has_several()) {
    study.parts.level_one.clear(), study.parts.coupled.clear();
  }
  for (const Machine& machine : machines) add_thresholds(machine, report);
  study.campbell = std::move(machines.front().campbell);
  return study;
}

}  // namespace whirl::inline dyn
