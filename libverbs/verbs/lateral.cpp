#include "libverbs/options/lateral.hpp"

#include "libdyn/linear/lateral_report.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "libio/texts/lateral_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/command/verb.hpp"

namespace whirl::inline cli {

namespace {

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
