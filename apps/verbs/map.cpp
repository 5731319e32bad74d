#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/study.hpp"
#include "apps/verbs/study_classification.hpp"
#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr std::size_t most_together = 256;  ///< points, in the lanes of one batch
const std::string group = "/map";

/// Points of a piece, classified in the lanes of one batch.
StudyRows compute(const StudySetup& setup, const std::vector<std::size_t>& piece) {
  std::vector<StudyPoint> points;
  for (const std::size_t number : piece) points.push_back(setup.point(number));
  std::vector<StudyPoint*> all;
  for (StudyPoint& point : points) all.push_back(&point);
  together(all, [&](std::span<Subject> motions) {
    settle(motions, setup.options());
    average(motions, setup.options());
  });
  StudyRows result;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const StudyPoint& point = points[i];
    if (!point.is_good() && result.failure.empty()) {
      result.failure = setup.describe(piece[i]) + ": " + point.why();
    }
    result.rows.emplace_back(piece[i], classification_row(point));
  }
  result.is_whole = !is_interrupted();
  return result;
}

/// Nested arrays in the shape of the axes.
Record nested(const StudySetup& setup, const std::function<Record(std::size_t)>& value,
              std::size_t axis = 0, std::size_t first = 0) {
  if (axis == setup.axes().size()) return value(first);
  Record::Array items;
  std::size_t stride = 1;
  for (std::size_t i = axis + 1; i < setup.axes().size(); ++i) {
    stride *= setup.axes()[i].values.size();
  }
  for (std::size_t i = 0; i < setup.axes()[axis].values.size(); ++i) {
    items.push_back(nested(setup, value, axis + 1, first + i * stride));
  }
  return items;
}

/// Worst regime of all contacts at a point.
Regime regime_at(const PointTable& table, std::size_t point) {
  double highest = 0.0;
  for (const double code : table.at("regime", point)) highest = std::max(highest, code);
  return static_cast<Regime>(static_cast<int>(highest));
}

/// What a point counts as: its motion, and the period of a periodic one.
std::string kind_of(const PointTable& table, std::size_t point) {
  if (!table.is_done(point)) return "not computed";
  const std::string motion = motion_name(table, point);
  if (motion.empty()) return "failed";
  if (motion != "periodic") return motion;
  const int period = static_cast<int>(table.number("period", point));
  const bool is_common = period > 0 && (period <= 6 || period == 8);
  return is_common ? fmt::format("period {}", period) : "other periods";
}

/// How many points have another motion than in the plane before [%], per plane.
std::vector<double> changes(const PointTable& table, std::size_t planes) {
  std::vector<double> percents(planes, 0.0);
  for (std::size_t i = 0; i < table.points(); ++i) {
    if (i % planes == 0 || kind_of(table, i) == kind_of(table, i - 1)) continue;
    percents[i % planes] += 100.0 / static_cast<double>(table.points() / planes);
  }
  return percents;
}

