// Stability of a lateral analysis: levels I and II.

#include <span>

#include "libdyn/linear/lateral_machine.hpp"
#include "libfe/lateral/rigid_supports.hpp"

namespace whirl::inline dyn {

namespace {

/// Checks of level I: of what it asks for that was not given, they are unknown. Of a shaft on which
/// no cross-coupled stiffness is expected the logarithmic decrement is asked for alone.
/// @param station  where Q acts
void add_stability_checks(const LevelOneState& found, const std::string& station, bool is_coupled,
                          LateralReport& report) {
  const auto add = [&](LateralRule rule, double value, double limit, const char* missing) {
    report.checks.push_back({.rule = rule,
                             .place = station,
                             .speed = report.maximum_speed,
                             .found = value,
                             .limit = limit,
                             .verdict = verdict_of(value, limit, true),
                             .missing = missing,
                             .variant = found.variant,
                             .shaft = found.shaft});
  };
  const bool is_told = report.anticipated > 0.0;
  add(LateralRule::log_decrement, found.log_decrement, least_log_decrement, "");
  if (!is_coupled) return;
  const bool is_unstable = found.limit == 0.0;  // whatever is expected
  const double ratio = is_unstable                             ? 0.0
                       : is_told && std::isfinite(found.limit) ? found.limit / report.anticipated
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

/// Numbers of the seals on a shaft.
std::vector<std::size_t> seals_on(const JournaledShaft& shaft, const Lateral& lateral) {
  const std::vector<Connection>& seals = lateral.structure.seals;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < seals.size(); ++i) {
    const Point at = lateral.assembler.point(seals[i].from);
    const bool is_own =
        shaft.name.empty() ||
        (at.kind == Point::Kind::node && shaft.of.has_node(at.index, lateral.assembler.mesh()));
    if (is_own) own.push_back(i);
  }
  return own;
}

/// The least damped mode with the seals of a shaft put in one by one; nothing without seals.
void add_level_two(const Machine& machine, const JournaledShaft& shaft, const Station& at,
                   LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const std::vector<Connection>& seals = lateral.structure.seals;
  const std::vector<std::size_t> own = seals_on(shaft, lateral);
  if (own.empty()) return;
  for (std::size_t count = 0; count <= own.size(); ++count) {
    Structure part = lateral.structure;
    const std::span left_out = std::span(own).subspan(count);
    for (const std::size_t i : left_out) {
      part.stations.push_back(seals[i].from);  // nodes stay where they are
    }
    for (auto i = left_out.rbegin(); i != left_out.rend(); ++i) {
      part.seals.erase(part.seals.begin() + static_cast<std::ptrdiff_t>(*i));
    }
    const CoupledMode least =
        least_damped_mode(part, lateral.options.range.maximum, at, lateral.options.modes, shaft.of);
    study.parts.level_two.push_back(
        {machine.variant, count == 0 ? "without seals" : "with seal " + seals[own[count - 1]].name,
         least.log_decrement, least.frequency, shaft.name});
  }
  const double found = study.parts.level_two.back().log_decrement;
  report.checks.push_back({.rule = LateralRule::level_two,
                           .place = "all seals of the model",
                           .speed = report.maximum_speed,
                           .found = found,
                           .limit = least_log_decrement,
                           .verdict = verdict_of(found, least_log_decrement, true),
                           .variant = machine.variant,
                           .shaft = shaft.name});
}

/// Whether a machine is nearer to instability than what the report has.
bool is_worse(const LevelOneState& a, const LateralReport& b) {
  const double a_limit = std::isnan(a.limit) ? INFINITY : a.limit;
  const double b_limit = std::isnan(b.limit) ? INFINITY : b.limit;
  return a_limit != b_limit ? a_limit < b_limit : a.log_decrement < b.log_decrement;
}

/// What the report tells once: of the shaft on which cross-coupled stiffness is expected.
void add_what_is_told(const Lateral& lateral, const JournaledShaft& shaft, LateralReport& report) {
  report.coupled_station = lateral.label_of(lateral.middle_node(shaft));
  if (lateral.options.has_anticipated) report.anticipated = lateral.options.anticipated;
  report.gas_density = lateral.options.gas_density.value_or(nan);
  try {
    report.rigid_critical_speed = critical_on_rigid_supports(lateral.structure, shaft.of);
  } catch (const NumericalError&) {
    report.rigid_critical_speed = nan;  // the region is unknown then
  }
}

void add_stability_of(const Machine& machine, const JournaledShaft& shaft, bool is_first,
                      LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const bool is_coupled = lateral.is_coupled(shaft);
  const Station at{.kind = Station::Kind::node, .node = lateral.middle_node(shaft) + 1};
  const CouplingStability found =
      coupling_stability(lateral.structure, lateral.options.range.maximum, at,
                         {.anticipated = is_coupled ? lateral.options.anticipated : 0.0,
                          .count = lateral.options.modes,
                          .shaft = shaft.of});
  LevelOneState one{.variant = machine.variant, .shaft = shaft.name};
  if (found.at_limit) one.limit = found.at_limit->coupling;
  if (found.at_anticipated) one.log_decrement = found.at_anticipated->log_decrement;
  if (is_coupled && (is_first || is_worse(one, report))) {
    report.coupled_modes = found.modes;
    report.limit = one.limit;
  }
  if (is_coupled && (is_first || one.log_decrement < report.log_decrement)) {
    report.log_decrement = one.log_decrement;
  }
  study.parts.level_one.push_back(one);
  for (const CoupledMode& mode : found.modes) {
    study.parts.coupled.push_back({mode, machine.variant, shaft.name});
  }
  const std::string station =
      shaft.name.empty() ? report.coupled_station : lateral.label_of(at.node - 1);
  add_stability_checks(one, station, is_coupled, report);
  add_level_two(machine, shaft, at, study);
}

}  // namespace

void add_stability(const Machine& machine, bool is_first, LateralStudy& study) {
  for (const JournaledShaft& shaft : machine.lateral.shafts) {
    if (is_first && machine.lateral.is_coupled(shaft)) {
      add_what_is_told(machine.lateral, shaft, study.report);
    }
  }
  for (const JournaledShaft& shaft : machine.lateral.shafts) {
    add_stability_of(machine, shaft, is_first, study);
  }
}

}  // namespace whirl::inline dyn
