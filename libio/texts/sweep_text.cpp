#include "libio/texts/sweep_text.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  const ClassifiedMotion* motion = nullptr;  ///< the first one; null: not computed, or failed
  std::string kind = "not computed";
  double least_impacts = 0.0, most_impacts = 0.0;  ///< per revolution
  double largest_exponent = 0.0;                   ///< per revolution
};

Stretch stretch_from(const SweepWay& way, std::size_t from) {
  Stretch s{.from = from, .to = from};
  while (s.to + 1 < way.size() && is_same_motion(way.point(from), way.point(s.to + 1))) ++s.to;
  if (!way.point(from)) return s;
  const ClassifiedMotion& first = way.point(from)->motion;
  s.kind = first.has_failed() ? "failed" : name_of(*first.kind);
  if (first.has_failed()) return s;
  s.motion = &first;
  s.least_impacts = s.most_impacts = first.impacts_per_rev();
  s.largest_exponent = first.largest_exponent();
  for (std::size_t i = from; i <= s.to; ++i) {
    const ClassifiedMotion& motion = way.point(i)->motion;
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
                   {"largest exponent per revolution", exponent_text}});
}

}  // namespace

std::string text_of(const SweepResult& sweep, const ParameterAxis& axis) {
  if (sweep.start == SweepStart::fresh) {
    return "\n  every value from the start of the model\n" + way_text({sweep, axis.values}, axis);
  }
  return "\n  up\n" + way_text({sweep, axis.values}, axis) + "\n  down\n" +
         way_text({sweep, axis.values, 1}, axis);
}

}  // namespace whirl::inline io
