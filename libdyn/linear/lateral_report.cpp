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

/// Peaks of every case of a machine.
void add_peaks(Machine& machine, LateralReport& report) {
  const Lateral& lateral = machine.lateral;
  const std::vector<double> landmarks = lateral.landmarks();
  ResponseCurveOptions how;  // unbalance changes no resonance
  how.resonances = resonances_between(lateral.assembler, landmarks.front(), landmarks.back());
  int number = machine.first_case;
  for (const Assembler& of_case : machine.unbalanced) {
    const ResponseCurve curve = response_curve(of_case, landmarks, lateral.points(), how);
    machine.speeds.push_back(curve.response.speeds);
    for (const ResponsePeak& found : curve.peaks) {
      report.peaks.push_back(lateral_peak(found, number, lateral.options.range));
    }
    report.unbounded.insert(report.unbounded.end(), curve.unbounded.begin(), curve.unbounded.end());
    report.speeds.insert(report.speeds.end(), curve.response.speeds.begin(),
                         curve.response.speeds.end());
    ++number;
  }
}

/// Vibration of one case at all probes, and where it is largest at operating speeds.
void add_responses(const Lateral& lateral, const Assembler& assembler, int number,
                   LateralStudy& study) {
  LateralReport& report = study.report;
  const UnbalanceResponse found = unbalance_response(assembler, report.speeds, lateral.points());
  LateralCase& of = report.cases[static_cast<std::size_t>(number)];
  for (Eigen::Index p = 0; p < found.x.rows(); ++p) {
    LateralResponse response{number, static_cast<int>(p), Vec(found.x.cols())};
    for (Eigen::Index k = 0; k < found.x.cols(); ++k) {
      const double size = 2.0 * Orbit(found.x(p, k), found.y(p, k)).major();
      response.peak_to_peak(k) = size;
      const double Omega = report.speeds[static_cast<std::size_t>(k)];
      if (Omega < report.minimum_speed || Omega > report.maximum_speed) continue;
      if (size <= of.vibration) continue;
      of.vibration = size, of.probe = static_cast<int>(p), of.vibration_speed = Omega;
    }
    report.responses.push_back(std::move(response));
  }
  UnbalanceResponse to_trip = found;  // speeds ascend
  std::erase_if(to_trip.speeds, [&](double s) { return s > report.trip_speed; });
  for (const BearingResponse& b : bearing_responses(assembler, to_trip)) {
    study.parts.forces.push_back({number, b.kind, b.name, b.largest, b.largest_at});
  }
  of.scaling = most_scaling;
  if (of.vibration > 0.0)
    of.scaling = std::min(most_scaling, report.vibration_limit / of.vibration);
}

