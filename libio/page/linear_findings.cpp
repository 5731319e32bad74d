#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/linear/static_study.hpp"
#include "libdyn/linear/unbalance_study.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/critical.hpp"
#include "libio/figures/result_of.hpp"
#include "libio/page/findings.hpp"
#include "libio/text/format.hpp"

namespace whirl::inline io {

namespace {

using figures::result_of;

/// The largest row of a matrix of two columns.
std::pair<double, Eigen::Index> largest_row(const Mat& of) {
  std::pair<double, Eigen::Index> most{0.0, -1};
  for (Eigen::Index i = 0; i < of.rows(); ++i) {
    const double size = of.row(i).norm();
    if (most.second < 0 || size > most.first) most = {size, i};
  }
  return most;
}

std::vector<RunningClearance> clearances_at_rest(const ResultView& result) {
  const auto& rest = result_of<StaticEquilibrium>(result);
  if (!result.assembler || rest.displacement.size() == 0) return {};
  return running_clearances(*result.model, *result.assembler, rest.displacement);
}

/// "3600.0 rpm is 12.3 % below the least continuous speed".
std::string distance_text(double critical, const Model& model) {
  const double low = model.machine.minimum > 0.0 ? model.machine.minimum : model.speed;
  const double high = model.machine.maximum > 0.0 ? model.machine.maximum : model.speed;
  if (!(low > 0.0) || !(high > 0.0) || std::isnan(critical)) return "";
  const bool is_range = low < high;
  if (critical < low) {
    return fmt::format("{} below the {}", percent_text((low - critical) / low),
                       is_range ? "least continuous speed" : "operating speed");
  }
  if (critical > high) {
    return fmt::format("{} above the {}", percent_text((critical - high) / high),
                       is_range ? "largest continuous speed" : "operating speed");
  }
  return is_range ? "between the continuous speeds" : "at the operating speed";
}

std::string speeds_of_machine(const Model& model) {
  if (model.machine.minimum > 0.0 && model.machine.maximum > 0.0) {
    return fmt::format("The machine runs from {} to {}.", speed_text(model.machine.minimum),
                       speed_text(model.machine.maximum));
  }
  return model.speed > 0.0 ? fmt::format("Operating speed: {}.", speed_text(model.speed))
                           : "The model tells no operating speed: no distances to it.";
}

/// The largest speed that a model tells; 0: none.
double highest_speed(const Model& model) {
  return std::max({model.speed, model.machine.maximum, model.machine.trip});
}

/// The lowest speed of a diagram at which a mode grows; infinite: none.
double lowest_unstable(const Campbell& diagram) {
  double lowest = INFINITY;
  for (const Threshold& t : diagram.thresholds) lowest = std::min(lowest, t.speed);
  for (const CampbellBranch& b : diagram.branches) {
    for (std::size_t i = 0; i < diagram.speeds.size(); ++i) {
      if (b.log_decrement[i] < 0.0) lowest = std::min(lowest, diagram.speeds[i]);
    }
  }
  return lowest;
}

Sheet modes_sheet(const Modes& modes) {
  return {"Modes that oscillate",
          sheet_table(modes.oscillatory,
                      in_both_units<Mode>({row_number("mode"),
                                           shown("frequency", "rpm", ".1f"),
                                           shown("frequency", "Hz", ".3f").as(""),
                                           shown("log_decrement", "", ".4f").as("log. decrement"),
                                           shown("damping_ratio", "", ".5f").as("damping ratio"),
                                           shown("whirl"),
                                           {"stands",
                                            [](const Mode& m) {
                                              return m.log_decrement() < 0.0 ? "UNSTABLE"
                                                     : m.is_heavily_damped() ? "heavily damped"
                                                                             : "stable";
                                            }}},
                                          2))};
}

/// Peaks with their margins, as the verb tells them.
std::vector<StationPeak> station_peaks_of(const UnbalanceStudy& study, const ResultView& result) {
  std::vector<StationPeak> peaks = study.peaks;
  for (StationPeak& p : peaks) {
    if (result.model) p.separation = machine_margin(*result.model, p);
  }
  return peaks;
}

Sheet response_peaks_sheet(const UnbalanceStudy& study, const std::vector<StationPeak>& peaks) {
  return {"Peaks of the largest response, separation margins after API 617",
          sheet_table(
              peaks,
              {shown("speed", "rpm", ".1f").as("peak"),
               {"largest at",
                [&](const StationPeak& p) {
                  return study.stations[static_cast<std::size_t>(p.row)].label;
                }},
               shown("amplitude", "um", ".3f").as("amplitude"),
               {"amplification factor",
                [](const StationPeak& p) { return texts::number_text(p.amplification(), ".2f"); }},
               {"margin",
                [](const StationPeak& p) {
                  return p.separation ? percent_text(p.separation->actual) + " " + *p.side() : "-";
                }},
               {"required",
                [](const StationPeak& p) {
                  if (!p.is_kept()) return std::string("-");
                  return p.separation->required == 0.0 ? "none"
                                                       : percent_text(p.separation->required);
                }},
               {"verdict", [](const StationPeak& p) {
                  return !p.is_kept() ? "not known" : *p.is_kept() ? "kept" : "NOT KEPT";
                }}})};
}

/// The largest of a response over its speeds.
struct LargestOf {
  std::string label;
  double amplitude = 0.0, speed = nan;
};

std::vector<LargestOf> largest_of_stations(const UnbalanceStudy& study) {
  std::vector<LargestOf> all;
  for (const StationResponse& s : study.stations) {
    LargestOf most{s.label};
    const auto look = [&](const Vec& major, const std::vector<double>& speeds) {
      for (Eigen::Index i = 0; i < major.size(); ++i) {
        if (!(major(i) > most.amplitude)) continue;
        most.amplitude = major(i);
        most.speed = speeds[static_cast<std::size_t>(i)];
      }
    };
    look(s.major, study.speeds);
    look(s.curve_major, study.curve_speeds);
    all.push_back(most);
  }
  return all;
}

Sheet largest_sheet(const std::vector<LargestOf>& all) {
  return {
      "Largest response of every station, major semi-axis",
      sheet_table(all, {{"station", [](const LargestOf& l) { return l.label; }},
                        {shown_heading("largest", "um"),
                         [](const LargestOf& l) { return shown_number(l.amplitude, "um", ".3f"); }},
                        {shown_heading("at", "rpm"),
                         [](const LargestOf& l) { return rpm_text(l.speed); }}})};
}

/// What the response takes of clearances. A response that goes beyond one is no motion of the
/// rotor, so that its margins alone pass nothing.
void add_clearances(const UnbalanceStudy& study, const ResultView& result, Findings& f) {
  if (!result.assembler) return;
  const auto uses = clearance_uses(*result.model, *result.assembler,
                                   study.curve_speeds.empty() ? study.speeds : study.curve_speeds);
  if (uses.empty()) return;
  f.sheets.push_back({"Clearances beside the response, without static sag",
                      sheet_table(uses, {shown("name").as("clearance of"),
                                         shown("clearance", "mm", ".4f"),
                                         shown("largest", "mm", ".4f").as("largest response"),
                                         shown("largest_at", "rpm", ".1f").as("at"),
                                         {"share", [](const ClearanceUse& use) {
                                            return percent_text(use.largest / use.clearance);
                                          }}})});
  std::string beyond;
  for (const ClearanceUse& use : uses) {
    if (!use.beyond.empty()) beyond += (beyond.empty() ? "" : ", ") + use.name;
  }
  if (beyond.empty()) return;
  if (f.standing == Standing::passed) f.standing = Standing::open;
  f.headline += "; but the response goes beyond the clearance of " + beyond;
}

}  // namespace

std::vector<Sheet> rest_sheets(const ResultView& result) {
  std::vector<Sheet> sheets;
  const auto& rest = result_of<StaticEquilibrium>(result);
  if (!rest.bearings.empty()) {
    sheets.push_back({"Loads at rest, force of the rotor on its supports (y points up)",
                      sheet_table(rest.bearings,
                                  {shown("bearing").as("support"), shown("fx", "N", ".1f").as("x"),
                                   shown("fy", "N", ".1f").as("y")})});
  }
  if (const auto& films = result_of<RunningFilms>(result).films; !films.empty()) {
    sheets.push_back(
        {"Journals on their oil films at rest",
         sheet_table(films, {shown("name").as("oil film"), shown("fx", "N", ".1f").as("load x"),
                             shown("fy", "N", ".1f").as("load y"), shown("eccentricity", "", ".3f"),
                             shown("attitude_deg", "", ".1f").as("attitude [deg]"),
                             shown("film", "um", ".1f").as("least film thickness"),
                             shown("sommerfeld", "", ".3f").as("Sommerfeld number"),
                             shown("power_loss", "W", ".0f").as("power loss")})});
  }
  if (const auto& rolling = result_of<RunningBearings>(result).bearings; !rolling.empty()) {
    sheets.push_back(
        {"Rolling bearings at rest",
         sheet_table(rolling,
                     {shown("name").as("rolling bearing"), shown("fx", "N", ".1f").as("load x"),
                      shown("fy", "N", ".1f").as("load y"), shown("loaded").as("elements pressed"),
                      shown("largest", "N", ".1f").as("largest load of one")})});
  }
  const std::vector<RunningClearance> clearances = clearances_at_rest(result);
  if (!clearances.empty()) {
    sheets.push_back(
        {"Clearances at rest, the closest first",
         sheet_table(clearances, {shown("name").as("clearance of"), shown("clearance", "mm", ".4f"),
                                  shown("distance", "mm", ".4f").as("displaced"),
                                  shown("left", "mm", ".4f")})});
  }
  return sheets;
}

std::vector<Sheet> critical_sheets(const ResultView& result) {
  const auto& found = result_of<CriticalSpeeds>(result).criticals;
  if (found.empty()) return {};
  TableColumns<Critical> columns{row_number("number"),
                                 shown("speed", "rpm", ".1f").as("undamped"),
                                 shown("damped_speed", "rpm", ".1f").as("damped"),
                                 shown("damping_ratio", "", ".5f").as("damping ratio"),
                                 shown("whirl"),
                                 {"distance of the undamped one", [&](const Critical& c) {
                                    const std::string far =
                                        result.model ? distance_text(c.speed, *result.model) : "";
                                    return far.empty() ? std::string("-") : far;
                                  }}};
  if (std::ranges::any_of(found, [](const Critical& c) { return c.shaft != Critical().shaft; })) {
    columns.push_back(shown("shaft").as("by"));
  }
  return {{"Critical speeds", sheet_table(found, columns)}};
}

Findings static_findings(const ResultView& result) {
  const auto& line = result_of<BendingLine>(result);
  Findings f{Standing::told, "Static equilibrium; nothing was asked for that it could fail."};
  if (line.z.size() > 0) {
    const auto [sag, at] = largest_row(line.deflection);
    const auto [moment, where] = largest_row(line.moment);
    f.headline = fmt::format("Largest static deflection of the shaft: {} at z = {}",
                             format_length(sag), format_length(line.z(at)));
    f.sentences.push_back(fmt::format("Largest bending moment: {} at z = {}.",
                                      format_engineering(moment, "N.m"),
                                      format_length(line.z(where))));
  }
  const std::vector<RunningClearance> clearances = clearances_at_rest(result);
  if (!clearances.empty()) {
    const RunningClearance& closest = clearances.front();
    f.sentences.push_back(closest.left() > 0.0
                              ? fmt::format("Closest clearance at rest: {}, {} of {} are left.",
                                            closest.name, format_length(closest.left()),
                                            format_length(closest.clearance))
                              : fmt::format("At rest the rotor is beyond the clearance of {} ({}).",
                                            closest.name, format_length(closest.clearance)));
  }
  f.sheets = rest_sheets(result);
  return f;
}

Findings modes_findings(const ResultView& result) {
  const auto& modes = result_of<ModesAtPoints>(result);
  if (modes.oscillatory.empty()) {
    return {Standing::told, "No table of modes at one speed: see the figures."};
  }
  Findings f;
  const double speed =
      result.file.has_attribute("/", "speed") ? result.file.number_attribute("/", "speed") : 0.0;
  std::string unstable;
  std::size_t least = 0;
  for (std::size_t i = 0; i < modes.oscillatory.size(); ++i) {
    const Mode& m = modes.oscillatory[i];
    if (m.log_decrement() < modes.oscillatory[least].log_decrement()) least = i;
    if (m.log_decrement() < 0.0)
      unstable += fmt::format("{}{}", unstable.empty() ? "" : ", ", i + 1);
  }
  f.standing = unstable.empty() ? Standing::told : Standing::failed;
  f.headline = unstable.empty()
                   ? fmt::format("Stable at {}: none of the {} lowest modes grows",
                                 speed_text(speed), modes.oscillatory.size())
                   : fmt::format("UNSTABLE at {}: mode {} grows", speed_text(speed), unstable);
  const Mode& m = modes.oscillatory[least];
  f.sentences.push_back(fmt::format("Least logarithmic decrement: {:.4f}, of mode {} at {}.",
                                    m.log_decrement(), least + 1, speed_text(m.frequency())));
  f.sentences.emplace_back("Overdamped modes and modes above these are not judged here.");
  f.sheets.push_back(modes_sheet(modes));
  return f;
}

Findings campbell_findings(const ResultView& result) {
  const auto& diagram = result_of<Campbell>(result);
  if (diagram.speeds.empty()) return {Standing::told, "No Campbell diagram in this result."};
  Findings f;
  const std::string range = fmt::format("{} to {}", speed_text(diagram.speeds.front()),
                                        speed_text(diagram.speeds.back()));
  const double unstable = lowest_unstable(diagram);
  const double highest = result.model ? highest_speed(*result.model) : 0.0;
  if (std::isinf(unstable)) {
    f.headline = fmt::format("No mode of the {} that were followed grows from {}",
                             diagram.branches.size(), range);
  } else if (highest > 0.0 && unstable > highest) {
    f.headline = fmt::format("Stable up to the largest operating speed; UNSTABLE from {} on",
                             speed_text(unstable));
  } else {
    f.standing = Standing::failed;
    f.headline = fmt::format("UNSTABLE from {} on, looked at from {}", speed_text(unstable), range);
  }
  for (const Threshold& t : diagram.thresholds) {
    f.sentences.push_back(fmt::format("Threshold of instability: {}, whirling at {}.",
                                      speed_text(t.speed), speed_text(t.frequency)));
  }
  if (result.model) f.sentences.push_back(speeds_of_machine(*result.model));
  f.sheets.push_back({"Critical speeds: branches on the line frequency = speed",
                      sheet_table(diagram.crossings,
                                  {shown("speed", "rpm", ".1f").as("critical speed"),
                                   shown("branch"),
                                   {"distance", [&](const Crossing& c) {
                                      return result.model ? distance_text(c.speed, *result.model)
                                                          : std::string("-");
                                    }}})});
  if (diagram.crossings.empty()) f.sheets.back().notes.emplace_back("None in this range.");
  return f;
}

Findings critical_findings(const ResultView& result) {
  const auto& found = result_of<CriticalSpeeds>(result).criticals;
  if (found.empty()) return {Standing::told, "No table of critical speeds: see the figures."};
  const double lowest = std::ranges::min(found, {}, &Critical::speed).speed;
  Findings f{Standing::told,
             fmt::format("{} critical speeds, the lowest at {}", found.size(), speed_text(lowest))};
  if (result.model) {
    f.sentences.push_back(speeds_of_machine(*result.model));
    const double low = std::max(result.model->machine.minimum, 0.0);
    const double high = std::max(result.model->machine.maximum, 0.0);
    const auto inside = std::count_if(found.begin(), found.end(), [&](const Critical& c) {
      return high > low && low > 0.0 && c.speed >= low && c.speed <= high;
    });
    if (inside > 0) {
      f.standing = Standing::open;
      f.sentences.push_back(fmt::format(
          "{} of them lie between the continuous speeds: whether they matter depends on their "
          "damping and excitation, which the unbalance response tells.",
          inside));
    }
  }
  f.sentences.emplace_back(
      "A required margin follows from amplification factors: see an unbalance response or the "
      "lateral analysis.");
  f.sheets = critical_sheets(result);
  return f;
}

Findings unbalance_findings(const ResultView& result) {
  const auto& study = result_of<UnbalanceStudy>(result);
  if (study.stations.empty()) return {Standing::told, "No response at the speeds of the model."};
  const std::vector<StationPeak> peaks = station_peaks_of(study, result);
  const auto count = [&](const auto& is) { return std::count_if(peaks.begin(), peaks.end(), is); };
  const auto lost = count([](const StationPeak& p) { return p.is_kept() && !*p.is_kept(); });
  const auto unknown = count([](const StationPeak& p) { return !p.is_kept(); });
  Findings f;
  if (peaks.empty()) {
    f.headline = "The response has no peak between these speeds";
  } else if (lost > 0) {
    f.standing = Standing::failed;
    f.headline = fmt::format("Separation margin NOT KEPT at {} of {} peaks", lost, peaks.size());
  } else if (unknown > 0) {
    f.standing = Standing::open;
    f.headline =
        fmt::format("Separation margin not known at {} of {} peaks", unknown, peaks.size());
  } else {
    f.standing = Standing::passed;
    f.headline = fmt::format("Separation margin kept at all {} peaks", peaks.size());
  }
  f.sentences.push_back(fmt::format("Speeds: {} to {}.", speed_text(study.speeds.front()),
                                    speed_text(study.speeds.back())));
  if (result.model) f.sentences.push_back(speeds_of_machine(*result.model));
  const std::vector<LargestOf> all = largest_of_stations(study);
  const auto most = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.amplitude < b.amplitude;
  });
  f.sentences.push_back(fmt::format("Largest response: {} (major semi-axis) at station {}, {}.",
                                    format_length(most->amplitude), most->label,
                                    speed_text(most->speed)));
  if (!peaks.empty()) f.summary = response_peaks_sheet(study, peaks).table;
  add_clearances(study, result, f);
  f.sheets.push_back(largest_sheet(all));
  return f;
}

}  // namespace whirl::inline io
