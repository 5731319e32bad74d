#include "apps/verbs/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/verbs/options.hpp"
#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline cli {

namespace {

std::string unsettled_text(const StudyOutcome& o) {
  std::string text =
      fmt::format("\n  {} motion{} not settled", o.unsettled, o.unsettled == 1 ? " has" : "s have");
  if (o.would_settle == o.unsettled) {
    text += fmt::format("; --discard {} would settle {}\n", o.settles_after,
                        o.unsettled == 1 ? "it" : "them");
  } else if (o.would_settle > 0) {
    text += fmt::format("; --discard {} would settle {}, of others more --revolutions would tell\n",
                        o.settles_after, o.would_settle);
  } else {
    text += "; more --revolutions would tell what they become\n";
  }
  return text;
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
  classify_.revolutions = call.integer("revolutions");
  classify_.discard = call.integer("discard", 0);
  classify_.exponents = call.integer("exponents");
  classify_.tolerance = call.number("tolerance", "");
  require_tolerance(classify_.tolerance, "--tolerance " + call.text("tolerance"));
  const long processors = std::max(1u, std::thread::hardware_concurrency());
  threads_ = static_cast<int>(call.integer_or("threads", processors));
  earlier_ = earlier_start(call, model_);
  if (call.has("from")) model_.start.whirl.clear();  // it goes on as it was
  family_.emplace(model_, axes_);
  for (const ParameterAxis& a : axes_) grid_.axes.push_back(a.values);
  // what is wrong at the ends is said before the work
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes_.size()); ++corner) {
    std::vector<double> values;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const std::vector<double>& all = axes_[i].values;
      values.push_back((corner >> i & 1) != 0 ? all.back() : all.front());
    }
    require_speed(family_->model(values));
  }
}

StudyModels StudySetup::models() const {
  return {.member =
              [this](std::span<const double> values) {
                StudyMember member{.model = family_->model(values), .scene = nullptr};
                member.scene = family_->scene(member.model);
                return member;
              },
          .start =
              [this](const StudyMember& member, const FullState* from) {
                const FullState* start = from ? from : earlier_ ? &earlier_->state : nullptr;
                if (!start) return family_->start(member.model, *member.scene, nullptr);
                Model model = member.model;
                model.start.from = StartFrom::file;
                model.start.whirl.clear();
                MotionState state = family_->start(model, *member.scene, start);
                if (!from) state.phase = earlier_->phase;
                return state;
              }};
}

StudyMember StudySetup::first() const {
  try {
    return models().member(grid_.values_at(0));
  } catch (const NumericalError& error) {
    throw NumericalError((axes_.empty() ? "" : describe(0) + ": ") + error.what());
  }
}

std::unique_ptr<ResultWriter> StudySetup::file(const Invocation& call) const {
  auto file = call.result_file(model_);
  write_start(*file, earlier_);
  return file;
}

std::string StudySetup::describe(std::size_t point) const {
  const std::vector<std::size_t> indices = grid_.indices_of(point);
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

StudyOutcome study_outcome(const std::vector<const ClassifiedMotion*>& motions, std::size_t resumed,
                           const std::function<std::string(std::size_t)>& describe) {
  StudyOutcome outcome{.resumed = resumed, .points = motions.size()};
  std::size_t failed = 0;
  std::string example;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i]) continue;
    const ClassifiedMotion& motion = *motions[i];
    ++outcome.done;
    failed += motion.has_failed() ? 1 : 0;
    if (example.empty() && !motion.failure.empty()) example = describe(i) + ": " + motion.failure;
    if (motion.kind != MotionKind::not_settled) continue;
    ++outcome.unsettled;
    outcome.would_settle += motion.settles_after > 0 ? 1 : 0;
    outcome.settles_after = std::max(outcome.settles_after, motion.settles_after);
  }
  if (failed > 0) {
    outcome.failure = fmt::format("{} of {} points{}{}", failed, outcome.points,
                                  example.empty() ? "" : ", for instance at ", example);
  }
  if (outcome.done < outcome.points) {
    outcome.status = 130;
  } else if (failed == outcome.points) {
    outcome.status = 3;
  }
  return outcome;
}

void add_outcome(const Invocation& call, const StudyOutcome& outcome, Report& report) {
  Record not_settled;
  not_settled.set("motions", outcome.unsettled);
  not_settled.set("settle_after_revs",
                  outcome.settles_after > 0 ? Record(outcome.settles_after) : Record(nullptr));
  not_settled.set("would_settle", outcome.would_settle);
  report.record.set("not_settled", not_settled);
  if (outcome.unsettled > 0) report.text += unsettled_text(outcome);
  if (outcome.resumed > 0) {
    report.text +=
        fmt::format("\n  {} of {} points were there already\n", outcome.resumed, outcome.points);
  }
  if (outcome.status == 130) {
    report.text += fmt::format("\n  stopped with {} of {} points{}\n", outcome.done, outcome.points,
                               call.has("out") ? "; the same line goes on from there" : "");
  }
  if (!outcome.failure.empty()) {
    if (outcome.status == 3) report.failure = outcome.failure;
    report.text += fmt::format("\n  failed: {}\n", outcome.failure);
    report.record.set("failure", outcome.failure);
  }
  if (call.has("out")) report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
}

}  // namespace whirl::inline cli
