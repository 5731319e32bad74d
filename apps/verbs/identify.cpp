#include "libdyn/motions/identify.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

/// A frequency [rad/s] in rpm with its sign; next to nothing is +0.0.
std::string signed_rpm(double frequency) {
  const std::string text = fmt::format("{:+.1f}", frequency / rpm);
  return text == "-0.0" ? "+0.0" : text;
}

/// What a peak is beside the mode of its shape: forced, a combination, or that mode, shifted.
std::string shift_text(const IdentifiedPeak& p, const Identification& id, double Omega) {
  constexpr double far = 0.1;  // of a mode's frequency: a peak beyond is not that mode's own
  if (is_forced(p.frequency, Omega, id.bin)) return "forced (1X)";
  const std::string shift = fmt::format("{:+.1f} %", 100.0 * p.shift);
  if (!p.combination) return shift;
  const std::string made_of = p.combination->text();
  return std::abs(p.shift) > far ? made_of : shift + ", " + made_of;
}

/// Table peaks x modes; the best mode of a peak is marked.
std::string mac_table(const Identification& id, double Omega) {
  std::vector<std::string> head{"peak [rpm]", "from the rotor", "radius"};
  for (std::size_t i = 0; i < id.modes.size(); ++i) {
    const Mode& m = id.modes[i];
    const char sense = m.whirl == Whirl::forward    ? 'F'
                       : m.whirl == Whirl::backward ? 'B'
                       : m.whirl == Whirl::mixed    ? 'M'
                                                    : 'P';
    head.push_back(fmt::format("{}{} {:.0f}", i + 1, sense, m.frequency() / rpm));
  }
  head.push_back("best");
  head.push_back("shift");
  Table table(head);
  for (const IdentifiedPeak& p : id.peaks) {
    std::vector<std::string> cells{signed_rpm(p.frequency), signed_rpm(p.frequency - Omega),
                                   format_length(p.amplitude)};
    for (const double value : p.mac)
      cells.push_back(value < 0.005 ? "·" : fmt::format("{:.2f}", value));
    cells.push_back(p.mac.empty() ? "-" : fmt::format("mode {}", p.mode + 1));
    cells.push_back(shift_text(p, id, Omega));
    table.row(cells);
  }
  return table.text();
}

Report run_identify(const Invocation& call) {
  const Model model = call.model();
  const auto file = call.result_file(model);
  IdentifyOptions options;
  options.modes = static_cast<int>(call.integer("modes"));
  options.rotations = call.has("rotations");
  options.mass_weighted = call.has("mass-weighted");
  options.stiffened = call.has("stiffened");
  const Run run = run_simulation(call, model);

  Report report{.record = begin_record(call, model),
                .failure = run.simulation.integration.diagnosis,
                .status = status_of(run.simulation.integration.outcome)};
  note_tables(call, model, report);
  add_run(report.record, run);
  report.text = "Identification" + (model.title.empty() ? "" : ": " + model.title) + "\n\n" +
                run_text(run, model);
  if (file) write_run(*file, run, model);
  if (!run.has_motion()) {
    report.record.set("peaks", Record::array())
        .set("modes", Record::array())
        .set("resonance", nullptr);
  } else {
    const Identification id = identify(model, run.scene, run.simulation.recording, options);
    report.record.merge(record_of(id));
    const ModesAtPoints modes({.oscillatory = id.modes}, run.scene.system.dofs);
    report.record.merge(record_of(modes));
    report.text += fmt::format(
        "\nMAC of deflection shapes (rows) against complex modes at {:.6g} rpm{} (columns: number, "
        "whirl, rpm)\n\n{}",
        model.speed / rpm, options.stiffened ? " with contacts closed" : "",
        mac_table(id, model.speed));
    if (id.resonance) {
      report.text +=
          fmt::format("\n  seen from the rotor {:.1f} : {:.1f} rpm = {}:{} within {:.2g} %\n",
                      id.resonance->high / rpm, id.resonance->low / rpm, id.resonance->p,
                      id.resonance->q, 100.0 * id.resonance->error);
    }
    if (file) {
      write_result(*file, modes);
      write_result(*file, id);
    }
  }
  commit(call, file.get(), report);
  return report;
}

}  // namespace

Verb identify_verb() {
  return {
      .name = "identify",
      .group = "Contact",
      .summary = "says which complex modes make up the motion (MAC)",
      .example = "whirl identify models/two_disk_mac.toml --out run.h5",
      .options = integration_options(
          {{"modes", "N", "how many modes to compare with", "8"},
           {"rotations", "", "let tilts count too, times the rotor's length"},
           {"mass-weighted", "", "weight the MAC with the mass matrix"},
           {"stiffened", "", "modes of the rotor with its contacts closed for good"}}),
      .run = run_identify,
  };
}

}  // namespace whirl::inline cli
