#include "apps/verbs/sweep_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

bool is_same_motion(const std::optional<SweepPoint>& a, const std::optional<SweepPoint>& b) {
  if (!a || !b) return !a && !b;
  return a->motion.kind == b->motion.kind && a->motion.period == b->motion.period;
}

/// What the motions of a stretch have in common.
std::vector<std::string> described(const SweepWay& way, std::size_t from, std::size_t to) {
  const std::optional<SweepPoint>& first = way.point(from);
  if (!first) return {"not computed", "-", "-", "-"};
  if (first->motion.has_failed()) return {"failed", "-", "-", "-"};
  double low = first->motion.impacts_per_rev(), high = low;
  double exponent = first->motion.largest_exponent();
  for (std::size_t i = from; i <= to; ++i) {
    const ClassifiedMotion& motion = way.point(i)->motion;
    low = std::min(low, motion.impacts_per_rev());
    high = std::max(high, motion.impacts_per_rev());
    exponent = std::max(exponent, motion.largest_exponent());
  }
  const int period = first->motion.period;
  constexpr double same = 1e-9;  // impacts a revolution
  return {
      std::string(name_of(*first->motion.kind)), period > 0 ? std::to_string(period) : "-",
      high - low < same ? fmt::format("{:.4g}", low) : fmt::format("{:.3g} to {:.3g}", low, high),
      fmt::format("{:+.4f}", exponent)};
}

}  // namespace

Record sweep_entries(const SweepWay& way) {
  Record list = Record::array();
  for (std::size_t k = 0; k < way.size(); ++k) {
    const std::optional<SweepPoint>& point = way.point(k);
    if (!point) continue;
    const ClassifiedMotion& motion = point->motion;
    Record r;
    r.set("value", way.axis.values[way.value(k)]);
    r.set("motion", motion.has_failed() ? Record(nullptr) : Record(name_of(*motion.kind)));
    r.set("period_revs", motion.period > 0 ? Record(motion.period) : Record(nullptr));
    Record sections = Record::array();
    if (const Mat& x = point->portrait.poincare_x; x.rows() > 0) {
      for (const double value : x.row(0)) {
        if (std::isfinite(value)) sections.add(value);
      }
    }
    r.set("poincare_m", sections);
    r.set("lyapunov_max",
          motion.exponents.empty() ? Record(nullptr) : Record(motion.largest_exponent()));
    r.set("impacts_per_rev", motion.impacts_per_rev());
    list.add(r);
  }
  return list;
}

std::string sweep_stretches(const SweepWay& way) {
  Table text({way.axis.title(), "values", "motion", "period", "impacts per revolution",
              "largest exponent per revolution"});
  for (std::size_t k = 0; k < way.size();) {
    std::size_t to = k;
    while (to + 1 < way.size() && is_same_motion(way.point(k), way.point(to + 1))) ++to;
    const double from = way.axis.shown(way.value(k)), until = way.axis.shown(way.value(to));
    std::vector<std::string> row{
        to == k ? fmt::format("{:.7g}", from) : fmt::format("{:.7g} to {:.7g}", from, until),
        fmt::format("{}", to - k + 1)};
    const std::vector<std::string> rest = described(way, k, to);
    row.insert(row.end(), rest.begin(), rest.end());
    text.row(row);
    k = to + 1;
  }
  return text.text();
}

}  // namespace whirl::inline cli
