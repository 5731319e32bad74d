#include "libdyn/linear/lateral_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/system/clearance.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/model.hpp"
#include "libdyn/system/resting_rotor.hpp"
#include "libfe/lateral/rigid_supports.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double first_speed = 0.1;  ///< of responses, over the maximum continuous one
constexpr double last_speed = 1.5;   ///< likewise, and of modes that are excited
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

/// Ascending, each once.
void sort_out(std::vector<double>& speeds) {
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
}

/// What all parts of the report ask of a model.
struct Lateral {
  const Model& model;
  LateralOptions options;
  Structure structure;  ///< linear, without unbalance and bow
  Assembler assembler;
  std::vector<Journal> journals;
  std::vector<NamedPoint> probes;

  Lateral(const Model& given, const LateralOptions& how)
      : model(given), options(how), structure(bare(given)), assembler(structure) {
    if (structure.shaft.empty()) throw ModelError({}, "shaft", "a lateral analysis needs a shaft");
    journals = journals_of(model, assembler, options.range.maximum);
    if (journals.empty()) {
      throw ModelError({}, "bearing",
                       "a lateral analysis needs a bearing or an oil film on the shaft");
    }
    probes = at_probes();
    if (probes.empty()) probes = at_journals();
  }

  static Structure bare(const Model& model) {
    Structure s = linear_structure(model);
    for (const Unbalance& u : s.unbalances)
      s.stations.push_back(u.at);  // nodes stay where they are
    s.unbalances.clear();
    s.bow = {};
    return s;
  }

  /// Stations with a probe of the model across the shaft, each once; vibration is told along the
  /// major axis there.
  std::vector<NamedPoint> at_probes() const {
    std::vector<NamedPoint> all;
    for (const NamedPoint& p : named_points(model, assembler)) {
      if (std::any_of(structure.probes.begin(), structure.probes.end(), [&](const Probe& probe) {
            return !probe.is_axial() && assembler.point(probe.at) == p.point;
          })) {
        all.push_back(p);
      }
    }
    return all;
  }

  std::vector<NamedPoint> at_journals() const {
    std::vector<NamedPoint> all;
    for (const NamedPoint& p : named_points(model, assembler)) {
      if (std::any_of(journals.begin(), journals.end(),
                      [&](const Journal& j) { return j.node + 1 == p.node(); })) {
        all.push_back(p);
      }
    }
    return all;
  }

  /// The unit that all probes of the model have; empty: they have several, or none but um.
  std::string probe_unit() const {
    const std::vector<Probe>& all = structure.probes;
    const bool is_one = std::all_of(all.begin(), all.end(),
                                    [&](const Probe& p) { return p.unit == all.front().unit; });
    return all.empty() || !is_one || all.front().unit == Probe{}.unit ? "" : all.front().unit;
  }

  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const NamedPoint& p : probes) all.push_back(p.point);
    return all;
  }

  std::string label_of(int node) const {
    for (const NamedPoint& p : named_points(model, assembler)) {
      if (p.node() == node + 1) return p.label();
    }
    return std::to_string(node + 1);
  }

  /// The node nearest to the middle between the outermost journals, from 0.
  int middle_node() const {
    const double middle = 0.5 * (journals.front().z + journals.back().z);
    const std::vector<double>& z = assembler.mesh().z;
    const auto nearest = std::min_element(z.begin(), z.end(), [&](double a, double b) {
      return std::abs(a - middle) < std::abs(b - middle);
    });
    return static_cast<int>(nearest - z.begin());
  }

  /// The rotor with the unbalance of a case.
  Assembler unbalanced(const UnbalanceCase& of) const {
    Structure s = structure;
    for (const UnbalancePlane& p : of.planes) {
      s.unbalances.push_back({.at = {.kind = Station::Kind::node, .node = p.node + 1},
                              .moment = p.moment,
                              .phase = p.phase});
    }
    return Assembler(s);
  }

  /// Speeds that every response goes through.
  std::vector<double> landmarks() const {
    const OperatingRange& r = options.range;
    std::vector<double> all{first_speed * r.maximum, r.minimum, r.maximum, r.trip,
                            std::max(last_speed * r.maximum, r.trip)};
    sort_out(all);
    return all;
  }
};

/// Peaks of every case.
/// @return  the speeds that the curve of each needs
std::vector<std::vector<double>> lateral_peaks(const Lateral& lateral,
                                               const std::vector<Assembler>& cases,
                                               LateralReport& report) {
  std::vector<std::vector<double>> speeds;
  const std::vector<double> landmarks = lateral.landmarks();
  ResponseCurveOptions how;  // unbalance changes no resonance
  how.resonances = resonances_between(lateral.assembler, landmarks.front(), landmarks.back());
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const ResponseCurve curve = response_curve(cases[c], landmarks, lateral.points(), how);
    speeds.push_back(curve.response.speeds);
    for (const ResponsePeak& found : curve.peaks) {
      report.peaks.push_back(lateral_peak(found, static_cast<int>(c), lateral.options.range));
    }
    report.unbounded.insert(report.unbounded.end(), curve.unbounded.begin(), curve.unbounded.end());
    report.speeds.insert(report.speeds.end(), speeds.back().begin(), speeds.back().end());
  }
  sort_out(report.speeds);
  sort_out(report.unbounded);
  return speeds;
}

