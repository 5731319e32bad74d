#include "libio/texts/motion_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "libio/text/format.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// The three strongest of some peaks: "+1664.6 (12 um), ...".
std::string peaks_text(const std::vector<FrequencyPeak>& peaks) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, peaks.size()); ++i) {
    text += fmt::format("{}{:+.1f} ({})", text.empty() ? "" : ", ", peaks[i].frequency / rpm,
                        format_length(peaks[i].amplitude));
  }
  return text.empty() ? "-" : text;
}

/// What stands still beside the rotor, such as the sag: seen from the rotor it turns backward as
/// fast as that.
/// @param Omega  speed of the rotor [rad/s]
bool stands_still(const FrequencyPeak& peak, double Omega) {
  return Omega != 0.0 && peak.frequency == -Omega;
}

/// The strongest peaks seen from the rotor, without the mean position.
std::string rotating_text(const StationSummary& station, double Omega) {
  std::vector<FrequencyPeak> moving = station.peaks_rotating;
  std::erase_if(moving, [&](const FrequencyPeak& p) { return stands_still(p, Omega); });
  return peaks_text(moving);
}

/// How far the mean position is from the axis.
std::string mean_text(const StationSummary& station, double Omega) {
  for (const FrequencyPeak& p : station.peaks_rotating) {
    if (stands_still(p, Omega)) return format_length(p.amplitude);
  }
  return "-";
}

}  // namespace

std::string contacts_table(const std::vector<ContactMeasure>& contacts, long revolutions) {
  return table_of(
      contact_shares(contacts, revolutions).contacts,
      {shown("name").as("contact"), shown("regime"), shown("duty", "", ".4f"),
       shown("impacts_per_rev", "", ".3f").as("impacts/rev"),
       shown("max_normal", "N", ".1f").as("largest normal"),
       shown("max_tangential", "N", ".1f").as("tangential"), shown("mean_slip", "m/s", ".4g")});
}

std::string reduction_text(const Scene& scene, const Model& model) {
  if (scene.reduced.size() == scene.system.size()) {
    return fmt::format("  {} degrees of freedom, not reduced\n", scene.system.size());
  }
  const ReductionError& e = scene.error;
  std::string text = fmt::format(
      "  {} of {} degrees of freedom; up to {:.0f} rpm eigenvalues are {:.2g} % off, contact "
      "receptances {:.2g} %\n",
      scene.reduced.size(), scene.system.size(), e.band / rpm, 100.0 * e.eigenvalue(),
      100.0 * e.receptance);
  if (e.within_tolerance) return text;
  text += fmt::format("  warning: that is more than reduction.tolerance = {:g}",
                      model.reduction.tolerance);
  const auto worst =
      std::max_element(e.pairs.begin(), e.pairs.end(),
                       [](const auto& a, const auto& b) { return a.error() < b.error(); });
  if (worst != e.pairs.end()) {
    text += fmt::format(" ({:.1f} rpm comes out as {:.1f} rpm)", worst->full.imag() / rpm,
                        worst->reduced.imag() / rpm);
  }
  return text + "\n";
}

std::string text_of(const Run& run, const Model& model, const RunSummary& summary,
                    const std::vector<StationSummary>& stations) {
  const RunCost& cost = summary.cost;
  std::string text =
      reduction_text(run.scene, model) +
      fmt::format(
          "  {} revolution{} recorded at {:.6g} rpm; {} steps, {} events, {:.2f} s with {}\n",
          summary.revolutions, summary.revolutions == 1 ? "" : "s", model.speed / rpm, cost.steps,
          cost.events, cost.wall, cost.method);
  if (run.simulation.integration.outcome == Outcome::stopped_by_observer) {
    text +=
        "  stopped before the end; a result file keeps the motion until there, --from goes on with "
        "it\n";
  }
  if (!run.has_motion()) return text;
  const std::vector<ContactMeasure>& contacts = run.simulation.recording.contacts;
  if (!contacts.empty()) text += "\n" + contacts_table(contacts, summary.revolutions);
  const double Omega = run.scene.system.Omega;
  return text + "\n" +
         table_of(stations,
                  {{"station", [](const StationSummary& s) { return s.label; }},
                   shown("max_radius").as("largest radius"),
                   {"mean position", [=](const StationSummary& s) { return mean_text(s, Omega); }},
                   {"strongest frequencies [rpm] (radius)",
                    [](const StationSummary& s) { return peaks_text(s.peaks); }},
                   {"seen from the rotor [rpm]",
                    [=](const StationSummary& s) { return rotating_text(s, Omega); }}}) +
         text_of(summary.probes);
}

}  // namespace whirl::inline io
