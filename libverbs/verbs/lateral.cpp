#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/text/lateral_values.hpp"
#include "libio/texts/lateral_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"
#include "libverbs/options/variants.hpp"

namespace whirl::inline cli {

namespace {

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
  ListOption variants = variants_option();
  auto fields() {
    return std::tie(minimum_speed, maximum_speed, trip_speed, coupling, stages, gas_density,
                    variants);
  }
};

OperatingRange range_of(const LateralVerbOptions& options, const Model& model) {
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

LateralOptions lateral_options(const LateralVerbOptions& options, const Model& model) {
  LateralOptions how{.range = range_of(options, model)};
  how.has_anticipated = options.coupling.is_given || options.stages.is_given;
  how.anticipated = options.coupling.value_or(0.0);
  if (options.gas_density) how.gas_density = *options.gas_density;
  if (options.stages) {
    if (options.coupling) throw options.stages.wrong("leave out --cross-coupling, which it tells");
    for (const Stage& stage : *options.stages) {
      how.anticipated += anticipated_coupling(stage, how.range.maximum);
    }
  }
  return how;
}

Report run_lateral(const Invocation& call, const LateralVerbOptions& options) {
  Model model = call.model();
  const LateralOptions how = lateral_options(options, model);
  model.speed = how.range.maximum;  // at which the rotor is weighed and looked at
  const Assembler assembler(model.structure);
  const LateralStudy study =
      lateral_report(model, how, variants_of(call, options.variants, model.speed));
  const StaticStudy rest = static_study(model, assembler);
  Report report = begin_report(call, model, record_of(study.report).merge(record_of(study.parts)));
  report.record.merge(record_of(study.criticals)).set("campbell", record_of(study.campbell));
  report.text = text_of(study);
  Model rotor = model;
  rotor.contacts = rolling_bearings(rotor.contacts);
  report.add_notes(linear_notes(rotor, study.report.speeds));
  if (has_linear_films(model)) {
    report.add_notes(
        {"level I: oil films keep the coefficients that they have without the "
         "cross-coupled stiffness; the same stiffness as a [[link]] or [[seal]] of the "
         "model moves the journals, too"});
  }
  report.add_notes(bare_value_notes(call.text("cross-coupling"), call.text("gas-density")));
  write_file(call, model, report, [&](ResultWriter& file) {
    write_points(file, model, assembler);
    write_result(file, study.report);
    write_result(file, study.parts);
    write_criticals(file, linear_structure(model), study.criticals);
    write_result(file, study.campbell);
    write_rest(file, rest);
  });
  return report;
}

}  // namespace

Verb lateral_verb() {
  return {
      .name = "lateral",
      .group = "Linear rotordynamics",
      .summary =
          "the lateral analysis after API 617: margins, limits, stability, passes and failures",
      .example =
          "whirl lateral models/compressor.toml --cross-coupling 5MN/m --gas-density 20kg/m^3",
      .run = run_lateral,
  };
}

}  // namespace whirl::inline cli
