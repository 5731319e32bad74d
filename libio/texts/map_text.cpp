#include "libio/texts/map_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "libio/text/table.hpp"

namespace whirl::inline io {

namespace {

using MapPoint = std::optional<ClassifiedMotion>;

/// Values of the last axis of three; else one plane.
std::size_t planes_of(const std::vector<ParameterAxis>& axes) {
  return axes.size() == 3 ? axes[2].values.size() : 1;
}

/// Whether a map lists a period by itself.
bool has_common_period(const ClassifiedMotion& motion) {
  return motion.period > 0 && (motion.period <= 6 || motion.period == 8);
}

/// What a point counts as: its motion, and the period of a periodic one.
std::string kind_of(const MapPoint& point) {
  if (!point) return "not computed";
  if (point->has_failed()) return "failed";
  if (point->kind != MotionKind::periodic) return std::string(name_of(*point->kind));
  return has_common_period(*point) ? fmt::format("period {}", point->period) : "other periods";
}

/// Order of the kinds: by period, then as they get wilder, then what is not known.
int rank_of(const MapPoint& point) {
  constexpr int other_periods = 1000, wilder = 1001, failed = 2000, not_computed = 2001;
  if (!point) return not_computed;
  if (point->has_failed()) return failed;
  if (point->kind == MotionKind::equilibrium) return 0;
  if (point->kind == MotionKind::periodic) {
    return has_common_period(*point) ? point->period : other_periods;
  }
  return wilder + static_cast<int>(*point->kind);
}

/// Shares of something [%], per plane.
using Shares = std::vector<double>;

/// What there is how often in a map.
struct MapShares {
  std::map<std::pair<int, std::string>, Shares> kinds{};  ///< by their rank
  std::map<Regime, Shares> regimes{};
  Shares changes{};  ///< points that have another motion than in the plane before
};

MapShares shares_of(const PointRows<ClassifiedMotion>& points, std::size_t planes) {
  MapShares all{.changes = Shares(planes, 0.0)};
  std::map<std::pair<int, int>, Shares*> known;  // of kinds and periods: names take long
  const double each = 100.0 / static_cast<double>(points.size() / planes);
  const Shares* before = nullptr;
  std::size_t i = 0;
  for (const MapPoint& point : points) {
    const std::size_t plane = i++ % planes;
    const int kind = !point ? -2 : point->has_failed() ? -1 : static_cast<int>(*point->kind);
    Shares*& shares = known[{kind, point ? point->period : 0}];
    if (!shares) {
      const std::string name = kind_of(point);
      shares = &all.kinds[{rank_of(point), name}];
      shares->resize(planes);
    }
    (*shares)[plane] += each;
    if (plane > 0 && shares != before) all.changes[plane] += each;
    before = shares;
    if (!point || point->contacts.empty()) continue;
    Shares& regime = all.regimes[point->regime()];
    regime.resize(planes);
    regime[plane] += each;
  }
  return all;
}

std::vector<std::string> cells(std::string_view name, const Shares& percents) {
  std::vector<std::string> row{std::string(name)};
  for (const double p : percents) row.push_back(fmt::format("{:.2f} %", p));
  return row;
}

/// The sign of a motion that is not periodic: the first letter of its kind, as the list has them.
char letter_of(MotionKind kind) {
  return kind == MotionKind::hyperchaotic ? 'H' : name_of(kind).front();
}

/// What these signs mean.
std::string letters() {
  std::string text;
  for (const auto& [name, kind] : choices(MotionKind{})) {
    if (kind == MotionKind::equilibrium || kind == MotionKind::periodic) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", letter_of(kind), name);
  }
  return text;
}

std::string sign_of(const MapPoint& point) {
  if (!point) return " ";
  if (point->has_failed()) return "!";
  const bool is_periodic = point->kind == MotionKind::periodic;
  const bool touches = point->regime() != Regime::none;
  if (point->kind == MotionKind::equilibrium || (is_periodic && !touches)) return "·";
  if (!is_periodic) return {letter_of(*point->kind)};
  return point->period > 0 && point->period < 10 ? std::to_string(point->period) : "p";
}

std::string map_picture(const MapResult& map, const std::vector<ParameterAxis>& axes) {
  constexpr std::size_t most_columns = 88, most_rows = 24;
  const ParameterAxis &across = axes[0], &up = axes[1];
  const std::size_t width = across.values.size(), height = up.values.size();
  const std::size_t columns = std::min(most_columns, width), rows = std::min(most_rows, height);
  const std::size_t planes = planes_of(axes);
  std::string text;
  for (std::size_t r = rows; r-- > 0;) {
    text += r == rows - 1 || r == 0 ? fmt::format("{:>10.4g} ", up.shown(r == 0 ? 0 : height - 1))
                                    : std::string(11, ' ');
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t i = columns == 1 ? 0 : c * (width - 1) / (columns - 1);
      const std::size_t j = rows == 1 ? 0 : r * (height - 1) / (rows - 1);
      text += sign_of(map.points[(i * height + j) * planes]);
    }
    text += '\n';
  }
  const std::string left = fmt::format("{:.6g}", across.shown(0));
  const std::string right = fmt::format("{:.6g}", across.shown(width - 1));
  text += std::string(11, ' ') + left;
  if (columns > left.size() + right.size()) {
    text += std::string(columns - left.size() - right.size(), ' ') + right;
  }
  const std::string plane =
      planes > 1 ? fmt::format(", {} = {:.6g}", axes[2].path, axes[2].shown(0)) : "";
  return text + fmt::format(
                    "\n           to the right {}, up {}{}\n           1 to 9 period, p other "
                    "periodic, {}, · no contact\n",
                    across.title(), up.title(), plane, letters());
}

std::string map_shares(const MapResult& map, const std::vector<ParameterAxis>& axes) {
  const bool has_planes = axes.size() == 3;
  const std::size_t planes = planes_of(axes);
  std::vector<std::string> head{"motion"};
  for (std::size_t p = 0; p < planes; ++p) {
    head.push_back(has_planes ? fmt::format("{:.6g}", axes[2].shown(p)) : "share");
  }
  const auto [kinds, regimes, changes] = shares_of(map.points, planes);
  Table motions(head);
  for (const auto& [kind, percents] : kinds) motions.row(cells(kind.second, percents));
  if (has_planes) {
    std::vector<std::string> row = cells("another than before", changes);
    row[1] = "-";
    motions.row(row);
  }
  std::string text = has_planes ? fmt::format("  {}, across\n", axes[2].title()) : "";
  text += motions.text();
  if (regimes.empty()) return text;
  head[0] = "contact";
  Table contacts(head);
  for (const auto& [regime, percents] : regimes) contacts.row(cells(name_of(regime), percents));
  return text + "\n" + contacts.text();
}

}  // namespace

std::string text_of(const MapResult& map, const std::vector<ParameterAxis>& axes) {
  return map_picture(map, axes) + "\n" + map_shares(map, axes);
}

}  // namespace whirl::inline io
