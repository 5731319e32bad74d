#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/constants.hpp"
#include "libbase/error.hpp"
#include "libdyn/studies/resonance_study.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

std::string branch_name(const Campbell& diagram, int branch) {
  return fmt::format("{} {}", branch + 1,
                     name_of(diagram.branches[static_cast<std::size_t>(branch)].whirl));
}

/// Sizes of the orbits of both modes in the contacts: "0.10 0.32 | 0.95 0.04".
std::string sizes_text(const std::vector<ContactOrbits>& contacts) {
  std::string fast, slow;
  for (const ContactOrbits& c : contacts) {
    fast += fmt::format("{}{:.2f}", fast.empty() ? "" : " ", c.fast);
    slow += fmt::format("{}{:.2f}", slow.empty() ? "" : " ", c.slow);
  }
  return fast + " | " + slow;
}

std::string bouncing_text(const std::optional<Bouncing>& b) {
  if (!b) return "none found";
  return fmt::format("{} at {:.1f} rpm, {:.4f} revolutions",
                     b->cycle.is_stable() ? "stable" : "unstable", b->speed / rpm, b->turns);
}

Record bouncing_record(const std::optional<Bouncing>& b) {
  if (!b) return nullptr;
  Record record;
  record.set("speed_rpm", b->speed / rpm).set("period_revs", b->turns);
  return record.set("stable", b->cycle.is_stable());
}

std::string places_text(const ResonanceStudy& study, bool confirms) {
  if (study.places.empty()) return "  none between these speeds\n";
  const std::vector<ContactOrbits>& contacts = study.places.front().contacts;
  std::vector<std::string> head{"speed [rpm]", "ratio", "faster mode", "slower mode",
                                "seen from the rotor [rpm]"};
  if (!contacts.empty()) head.emplace_back("at the contacts");
  if (confirms) head.emplace_back("bouncing");
  Table table(head);
  for (const ResonancePlace& r : study.places) {
    std::vector<std::string> row{
        fmt::format("{:.1f}", r.speed / rpm), fmt::format("{}:{}", r.p, r.q),
        branch_name(study.diagram, r.fast), branch_name(study.diagram, r.slow),
        fmt::format("{:.1f}, {:.1f}", r.p * r.frequency / rpm, r.q * r.frequency / rpm)};
    if (!contacts.empty()) row.push_back(sizes_text(r.contacts));
    if (confirms) row.push_back(bouncing_text(r.bouncing));
    table.row(row);
  }
  std::string names;
  for (const ContactOrbits& c : contacts) names += (names.empty() ? "" : ", ") + c.name;
  if (names.empty()) return table.text();
  return table.text() +
         fmt::format(
             "\n  at the contacts ({}): orbits of both modes by their largest on the rotor\n",
             names);
}

ResonanceOptions options_of(const Invocation& call, const Model& model) {
  ResonanceOptions options{
      .speeds = call.speeds(model),
      .modes = static_cast<int>(call.integer("modes")),
      .largest = static_cast<int>(call.integer("largest")),
      .confirms = call.has("confirm"),
      .search = {.starts = static_cast<int>(call.integer("starts")),
                 .seed = static_cast<std::uint64_t>(call.integer("seed"))},
  };
  if (options.confirms && model.contacts.empty()) {
    throw ModelError({"--confirm"}, "", "expected a model with contacts to bounce in");
  }
  return options;
}

/// The result file; a motion that bounces is its end, so that others begin there.
void write(ResultWriter& file, const Model& model, const Assembler& assembler,
           const ResonanceStudy& study) {
  const auto first = std::find_if(study.places.begin(), study.places.end(),
                                  [](const auto& place) { return place.bouncing.has_value(); });
  if (first != study.places.end()) {
    MotionState on_it;
    on_it.y = first->bouncing->cycle.state;
    write_end(file, model, *scene_at_speed(model, first->bouncing->speed), on_it);
  } else {
    write_points(file, model, assembler);
  }
  write_result(file, study.diagram);
  write_result(file, study);
}

Report run_resonances(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const ResonanceOptions options = options_of(call, model);
  const auto file = call.result_file(model);
  if (options.confirms) install_interrupt_handler();
  std::optional<Progress> progress;
  const ResonanceStudy study = resonance_study(
      model, assembler, options,
      {.progress =
           [&](long done, long total) {
             if (!progress) {
               progress.emplace("looking for bouncing motions", total, call.shows_progress);
             }
             progress->update(done);
           },
       .is_stopped = is_interrupted});

  Report report{.record = begin_record(call, model), .status = study.is_whole ? 0 : 130};
  Record list = Record::array();
  for (const ResonancePlace& place : study.places) {
    Record entry = record_of(place);
    if (options.confirms) entry.set("bouncing", bouncing_record(place.bouncing));
    list.add(entry);
  }
  report.record.set("resonances", list);
  report.text = "Internal resonances seen from the rotor" +
                (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                places_text(study, options.confirms) + (study.is_whole ? "" : "\n  stopped\n");
  if (!options.confirms) note_left_out(model, report);
  note_tables(model, options.speeds.front(), options.speeds.back(), report);
  if (file) write(*file, model, assembler, study);
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb resonances_verb() {
  return {
      .name = "resonances",
      .group = "Linear rotordynamics",
      .summary =
          "speeds at which two modes are in p:q resonance seen from the rotor, where it may bounce",
      .example = "whirl resonances models/two_disk_mac.toml --speeds 1000:8000:50rpm --confirm",
      .options = {{"modes", "N", "how many modes", "4"},
                  speeds_option,
                  {"largest", "N", "of p and q", "4"},
                  {"confirm", "", "look for bouncing motions near each of them"},
                  {"starts", "N", "of them at every speed that is tried", "16"},
                  seed_option},
      .run = run_resonances,
  };
}

}  // namespace whirl::inline cli
