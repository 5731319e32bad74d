#include "libdyn/studies/basins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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
#include "libio/text/format.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr std::size_t most_together = 64;  ///< starts, in the lanes of one batch
const std::string group = "/basins";
constexpr int failed = -1, unsettled = -2;  ///< in place of the number of an attractor

/// Where the starts come from: the axes, or chance around the model's start.
struct Starts {
  const StudySetup& setup;
  std::size_t count = 0;  ///< of random ones; 0: from the axes
  double size = 0.0;      ///< [length scales]
  std::uint64_t seed = 0;

  std::size_t points() const { return count > 0 ? count : setup.points(); }
  /// The first of random starts is the model's own.
  StudyPoint point(std::size_t number) const {
    StudyPoint p = setup.point(count > 0 ? 0 : number);
    if (count > 0 && number > 0 && p.scene) {
      MotionState& start = p.subject.found.end;
      start = random_start(p.scene->contacts, start, size, seed, number);
    }
    return p;
  }
};

std::vector<double> numbers(const Vec& v) {
  return {v.begin(), v.end()};
}

StudyRows compute(const Starts& starts, const std::vector<std::size_t>& piece) {
  const ClassifyOptions& options = starts.setup.options();
  std::vector<StudyPoint> points;
  for (const std::size_t number : piece) points.push_back(starts.point(number));
  std::vector<StudyPoint*> all;
  std::vector<FullState> begins;
  for (StudyPoint& p : points) {
    all.push_back(&p);
    begins.push_back(p.scene ? full_state(*p.scene, p.subject.found.end) : FullState{});
  }
  together(all, [&](std::span<Subject> motions) {
    settle(motions, options);
    average(motions, options);
  });
  StudyRows result;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const StudyPoint& p = points[i];
    const Classification& found = p.subject.found;
    if (!p.is_good() && result.failure.empty()) {
      result.failure = fmt::format("start {}: {}", piece[i] + 1, p.why());
    }
    PointRow row = classification_row(p);
    row.push_back(numbers(begins[i].displacement));
    row.push_back(numbers(begins[i].velocity));
    row.push_back(found.sections);
    result.rows.emplace_back(piece[i], std::move(row));
  }
  result.is_whole = !is_interrupted();
  return result;
}

Ending ending_at(const PointTable& table, std::size_t point) {
  Ending e{.kind = static_cast<MotionKind>(static_cast<int>(table.number("motion", point))),
           .period = static_cast<int>(table.number("period", point)),
           .is_proven = table.number("is_proven", point) == 1.0,
           .sections = table.at("section", point)};
  for (const double code : table.at("regime", point)) {
    e.regimes.push_back(static_cast<Regime>(static_cast<int>(code)));
  }
  return e;
}

/// Starts that ended in the same motion.
struct Basin {
  std::size_t first = 0, count = 0;
};

