#include "libio/texts/sweep_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/names.hpp"
#include "libio/text/format.hpp"
#include "libio/texts/probe_text.hpp"
#include "libio/texts/row_table.hpp"

namespace whirl::inline io {

namespace {

bool is_same_motion(const std::optional<SweepPoint>& a, const std::optional<SweepPoint>& b) {
  if (!a || !b) return !a && !b;
  return a->motion.kind == b->motion.kind && a->motion.period == b->motion.period;
}

/// Values with the same motion.
struct Stretch {
  std::size_t from = 0, to = 0;              ///< as SweepWay counts them
  std::optional<ClassifiedMotion> motion{};  ///< the first one; none: not computed, or failed
  std::string kind = "not computed";
  double least_impacts = 0.0, most_impacts = 0.0;  ///< per revolution
  double largest_exponent = 0.0;                   ///< per revolution
};

Stretch stretch_from(const SweepWay& way, std::size_t from) {
  Stretch s{.from = from, .to = from};
  const std::optional<SweepPoint> begin = way.point(from);
  while (s.to + 1 < way.size() && is_same_motion(begin, way.point(s.to + 1))) ++s.to;
  if (!begin) return s;
  const ClassifiedMotion& first = begin->motion;
  s.kind = first.has_failed() ? "failed" : name_of(*first.kind);
  if (first.has_failed()) return s;
  s.motion = first;
  s.least_impacts = s.most_impacts = first.impacts_per_rev();
  s.largest_exponent = first.largest_exponent();
  for (std::size_t i = from; i <= s.to; ++i) {
    const ClassifiedMotion motion = way.point(i).value().motion;
    s.least_impacts = std::min(s.least_impacts, motion.impacts_per_rev());
    s.most_impacts = std::max(s.most_impacts, motion.impacts_per_rev());
    s.largest_exponent = std::max(s.largest_exponent, motion.largest_exponent());
  }
  return s;
}

std::string period_text(const Stretch& s) {
  return s.motion && s.motion->period > 0 ? std::to_string(s.motion->period) : "-";
}

std::string impacts_text(const Stretch& s) {
  constexpr double same = 1e-9;  // impacts a revolution
  if (!s.motion) return "-";
  if (s.most_impacts - s.least_impacts < same) return fmt::format("{:.4g}", s.least_impacts);
  return fmt::format("{:.3g} to {:.3g}", s.least_impacts, s.most_impacts);
}

std::string exponent_text(const Stretch& s) {
  return s.motion ? fmt::format("{:+.4f}", s.largest_exponent) : "-";
}

/// Where contacts begin and end to touch, a line each: "contact ring touches from 131.5 rad/s (not
/// yet at 131) to 139, all the time".
std::string touch_text(const SweepWay& way, const ParameterAxis& axis) {
  constexpr std::size_t most = 12;
  const std::vector<TouchRange> ranges = touch_ranges(way);
  const auto value = [&](std::size_t k) { return fmt::format("{:.7g}", axis.shown(way.index(k))); };
  std::string text;
  for (std::size_t i = 0; i < std::min(most, ranges.size()); ++i) {
    const TouchRange& r = ranges[i];
    const std::string contact = named("contact", way.sweep.system.contacts[r.contact]);
    const bool is_one = r.from == r.to;
    text += fmt::format("  {} touches {} {}", contact, is_one ? "at" : "from", value(r.from));
    if (r.begins) text += fmt::format(" (not at {})", value(r.from - 1));
    if (!is_one) text += " to " + value(r.to);
    if (r.ends) text += fmt::format(" (no more at {})", value(r.to + 1));
    text += r.is_permanent ? ", all the time\n" : "\n";
  }
  if (ranges.size() > most) text += fmt::format("  and {} ranges more\n", ranges.size() - most);
  if (ranges.empty() && !way.sweep.system.contacts.empty()) text = "  no contact touches\n";
  return text.empty() ? "" : "\n" + text;
}

std::string way_text(const SweepWay& way, const ParameterAxis& axis) {
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < way.size(); k = stretches.back().to + 1) {
    stretches.push_back(stretch_from(way, k));
  }
  const auto values = [&](const Stretch& s) {
    const double from = axis.shown(way.index(s.from)), to = axis.shown(way.index(s.to));
    return s.from == s.to ? fmt::format("{:.7g}", from) : fmt::format("{:.7g} to {:.7g}", from, to);
  };
  return table_of(stretches,
                  {{axis.title(), values},
                   {"values", [](const Stretch& s) { return std::to_string(s.to - s.from + 1); }},
                   {"motion", [](const Stretch& s) { return s.kind; }},
                   {"period", period_text},
                   {"impacts per revolution", impacts_text},
                   {"largest exponent per revolution", exponent_text}}) +
         touch_text(way, axis);
}

/// The largest of a number along a sweep; of one way or both.
struct LargestAlong {
  std::size_t of = 0;     ///< number of the probe, or of the support
  double value = nan;     ///< NaN: nothing is known of it
  std::size_t index = 0;  ///< of the value of the parameter
  std::string way{};
};

/// The largest of each of `count` numbers of the portraits.
std::vector<LargestAlong> largest_along(const SweepResult& sweep, Vec Portrait::*numbers,
                                        std::size_t count) {
  std::vector<LargestAlong> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back({.of = i});
  const std::vector<std::string> ways = sweep.ways();
  const std::size_t values = sweep.points.size() / ways.size();
  for (std::size_t k = 0; k < sweep.points.size(); ++k) {
    const auto point = sweep.points[k];
    if (!point) continue;
    const Vec& known = point->portrait.*numbers;
    for (LargestAlong& most : all) {
      const auto row = static_cast<Eigen::Index>(most.of);
      if (row >= known.size() || !std::isfinite(known(row)) || known(row) <= most.value) continue;
      most = {most.of, known(row), k % values, ways[k / values]};
    }
  }
  return all;
}

/// The columns that say where the largest numbers are.
void add_places(const ParameterAxis& axis, TableColumns<LargestAlong>& columns) {
  columns.push_back({"at " + axis.title(), [&axis](const LargestAlong& l) {
                       return std::isfinite(l.value) ? fmt::format("{:.7g}", axis.shown(l.index))
                                                     : "-";
                     }});
  columns.push_back({"on the way", [](const LargestAlong& l) { return l.way; }});
}

std::string probes_text(const SweepResult& sweep, const ParameterAxis& axis) {
  if (sweep.probes.size() == 0 || sweep.spectrum_revolutions == 0) return "";
  const auto probe = [&](const LargestAlong& l) { return sweep.probes[l.of]; };
  TableColumns<LargestAlong> columns{
      {"probe", [=](const LargestAlong& l) { return probe(l).name; }},
      {"angle [deg]", [=](const LargestAlong& l) { return angle_text(probe(l)); }},
      {"largest", [=](const LargestAlong& l) {
         return std::isfinite(l.value) ? reading_text(l.value, probe(l)) : "-";
       }}};
  add_places(axis, columns);
  return "\n  Along the probes, peak to peak\n" +
         table_of(largest_along(sweep, &Portrait::probe_peak_to_peak, sweep.probes.size()),
                  columns);
}

std::string supports_text(const SweepResult& sweep, const ParameterAxis& axis) {
  if (sweep.leaves_out("support")) return "";
  TableColumns<LargestAlong> columns{
      {"support", [&](const LargestAlong& l) { return sweep.supports[l.of]; }},
      {"largest force", [](const LargestAlong& l) {
         return std::isfinite(l.value) ? format_engineering(l.value, "N") : "-";
       }}};
  add_places(axis, columns);
  return "\n  Forces on supports\n" +
         table_of(largest_along(sweep, &Portrait::support_largest, sweep.supports.size()), columns);
}

}  // namespace

std::string text_of(const SweepResult& sweep, const ParameterAxis& axis) {
  if (sweep.start == SweepStart::fresh) {
    return "\n  every value from the start of the model\n" + way_text({sweep, axis.values}, axis) +
           probes_text(sweep, axis) + supports_text(sweep, axis);
  }
  return "\n  up\n" + way_text({sweep, axis.values}, axis) + "\n  down\n" +
         way_text({sweep, axis.values, 1}, axis) + probes_text(sweep, axis) +
         supports_text(sweep, axis);
}

}  // namespace whirl::inline io
