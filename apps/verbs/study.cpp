#include "apps/verbs/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/progress.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/simulation.hpp"
#include "apps/verbs/study_classification.hpp"
#include "apps/verbs/study_file.hpp"
#include "libbase/error.hpp"
#include "libbase/piece_sizes.hpp"
#include "libbase/work_queue.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl {

namespace {

/// Motions of a study that have not settled.
struct Unsettled {
  long motions = 0, would_settle = 0;
  long after = 0;  ///< revolutions of transient after which these would have settled
};

Unsettled unsettled_of(const PointTable& table) {
  Unsettled u;
  for (std::size_t i = 0; i < table.points(); ++i) {
    if (motion_name(table, i) != name_of(MotionKind::not_settled)) continue;
    ++u.motions;
    const long after = static_cast<long>(table.number("settles_after", i));
    if (after > 0) ++u.would_settle;
    u.after = std::max(u.after, after);
  }
  return u;
}

std::string unsettled_text(const Unsettled& u) {
  std::string text =
      fmt::format("\n  {} motion{} not settled", u.motions, u.motions == 1 ? " has" : "s have");
  if (u.would_settle == u.motions) {
    text +=
        fmt::format("; --discard {} would settle {}\n", u.after, u.motions == 1 ? "it" : "them");
  } else if (u.would_settle > 0) {
    text += fmt::format("; --discard {} would settle {}, of others more --revolutions would tell\n",
                        u.after, u.would_settle);
  } else {
    text += "; more --revolutions would tell what they become\n";
  }
  return text;
}

/// The pieces of a study that are not done, one after the other.
class Pieces {
 public:
  Pieces(const StudyWork& work, const PointTable& table) : work_(work), table_(table) {
    for (std::size_t i = 0; i < table.points(); ++i) left_ += table.is_done(i) ? 0 : 1;
  }

  /// Points that are computed together; none: all have been given out.
  std::vector<std::size_t> next(PieceSizes& sizes) {
    if (work_.pieces.empty()) return next_points(sizes.next(left_));
    while (at_ < work_.pieces.size()) {
      const auto& piece = work_.pieces[at_++];
      if (!std::all_of(piece.begin(), piece.end(), [&](auto p) { return table_.is_done(p); })) {
        return piece;
      }
    }
    return {};
  }

 private:
  std::vector<std::size_t> next_points(std::size_t count) {
    std::vector<std::size_t> piece;
    for (; at_ < table_.points() && piece.size() < count; ++at_) {
      if (!table_.is_done(at_)) piece.push_back(at_);
    }
    left_ -= piece.size();
    return piece;
  }

  const StudyWork& work_;
  const PointTable& table_;
  std::size_t at_ = 0;    ///< the next piece, or point
  std::size_t left_ = 0;  ///< points that are neither done nor given out
};

/// Work that says how long it took.
std::function<StudyRows()> timed(std::function<StudyRows()> work) {
  return [work = std::move(work)] {
    const auto begin = std::chrono::steady_clock::now();
    StudyRows rows = work();
    rows.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return rows;
  };
}

}  // namespace

std::vector<OptionSpec> study_options(std::vector<OptionSpec> own) {
  const std::vector<OptionSpec> shared{
      {"revolutions", "N", "revolutions that are measured", "1000"},
      {"exponents", "N", "of these, over which Lyapunov exponents are averaged at most", "1000"},
      discard_option,
      tolerance_option,
      from_option,
      restart_option};
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

void together(const std::vector<StudyPoint*>& points,
              const std::function<void(std::span<Subject>)>& f) {
  std::vector<StudyPoint*> good;
  std::vector<Subject> subjects;
  for (StudyPoint* p : points) {
    if (!p->is_good()) continue;
    good.push_back(p);
    subjects.push_back(std::move(p->subject));
  }
  f(subjects);
  for (std::size_t i = 0; i < good.size(); ++i) good[i]->subject = std::move(subjects[i]);
}

StudySetup::StudySetup(const Invocation& call, std::size_t least, std::size_t most)
    : model_(call.model()) {
  const int count = static_cast<int>(call.integer_or("points", 0, 2));
  for (const std::string& text : call.over) {
    const auto axis = parse_axis(text, count);
    if (!axis) throw ModelError({"--over " + text}, "", axis.problem);
    axes_.push_back(*axis);
  }
  if (axes_.size() < least || axes_.size() > most) {
    const std::string right =
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    throw ModelError({"--over"}, "",
                     fmt::format("found {} of them, expected {}: --over PATH=first:last:step, "
                                 "such as --over operation.speed=100:200:1rad/s",
                                 axes_.size(), right));
  }
  options_.revolutions = call.integer("revolutions");
  options_.discard = call.integer("discard", 0);
  options_.exponents = call.integer("exponents");
  options_.tolerance = call.number("tolerance", "");
  require_tolerance(options_.tolerance, "--tolerance " + call.text("tolerance"));
  const long processors = std::max(1u, std::thread::hardware_concurrency());
  threads_ = static_cast<int>(call.integer_or("threads", processors));
  earlier_ = earlier_start(call, model_);
  if (call.has("from")) model_.start.whirl.clear();  // it goes on as it was
  family_.emplace(model_, axes_);
  // what is wrong at the ends is said before the work
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes_.size()); ++corner) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      indices.push_back((corner >> i & 1) != 0 ? axes_[i].values.size() - 1 : 0);
    }
    require_speed(family_->model(values_at(indices)));
  }
}

std::size_t StudySetup::points() const {
  std::size_t product = 1;
  for (const ParameterAxis& a : axes_) product *= a.values.size();
  return product;
}

