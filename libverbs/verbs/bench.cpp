#include <fmt/format.h>

#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/work_precision.hpp"
#include "libio/text/parameter_axis.hpp"
#include "libio/texts/work_precision_text.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/simulation.hpp"

namespace whirl::inline cli {

namespace {

struct BenchVerbOptions {
  Option<long> revolutions{"revolutions", "N", "revolutions that are measured", 20,
                           Whole{1, 100'000}};
  Option<long> discard = discard_option();
  Option<std::string> methods{
      "methods", "M,...",
      "integrators, as of simulate --method; left out: all that suit the model"};
  Option<std::string> tolerances{"tolerances", "T,...", "of their steps",
                                 "1e-4,1e-6,1e-8,1e-10,1e-12"};
  Option<std::string> isa = isa_option();
  Option<std::string> from = from_option();
  Option<std::string> svg =
      output_option("svg", "FILE", "picture of time over error, both logarithmic", ".svg");
  auto fields() { return std::tie(revolutions, discard, methods, tolerances, isa, from, svg); }
};

WorkPrecisionOptions bench_options(const BenchVerbOptions& asked) {
  WorkPrecisionOptions options{.revolutions = *asked.revolutions, .discard = *asked.discard};
  if (asked.methods) options.methods = split(*asked.methods, ',');
  for (const std::string& m : options.methods) {
    parsed_option("methods", m,
                  [](const std::string& name) { return parse_method(name, candidate_names()); });
  }
  for (const std::string& part : split(*asked.tolerances, ',')) {
    options.tolerances.push_back(parsed_option("tolerances", part, parse_tolerance));
  }
  return options;
}

Report run_bench(const Invocation& call, const BenchVerbOptions& asked) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  const WorkPrecisionOptions options = bench_options(asked);
  const Scene scene = make_scene(model);
  const WorkPrecisionStudy study = work_precision_study(
      scene.contacts, starting_state(asked.from, model, scene), options,
      {.progress = progress_of(call, "measuring"), .is_stopped = call.stop_asked()});

  Report report = begin_report(call, model, record_of(study));
  report.status = study.is_whole ? exit_status::done : exit_status::stopped;
  report.text = headline("Speed against error", model) + "\n" + text_of(study, model);
  if (asked.svg) {
    const Figure figure = work_precision_figure(work_precision_of(study, model));
    replace_file(*asked.svg, svg_of(figure), call.picture_replaces());
    report.text += fmt::format("\n  picture: {}\n", *asked.svg);
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
      .run = run_bench,
  };
}

}  // namespace whirl::inline cli
