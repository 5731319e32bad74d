#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "libdyn/motions/unbalance_study.hpp"
#include "libio/results/columns.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : std::string("-");
}

/// A peak's margin to the operating speed, and the one that is required.
std::pair<std::string, std::string> margin_text(const StationPeak& peak) {
  if (!peak.separation) return {"-", "-"};
  const SeparationMargin& m = *peak.separation;
  const std::string actual = fmt::format("{} {}", percent(m.actual), *peak.side());
  if (!peak.is_kept()) return {actual, "-"};
  if (m.required == 0.0) return {actual, "none"};
  return {actual, fmt::format("{}, {}", percent(m.required), m.is_kept() ? "kept" : "NOT KEPT")};
}

std::string peaks_text(const Model& model, const UnbalanceStudy& study) {
  if (study.peaks.empty()) return "";
  const bool has_speed = model.has_speed && model.speed > 0.0;
  Table table({"peak [rpm]", "largest at", "[um]", "amplification",
               has_speed ? fmt::format("margin to {:.6g} rpm", model.speed / rpm) : "margin",
               "required"});
  bool is_told = true;
  for (const StationPeak& peak : study.peaks) {
    const double factor = peak.amplification();
    is_told = is_told && std::isfinite(factor);
    const auto [margin, required] = margin_text(peak);
    table.row({fmt::format("{:.1f}", peak.speed / rpm),
               study.stations[static_cast<std::size_t>(peak.row)].label,
               fmt::format("{:.3f}", 1e6 * peak.amplitude),
               std::isfinite(factor) ? fmt::format("{:.4g}", factor) : "-", margin, required});
  }
  return "\nPeaks of the largest response: amplification factors and separation margins after API "
         "617\n\n" +
         table.text() +
         (is_told
              ? ""
              : "\n  -: the response does not fall to 0.707 of this peak between these speeds\n");
}

std::string stations_text(const UnbalanceStudy& study) {
  Table table({"station", "largest [um]", "at [rpm]", "at the highest speed [um]"});
  for (std::size_t i = 0; i < study.stations.size(); ++i) {
    const StationResponse& of = study.stations[i];
    table.row({of.label, fmt::format("{:.3f}", 1e6 * study.largest[i].amplitude),
               fmt::format("{:.1f}", study.largest[i].speed / rpm),
               fmt::format("{:.3f}", 1e6 * of.major(of.major.size() - 1))});
  }
  const std::vector<double>& speeds = study.speeds;
  const std::string range = speeds.size() == 1
                                ? fmt::format("at {:.6g} rpm", speeds[0] / rpm)
                                : fmt::format("{} speeds from {:.6g} to {:.6g} rpm", speeds.size(),
                                              speeds.front() / rpm, speeds.back() / rpm);
  return fmt::format("Unbalance response, {} (major semi-axes)\n\n{}", range, table.text());
}

/// A clearance that the response goes beyond.
std::string beyond_text(const ClearanceUse& use) {
  std::string ranges;
  for (const SpeedRange& range : use.beyond) {
    ranges += fmt::format("{}{:.1f} to {:.1f}", ranges.empty() ? "" : ", ", range.first / rpm,
                          range.last / rpm);
  }
  return fmt::format(
      "the response goes beyond the clearance of {} ({:.4g} mm) at {} rpm, up to {:.4g} mm, "
      "{:.3g} times the clearance, at {:.1f} rpm: there it touches, and this response is not its "
      "motion",
      use.name, 1e3 * use.clearance, ranges, 1e3 * use.largest, use.largest / use.clearance,
      use.at / rpm);
}

/// What keeps the response from being the whole truth.
void add_notes(const Model& model, const UnbalanceStudy& study, Report& report) {
  for (const ClearanceUse& use : study.clearances) {
    if (!use.beyond.empty()) report.notes.push_back(beyond_text(use));
  }
  for (const double Omega : study.unbounded) {
    report.notes.push_back(fmt::format(
        "the response is unbounded at {:.2f} rpm, a resonance without damping", Omega / rpm));
  }
  if (!study.failure.empty()) {
    report.notes.push_back(fmt::format(
        "the modes of this rotor were not found ({}): narrow peaks may be missing", study.failure));
  }
  note_left_out(model, report);
  note_tables(model, study.speeds.front(), study.speeds.back(), report);
}

Report run_unbalance(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const UnbalanceStudy study =
      unbalance_study(model, assembler,
                      {.speeds = call.speeds(model),
                       .has_given_speeds = call.has("speeds"),
                       .stations = select_points(model, assembler, call.text("stations"))});
  Report report{.record = begin_record(call, model).merge(record_of(study)),
                .text = stations_text(study) + peaks_text(model, study)};
  if (model.structure.unbalances.empty()) report.text += "\n  The model has no unbalance.\n";
  add_notes(model, study, report);
  if (const auto file = call.result_file(model)) {
    write_points(*file, model, assembler);
    write_result(*file, study);
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace

Verb unbalance_verb() {
  return {
      .name = "unbalance",
      .group = "Linear rotordynamics",
      .summary = "steady unbalance response over speeds",
      .example = "whirl unbalance models/two_disk_mac.toml --speeds 0:8000:10rpm",
      .options = {speeds_option, {"stations", "NAME,...", "names, node numbers or all", "all"}},
      .run = run_unbalance,
  };
}

}  // namespace whirl::inline cli
