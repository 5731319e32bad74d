#include <fmt/format.h>

#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/work_precision.hpp"
#include "libio/text/interrupt.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/texts/work_precision_text.hpp"

namespace whirl::inline cli {

namespace {

WorkPrecisionOptions bench_options(const Invocation& call) {
  WorkPrecisionOptions options{.revolutions = call.integer("revolutions"),
                               .discard = call.integer("discard", 0)};
  if (call.has("methods")) options.methods = split(call.text("methods"), ',');
  for (const std::string& m : options.methods) {
    parsed_option("methods", m,
                  [](const std::string& name) { return parse_method(name, candidate_names()); });
  }
  for (const std::string& part : split(call.text("tolerances"), ',')) {
    options.tolerances.push_back(parsed_option("tolerances", part, parse_tolerance));
  }
  return options;
}

Report run_bench(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  const WorkPrecisionOptions options = bench_options(call);
  const Scene scene = make_scene(model);
  install_interrupt_handler();
  const WorkPrecisionStudy study = work_precision_study(
      scene.contacts, starting_state(call, model, scene), options,
      {.progress = progress_of(call, "measuring"), .is_stopped = is_interrupted});

  Report report = begin_report(call, model, record_of(study));
  report.status = study.is_whole ? 0 : 130;
  report.text = headline("Speed against error", model) + "\n" + text_of(study, model);
  if (call.has("svg")) {
    const Figure figure = work_precision_figure(work_precision_of(study, model));
    replace_file(call.given.at("svg"), svg_of(figure), call.picture_replaces());
    report.text += fmt::format("\n  picture: {}\n", call.given.at("svg"));
  }
  if (file) {
    file->attribute("/", "speed", model.speed);
    write_result(*file, study);
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb bench_verb() {
  return {
      .name = "bench",
      .group = "Contact",
      .summary = "speed against error of every integrator on this model",
      .example =
          "whirl bench models/two_disk_mac.toml --methods dop853,rk4 --tolerances 1e-6,1e-10 --svg "
          "bench.svg",
      .options = {{"revolutions", "N", "revolutions that are measured", "20"},
                  discard_option,
                  {"methods", "M,...",
                   "integrators, as of simulate --method; left out: all that suit the model"},
                  {"tolerances", "T,...", "of their steps", "1e-4,1e-6,1e-8,1e-10,1e-12"},
                  from_option,
                  {"svg", "FILE", "picture of time over error, both logarithmic"}},
      .run = run_bench,
  };
}

}  // namespace whirl::inline cli
