#include "libdyn/motions/identify.hpp"

#include <fmt/format.h>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/simulation.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

Record record_of(const Combination& combination) {
  Record terms = Record::array();
  for (const Combination::Term& t : combination.terms) {
    terms.add(Record().set("times", t.times).set("frequency_rpm", t.frequency / rpm));
  }
  return terms;
}

Record record_of(const IdentifiedPeak& peak, double Omega) {
  Record r;
  r.set("frequency_rpm", peak.frequency / rpm)
      .set("amplitude_m", peak.amplitude)
      .set("mac", peak.mac);
  r.set("mode", peak.mac.empty() ? Record(nullptr) : Record(peak.mode + 1))
      .set("shift", peak.shift);
  r.set("frequency_rotating_rpm", (peak.frequency - Omega) / rpm);
  r.set("combination", peak.combination ? record_of(*peak.combination) : Record(nullptr));
  return r;
}

/// A frequency [rad/s] in rpm with its sign; next to nothing is +0.0.
std::string signed_rpm(double frequency) {
  const std::string text = fmt::format("{:+.1f}", frequency / rpm);
  return text == "-0.0" ? "+0.0" : text;
}

/// "2 x 2377.2 - 4430.0", in rpm.
std::string combination_text(const Combination& combination) {
  std::string text;
  for (const Combination::Term& t : combination.terms) {
    const bool is_minus = t.times < 0;
    text += text.empty() ? (is_minus ? "-" : "") : is_minus ? " - " : " + ";
    if (std::abs(t.times) > 1) text += fmt::format("{} x ", std::abs(t.times));
    text += t.frequency < 0.0 ? fmt::format("({:.1f})", t.frequency / rpm)
                              : fmt::format("{:.1f}", t.frequency / rpm);
  }
  return text;
}

/// What a peak is beside the mode of its shape: forced, a combination, or that mode, shifted.
std::string shift_text(const IdentifiedPeak& p, const Identification& id, double Omega) {
  constexpr double far = 0.1;  // of a mode's frequency: a peak beyond is not that mode's own
  if (is_forced(p.frequency, Omega, id.bin)) return "forced (1X)";
  const std::string shift = fmt::format("{:+.1f} %", 100.0 * p.shift);
  if (!p.combination) return shift;
  const std::string made_of = combination_text(*p.combination);
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
    Record peaks = Record::array();
    for (const IdentifiedPeak& p : id.peaks) peaks.add(record_of(p, model.speed));
    report.record.set("peaks", peaks);
    Modes modes;
    modes.oscillatory = id.modes;
    add_modes(report.record, modes);
    if (id.resonance) {
      Record r;
      r.set("ratio", Record(Record::Array{id.resonance->p, id.resonance->q}))
          .set("error", id.resonance->error);
      r.set("frequencies_rpm",
            std::vector<double>{id.resonance->high / rpm, id.resonance->low / rpm});
      report.record.set("resonance", r);
    } else {
      report.record.set("resonance", nullptr);
    }
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
      write_modes(*file, modes, run.scene.system.dofs);
      const auto np = static_cast<Eigen::Index>(id.peaks.size()),
                 nm = static_cast<Eigen::Index>(id.modes.size());
      Mat mac(np, nm);
      Vec frequency(np), amplitude(np);
      std::vector<std::string> combination;
      for (Eigen::Index i = 0; i < np; ++i) {
        const IdentifiedPeak& p = id.peaks[static_cast<std::size_t>(i)];
        frequency(i) = p.frequency;
        amplitude(i) = p.amplitude;
        combination.push_back(p.combination ? combination_text(*p.combination) : "");
        mac.row(i) = Eigen::Map<const Eigen::RowVectorXd>(p.mac.data(), nm);
      }
      if (np > 0) {
        file->dataset("/mac/frequency", frequency, {"rad/s", "signed frequency of the peak", {""}});
        file->dataset("/mac/amplitude", amplitude,
                      {"m", "largest radius at the peak", {"/mac/frequency"}});
        file->dataset("/mac/combination", combination,
                      {"", "stronger peaks that make up the frequency [rpm]", {"/mac/frequency"}});
        file->dataset("/mac/mac", mac,
                      {"", "modal assurance criterion", {"/mac/frequency", "/modes/number"}});
      }
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

}  // namespace whirl
