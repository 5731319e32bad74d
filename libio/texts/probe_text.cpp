#include "libio/texts/probe_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/text/units.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

/// A peak, with its probe.
struct PeakLine {
  const ProbeResponse* probe;
  const ProbePeak* peak;
};

std::string amplification_text(const PeakLine& line) {
  const double factor = line.peak->amplification();
  return std::isfinite(factor) ? fmt::format("{:.4g}", factor) : "-";
}

}  // namespace

std::string angle_text(const ProbeLabel& probe) {
  return fmt::format("{:g}{}", probe.angle_deg(), probe.is_axial() ? " along z" : "");
}

std::string reading_text(double reading, const ProbeLabel& probe) {
  if (probe.unit == Probe{}.unit) return shown_value(reading, probe.unit, ".4g");
  return fmt::format("{:.4g} {}", reading / *parse_as("1 " + probe.unit, "m"), probe.unit);
}

std::string text_of(const std::vector<ProbeResponse>& probes) {
  if (probes.empty()) return "";
  const std::string largest = table_of(
      probes, {shown("name").as("probe"),
               {"angle [deg]", angle_text},
               {"largest",
                [](const ProbeResponse& p) { return reading_text(p.largest.peak_to_peak(), p); }},
               {shown_heading("at", "rpm"),
                [](const ProbeResponse& p) { return shown_number(p.largest.speed, "rpm", ".1f"); }},
               {"at the highest speed", [](const ProbeResponse& p) {
                  const Vec size = p.peak_to_peak();
                  return reading_text(size(size.size() - 1), p);
                }}});
  std::vector<PeakLine> lines;
  for (const ProbeResponse& probe : probes) {
    for (const ProbePeak& peak : probe.peaks) lines.push_back({&probe, &peak});
  }
  const std::string text = "\nAlong the probes, peak to peak\n\n" + largest;
  if (lines.empty()) return text;
  return text + "\nPeaks along the probes\n\n" +
         table_of(
             lines,
             {{"probe", [](const PeakLine& l) { return l.probe->name; }},
              {shown_heading("peak", "rpm"),
               [](const PeakLine& l) { return shown_number(l.peak->speed, "rpm", ".1f"); }},
              {"peak to peak",
               [](const PeakLine& l) { return reading_text(l.peak->peak_to_peak(), *l.probe); }},
              {"amplification", amplification_text}});
}

std::string text_of(const std::vector<ForcedReading>& readings, const std::vector<double>& speeds) {
  if (readings.empty()) return "";
  const auto top = [](const ForcedReading& f) {  // NaN compares as smaller
    const Vec size = f.peak_to_peak();
    Eigen::Index at = 0;
    for (Eigen::Index i = 1; i < size.size(); ++i) {
      if (size(i) > size(at) || !std::isfinite(size(at))) at = i;
    }
    return at;
  };
  const auto text_at = [](const ForcedReading& f, Eigen::Index i) {
    const double reading = f.peak_to_peak()(i);
    return std::isfinite(reading) ? reading_text(reading, f) : "-";
  };
  return "\nThe same along the probes, peak to peak\n\n" +
         table_of(readings,
                  {{"force", [](const ForcedReading& f) { return force_text(f); }},
                   shown("name").as("probe"),
                   {"largest", [=](const ForcedReading& f) { return text_at(f, top(f)); }},
                   {shown_heading("at", "rpm"),
                    [=, &speeds](const ForcedReading& f) {
                      return shown_number(speeds[static_cast<std::size_t>(top(f))], "rpm", ".1f");
                    }},
                   {"at the highest speed",
                    [=](const ForcedReading& f) { return text_at(f, f.amplitude.size() - 1); }}});
}

std::string text_of(const std::vector<RestingProbe>& probes) {
  if (probes.empty()) return "";
  return "\n" + table_of(probes, {shown("name").as("probe"),
                                  {"angle [deg]", angle_text},
                                  {"reads",
                                   [](const RestingProbe& p) { return reading_text(p.mean, p); }}});
}

std::string text_of(const std::vector<ProbeSummary>& probes) {
  if (probes.empty()) return "";
  return "\n" + table_of(probes,
                         {shown("name").as("probe"),
                          {"angle [deg]", angle_text},
                          {"mean", [](const ProbeSummary& p) { return reading_text(p.mean, p); }},
                          {"peak to peak",
                           [](const ProbeSummary& p) { return reading_text(p.peak_to_peak, p); }}});
}

std::string text_of(const std::vector<OrbitProbe>& probes) {
  if (probes.empty()) return "";
  return "\n" + table_of(probes, {shown("name").as("probe"),
                                  {"angle [deg]", angle_text},
                                  {"peak to peak", [](const OrbitProbe& p) {
                                     return reading_text(p.peak_to_peak, p);
                                   }}});
}

}  // namespace whirl::inline io
