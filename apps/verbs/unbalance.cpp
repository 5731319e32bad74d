#include "libfe/unbalance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/invocation.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "libdyn/system/clearance.hpp"
#include "libfe/response_curve.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

/// What the verb computes.
struct Study {
  std::vector<NamedPoint> stations;
  ResponseCurve curve;
  UnbalanceResponse rows;  ///< at the speeds that were asked for, else the curve
  bool are_rows_asked = false;
  Mat major, minor;  ///< of the rows: stations x speeds [m]
};

/// What is asked of every orbit, stations x speeds [m].
template <class Ask>
Mat of_orbits(const UnbalanceResponse& response, const Ask& ask) {
  return response.x.binaryExpr(response.y, [&](Complex x, Complex y) { return ask(Orbit(x, y)); });
}

Study study_of(const Invocation& call, const Model& model, const Assembler& assembler) {
  Study study{.stations = select_points(model, assembler, call.text("stations"))};
  std::vector<Point> points;
  for (const NamedPoint& p : study.stations) points.push_back(p.point);
  const std::vector<double> speeds = call.speeds(model);
  study.are_rows_asked = call.has("speeds");
  if (study.are_rows_asked) study.rows = unbalance_response(assembler, speeds, points);
  study.curve = response_curve(assembler, speeds, points);
  if (!study.are_rows_asked) study.rows = study.curve.response;
  study.major = of_orbits(study.rows, [](const Orbit& o) { return o.major(); });
  study.minor = of_orbits(study.rows, [](const Orbit& o) { return o.forward - o.backward; });
  return study;
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : std::string("-");
}

/// Peaks of the response: their records, and a table for people.
std::string add_peaks(const Model& model, const Study& study, Record& record) {
  const bool has_speed = model.has_speed && model.speed > 0.0;
  Record list = Record::array();
  Table table({"peak [rpm]", "largest at", "[um]", "amplification",
               has_speed ? fmt::format("margin to {:.6g} rpm", model.speed / rpm) : "margin",
               "required"});
  bool is_told = true;
  for (const ResponsePeak& peak : study.curve.peaks) {
    const NamedPoint& station = study.stations[static_cast<std::size_t>(peak.row)];
    const double factor = peak.amplification();
    is_told = is_told && std::isfinite(factor);
    Record r;
    r.set("speed_rpm", peak.speed / rpm);
    r.set("node", station.node() > 0 ? Record(station.node()) : Record(nullptr));
    r.set("name", station.name).set("amplitude_m", peak.amplitude).set("amplification", factor);
    r.set("half_power_rpm", std::vector<double>{peak.below / rpm, peak.above / rpm});
    std::vector<std::string> cells{fmt::format("{:.1f}", peak.speed / rpm), point_label(station),
                                   fmt::format("{:.3f}", 1e6 * peak.amplitude),
                                   std::isfinite(factor) ? fmt::format("{:.4g}", factor) : "-"};
    if (has_speed) {
      const SeparationMargin m = separation_margin(peak, model.speed);
      const bool is_known = std::isfinite(m.required);
      r.set("margin", m.actual).set("side", m.is_below ? "below" : "above");
      r.set("required_margin", m.required);
      r.set("is_kept", is_known ? Record(m.is_kept()) : Record(nullptr));
      cells.push_back(fmt::format("{} {}", percent(m.actual), m.is_below ? "below" : "above"));
      cells.push_back(!is_known           ? "-"
                      : m.required == 0.0 ? "none"
                                          : fmt::format("{}, {}", percent(m.required),
                                                        m.is_kept() ? "kept" : "NOT KEPT"));
    } else {
      r.set("margin", nullptr).set("side", nullptr).set("required_margin", nullptr);
      r.set("is_kept", nullptr);
      cells.insert(cells.end(), {"-", "-"});
    }
    list.add(r);
    table.row(std::move(cells));
  }
  record.set("peaks", list);
  if (study.curve.peaks.empty()) return "";
  return "\nPeaks of the largest response: amplification factors and separation margins after API "
         "617\n\n" +
         table.text() +
         (is_told
              ? ""
              : "\n  -: the response does not fall to 0.707 of this peak between these speeds\n");
}

/// Responses of the stations: their records, and a table for people.
std::string add_stations(const Study& study, Record& record) {
  std::vector<double> in_rpm = study.rows.speeds;
  for (double& v : in_rpm) v /= rpm;
  record.set("speeds_rpm", in_rpm);
  Record entries = Record::array();
  Table table({"station", "largest [um]", "at [rpm]", "at the highest speed [um]"});
  const std::vector<LargestResponse> largest = largest_responses(study.curve.response);
  for (std::size_t i = 0; i < study.stations.size(); ++i) {
    const auto p = static_cast<Eigen::Index>(i);
    Record x = Record::array(), y = Record::array(), r;
    for (Eigen::Index s = 0; s < study.rows.x.cols(); ++s) {
      x.add(study.rows.x(p, s));
      y.add(study.rows.y(p, s));
    }
    const NamedPoint& station = study.stations[i];
    r.set("node", station.node() > 0 ? Record(station.node()) : Record(nullptr))
        .set("name", station.name);
    r.set("major_m", Vec(study.major.row(p).transpose()));
    r.set("minor_m", Vec(study.minor.row(p).transpose()));
    entries.add(r.set("x_m", x).set("y_m", y));
    table.row({point_label(station), fmt::format("{:.3f}", 1e6 * largest[i].amplitude),
               fmt::format("{:.1f}", largest[i].speed / rpm),
               fmt::format("{:.3f}", 1e6 * study.major(p, study.major.cols() - 1))});
  }
  record.set("stations", entries);
  const std::string range = in_rpm.size() == 1
                                ? fmt::format("at {:.6g} rpm", in_rpm[0])
                                : fmt::format("{} speeds from {:.6g} to {:.6g} rpm", in_rpm.size(),
                                              in_rpm.front(), in_rpm.back());
  return fmt::format("Unbalance response, {} (major semi-axes)\n\n{}", range, table.text());
}