/// Shares of motions; with three axes, a column for each value of the last one.
std::string shares(const PointTable& table, const StudySetup& setup) {
  const bool has_planes = setup.axes().size() == 3;
  const std::size_t planes = has_planes ? setup.axes()[2].values.size() : 1;
  std::vector<std::string> head{"motion"};
  for (std::size_t p = 0; p < planes; ++p) {
    head.push_back(has_planes ? fmt::format("{:.6g}", setup.axes()[2].shown(p)) : "share");
  }
  std::map<std::string, std::vector<double>> counts;
  std::map<Regime, std::vector<double>> regimes;
  const double whole = static_cast<double>(table.points() / planes);
  for (std::size_t i = 0; i < table.points(); ++i) {
    auto& count = counts[kind_of(table, i)];
    count.resize(planes);
    count[i % planes] += 100.0 / whole;
    if (motion_name(table, i).empty() || table.at("regime", i).empty()) continue;
    auto& regime = regimes[regime_at(table, i)];
    regime.resize(planes);
    regime[i % planes] += 100.0 / whole;
  }
  // by period, then as they get wilder
  const auto rank = [](const std::string& kind) {
    if (kind == "equilibrium") return 0;
    if (kind.starts_with("period ")) return std::stoi(kind.substr(7));
    std::vector<std::string> rest{"other periods"};
    for (const auto& [name, unused] : choices(MotionKind{})) rest.emplace_back(name);
    rest.insert(rest.end(), {"failed", "not computed"});
    return 1000 + static_cast<int>(std::find(rest.begin(), rest.end(), kind) - rest.begin());
  };
  std::vector<std::string> kinds;
  for (const auto& [kind, unused] : counts) kinds.push_back(kind);
  std::sort(kinds.begin(), kinds.end(),
            [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  const auto cells = [](std::string name, const std::vector<double>& percents) {
    std::vector<std::string> row{std::move(name)};
    for (const double p : percents) row.push_back(fmt::format("{:.2f} %", p));
    return row;
  };
  Table motions(head);
  for (const std::string& kind : kinds) motions.row(cells(kind, counts[kind]));
  if (has_planes) {
    std::vector<std::string> row = cells("another than before", changes(table, planes));
    row[1] = "-";
    motions.row(row);
  }
  std::string text;
  if (has_planes) text += fmt::format("  {}, across\n", setup.axes()[2].title());
  text += motions.text();
  if (regimes.empty()) return text;
  head[0] = "contact";
  Table contacts(head);
  for (const auto& [regime, percents] : regimes) {
    contacts.row(cells(std::string(name_of(regime)), percents));
  }
  return text + "\n" + contacts.text();
}

/// The sign of a motion that is not periodic: the first letter of its kind, as the list has them.
char letter_of(std::string_view motion) {
  if (motion == name_of(MotionKind::hyperchaotic)) return 'H';
  return motion.front();
}

/// What these signs mean.
std::string letters() {
  std::string text;
  for (const auto& [name, kind] : choices(MotionKind{})) {
    if (kind == MotionKind::equilibrium || kind == MotionKind::periodic) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", letter_of(name), name);
  }
  return text;
}

/// The plane as signs, the first axis to the right, the second one up.
std::string picture(const PointTable& table, const StudySetup& setup) {
  constexpr std::size_t most_columns = 88, most_rows = 24;
  const ParameterAxis &across = setup.axes()[0], &up = setup.axes()[1];
  const std::size_t width = across.values.size(), height = up.values.size();
  const std::size_t columns = std::min(most_columns, width);
  const std::size_t rows = std::min(most_rows, height);
  const std::size_t planes = setup.axes().size() == 3 ? setup.axes()[2].values.size() : 1;
  std::string text;
  for (std::size_t r = rows; r-- > 0;) {
    text += r == rows - 1 || r == 0 ? fmt::format("{:>10.4g} ", up.shown(r == 0 ? 0 : height - 1))
                                    : std::string(11, ' ');
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t i = columns == 1 ? 0 : c * (width - 1) / (columns - 1);
      const std::size_t j = rows == 1 ? 0 : r * (height - 1) / (rows - 1);
      const std::size_t point = (i * height + j) * planes;
      const std::string motion = motion_name(table, point);
      const double period = table.number("period", point);
      const bool touches = regime_at(table, point) != Regime::none;
      if (!table.is_done(point)) {
        text += ' ';
      } else if (motion.empty()) {
        text += '!';
      } else if (motion == "equilibrium" || (motion == "periodic" && !touches)) {
        text += "·";
      } else if (motion == "periodic") {
        text +=
            period > 0.0 && period < 10.0 ? static_cast<char>('0' + static_cast<int>(period)) : 'p';
      } else {
        text += letter_of(motion);
      }
    }
    text += '\n';
  }
  const std::string left = fmt::format("{:.6g}", across.shown(0));
  const std::string right = fmt::format("{:.6g}", across.shown(width - 1));
  text += std::string(11, ' ') + left;
  if (columns > left.size() + right.size()) {
    text += std::string(columns - left.size() - right.size(), ' ') + right;
  }
  return text + fmt::format(
                    "\n           to the right {}, up {}{}\n           1 to 9 period, p other "
                    "periodic, {}, · no contact\n",
                    across.title(), up.title(),
                    planes > 1 ? fmt::format(", {} = {:.6g}", setup.axes()[2].path,
                                             setup.axes()[2].shown(0))
                               : "",
                    letters());
}

Report run_map(const Invocation& call) {
  StudySetup setup(call, 2, 3);
  setup.options().watch = [](long) { return !is_interrupted(); };
  const StudyPoint first = setup.point(0);
  if (!first.scene) throw NumericalError(setup.describe(0) + ": " + first.failure);
  std::vector<Eigen::Index> shape;
  for (const ParameterAxis& a : setup.axes()) shape.push_back(std::ssize(a.values));
  PointTable table(group, classification_columns(*first.scene, group), shape,
                   setup.axis_paths(group));
  StudyWork work{.label = "mapping", .most_together = most_together, .threads = setup.threads()};
  work.prepare = [&](const std::vector<std::size_t>& piece) -> std::function<StudyRows()> {
    return [&setup, piece] { return compute(setup, piece); };
  };
  const StudyOutcome outcome = run_study(call, work, table, setup.earlier(), [&] {
    auto file = setup.file(call, group);
    write_classification_axes(*file, *first.scene, group);
    return file;
  });

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  const auto known = [&](std::size_t i) { return !motion_name(table, i).empty(); };
  report.record.set("axes", setup.axes_record());
  report.record.set("motion", nested(setup, [&](std::size_t i) {
                      return known(i) ? Record(motion_name(table, i)) : Record(nullptr);
                    }));
  report.record.set("period_revs", nested(setup, [&](std::size_t i) {
                      const double period = table.number("period", i);
                      return period > 0.0 ? Record(static_cast<long>(period)) : Record(nullptr);
                    }));
  report.record.set("regime", nested(setup, [&](std::size_t i) {
                      return known(i) ? Record(name_of(regime_at(table, i))) : Record(nullptr);
                    }));
  report.record.set("lyapunov_max", nested(setup, [&](std::size_t i) {
                      return known(i) ? Record(table.at("exponent", i)[0]) : Record(nullptr);
                    }));
  report.record.set("resumed", static_cast<long>(outcome.resumed));
  const std::string& title = setup.model().title;
  report.text = "Map" + (title.empty() ? "" : ": " + title) +
                fmt::format("; {} points\n\n", setup.points()) + picture(table, setup) + "\n" +
                shares(table, setup);
  add_outcome(call, outcome, table, report);
  return report;
}

}  // namespace

Verb map_verb() {
  return {
      .name = "map",
      .group = "Contact",
      .summary = "a plane of two parameters, or several planes, every point classified",
      .example =
          "whirl map models/jeffcott_stator.toml --over operation.speed=130:160:2rad/s --over "
          "contact.ring.stiffness=10:150:10MN/m --out map.h5",
      .options = study_options({over_option, points_option}),
      .run = run_map,
  };
}

}  // namespace whirl