Report run_basins(const Invocation& call) {
  StudySetup setup(call, 0, 2);
  for (const ParameterAxis& axis : setup.axes()) {
    if (axis.path.starts_with("start.")) continue;
    throw ModelError({"--over " + axis.path}, "",
                     "basins vary the start only, such as start.displaced.1.x; `map` and `sweep` "
                     "vary anything");
  }
  setup.options().watch = [](long) { return !is_interrupted(); };
  setup.options().sections = setup.options().longest_period;
  const Starts starts{
      .setup = setup,
      .count = setup.axes().empty() ? static_cast<std::size_t>(call.integer("starts")) : 0,
      .size = call.number("size", ""),
      .seed = static_cast<std::uint64_t>(call.integer("seed", 0))};
  if (!setup.axes().empty() && call.has("starts")) {
    throw ModelError({"--starts " + call.text("starts")}, "",
                     "with --over the starts are those of its values");
  }
  const StudyPoint first = starts.point(0);
  if (!first.scene) throw NumericalError(first.failure);

  std::vector<PointColumn> columns = classification_columns(*first.scene, group);
  const Eigen::Index full = first.scene->reduced.dofs.T.rows();
  columns.push_back({"start_displacement", "m, rad", "displacement at the start", false, {full}});
  columns.push_back({"start_velocity", "m/s, rad/s", "velocity at the start", false, {full}});
  columns.push_back({"section",
                     "",
                     "reduced states (eta, eta') at phase 0, the last ones",
                     false,
                     {setup.options().sections, first.scene->contacts.size()}});
  std::vector<Eigen::Index> shape{static_cast<Eigen::Index>(starts.points())};
  std::vector<std::string> axes{group + "/start"};
  if (!setup.axes().empty()) {
    shape.clear();
    for (const ParameterAxis& a : setup.axes()) shape.push_back(std::ssize(a.values));
    axes = setup.axis_paths(group);
  }
  PointTable table(group, columns, shape, axes);
  StudyWork work{.label = "starting", .most_together = most_together, .threads = setup.threads()};
  work.prepare = [&](const std::vector<std::size_t>& piece) -> std::function<StudyRows()> {
    return [&starts, piece] { return compute(starts, piece); };
  };
  const auto begin = [&] {
    auto file = setup.file(call, group);
    if (setup.axes().empty()) {
      std::vector<int> all(table.points());
      std::iota(all.begin(), all.end(), 1);
      file->dataset(axes[0], all, {"", "start", {""}});
    }
    write_classification_axes(*file, *first.scene, group);
    return file;
  };
  const StudyOutcome outcome = run_study(call, work, table, setup.earlier(), begin);

  std::vector<std::size_t> good;
  std::vector<Ending> endings;
  std::vector<int> attractor(table.points(), failed);
  std::size_t ended = 0;
  for (std::size_t i = 0; i < table.points(); ++i) {
    const std::string motion = motion_name(table, i);
    if (motion.empty()) continue;
    ++ended;
    if (motion == name_of(MotionKind::not_settled)) {
      attractor[i] = unsettled;
      continue;
    }
    good.push_back(i);
    endings.push_back(ending_at(table, i));
  }
  const std::vector<int> found = attractors(first.scene->contacts, endings);
  std::vector<Basin> basins;
  for (std::size_t i = 0; i < good.size(); ++i) {
    const auto number = static_cast<std::size_t>(found[i]);
    if (number == basins.size()) basins.push_back({good[i], 0});
    ++basins[number].count;
    attractor[good[i]] = found[i];
  }
  if (outcome.status == 0 && call.has("out")) {
    const auto file = begin();
    table.write(*file);
    file->dataset(
        group + "/attractor", attractor, shape,
        {"", "number of the motion that a start ends in, from 0; -1: failed, -2: not settled",
         axes});
    file->commit();
  }

  Report report{.record = begin_record(call, setup.model()), .status = outcome.status};
  note_tables(call, setup.model(), report);
  std::vector<std::size_t> order(basins.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return basins[a].count > basins[b].count; });
  Record list = Record::array();
  Table text({"motion", "share of starts", "period", "contacts", "impacts per revolution",
              "largest exponent per revolution", "first start"});
  for (const std::size_t k : order) {
    const std::size_t i = basins[k].first;
    const Ending e = ending_at(table, i);
    const double share = static_cast<double>(basins[k].count) / static_cast<double>(ended);
    double impacts = 0.0;
    for (const double per_rev : table.at("impacts_per_rev", i)) impacts += per_rev;
    std::string regimes;
    Regime strongest = Regime::none;
    for (const Regime r : e.regimes) {
      regimes += (regimes.empty() ? "" : ", ") + std::string(name_of(r));
      strongest = std::max(strongest, r);
    }
    const auto vector = [&](const char* column) {
      const auto values = table.at(column, i);
      return std::vector<double>(values.begin(), values.end());
    };
    Record start;
    start.set("number", static_cast<long>(i) + 1);
    start.set("displacement", vector("start_displacement"));
    start.set("velocity", vector("start_velocity"));
    Record r;
    r.set("number", static_cast<long>(k)).set("motion", motion_name(table, i)).set("share", share);
    r.set("period_revs", e.period > 0 ? Record(e.period) : Record(nullptr));
    r.set("regime", name_of(strongest)).set("impacts_per_rev", impacts);
    r.set("lyapunov_max", table.at("exponent", i)[0]).set("start", start);
    list.add(r);
    text.row({motion_name(table, i), fmt::format("{:.2f} %", 100.0 * share),
              e.period > 0 ? std::to_string(e.period) : "-", regimes.empty() ? "-" : regimes,
              fmt::format("{:.4g}", impacts), fmt::format("{:+.4f}", table.at("exponent", i)[0]),
              std::to_string(i + 1)});
  }
  if (const std::size_t open = ended - good.size(); open > 0) {
    const double share = static_cast<double>(open) / static_cast<double>(ended);
    text.row({std::string(name_of(MotionKind::not_settled)), fmt::format("{:.2f} %", 100.0 * share),
              "-", "-", "-", "-", "-"});
  }
  report.record.set("starts", static_cast<long>(table.points())).set("attractors", list);
  if (!setup.axes().empty()) report.record.set("axes", setup.axes_record());
  report.record.set("resumed", static_cast<long>(outcome.resumed));
  const std::string& title = setup.model().title;
  report.text = "Coexisting motions" + (title.empty() ? "" : ": " + title) +
                fmt::format("; {} starts\n\n", table.points()) + text.text();
  add_outcome(call, outcome, table, report);
  return report;
}

}  // namespace

Verb basins_verb() {
  return {
      .name = "basins",
      .group = "Contact",
      .summary = "coexisting motions, and how much of the starts each attracts",
      .example =
          "whirl basins models/jeffcott_stator.toml --set contact.ring.stiffness=50e6 --starts 500",
      .options = study_options(
          {{"starts", "N", "starts: that of the model, the others random around it", "256"},
           seed_option,
           start_size_option,
           {"over", "PATH=A:B:STEP",
            "instead of random starts, values of the model's start: "
            "start.displaced.1.x=-1:1:0.1mm"},
           points_option}),
      .run = run_basins,
  };
}

}  // namespace whirl
