#pragma once
/// Options of a lateral analysis: the speeds of the machine, what drives its whirl, its variants.

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "libdyn/linear/lateral_report.hpp"
#include "libio/text/lateral_values.hpp"
#include "libverbs/options/variants.hpp"

namespace whirl::inline cli {

struct LateralVerbOptions {
  Option<double> minimum_speed{
      "minimum-speed", "S",
      "least continuous speed; left out: minimum_speed of the model, or its speed",
      parse_running_speed};
  Option<double> maximum_speed{
      "maximum-speed", "S",
      "largest continuous speed; left out: maximum_speed of the model, or its speed",
      parse_running_speed};
  Option<double> trip_speed{
      "trip-speed", "S",
      "at which it is stopped; left out: trip_speed of the model, or 1.05 times the largest",
      parse_running_speed};
  Option<double> coupling{"cross-coupling", "Q",
                          "cross-coupled stiffness to be expected, such as 2MN/m", parse_coupling};
  Option<std::vector<Stage>> stages{
      "stages", "P:D:H:R,...",
      "instead, what makes it: power, diameter, least width and density ratio of each impeller",
      parse_stages};
  Option<double> gas_density{
      "gas-density", "RHO",
      "average of the gas, for the region of the screening of level I, such as 30kg/m^3",
      parse_gas_density};
  Option<std::string> coupled_shaft{
      "coupled-shaft", "NAME",
      "[[rotor]] on which the cross-coupled stiffness and the gas are; left out: the first shaft",
      ""};
  ListOption variants = variants_option();
  auto fields() {
    return std::tie(minimum_speed, maximum_speed, trip_speed, coupling, stages, gas_density,
                    coupled_shaft, variants);
  }
};

inline OperatingRange range_of(const LateralVerbOptions& options, const Model& model) {
  OperatingRange range = operating_range(model, options.maximum_speed.value_or(0.0));
  if (!(range.maximum > 0.0)) {
    throw wrong_option("maximum-speed", "", "the model has no operating speed: give one");
  }
  range.minimum = options.minimum_speed.value_or(range.minimum);
  range.trip = options.trip_speed.value_or(range.trip);
  if (range.minimum > range.maximum)
    throw options.minimum_speed.wrong("is above the maximum speed");
  if (range.trip < range.maximum) throw options.trip_speed.wrong("is below the maximum speed");
  return range;
}

/// Number of the shaft on which the gas is, from 0.
inline int coupled_shaft(const LateralVerbOptions& options, const Model& model) {
  const std::string& name = *options.coupled_shaft;
  const auto number = model.structure.shaft_named(name == "shaft" ? "" : name);
  if (!number) throw options.coupled_shaft.wrong("is no [[rotor]] of the model");
  return *number;
}

inline LateralOptions lateral_options(const LateralVerbOptions& options, const Model& model) {
  LateralOptions how{.range = range_of(options, model)};
  how.coupled_shaft = coupled_shaft(options, model);
  const double own = model.structure.shafts()[static_cast<std::size_t>(how.coupled_shaft)].speed_at(
      how.range.maximum);
  how.has_anticipated = options.coupling.is_given || options.stages.is_given;
  how.anticipated = options.coupling.value_or(0.0);
  if (options.gas_density) how.gas_density = *options.gas_density;
  if (options.stages) {
    if (options.coupling) throw options.stages.wrong("leave out --cross-coupling, which it tells");
    for (const Stage& stage : *options.stages) {
      how.anticipated += anticipated_coupling(stage, std::abs(own));
    }
  }
  return how;
}

}  // namespace whirl::inline cli
