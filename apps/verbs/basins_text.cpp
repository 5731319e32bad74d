#include "apps/verbs/basins_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

/// Numbers of the basins, the largest first.
std::vector<std::size_t> by_size(const BasinsResult& result) {
  std::vector<std::size_t> order(result.basins.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return result.basins[a].count > result.basins[b].count; });
  return order;
}

/// Starts that led somewhere, settled or not.
std::size_t ended_starts(const BasinsResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.points.begin(), result.points.end(),
                    [](const auto& p) { return p && !p->motion.has_failed(); }));
}

double share_of(std::size_t count, const BasinsResult& result) {
  return static_cast<double>(count) / static_cast<double>(ended_starts(result));
}

std::string as_percent(double share) {
  return fmt::format("{:.2f} %", 100.0 * share);
}

}  // namespace

Record basins_entries(const BasinsResult& result) {
  Record list = Record::array();
  for (const std::size_t number : by_size(result)) {
    const Basin& basin = result.basins[number];
    const BasinsPoint& first = *result.points[basin.first];
    const ClassifiedMotion& motion = first.motion;
    Record start;
    start.set("number", static_cast<long>(basin.first) + 1);
    start.set("displacement", first.start.displacement).set("velocity", first.start.velocity);
    Record r;
    r.set("number", static_cast<long>(number)).set("motion", name_of(*motion.kind));
    r.set("share", share_of(basin.count, result));
    r.set("period_revs", motion.period > 0 ? Record(motion.period) : Record(nullptr));
    r.set("regime", name_of(motion.regime())).set("impacts_per_rev", motion.impacts_per_rev());
    r.set("lyapunov_max", motion.largest_exponent()).set("start", start);
    list.add(r);
  }
  return list;
}

std::string basins_table(const BasinsResult& result) {
  Table text({"motion", "share of starts", "period", "contacts", "impacts per revolution",
              "largest exponent per revolution", "first start"});
  std::size_t open = ended_starts(result);
  for (const std::size_t number : by_size(result)) {
    const Basin& basin = result.basins[number];
    const ClassifiedMotion& motion = result.points[basin.first]->motion;
    std::string regimes;
    for (const ContactDoing& c : motion.contacts) {
      regimes += (regimes.empty() ? "" : ", ") + std::string(name_of(c.regime));
    }
    text.row({std::string(name_of(*motion.kind)), as_percent(share_of(basin.count, result)),
              motion.period > 0 ? std::to_string(motion.period) : "-",
              regimes.empty() ? "-" : regimes, fmt::format("{:.4g}", motion.impacts_per_rev()),
              fmt::format("{:+.4f}", motion.largest_exponent()), std::to_string(basin.first + 1)});
    open -= basin.count;
  }
  if (open > 0) {
    text.row({std::string(name_of(MotionKind::not_settled)), as_percent(share_of(open, result)), "-",
              "-", "-", "-", "-"});
  }
  return text.text();
}

}  // namespace whirl::inline cli
