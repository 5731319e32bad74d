#include "libio/texts/machine_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libio/text/shown_units.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

constexpr double mm_per_s = 1e-3;

/// Where the overall reading of a probe is largest.
Eigen::Index largest_point(const TrendCurve& curve) {
  Eigen::Index at = 0;
  curve.overall.maxCoeff(&at);
  return at;
}

}  // namespace

std::string text_of(const Trend& trend) {
  const Eigen::Index last = std::ssize(trend.number) - 1;
  const auto where = [&](Eigen::Index k) {
    if (trend.records.empty()) return texts::number_text(trend.time(k), ".4g") + " s";
    return trend.records[static_cast<std::size_t>(k)];
  };
  const TableColumns<TrendCurve> columns{
      shown("name").as("probe"),
      {"largest p-p", [](const TrendCurve& c) { return reading_text(c.overall.maxCoeff(), c); }},
      {"at", [&](const TrendCurve& c) { return where(largest_point(c)); }},
      {shown_heading("speed", "rpm"),
       [&](const TrendCurve& c) {
         return texts::number_text(trend.speed(largest_point(c)) / rpm, ".1f");
       }},
      {"first p-p", [](const TrendCurve& c) { return reading_text(c.overall(0), c); }},
      {"last p-p", [=](const TrendCurve& c) { return reading_text(c.overall(last), c); }},
      {"last 1X p-p",
       [=](const TrendCurve& c) { return reading_text(2.0 * std::abs(c.first(last)), c); }},
      {"phase [deg]",
       [=](const TrendCurve& c) {
         return texts::number_text(std::arg(c.first(last)) / degree, "+.1f");
       }},
      {"gap moved by",
       [=](const TrendCurve& c) { return reading_text(c.gap(last) - c.gap(0), c); }}};
  std::string text = fmt::format(
      "Trend of {} {}{}\n\n{}", trend.number.size(), trend.records.empty() ? "point" : "record",
      trend.number.size() == 1 ? "" : "s", table_of(trend.probes, columns));
  for (const auto& [name, limit] : {std::pair{"alarm", trend.alarm}, {"trip", trend.trip}}) {
    if (!limit) continue;
    for (const TrendCurve& c : trend.probes) {
      const double most = c.overall.maxCoeff();
      if (most <= *limit) continue;
      text += fmt::format("\n  {}: {} reads {} peak to peak, over {}\n", name, c.name,
                          reading_text(most, c), reading_text(*limit, c));
    }
  }
  return text;
}

std::string text_of(const ZoneReport& zones) {
  const bool is_of_shaft = zones.si_unit == "m";
  const auto told = [=](double value, const ZoneVerdict& of) {
    return is_of_shaft ? reading_text(value, of) : fmt::format("{:.3g} mm/s", value / mm_per_s);
  };
  const TableColumns<ZoneVerdict> columns{
      shown("name").as("probe"),
      {shown_heading("at", "rpm"),
       [](const ZoneVerdict& z) { return shown_number(z.speed, "rpm", ".1f"); }},
      {is_of_shaft ? "overall p-p" : "velocity r.m.s.",
       [=](const ZoneVerdict& z) { return told(z.value, z); }},
      {"A/B", [=](const ZoneVerdict& z) { return told(z.limits.ab, z); }},
      {"B/C", [=](const ZoneVerdict& z) { return told(z.limits.bc, z); }},
      {"C/D", [=](const ZoneVerdict& z) { return told(z.limits.cd, z); }},
      {"zone", [](const ZoneVerdict& z) { return z.zone; }}};
  return fmt::format("Zones of ISO 20816-3, {}: {}\n\n{}", zones.of, zones.zone,
                     table_of(zones.probes, columns));
}

std::vector<std::string> notes_of(const ZoneReport& zones) {
  std::vector<std::string> notes{
      "boundaries of zones are those of ISO 7919-3 and ISO 10816-3, which ISO 20816-3 took over: "
      "check those of the contract"};
  if (zones.si_unit == "m") {
    constexpr double slow = 1000.0 * rpm;
    for (const ZoneVerdict& z : zones.probes) {
      if (z.speed >= slow) continue;
      notes.push_back(fmt::format("zones of shafts are for {} and more, the record has {}",
                                  shown_value(1000.0 * rpm, "rpm", ".0f"),
                                  shown_value(z.speed, "rpm", ".1f")));
      break;
    }
  }
  return notes;
}

std::string shapes_text(const OrderTracking& tracking) {
  if (tracking.shapes.empty()) return "";
  const TableColumns<OrderShape> columns{
      {shown_heading("peak", "rpm"),
       [](const OrderShape& s) { return shown_number(s.speed, "rpm", ".1f"); }},
      {"mode",
       [](const OrderShape& s) {
         return s.mode == 0 ? std::string("-") : fmt::format("{} {}", s.mode, s.whirl);
       }},
      {shown_heading("its frequency", "rpm"),
       [](const OrderShape& s) {
         return s.mode == 0 ? std::string("-") : shown_number(s.frequency, "rpm", ".1f");
       }},
      {"MAC", [](const OrderShape& s) { return fmt::format("{:.3f}", s.mac); }},
      {"next MAC", [](const OrderShape& s) { return fmt::format("{:.3f}", s.second); }}};
  return "\n1X shapes of all probes at the peaks beside modes of the model at that speed\n\n" +
         table_of(tracking.shapes, columns);
}

std::string model_curve_text(const OrderTracking& tracking) {
  if (!tracking.model_factor) return "";
  return fmt::format(
      "\n  model: its unbalances times {:.4g}, turned by {:+.1f} deg, beside the readings of 1X\n",
      *tracking.model_factor, tracking.model_turn.value_or(0.0) / degree);
}

}  // namespace whirl::inline io
