#include "libio/texts/classification_text.hpp"
#include "libio/texts/motion_notes.hpp"
#include "libverbs/command/reporting.hpp"
#include "libverbs/options/common.hpp"
#include "libverbs/options/simulation.hpp"

namespace whirl::inline cli {

namespace {

struct ClassifyVerbOptions {
  Option<long> revolutions{"revolutions", "N",
                           "revolutions over which Lyapunov exponents are averaged", 1000,
                           revolution_range};
  ExponentVerbOptions lyapunov{};
  Option<long> discard = discard_option();
  StepVerbOptions by{};
  Option<double> tolerance = tolerance_option();
  Option<std::string> isa = isa_option();
  Option<std::string> from = from_option();
  auto fields() { return std::tie(revolutions, lyapunov, discard, by, tolerance, isa, from); }
};

constexpr Eigen::Index told_estimates = 400;  ///< of exponents over time

ClassifyOptions classify_options(const Invocation& call, const ClassifyVerbOptions& asked) {
  ClassifyOptions options{.discard = *asked.discard,
                          .revolutions = *asked.revolutions,
                          .exponents = *asked.revolutions,
                          .most_exponents = asked.lyapunov.count.value_or(0),
                          .resolution = asked.lyapunov.resolution.value_or(0.0),
                          .tolerance = *asked.tolerance,
                          .rk4_steps = asked.by.rk4_steps(),
                          .path = call.wants_result() ? told_estimates : 0};
  options.watch = [progress = progress_of(call, "classifying"), is_stopped = call.stop_asked(),
                   total = options.discard + options.revolutions](long done) {
    progress(done, total);
    return !is_stopped();
  };
  return options;
}

Report run_classify(const Invocation& call, const ClassifyVerbOptions& asked) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  const ClassifyOptions options = classify_options(call, asked);
  const Scene scene = make_scene(model);
  const Classification c =
      classify(scene.contacts, starting_state(asked.from, model, scene), options);
  const ClassificationResult result{c, scene.contacts.period()};

  Report report = begin_report(call, model, record_of(result));
  report.add_notes(asked.by.notes());
  report.failure = c.failure;
  report.status = status_of(c.outcome);
  note_model(call, model, report);
  if (result.is_known()) report.add_notes(motion_notes(model, scene, c.end, noted_revolutions));
  report.record.merge(record_of(contact_shares(c.contacts, c.revolutions)))
      .set("reduction", record_of(reduction_facts(scene)));
  if (c.failure) report.record.set("failure", c.failure.text());
  report.text =
      headline("Kind of motion", model) + "\n" + reduction_text(scene, model) + text_of(result);
  if (file) {
    write_end(*file, model, scene, c.end);
    if (result.is_known()) write_result(*file, result);
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb classify_verb() {
  return {
      .name = "classify",
      .group = "Contact",
      .summary = "tells the kind of the steady motion: periodic, quasi-periodic, chaotic",
      .example = "whirl classify models/jeffcott_stator.toml --set contact.ring.friction=0.15",
      .run = run_classify,
  };
}

}  // namespace whirl::inline cli
