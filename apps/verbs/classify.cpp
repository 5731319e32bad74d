#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "libdyn/studies/classification_result.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

constexpr long longer = 4;  ///< times the revolutions, that halve what chance leaves of a mean

std::string plural(long n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// What would tell a motion that has not settled.
std::string what_settles(const Classification& c) {
  std::string text = fmt::format(
      "  means over sections still change by {:.2g} of their spread from one half of them to the "
      "other\n",
      c.drift.change);
  if (c.settles_after > 0) {
    return text + fmt::format("  would settle in about {} revolutions: --discard {}\n",
                              c.settles_after, c.settles_after);
  }
  return text + fmt::format("  without a steady decay: --revolutions {} would tell more\n",
                            longer * c.revolutions);
}

/// What was found, and why it is so.
std::string evidence(const Classification& c, double period) {
  std::string text = fmt::format("  {}", name_of(c.kind));
  if (c.period > 0 && c.kind != MotionKind::equilibrium) {
    text += fmt::format(", repeats after {}", plural(c.period, "revolution"));
  }
  if (!c.contacts.empty()) {
    text += fmt::format("; {} in {}", plural(static_cast<long>(c.impacts()), "impact"),
                        plural(c.revolutions, "revolution"));
  }
  text += "\n";
  const double largest = c.exponents(0);
  if (c.is_free) {
    text += fmt::format(
        "  no contact can happen any more: the orbit is the linear rotor's; its largest multiplier "
        "is "
        "{:.6f} a revolution\n",
        std::exp(largest));
  } else if (c.is_proven) {
    text += fmt::format(
        "  Newton's method found the orbit, to {:.0e} length scales; its largest multiplier is "
        "{:.6f} a revolution\n",
        c.residual, std::exp(largest));
  } else {
    text += fmt::format(
        "  largest exponent {:+.4f} a revolution ({:+.3f} 1/s), mean of {}; known to {:.4f} (99 of "
        "100), within {:.4f} it would count as zero\n",
        largest, largest / period, c.revolutions, c.resolution, c.zero);
    if (c.kind == MotionKind::not_settled) text += what_settles(c);
    if (c.section_dimension < 1e9) {
      text += fmt::format("  sections at phase 0 lie on a set of dimension {:.2f}{}\n",
                          c.section_dimension,
                          std::abs(c.section_dimension - 1.0) < 0.1 ? ", a closed curve" : "");
    }
  }
  Table table({"exponent", "per revolution", "[1/s]"});
  for (Eigen::Index i = 0; i < c.exponents.size(); ++i) {
    table.row({std::to_string(i + 1), fmt::format("{:+.6f}", c.exponents(i)),
               fmt::format("{:+.4f}", c.exponents(i) / period)});
  }
  return text + "\n" + table.text();
}

Report run_classify(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const auto file = call.result_file(model);
  ClassifyOptions options;
  options.revolutions = call.integer("revolutions");
  options.discard = call.integer("discard", 0);
  options.exponents = options.revolutions;
  options.tolerance = call.number("tolerance", "");
  require_tolerance(options.tolerance, "--tolerance " + call.text("tolerance"));
  const Scene scene = make_scene(model);
  Progress progress("classifying", options.discard + options.revolutions, call.shows_progress);
  install_interrupt_handler();
  options.watch = [&](long done) {
    progress.update(done);
    return !is_interrupted();
  };
  const Classification c = classify(scene.contacts, starting_state(call, model, scene), options);

  Report report{
      .record = begin_record(call, model), .failure = c.diagnosis, .status = status_of(c.outcome)};
  note_tables(call, model, report);
  const bool is_known = report.status == 0;
  Record& r = report.record;
  const ClassificationResult result{c, scene.contacts.period()};
  r.merge(record_of(result));
  add_contacts(r, c.contacts, c.revolutions);
  add_reduction(r, scene);
  if (!c.diagnosis.empty()) r.set("failure", c.diagnosis);

  report.text = "Kind of motion" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                reduction_text(scene, model);
  if (is_known) {
    report.text += evidence(c, scene.contacts.period());
    if (!c.contacts.empty()) report.text += "\n" + contacts_table(c.contacts, c.revolutions);
  } else if (report.status == 130) {
    report.text += fmt::format("  stopped after {}, before the kind was known\n",
                               plural(c.revolutions, "averaged revolution"));
  }
  if (file) {
    write_end(*file, model, scene, c.end);
    if (is_known) write_result(*file, result);
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
      .options = {{"revolutions", "N", "revolutions over which Lyapunov exponents are averaged",
                   "1000"},
                  discard_option,
                  tolerance_option,
                  from_option},
      .run = run_classify,
  };
}

}  // namespace whirl::inline cli
