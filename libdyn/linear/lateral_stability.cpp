// Stability of a lateral analysis: levels I and II.

#include <span>

#include "libdyn/linear/lateral_machine.hpp"
#include "libfe/lateral/rigid_supports.hpp"

namespace whirl::inline dyn {

namespace {

/// Checks of level I: of what it asks for that was not given, they are unknown.
void add_stability_checks(const LevelOneState& found, LateralReport& report) {
  const auto add = [&](LateralRule rule, double value, double limit, const char* missing) {
    report.checks.push_back({.rule = rule,
                             .place = report.coupled_station,
                             .speed = report.maximum_speed,
                             .found = value,
                             .limit = limit,
                             .verdict = verdict_of(value, limit, true),
                             .missing = missing,
                             .variant = found.variant});
  };
  const bool is_told = report.anticipated > 0.0;
  add(LateralRule::log_decrement, found.log_decrement, least_log_decrement, "");
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

/// The least damped mode with the seals of a machine put in one by one; nothing without seals.
void add_level_two(const Machine& machine, const Station& at, LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const std::vector<Connection>& seals = lateral.structure.seals;
  if (seals.empty()) return;
  for (std::size_t count = 0; count <= seals.size(); ++count) {
    Structure part = lateral.structure;
    for (const Connection& left_out : std::span(seals).subspan(count)) {
      part.stations.push_back(left_out.from);  // nodes stay where they are
    }
    part.seals.resize(count);
    const CoupledMode least =
        least_damped_mode(part, lateral.options.range.maximum, at, lateral.options.modes);
    study.parts.level_two.push_back(
        {machine.variant, count == 0 ? "without seals" : "with seal " + seals[count - 1].name,
         least.log_decrement, least.frequency});
  }
  const double found = study.parts.level_two.back().log_decrement;
  report.checks.push_back({.rule = LateralRule::level_two,
                           .place = "all seals of the model",
                           .speed = report.maximum_speed,
                           .found = found,
                           .limit = least_log_decrement,
                           .verdict = verdict_of(found, least_log_decrement, true),
                           .variant = machine.variant});
}

/// Whether a machine is nearer to instability than what the report has.
bool is_worse(const LevelOneState& a, const LateralReport& b) {
  const double a_limit = std::isnan(a.limit) ? INFINITY : a.limit;
  const double b_limit = std::isnan(b.limit) ? INFINITY : b.limit;
  return a_limit != b_limit ? a_limit < b_limit : a.log_decrement < b.log_decrement;
}

}  // namespace

void add_stability(const Machine& machine, bool is_first, LateralStudy& study) {
  LateralReport& report = study.report;
  const Lateral& lateral = machine.lateral;
  const Station at{.kind = Station::Kind::node, .node = lateral.middle_node() + 1};
  if (is_first) {
    report.coupled_station = lateral.label_of(at.node - 1);
    if (lateral.options.has_anticipated) report.anticipated = lateral.options.anticipated;
    report.gas_density = lateral.options.gas_density.value_or(nan);
    try {
      report.rigid_critical_speed = critical_on_rigid_supports(lateral.structure);
    } catch (const NumericalError&) {
      report.rigid_critical_speed = nan;  // the region is unknown then
    }
  }
  const CouplingStability found = coupling_stability(
      lateral.structure, lateral.options.range.maximum, at,
      {.anticipated = lateral.options.anticipated, .count = lateral.options.modes});
  LevelOneState one{.variant = machine.variant};
  if (found.at_limit) one.limit = found.at_limit->coupling;
  if (found.at_anticipated) one.log_decrement = found.at_anticipated->log_decrement;
  if (is_first || is_worse(one, report)) {
    report.coupled_modes = found.modes;
    report.limit = one.limit;
  }
  if (is_first || one.log_decrement < report.log_decrement) {
    report.log_decrement = one.log_decrement;
  }
  study.parts.level_one.push_back(one);
  for (const CoupledMode& mode : found.modes) {
    study.parts.coupled.push_back({mode, machine.variant});
  }
  add_stability_checks(one, report);
  add_level_two(machine, at, study);
}

}  // namespace whirl::inline dyn