/// The largest responses at clearances up to the trip speed, scaled.
void add_clearances(const Lateral& lateral, const Assembler& assembler, int number,
                    std::vector<double> speeds, const std::vector<RunningClearance>& running,
                    LateralReport& report) {
  Model centered = lateral.model;  // responses are those about the place where the rotor rests
  for (Contact& c : centered.contacts) c.offset.setZero();
  for (OilFilm& f : centered.films) f.offset.setZero();
  std::erase_if(speeds, [&](double s) { return s > report.trip_speed; });
  const double scaling = report.cases[static_cast<std::size_t>(number)].scaling;
  for (const ClearanceUse& use : clearance_uses(centered, assembler, speeds)) {
    const auto rest = std::find_if(running.begin(), running.end(),
                                   [&](const RunningClearance& r) { return r.name == use.name; });
    report.clearances.push_back({number, use.name, rest->left(), scaling * use.largest, use.at});
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

void add_checks(const Lateral& lateral, LateralReport& report) {
  const auto probe = [&](Eigen::Index i) {
    return report.probes[static_cast<std::size_t>(i)].station;
  };
  const auto add = [&](LateralCheck check, bool is_least) {
    check.verdict = verdict_of(check.found, check.limit, is_least);
    if (check.of_case >= 0) {
      check.variant = report.cases[static_cast<std::size_t>(check.of_case)].variant;
    }
    report.checks.push_back(std::move(check));
  };
  for (const LateralPeak& p : report.peaks) {
    add({LateralRule::separation_margin, p.of_case, probe(p.row), p.speed, p.margin.actual,
         p.margin.required},
        true);
  }
  for (const double speed : report.unbounded) {  // without damping: as sharp as can be
    const ResponsePeak sharp{
        .speed = speed, .below = (1.0 - 1e-9) * speed, .above = (1.0 + 1e-9) * speed};
    const SeparationMargin margin = separation_margin(sharp, lateral.options.range);
    add({LateralRule::separation_margin, -1, "undamped resonance", speed, margin.actual,
         margin.required},
        true);
  }
  for (std::size_t c = 0; c < report.cases.size(); ++c) {
    const LateralCase& of = report.cases[c];
    add({LateralRule::vibration, static_cast<int>(c), probe(of.probe), of.vibration_speed,
         of.vibration, report.vibration_limit},
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

/// Cases of a machine, and its rotor with the unbalance of each.
void add_cases(Machine& machine, const std::vector<Critical>& criticals, LateralReport& report) {
  const Lateral& lateral = machine.lateral;
  const double maximum = lateral.options.range.maximum;
  const std::vector<UnbalanceCase> cases = unbalance_cases(
      lateral.assembler, criticals, lateral.journals, maximum, last_lateral_speed * maximum);
  if (cases.empty())
    throw NumericalError("no critical speed was found that unbalance could excite");
  machine.first_case = static_cast<int>(report.cases.size());
  for (const UnbalanceCase& c : cases) {
    const int number = static_cast<int>(report.cases.size());
    report.cases.push_back({.variant = machine.variant,
                            .mode_speed = c.mode.speed,
                            .whirl = c.mode.whirl,
                            .places = c.places});
    for (const UnbalancePlane& p : c.planes) {
      report.planes.push_back({number, lateral.label_of(p.node), p.moment, p.phase});
    }
    machine.unbalanced.push_back(lateral.unbalanced(c));
  }
}

/// Responses and clearances of a machine at the speeds of the report.
void add_motions(const Machine& machine, LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const Assembler own(lateral.model.structure);
  const RestingRotor rest = resting_rotor(lateral.model, own, lateral.options.range.maximum);
  const auto running = running_clearances(lateral.model, own, rest.at_rest.displacement);
  for (std::size_t c = 0; c < machine.unbalanced.size(); ++c) {
    const int number = machine.first_case + static_cast<int>(c);
    add_responses(lateral, machine.unbalanced[c], number, study);
    add_clearances(lateral, machine.unbalanced[c], number, machine.speeds[c], running, report);
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
  for (const Journal& j : lateral.journals) report.journals.push_back({j.name, j.mass});
  for (const NamedPoint& p : lateral.probes) report.probes.push_back({p.label()});
  for (Machine& machine : machines) {
    require_probes_of(lateral, machine);
    machine.campbell =
        campbell(machine.lateral.assembler, campbell_range(machine.lateral), options.modes);
    const auto criticals = critical_speeds(machine.lateral.assembler,
                                           {.count = options.criticals, .start = range.maximum});
    if (machine.variant.empty()) study.criticals.criticals = criticals;
    add_cases(machine, criticals, report);
    add_peaks(machine, report);
  }
  sort_out(report.speeds);
  sort_out(report.unbounded);
  for (const Machine& machine : machines) add_motions(machine, study);
  add_checks(lateral, report);
  for (const Machine& machine : machines) {
    add_stability(machine, &machine == &machines.front(), study);
  }
  if (variants.empty()) study.parts.level_one.clear(), study.parts.coupled.clear();
  for (const Machine& machine : machines) add_thresholds(machine, report);
  study.campbell = std::move(machines.front().campbell);
  return study;
}

}  // namespace whirl::inline dyn
