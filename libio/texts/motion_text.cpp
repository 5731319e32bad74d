#include "libio/texts/motion_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "libio/text/format.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// The three strongest of some peaks: "+1664.6 (12 um), ...".
std::string peaks_text(const std::vector<FrequencyPeak>& peaks) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, peaks.size()); ++i) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ",
                        shown_number(peaks[i].frequency, "rpm", "+.1f"),
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

std::string supports_table(const std::vector<SupportLoad>& supports) {
  TableColumns<SupportLoad> columns{{shown("name").as("force on")},
                                    {shown("kind").as("")},
                                    {shown("mean_fx", "N", ".4g").as("mean x")},
                                    {shown("mean_fy", "N", ".4g").as("mean y")},
                                    {shown("peak_to_peak_fx", "N", ".4g").as("p-p x")},
                                    {shown("peak_to_peak_fy", "N", ".4g").as("p-p y")}};
  const bool has_begun = std::any_of(supports.begin(), supports.end(), [](const SupportLoad& s) {
    return s.before.has_value() || s.after.has_value();
  });
  if (has_begun) columns.push_back({shown("before", "N", ".4g")});
  columns.push_back({shown("largest", "N", ".4g")});
  if (has_begun) columns.push_back({shown("largest_at", "s", ".5g").as("at")});
  if (has_begun) columns.push_back({shown("after", "N", ".4g")});
  return table_of(supports, columns);
}

/// The last touches of several contacts, in the order in which they begin.
std::string touches_text(const std::vector<ContactTouch>& touches) {
  constexpr std::size_t most = 8;
  if (touches.empty()) return "";
  const std::size_t count = std::min(most, touches.size());
  const std::vector<ContactTouch> last(touches.end() - static_cast<std::ptrdiff_t>(count),
                                       touches.end());
  return fmt::format("\nThe last {} touches, in their order\n\n", count) +
         table_of(last, {shown("contact"), shown("begins", "s", ".6g").as("from"),
                         shown("ends", "s", ".6g").as("to"),
                         shown("max_normal", "N", ".4g").as("largest normal")});
}

std::string friction_table(const std::vector<ContactShare>& contacts) {
  return table_of(contacts,
                  {shown("name").as("friction at"), shown("friction_energy", "J", ".4g").as("heat"),
                   shown("mean_power", "W", ".4g").as("mean power"),
                   shown("max_power", "W", ".4g").as("largest"),
                   shown("mean_torque", "N.m", ".4g").as("mean torque"),
                   shown("max_torque", "N.m", ".4g").as("largest")});
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

std::string text_of(const MotionLoads& loads) {
  std::string text;
  const auto rubs = [](const ContactShare& c) { return c.rubbing.energy > 0.0; };
  if (std::any_of(loads.contacts.begin(), loads.contacts.end(), rubs)) {
    text += "\n" + friction_table(loads.contacts);
  }
  if (!loads.supports.empty()) text += "\n" + supports_table(loads.supports);
  return text;
}

std::string loads_begin_text(const std::vector<double>& begins) {
  if (begins.empty()) return "";
  std::vector<std::string> times;
  for (const double t : begins) times.push_back(fmt::format("{:.6g} s", t));
  return fmt::format(
      "Loads begin at {}: before, largest and after are forces with their mean, the last ones "
      "those "
      "of eight revolutions at most.",
      fmt::join(times, ", "));
}

std::string reduction_text(const Scene& scene, const Model& model) {
  if (scene.reduced.size() == scene.system.size()) {
    return fmt::format("  {} degrees of freedom, not reduced\n", scene.system.size());
  }
  const ReductionError& e = scene.error;
  std::string text = fmt::format(
      "  {} of {} degrees of freedom; up to {} eigenvalues are {:.2g} % off, contact receptances "
      "{:.2g} %\n",
      scene.reduced.size(), scene.system.size(), shown_value(e.band, "rpm", ".0f"),
      100.0 * e.eigenvalue(), 100.0 * e.receptance);
  if (e.within_tolerance) return text;
  text += fmt::format("  warning: that is more than reduction.tolerance = {:g}",
                      model.reduction.tolerance);
  const auto worst =
      std::max_element(e.pairs.begin(), e.pairs.end(),
                       [](const auto& a, const auto& b) { return a.error() < b.error(); });
  if (worst != e.pairs.end()) {
    text += fmt::format(" ({} comes out as {})", shown_value(worst->full.imag(), "rpm", ".1f"),
                        shown_value(worst->reduced.imag(), "rpm", ".1f"));
  }
  return text + "\n";
}

std::string text_of(const Run& run, const Model& model, const RunSummary& summary,
                    const std::vector<StationSummary>& stations) {
  const RunCost& cost = summary.cost;
  std::string text =
      reduction_text(run.scene, model) +
      fmt::format("  {} revolution{} recorded at {}; {} steps, {} events, {:.2f} s with {}\n",
                  summary.revolutions, summary.revolutions == 1 ? "" : "s",
                  shown_value(model.speed, "rpm", ".6g"), cost.steps, cost.events, cost.wall,
                  cost.method);
  if (run.simulation.integration.outcome == Outcome::stopped_by_observer) {
    text +=
        "  stopped before the end; a result file keeps the motion until there, --from goes on with "
        "it\n";
  }
  if (!run.has_motion()) return text;
  const std::vector<ContactMeasure>& contacts = run.simulation.recording.contacts;
  if (!contacts.empty()) text += "\n" + contacts_table(contacts, summary.revolutions);
  if (contacts.size() > 1) text += touches_text(summary.touches);
  text += text_of(MotionLoads{summary.supports, summary.contacts});
  if (const std::string begins = loads_begin_text(summary.begins); !begins.empty()) {
    text += "  " + begins + "\n";
  }
  const double Omega = run.scene.system.Omega;
  return text + "\n" +
         table_of(stations,
                  {{"station", [](const StationSummary& s) { return s.label; }},
                   shown("max_radius").as("largest radius"),
                   {"mean position", [=](const StationSummary& s) { return mean_text(s, Omega); }},
                   {shown_heading("strongest frequencies", "rpm") + " (radius)",
                    [](const StationSummary& s) { return peaks_text(s.peaks); }},
                   {shown_heading("seen from the rotor", "rpm"),
                    [=](const StationSummary& s) { return rotating_text(s, Omega); }}}) +
         text_of(summary.probes);
}

}  // namespace whirl::inline io
