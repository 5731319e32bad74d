#include "libio/texts/unbalance_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libdyn/system/model.hpp"
#include "libfe/assembly/excitations.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : std::string("-");
}

/// A peak's margin to the operating speeds.
std::string margin_text(const StationPeak& peak) {
  if (!peak.separation) return "-";
  if (peak.separation->actual == 0.0) return "none, within";
  return fmt::format("{} {}", percent(peak.separation->actual), *peak.side());
}

/// The margin that is required.
std::string required_text(const StationPeak& peak) {
  if (!peak.separation || !peak.is_kept()) return "-";
  const SeparationMargin& m = *peak.separation;
  if (m.required == 0.0) return "none";
  return fmt::format("{}, {}", percent(m.required), m.is_kept() ? "kept" : "NOT KEPT");
}

std::string peaks_text(const UnbalanceStudy& study, const Model& model) {
  if (study.peaks.empty()) return "";
  const auto factor = [](const StationPeak& p) {
    const double value = p.amplification();
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
  };
  const auto place = [&](const StationPeak& p) {
    return study.stations[static_cast<std::size_t>(p.row)].label;
  };
  const bool is_told = std::all_of(study.peaks.begin(), study.peaks.end(),
                                   [](const auto& p) { return std::isfinite(p.amplification()); });
  const MachineSpeeds& machine = model.machine;
  const std::string margin =
      machine.minimum > 0.0 && machine.maximum > 0.0
          ? fmt::format("margin to {} to {}", shown_number(machine.minimum, "rpm", ".6g"),
                        shown_value(machine.maximum, "rpm", ".6g"))
      : model.has_speed && model.speed > 0.0
          ? fmt::format("margin to {}", shown_value(model.speed, "rpm", ".6g"))
          : "margin";
  return "\nPeaks of the largest response: amplification factors and separation margins after API "
         "617\n\n" +
         table_of(study.peaks, {shown("speed", "rpm", ".1f").as("peak"),
                                {"largest at", place},
                                shown("amplitude", "um", ".3f").as("amplitude"),
                                {"amplification", factor},
                                {margin, margin_text},
                                {"required", required_text}}) +
         (is_told
              ? ""
              : "\n  -: the response does not fall to 0.707 of this peak between these speeds\n");
}

std::string range_text(const std::vector<double>& speeds) {
  if (speeds.size() == 1) return fmt::format("at {}", shown_value(speeds[0], "rpm", ".6g"));
  return fmt::format("{} speeds from {} to {}", speeds.size(),
                     shown_number(speeds.front(), "rpm", ".6g"),
                     shown_value(speeds.back(), "rpm", ".6g"));
}

/// Largest responses to forces of other frequencies; a dash where they are not bounded.
std::string forced_text(const UnbalanceStudy& study) {
  if (study.forced.empty()) return "";
  const auto largest = [](const ForcedResponse& f, Eigen::Index* at) {
    double most = 0.0;
    for (Eigen::Index i = 0; i < f.major.size(); ++i) {
      if (!(f.major(i) > most)) continue;
      most = f.major(i);
      if (at) *at = i;
    }
    return most;
  };
  const auto speed = [&](const ForcedResponse& f) {
    Eigen::Index at = 0;
    largest(f, &at);
    return shown_number(study.speeds[static_cast<std::size_t>(at)], "rpm", ".1f");
  };
  return "\nResponse to forces of other frequencies, at these speeds (major semi-axes)\n\n" +
         table_of(study.forced, {{"force", [](const ForcedResponse& f) { return force_text(f); }},
                                 shown("station"),
                                 {shown_heading("largest", "um"),
                                  [&](const ForcedResponse& f) {
                                    return shown_number(largest(f, nullptr), "um", ".3f");
                                  }},
                                 {shown_heading("at", "rpm"), speed},
                                 {shown_heading("at the highest speed", "um"),
                                  [](const ForcedResponse& f) {
                                    return shown_number(f.major(f.major.size() - 1), "um", ".3f");
                                  }}}) +
         text_of(study.forced_probes, study.speeds);
}

/// Forces on bearings, seals, links and oil films.
std::string bearings_text(const UnbalanceStudy& study) {
  if (study.bearings.empty()) return "";
  return "\nForces of the rotor on its supports (largest in a period, without the weight)\n\n" +
         table_of(study.bearings,
                  {shown("name").as("support"),
                   shown("kind").as(""),
                   shown("largest", "N", ".4g"),
                   shown("largest_at", "rpm", ".1f").as("at"),
                   {shown_heading("at the highest speed", "N"), [](const BearingResponse& b) {
                      return shown_number(b.force()(b.x.size() - 1), "N", ".4g");
                    }}});
}

/// A clearance that the response goes beyond.
std::string beyond_text(const ClearanceUse& use) {
  std::string ranges;
  for (const SpeedRange& range : use.beyond) {
    ranges +=
        fmt::format("{}{} to {}", ranges.empty() ? "" : ", ",
                    shown_number(range.first, "rpm", ".1f"), shown_value(range.last, "rpm", ".1f"));
  }
  return fmt::format(
      "the response goes beyond the clearance of {} ({}) at {}, up to {}, {:.3g} times the "
      "clearance, at {}: there it touches, and this response is not its motion",
      use.name, shown_value(use.clearance, "mm", ".4g"), ranges,
      shown_value(use.largest, "mm", ".4g"), use.largest / use.clearance,
      shown_value(use.at, "rpm", ".1f"));
}

}  // namespace

std::string text_of(const UnbalanceStudy& study, const Model& model) {
  const auto largest = [&](int number) -> const auto& {
    return study.largest[static_cast<std::size_t>(number) - 1];
  };
  const std::string stations = table_of(
      study.stations, {shown("station"),
                       {shown_heading("largest", "um"),
                        [&](const StationResponse&, int i) {
                          return shown_number(largest(i).amplitude, "um", ".3f");
                        }},
                       {shown_heading("at", "rpm"),
                        [&](const StationResponse&, int i) {
                          return shown_number(largest(i).speed, "rpm", ".1f");
                        }},
                       {shown_heading("at the highest speed", "um"), [](const StationResponse& s) {
                          return shown_number(s.major(s.major.size() - 1), "um", ".3f");
                        }}});
  return fmt::format(
      "Unbalance response, {} (major semi-axes, zero to peak)\n\n{}{}{}{}{}{}",
      range_text(study.speeds), stations, peaks_text(study, model), text_of(study.probes),
      bearings_text(study),
      has_synchronous_load(model.structure) ? "" : "\n  The model has no unbalance.\n",
      forced_text(study));
}

std::vector<std::string> notes_of(const UnbalanceStudy& study) {
  std::vector<std::string> notes;
  for (const ClearanceUse& use : study.clearances) {
    if (!use.beyond.empty()) notes.push_back(beyond_text(use));
  }
  for (const double Omega : study.unbounded) {
    notes.push_back(fmt::format("the response is unbounded at {}, a resonance without damping",
                                shown_value(Omega, "rpm", ".2f")));
  }
  if (!study.forced.empty() && !study.clearances.empty()) {
    notes.push_back(
        "clearances are compared with the response at the frequency of the speed alone, without "
        "that to forces of other frequencies");
  }
  if (study.failure) {
    notes.push_back(
        fmt::format("the modes of this rotor were not found ({}): narrow peaks may be missing",
                    study.failure.text()));
  }
  return notes;
}

}  // namespace whirl::inline io