/// Vibration of one case at all probes, and where it is largest at operating speeds.
void add_responses(const Lateral& lateral, const Assembler& assembler, int number,
                   LateralReport& report) {
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

/// A check of something that should be at least, or at most, so much.
Verdict verdict_of(double found, double limit, bool is_least) {
  if (std::isnan(found) || !std::isfinite(limit)) return Verdict::unknown;
  return (is_least ? found >= limit : found <= limit) ? Verdict::passed : Verdict::failed;
}

/// Where a mode begins or ceases to grow at speeds up to the trip speed, a part of them is
/// unstable.
void add_thresholds(const std::vector<Threshold>& thresholds, LateralReport& report) {
  for (const Threshold& t : thresholds) {
    if (t.speed < report.minimum_speed || t.speed > report.trip_speed) continue;
    report.checks.push_back({.rule = LateralRule::log_decrement,
                             .place = "threshold of instability",
                             .speed = t.speed,
                             .found = 0.0,
                             .limit = least_log_decrement,
                             .verdict = Verdict::failed});
  }
}

/// Checks of level I: of what it asks for that was not given, they are unknown.
void add_stability_checks(LateralReport& report) {
  const auto add = [&](LateralRule rule, double found, double limit, const char* missing) {
    report.checks.push_back({.rule = rule,
                             .place = report.coupled_station,
                             .speed = report.maximum_speed,
                             .found = found,
                             .limit = limit,
                             .verdict = verdict_of(found, limit, true),
                             .missing = missing});
  };
  const bool is_told = report.anticipated > 0.0;
  add(LateralRule::log_decrement, report.log_decrement, least_log_decrement, "");
  const bool is_unstable = report.limit == 0.0;  // whatever is expected
  const double ratio = is_unstable                              ? 0.0
                       : is_told && std::isfinite(report.limit) ? report.limit / report.anticipated
                                                                : nan;
  const char* no_coupling = is_told || is_unstable ? "" : "--cross-coupling";
  add(LateralRule::coupling_ratio, ratio, least_coupling_ratio, no_coupling);
  const auto region = report.region();
  const double least = region == StabilityRegion::b   ? least_coupling_ratio_in_region_b
                       : region == StabilityRegion::a ? least_coupling_ratio
                                                      : nan;
  add(LateralRule::stability_region, ratio, least,
      std::isfinite(report.gas_density) ? no_coupling : "--gas-density");
}

void add_checks(const Lateral& lateral, LateralReport& report) {
  const auto probe = [&](Eigen::Index i) {
    return report.probes[static_cast<std::size_t>(i)].station;
  };
  const auto add = [&](LateralCheck check, bool is_least) {
    check.verdict = verdict_of(check.found, check.limit, is_least);
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
  add_stability_checks(report);
}

void add_stability(const Lateral& lateral, LateralReport& report) {
  const int node = lateral.middle_node();
  report.coupled_station = lateral.label_of(node);
  if (lateral.options.has_anticipated) report.anticipated = lateral.options.anticipated;
  const CouplingStability found = coupling_stability(
      lateral.structure, lateral.options.range.maximum,
      {.kind = Station::Kind::node, .node = node + 1},
      {.anticipated = lateral.options.anticipated, .count = lateral.options.modes});
  report.coupled_modes = found.modes;
  if (found.at_limit) report.limit = found.at_limit->coupling;
  if (found.at_anticipated) report.log_decrement = found.at_anticipated->log_decrement;
  report.gas_density = lateral.options.gas_density.value_or(nan);
  try {
    report.rigid_critical_speed = critical_on_rigid_supports(lateral.structure);
  } catch (const NumericalError&) {
    report.rigid_critical_speed = nan;  // the region is unknown then
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

void add_cases(const Lateral& lateral, const std::vector<UnbalanceCase>& cases,
               LateralReport& report) {
  for (const Journal& j : lateral.journals) report.journals.push_back({j.name, j.mass});
  for (const NamedPoint& p : lateral.probes) report.probes.push_back({p.label()});
  for (const UnbalanceCase& c : cases) {
    const int number = static_cast<int>(report.cases.size());
    report.cases.push_back({.mode_speed = c.mode.speed, .whirl = c.mode.whirl});
    for (const UnbalancePlane& p : c.planes) {
      report.planes.push_back({number, lateral.label_of(p.node), p.moment, p.phase});
    }
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

LateralStudy lateral_report(const Model& model, const LateralOptions& options) {
  const Lateral lateral(model, options);
  const OperatingRange& range = options.range;
  LateralStudy study;
  LateralReport& report = study.report;
  report.minimum_speed = range.minimum;
  report.maximum_speed = range.maximum;
  report.trip_speed = range.trip;
  report.vibration_limit = vibration_limit(range.maximum);
  report.vibration_unit = lateral.probe_unit();
  study.criticals.criticals =
      critical_speeds(lateral.assembler, {.count = options.criticals, .start = range.maximum});
  study.campbell = campbell(lateral.assembler, campbell_range(lateral), options.modes);

  const std::vector<UnbalanceCase> cases =
      unbalance_cases(lateral.assembler, study.criticals.criticals, lateral.journals, range.maximum,
                      last_speed * range.maximum);
  if (cases.empty())
    throw NumericalError("no critical speed was found that unbalance could excite");
  add_cases(lateral, cases, report);
  std::vector<Assembler> unbalanced;
  for (const UnbalanceCase& c : cases) unbalanced.push_back(lateral.unbalanced(c));
  const std::vector<std::vector<double>> speeds = lateral_peaks(lateral, unbalanced, report);

  const Assembler own(model.structure);
  const RestingRotor rest = resting_rotor(model, own, range.maximum);
  const auto running = running_clearances(model, own, rest.at_rest.displacement);
  for (int c = 0; c < static_cast<int>(cases.size()); ++c) {
    const auto at = static_cast<std::size_t>(c);
    add_responses(lateral, unbalanced[at], c, report);
    add_clearances(lateral, unbalanced[at], c, speeds[at], running, report);
  }
  add_stability(lateral, report);
  add_checks(lateral, report);
  add_thresholds(study.campbell.thresholds, report);
  return study;
}

}  // namespace whirl::inline dyn
