#include "libfe/unbalance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/verbs/all.hpp"
#include "apps/verbs/common.hpp"
#include "libfe/amplification.hpp"
#include "libio/hdf5.hpp"
#include "libio/table.hpp"

namespace whirl {

namespace {

/// Peaks of the response: their records, and a table for people.
std::string add_peaks(const Model& model, const std::vector<NamedPoint>& stations,
                      const std::vector<double>& speeds, const Mat& major, Record& record) {
  const bool has_speed = model.has_speed && model.speed > 0.0;
  Record list = Record::array();
  Table table({"peak [rpm]", "largest at", "[um]", "amplification",
               has_speed ? fmt::format("margin to {:.6g} rpm", model.speed / rpm) : "margin",
               "required"});
  const auto percent = [](double share) {
    return std::isfinite(share) ? fmt::format("{:.1f} %", 100.0 * share) : std::string("-");
  };
  const auto peaks = response_peaks(speeds, major);
  const char* hint =
      "\n  -: the speeds are too far apart for this peak, or end beside it: --speeds "
      "FIRST:LAST:STEP\n";
  bool is_told = true;
  for (const ResponsePeak& peak : peaks) {
    const NamedPoint& station = stations[static_cast<std::size_t>(peak.row)];
    const double factor = peak.amplification();
    is_told = is_told && std::isfinite(factor);
    Record r;
    r.set("speed_rpm", peak.speed / rpm);
    r.set("node", station.node() > 0 ? Record(station.node()) : Record(nullptr));
    r.set("name", station.name).set("amplitude_m", peak.amplitude).set("amplification", factor);
    std::vector<std::string> cells{fmt::format("{:.1f}", peak.speed / rpm), point_label(station),
                                   fmt::format("{:.3f}", 1e6 * peak.amplitude),
                                   std::isfinite(factor) ? fmt::format("{:.3g}", factor) : "-"};
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
  if (peaks.empty()) return "";
  return "\nPeaks of the largest response: amplification factors and separation margins after API "
         "617\n\n" +
         table.text() + (is_told ? "" : hint);
}

}  // namespace

Report run_unbalance(const Invocation& call) {
  const Model model = call.model();
  const Assembler assembler(model.structure);
  const std::vector<double> speeds = call.speeds(model);
  const std::string list = call.text("stations", "all");
  const std::vector<NamedPoint> stations = select_points(model, assembler, list);
  std::vector<Point> points;
  for (const NamedPoint& p : stations) points.push_back(p.point);
  const UnbalanceResponse response = unbalance_response(assembler, speeds, points);

  Report report{.record = begin_record(call, model)};
  std::vector<double> in_rpm = speeds;
  for (double& v : in_rpm) v /= rpm;
  report.record.set("speeds_rpm", in_rpm);
  Record entries = Record::array();
  Table table({"station", "largest [um]", "at [rpm]", "at the highest speed [um]"});
  const auto ns = static_cast<Eigen::Index>(speeds.size());
  Mat major(response.x.rows(), ns), minor(response.x.rows(), ns);
  for (Eigen::Index p = 0; p < response.x.rows(); ++p) {
    Record x = Record::array(), y = Record::array();
    for (Eigen::Index s = 0; s < ns; ++s) {
      const Orbit orbit(response.x(p, s), response.y(p, s));
      major(p, s) = orbit.major();
      minor(p, s) = orbit.forward - orbit.backward;
      x.add(response.x(p, s));
      y.add(response.y(p, s));
    }
    const NamedPoint& station = stations[static_cast<std::size_t>(p)];
    Record r;
    r.set("node", station.node() > 0 ? Record(station.node()) : Record(nullptr))
        .set("name", station.name);
    r.set("major_m", Vec(major.row(p).transpose())).set("minor_m", Vec(minor.row(p).transpose()));
    r.set("x_m", x).set("y_m", y);
    entries.add(r);
    Eigen::Index top = 0;
    const double largest = major.row(p).maxCoeff(&top);
    table.row({point_label(station), fmt::format("{:.3f}", 1e6 * largest),
               fmt::format("{:.1f}", in_rpm[static_cast<std::size_t>(top)]),
               fmt::format("{:.3f}", 1e6 * major(p, ns - 1))});
  }
  report.record.set("stations", entries);
  const std::string peaks = add_peaks(model, stations, speeds, major, report.record);
  const std::string range = speeds.size() == 1
                                ? fmt::format("at {:.6g} rpm", in_rpm[0])
                                : fmt::format("{} speeds from {:.6g} to {:.6g} rpm", speeds.size(),
                                              in_rpm.front(), in_rpm.back());
  report.text =
      fmt::format("Unbalance response, {} (major semi-axes)\n\n{}", range, table.text()) + peaks;
  if (model.structure.unbalances.empty()) report.text += "\n  The model has no unbalance.\n";
  if (const auto file = call.result_file(model)) {
    std::vector<std::string> names;
    for (const NamedPoint& p : stations) names.push_back(point_label(p));
    write_points(*file, model, assembler);
    file->dataset("/unbalance/speed", speeds, {"rad/s", "rotor speed", {""}});
    file->dataset("/unbalance/station", names, {"", "station", {""}});
    const std::vector<std::string> axes{"/unbalance/station", "/unbalance/speed"};
    file->dataset("/unbalance/x", response.x, {"m", "complex amplitude of x", axes});
    file->dataset("/unbalance/y", response.y, {"m", "complex amplitude of y", axes});
    file->dataset("/unbalance/major", major, {"m", "major semi-axis of the orbit", axes});
    file->dataset("/unbalance/minor", minor, {"m", "minor semi-axis, > 0 forward", axes});
    commit(call, file.get(), report);
  }
  return report;
}

}  // namespace whirl