std::vector<std::size_t> StudySetup::indices_of(std::size_t number) const {
  std::vector<std::size_t> indices(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {
    indices[i] = number % axes_[i].values.size();
    number /= axes_[i].values.size();
  }
  return indices;
}

std::vector<double> StudySetup::values_at(const std::vector<std::size_t>& indices) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < axes_.size(); ++i) values.push_back(axes_[i].values[indices[i]]);
  return values;
}

StudyPoint StudySetup::point(std::size_t number, const FullState* from) const {
  StudyPoint p;
  p.model = std::make_unique<Model>(family_->model(values_at(indices_of(number))));
  const FullState* start = from ? from : earlier_ ? &earlier_->state : nullptr;
  if (start) {
    p.model->start.from = StartFrom::file;
    p.model->start.whirl.clear();
  }
  try {
    p.scene = family_->scene(*p.model);
    p.subject.system = &p.scene->contacts;
    p.subject.found.end = family_->start(*p.model, *p.scene, start);
    if (start && !from) p.subject.found.end.phase = earlier_->phase;
  } catch (const NumericalError& error) {
    p.failure = error.what();
  }
  return p;
}

std::vector<std::string> StudySetup::axis_paths(const std::string& group) const {
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    paths.push_back(fmt::format("{}/axis_{}", group, i + 1));
  }
  return paths;
}

std::unique_ptr<ResultWriter> StudySetup::file(const Invocation& call,
                                               const std::string& group) const {
  auto file = call.result_file(model_);
  write_start(*file, earlier_);
  const std::vector<std::string> paths = axis_paths(group);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    file->dataset(paths[i], axes_[i].values, {axes_[i].unit, axes_[i].path, {""}});
  }
  return file;
}

std::string StudySetup::describe(std::size_t number) const {
  const std::vector<std::size_t> indices = indices_of(number);
  std::string text;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    text +=
        fmt::format("{}{} = {:.10g}{}{}", text.empty() ? "" : ", ", axes_[i].path,
                    axes_[i].values[indices[i]], axes_[i].unit.empty() ? "" : " ", axes_[i].unit);
  }
  return text;
}

Record StudySetup::axes_record() const {
  Record list = Record::array();
  for (const ParameterAxis& a : axes_) {
    Record r;
    r.set("parameter", a.path).set("unit", a.unit).set("values", a.values);
    list.add(r);
  }
  return list;
}

StudyOutcome run_study(const Invocation& call, const StudyWork& work, PointTable& table,
                       const std::optional<EarlierEnd>& start,
                       const std::function<std::unique_ptr<ResultWriter>()>& begin) {
  StudyOutcome outcome;
  StudyFile saver(
      call, start, begin, [&](ResultWriter& file) { table.write(file); },
      [&](const ResultReader& earlier) { table.read(earlier); });
  outcome.resumed = table.done();
  install_interrupt_handler();
  Progress progress(work.label, static_cast<long>(table.points() - outcome.resumed),
                    call.shows_progress);
  PieceSizes sizes(work.most_together, work.threads);
  {
    WorkQueue<StudyRows> queue(work.threads);
    const auto take = [&](std::chrono::milliseconds patience) {
      const auto result = queue.take(patience);
      if (!result || !result->is_whole) return;
      for (const auto& [point, row] : result->rows) table.put(point, row);
      sizes.learn(result->rows.size(), result->seconds);
      if (outcome.failure.empty()) outcome.failure = result->failure;
      saver.save_if_due();
      progress.update(static_cast<long>(table.done() - outcome.resumed));
    };
    Pieces pieces(work, table);
    try {
      while (!is_interrupted()) {
        const std::vector<std::size_t> piece = pieces.next(sizes);
        if (piece.empty()) break;
        queue.add(timed(work.prepare(piece)));
        while (queue.is_full()) take(std::chrono::milliseconds(100));
      }
      while (queue.has_open()) take(std::chrono::milliseconds(100));
    } catch (...) {  // a wrong model somewhere in the middle: what is done is kept
      saver.save();
      throw;
    }
  }
  saver.save();
  std::size_t failed = 0;
  for (std::size_t i = 0; i < table.points(); ++i) {
    if (table.is_done(i) && table.number("motion", i) < 0.0) ++failed;
  }
  if (failed > 0) {
    outcome.failure =
        fmt::format("{} of {} points{}{}", failed, table.points(),
                    outcome.failure.empty() ? "" : ", for instance at ", outcome.failure);
  }
  if (table.done() < table.points()) {
    outcome.status = 130;
  } else if (failed == table.points()) {
    outcome.status = 3;
  }
  return outcome;
}

void add_outcome(const Invocation& call, const StudyOutcome& outcome, const PointTable& table,
                 Report& report) {
  const Unsettled unsettled = unsettled_of(table);
  Record not_settled;
  not_settled.set("motions", unsettled.motions);
  not_settled.set("settle_after_revs",
                  unsettled.after > 0 ? Record(unsettled.after) : Record(nullptr));
  not_settled.set("would_settle", unsettled.would_settle);
  report.record.set("not_settled", not_settled);
  if (unsettled.motions > 0) report.text += unsettled_text(unsettled);
  if (outcome.resumed > 0) {
    report.text +=
        fmt::format("\n  {} of {} points were there already\n", outcome.resumed, table.points());
  }
  if (outcome.status == 130) {
    report.text += fmt::format("\n  stopped with {} of {} points{}\n", table.done(), table.points(),
                               call.has("out") ? "; the same line goes on from there" : "");
  }
  if (!outcome.failure.empty()) {
    if (outcome.status == 3) report.failure = outcome.failure;
    report.text += fmt::format("\n  failed: {}\n", outcome.failure);
    report.record.set("failure", outcome.failure);
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
}

}  // namespace whirl
