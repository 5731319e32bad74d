#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libdyn/studies/work_precision_study.hpp"
#include "libio/drawing/figure_svg.hpp"
#include "libio/figures/work_precision.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/table.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline cli {

namespace {

constexpr double sensitive = 100.0;       ///< growth of deviations that is worth a line
constexpr double poor_reference = 1e-10;  ///< its own error

std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t to = std::min(list.find(',', from), list.size());
    parts.push_back(list.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

WorkPrecisionOptions options_of(const Invocation& call) {
  WorkPrecisionOptions options;
  options.revolutions = call.integer("revolutions");
  options.discard = call.integer("discard", 0);
  const auto names = candidate_names();
  options.methods.assign(names.begin(), names.end());
  if (call.has("methods")) options.methods = parts_of(call.text("methods"));
  for (const std::string& m : options.methods) require_method(m, names, "--methods " + m);
  for (const std::string& part : parts_of(call.text("tolerances"))) {
    const auto value = parse_as(part, "");
    if (!value) throw ModelError({"--tolerances " + part}, "", value.problem);
    require_tolerance(*value, "--tolerances " + part);
    options.tolerances.push_back(*value);
  }
  return options;
}

WorkPrecisionStudy study_of(const Invocation& call, const Model& model) {
  WorkPrecisionOptions options = options_of(call);
  const Scene scene = make_scene(model);
  const MotionState start = starting_state(call, model, scene);
  if (start.phase > 0.0) options.discard = std::max(1L, options.discard);
  if (!call.has("methods") && !suits_collocation(scene.contacts)) {
    std::erase(options.methods, Collocation::name);
  }
  const auto count = static_cast<long>(options.methods.size() * options.tolerances.size());
  Progress progress("measuring", count + 1, call.shows_progress);
  return work_precision_study(
      scene.contacts, start, options,
      {.progress = [&](long done, long) { progress.update(done); }, .is_stopped = is_interrupted});
}

std::string text_of(const WorkPrecisionStudy& bench, const Model& model) {
  const ReferenceMotion& reference = bench.reference;
  if (bench.runs.empty()) return "  stopped before the first run\n";
  const auto revolutions = static_cast<double>(bench.options.revolutions);
  Table table({"method", "tolerance", "error", "ns/revolution", "steps/rev", "evaluations/rev"});
  std::string failures;
  for (const TimedRun& run : bench.runs) {
    const std::string tolerance = tolerance_text(run.tolerance);
    if (run.has_failed()) {
      table.row({run.method, tolerance, "-", "-", "-", "-"});
      failures += fmt::format("  {} at {} failed: {}\n", run.method, tolerance, run.failure());
      continue;
    }
    table.row({run.method, tolerance, fmt::format("{:.1e}", run.error),
               fmt::format("{:.0f}", 1e9 * run.time),
               fmt::format("{:.1f}", static_cast<double>(run.steps()) / revolutions),
               fmt::format("{:.1f}", static_cast<double>(run.evaluations()) / revolutions)});
  }
  std::string text = table.text() + (failures.empty() ? "" : "\n" + failures);
  text += fmt::format(
      "\n  error: the largest after {} revolution{}, displacements by {},\n"
      "  velocities by that times the speed, against {}, whose own error is about {:.0e}\n",
      bench.options.revolutions, bench.options.revolutions == 1 ? "" : "s",
      model.contacts.empty() ? "the size of the motion" : "the smallest clearance",
      reference.made_by, reference.error);
  if (reference.growth > sensitive) {
    const std::string size =
        reference.is_lost()
            ? "until it is as large as the motion"
            : fmt::format(
                  "{:.2g} times, e times every {:.2g} revolutions", reference.growth,
                  static_cast<double>(bench.options.revolutions) / std::log(reference.growth));
    text += fmt::format(
        "  over these revolutions a small deviation grows {}:\n"
        "  the motion is chaotic or unstable, and so grow the errors of steps; fewer "
        "--revolutions\n"
        "  show the methods alone\n",
        size);
  }
  if (reference.error > poor_reference) {
    text += fmt::format(
        "  warning: the reference is no better than {:.0e}; errors near or below that say "
        "nothing\n",
        reference.error);
  }
  if (!bench.is_whole) text += "  stopped before the end\n";
  return text;
}

Figure figure_of(const WorkPrecisionStudy& bench, const Model& model) {
  const WorkPrecisionOptions& options = bench.options;
  WorkPrecision data{.title = model.title.empty() ? "Speed against error" : model.title,
                     .methods = options.methods,
                     .tolerances = options.tolerances};
  data.subtitle = fmt::format("{:.6g} rpm, one core, {}", model.speed / rpm,
                              tolerance_range(options.tolerances));
  const auto by_methods = [](const Mat& table) {
    const auto numbers = table.transpose().reshaped();
    return std::vector<double>(numbers.begin(), numbers.end());
  };
  data.error = by_methods(bench.errors());
  data.time = by_methods(bench.times());
  data.revolutions = static_cast<double>(options.revolutions);
  data.reference_error = bench.reference.error;
  data.unit = model.contacts.empty() ? "sizes of the motion" : "clearances";
  return work_precision_figure(data);
}

Report run_bench(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  install_interrupt_handler();
  const WorkPrecisionStudy bench = study_of(call, model);

  Report report{.record = begin_record(call, model), .status = bench.is_whole ? 0 : 130};
  report.record.merge(record_of(bench));
  report.text = "Speed against error" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                text_of(bench, model);
  if (call.has("svg")) {
    replace_file(call.given.at("svg"), svg_of(figure_of(bench, model)), call.picture_replaces());
    report.text += fmt::format("\n  picture: {}\n", call.given.at("svg"));
  }
  if (file) {
    file->attribute("/", "speed", model.speed);
    write_result(*file, bench);
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