/// Clearances that the response takes: their records, and a note for each that it goes beyond.
void add_clearances(const Model& model, const Assembler& assembler, const Study& study,
                    Report& report) {
  Record list = Record::array();
  for (const ClearanceUse& use : clearance_uses(model, assembler, study.curve.response.speeds)) {
    Record r, beyond = Record::array();
    std::string ranges;
    for (const SpeedRange& range : use.beyond) {
      beyond.add(std::vector<double>{range.first / rpm, range.last / rpm});
      ranges += fmt::format("{}{:.1f} to {:.1f}", ranges.empty() ? "" : ", ", range.first / rpm,
                            range.last / rpm);
    }
    r.set("name", use.name).set("clearance_m", use.clearance).set("largest_m", use.largest);
    list.add(r.set("largest_at_rpm", use.at / rpm).set("beyond_rpm", beyond));
    if (use.beyond.empty()) continue;
    report.notes.push_back(fmt::format(
        "the response goes beyond the clearance of {} ({:.4g} mm) at {} rpm, up to {:.4g} mm, "
        "{:.3g} times the clearance, at {:.1f} rpm: there it touches, and this response is not its "
        "motion",
        use.name, 1e3 * use.clearance, ranges, 1e3 * use.largest, use.largest / use.clearance,
        use.at / rpm));
  }
  report.record.set("clearances", list);
}

/// What keeps the response from being the whole truth.
void add_notes(const Model& model, const Study& study, Report& report) {
  Record unbounded = Record::array();
  for (const double Omega : study.curve.unbounded) {
    unbounded.add(Omega / rpm);
    report.notes.push_back(fmt::format(
        "the response is unbounded at {:.2f} rpm, a resonance without damping", Omega / rpm));
  }
  report.record.set("unbounded_rpm", unbounded);
  if (!study.curve.failure.empty()) {
    report.notes.push_back(
        fmt::format("the modes of this rotor were not found ({}): narrow peaks may be missing",
                    study.curve.failure));
  }
  note_left_out(model, report);
  note_tables(model, study.rows.speeds.front(), study.rows.speeds.back(), report);
}

void write_curve(ResultWriter& file, const ResponseCurve& curve) {
  const UnbalanceResponse& r = curve.response;
  const Mat major = of_orbits(r, [](const Orbit& o) { return o.major(); });
  file.dataset("/unbalance/curve_speed", r.speeds,
               {"rad/s", "rotor speed, as many as the curves need", {""}});
  const std::vector<std::string> axes{"/unbalance/station", "/unbalance/curve_speed"};
  file.dataset("/unbalance/curve_x", r.x, {"m", "complex amplitude of x", axes});
  file.dataset("/unbalance/curve_y", r.y, {"m", "complex amplitude of y", axes});
  file.dataset("/unbalance/curve_major", major, {"m", "major semi-axis of the orbit", axes});
}

void write_peaks(ResultWriter& file, const std::vector<ResponsePeak>& peaks) {
  if (peaks.empty()) return;
  std::vector<double> speed, amplitude, below, above;
  std::vector<int> station;
  for (const ResponsePeak& peak : peaks) {
    speed.push_back(peak.speed);
    station.push_back(static_cast<int>(peak.row) + 1);
    amplitude.push_back(peak.amplitude);
    below.push_back(peak.below);
    above.push_back(peak.above);
  }
  const std::vector<std::string> axes{"/unbalance/peak_speed"};
  file.dataset("/unbalance/peak_speed", speed, {"rad/s", "speed of a peak", {""}});
  file.dataset("/unbalance/peak_station", station, {"", "number of the station, from 1", axes});
  file.dataset("/unbalance/peak_amplitude", amplitude, {"m", "major semi-axis there", axes});
  file.dataset("/unbalance/peak_below", below, {"rad/s", "0.707 of the peak, below it", axes});
  file.dataset("/unbalance/peak_above", above, {"rad/s", "0.707 of the peak, above it", axes});
}

void write(ResultWriter& file, const Study& study) {
  std::vector<std::string> names;
  for (const NamedPoint& p : study.stations) names.push_back(point_label(p));
  file.dataset("/unbalance/speed", study.rows.speeds, {"rad/s", "rotor speed", {""}});
  file.dataset("/unbalance/station", names, {"", "station", {""}});
  const std::vector<std::string> axes{"/unbalance/station", "/unbalance/speed"};
  file.dataset("/unbalance/x", study.rows.x, {"m", "complex amplitude of x", axes});
  file.dataset("/unbalance/y", study.rows.y, {"m", "complex amplitude of y", axes});
  file.dataset("/unbalance/major", study.major, {"m", "major semi-axis of the orbit", axes});
  file.dataset("/unbalance/minor", study.minor, {"m", "minor semi-axis, > 0 forward", axes});
  if (study.are_rows_asked) write_curve(file, study.curve);
  write_peaks(file, study.curve.peaks);
}

Report run_unbalance(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const Study study = study_of(call, model, assembler);
  Report report{.record = begin_record(call, model)};
  report.text = add_stations(study, report.record);
  report.text += add_peaks(model, study, report.record);
  if (model.structure.unbalances.empty()) report.text += "\n  The model has no unbalance.\n";
  add_clearances(model, assembler, study, report);
  add_notes(model, study, report);
  if (const auto file = call.result_file(model)) {
    write_points(*file, model, assembler);
    write(*file, study);
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

}  // namespace whirl
