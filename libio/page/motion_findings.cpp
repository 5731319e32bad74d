#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdyn/motions/run_result.hpp"
#include "libdyn/studies/orbit_result.hpp"
#include "libdyn/system/clearance.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/findings.hpp"
#include "libio/text/format.hpp"
#include "libio/texts/motion_text.hpp"

namespace whirl::inline io {

namespace {

using figures::result_of;

/// How far a station moves.
struct Reach {
  std::string station;
  double radius = 0.0;      ///< largest distance from the axis [m]
  double x = 0.0, y = 0.0;  ///< peak to peak [m]
};

std::vector<Reach> station_reaches(const MotionRecord& motion) {
  std::vector<Reach> all;
  for (const StationMotion& s : motion.stations) {
    if (s.x.size() == 0) continue;
    all.push_back({s.station, std::sqrt((s.x.array().square() + s.y.array().square()).maxCoeff()),
                   s.x.maxCoeff() - s.x.minCoeff(), s.y.maxCoeff() - s.y.minCoeff()});
  }
  return all;
}

Sheet reach_sheet(const std::vector<Reach>& all) {
  return {"Displacements of stations in what was recorded",
          sheet_table(all, {{"station", [](const Reach& r) { return r.station; }},
                            {shown_heading("largest radius", "um"),
                             [](const Reach& r) { return shown_number(r.radius, "um", ".3f"); }},
                            {shown_heading("peak to peak x", "um"),
                             [](const Reach& r) { return shown_number(r.x, "um", ".3f"); }},
                            {shown_heading("peak to peak y", "um"),
                             [](const Reach& r) { return shown_number(r.y, "um", ".3f"); }}})};
}

Sheet touched_sheet(const std::vector<ContactShare>& contacts) {
  return {
      "Contacts",
      sheet_table(contacts,
                  {shown("name").as("contact"),
                   shown("regime"),
                   {"time in touch",
                    [](const ContactShare& c) { return fmt::format("{:.2f} %", 100.0 * c.duty); }},
                   shown("impacts_per_rev", "", ".4g").as("impacts per revolution"),
                   shown("max_normal", "N", ".4g").as("largest normal force"),
                   shown("max_tangential", "N", ".4g").as("largest friction force"),
                   shown("mean_slip", "m/s", ".4g").as("mean slip in touch")})};
}

Sheet taken_clearances_sheet(const std::vector<RunningClearance>& all) {
  return {"Clearances where the motion takes most of each",
          sheet_table(
              all, {shown("name").as("clearance of"), shown("clearance", "mm", ".4f"),
                    shown("distance", "mm", ".4f").as("displaced"), shown("left", "mm", ".4f")})};
}

Sheet friction_sheet(const std::vector<ContactShare>& contacts) {
  return {"Friction of contacts",
          sheet_table(contacts,
                      {shown("name").as("contact"), shown("friction_energy", "J", ".4g").as("heat"),
                       shown("mean_power", "W", ".4g").as("mean power"),
                       shown("max_power", "W", ".4g").as("largest power"),
                       shown("mean_torque", "N.m", ".4g").as("mean moment"),
                       shown("max_torque", "N.m", ".4g").as("largest moment")})};
}

bool is_heated(const std::vector<ContactShare>& contacts) {
  return std::ranges::any_of(contacts,
                             [](const ContactShare& c) { return c.rubbing.energy > 0.0; });
}

/// Forces on supports; where a load begins on the way, those before and after it too.
Sheet supports_sheet(const std::vector<SupportLoad>& loads, const std::vector<double>& begins) {
  TableColumns<SupportLoad> columns{shown("name").as("support"),
                                    shown("kind"),
                                    shown("mean_fx", "N", ".4g").as("mean x"),
                                    shown("mean_fy", "N", ".4g").as("mean y"),
                                    shown("largest", "N", ".4g"),
                                    shown("largest_at", "s", ".5g").as("at")};
  Sheet sheet{"Forces of the rotor on its supports in what was recorded", {}};
  if (!begins.empty()) {
    columns.push_back(shown("before", "N", ".4g"));
    columns.push_back(shown("after", "N", ".4g"));
    sheet.notes.push_back(loads_begin_text(begins));
  }
  sheet.table = sheet_table(loads, columns);
  return sheet;
}

}  // namespace

Findings motion_findings(const ResultView& result) {
  const auto& motion = result_of<MotionRecord>(result);
  const auto& run = result_of<RunFacts>(result);
  const auto& shares = result_of<ContactShares>(result);
  Findings f;
  const std::vector<Reach> all = station_reaches(motion);
  const auto most = std::max_element(
      all.begin(), all.end(), [](const Reach& a, const Reach& b) { return a.radius < b.radius; });
  f.headline = all.empty() ? "A motion without stations."
                           : fmt::format("Largest displacement: {} at station {}",
                                         format_length(most->radius), most->station);
  if (run.failure) {
    f.standing = Standing::open;
    f.sentences.push_back(fmt::format("The computation ended early: {}.", run.failure.text()));
  }
  f.sentences.push_back(fmt::format("Recorded: {:g} revolutions.", run.revolutions));
  const auto touched = std::count_if(shares.contacts.begin(), shares.contacts.end(),
                                     [](const ContactShare& c) { return c.duty > 0.0; });
  if (!shares.contacts.empty()) {
    f.sentences.push_back(
        fmt::format("{} of {} contacts are touched.", touched, shares.contacts.size()));
    f.summary = touched_sheet(shares.contacts).table;
  }
  f.sentences.emplace_back("One motion from one start: other starts may lead to other motions.");
  f.sheets.push_back(reach_sheet(all));
  const auto loads = support_loads(motion, static_cast<int>(run.samples_per_revolution));
  if (!loads.empty()) f.sheets.push_back(supports_sheet(loads, motion.begins));
  if (is_heated(shares.contacts)) f.sheets.push_back(friction_sheet(shares.contacts));
  if (result.assembler && motion.basis.rows() > 0) {
    const auto clearances =
        largest_distances(*result.model, *result.assembler, motion.basis, motion.coordinates);
    if (!clearances.empty()) f.sheets.push_back(taken_clearances_sheet(clearances));
  }
  return f;
}

Findings orbit_findings(const ResultView& result) {
  const auto& orbit = result_of<OrbitResult>(result);
  const double largest =
      orbit.multipliers.size() > 0 ? orbit.multipliers.cwiseAbs().maxCoeff() : 0.0;
  Findings f;
  f.headline =
      fmt::format("A periodic orbit, {}: the largest Floquet multiplier has the size {:.6g}.",
                  largest <= 1.0 ? "stable" : "unstable", largest);
  if (!result.file.has(std::string(MotionLoads::group))) return f;
  const auto& loads = result_of<MotionLoads>(result);
  if (!loads.contacts.empty()) f.sheets.push_back(touched_sheet(loads.contacts));
  if (!loads.supports.empty()) f.sheets.push_back(supports_sheet(loads.supports, {}));
  if (is_heated(loads.contacts)) f.sheets.push_back(friction_sheet(loads.contacts));
  return f;
}

}  // namespace whirl::inline io
