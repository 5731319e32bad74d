#include "libdyn/branches/torus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/invocation.hpp"
#include "apps/progress.hpp"
#include "apps/verb.hpp"
#include "apps/verbs/borders.hpp"
#include "apps/verbs/common.hpp"
#include "apps/verbs/notes.hpp"
#include "apps/verbs/options.hpp"
#include "apps/verbs/orbits.hpp"
#include "apps/verbs/simulation.hpp"
#include "libbase/error.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/text/table.hpp"

namespace whirl {

namespace {

constexpr int largest_denominator = 12;  ///< of a locking that is named

/// A circle at a value of the parameter.
struct CirclePoint {
  double value = 0.0;
  double rotation = 0.0;  ///< per revolution
  double growth = 0.0;    ///< largest exponent across it, per revolution
  double tail = 0.0;
};

/// The ratio of small integers next to a rotation, to name what it locks to.
std::pair<int, int> nearest_ratio(double rotation) {
  std::pair<int, int> best{0, 1};
  for (int q = 1; q <= largest_denominator; ++q) {
    const int p = static_cast<int>(std::lround(rotation * q));
    if (std::abs(rotation - double(p) / q) <
        std::abs(rotation - double(best.first) / best.second) - 1e-12) {
      best = {p, q};
    }
  }
  return best;
}

/// Both ways along the parameter, in ascending order of the walk.
struct Walks {
  std::vector<CirclePoint> points;
  std::vector<std::string> ends;
};

CirclePoint point_of(const BranchPoint& p, const Vec& scale, int period) {
  const InvariantCircle circle = circle_of(p.z.head(p.z.size() - 1), scale, period);
  const double growth = p.multipliers.size() > 0 ? std::log(p.multipliers(0).real()) : NAN;
  return {p.value, circle.rotation / period, growth / period, circle.tail};
}

Report run_torus(const Invocation& call) {
  const Model model = call.model();
  require_speed(model);
  const int period = static_cast<int>(call.integer("period"));
  const long count = call.integer("revolutions", 200);
  const CircleOptions options{.period = period,
                              .harmonics = static_cast<int>(call.integer("harmonics"))};
  std::optional<BranchParameters> parameters;
  if (!call.over.empty()) {
    parameters = branch_parameters(call, model);
    if (parameters->across) throw ModelError({"--over"}, "", "found 2 of them, expected one");
  }
  const Model at_first = parameters ? parameters->model(parameters->along.first) : model;
  const auto file = call.result_file(model);
  const auto scene = std::make_shared<const Scene>(make_scene(at_first));
  Trajectory motion = after_transient(call, at_first, *scene);
  Report report{.record = begin_record(call, model), .status = status_of(motion.outcome)};
  note_tables(call, model, report);
  if (report.status == 130) {
    report.failure = "stopped in the transient";
    return report;
  }
  if (report.status == 3) throw NumericalError(motion.diagnosis);
  motion.revolutions = count * period;
  integrate_single(motion, {.tolerance = 1e-11, .sections = true});
  if (motion.outcome != Outcome::reached_end) throw NumericalError(motion.diagnosis);
  const Eigen::Index n = scene->contacts.size();
  const Eigen::Map<const Mat> all(motion.sections.data(), n, std::ssize(motion.sections) / n);
  Mat sections(n, count);
  for (Eigen::Index i = 0; i < count; ++i) sections.col(i) = all.col((i + 1) * period - 1);

  const Flow flow = flow_of(scene->contacts);
  const auto guess = guessed_circle(sections, flow.scale, period, options.harmonics);
  if (!guess) {
    throw NumericalError("the motion has settled on a periodic orbit: there is no circle");
  }
  const InvariantCircle circle = find_circle(flow, *guess, options);
  if (!circle.is_good()) {
    const auto [p, q] = nearest_ratio(guess->rotation);
    report.failure =
        fmt::format("{}; the motion turns by {:.9f} of the circle, {}/{} and {:+.1e}",
                    circle.failure, guess->rotation, p, q, guess->rotation - double(p) / q);
    report.status = 3;
  }

  Walks walks;
  if (circle.is_good() && parameters) {
    const FlowAt flow_at = [&](double value) { return flow_of(parameters->scene(value), *scene); };
    const BranchParameter& along = parameters->along;
    install_interrupt_handler();
    Progress progress("circles", call.integer("most"), call.shows_progress);
    for (const double direction : {-along.direction, along.direction}) {
      if (direction != along.direction && !along.goes_both) continue;
      ContinuationOptions how = along.options();
      how.direction = direction;
      how.most_points = static_cast<int>(call.integer("most"));
      how.smallest_step = 1e-6;
      Continuation walk(circle_equations(flow_at, flow.scale, period, circle.coordinate),
                        circle_unknowns(circle, flow.scale), how);
      while (!is_interrupted() && walk.advance()) {
        progress.update(std::ssize(walk.branch().points));
      }
      std::vector<CirclePoint> found;
      for (const BranchPoint& p : walk.branch().points) {
        found.push_back(point_of(p, flow.scale, period));
      }
      if (direction != along.direction) std::reverse(found.begin(), found.end());
      if (!walks.points.empty()) found.erase(found.begin());
      walks.points.insert(walks.points.end(), found.begin(), found.end());
      const auto [p, q] = nearest_ratio(direction == along.direction ? found.back().rotation
                                                                     : found.front().rotation);
      walks.ends.push_back(walk.branch().end ? fmt::format("{} (rotation next to {}/{})",
                                                           walk.branch().end->text, p, q)
                                             : "stopped");
      if (!walk.branch().end) report.status = 130;
    }
  }

  const double speed = scene->contacts.Omega() / rpm;
  Record& r = report.record;
  Record exponents = Record::array();
  for (const double e : circle.exponents) exponents.add(e / period);
  r.set("period_revs", period).set("rotation_per_rev", circle.rotation / period);
  r.set("frequency_rpm", circle.rotation / period * speed);
  r.set("exponents_per_rev", exponents).set("along_per_rev", circle.along / period);
  r.set("stable", circle.is_good() ? Record(circle.is_stable()) : Record(nullptr));
  r.set("harmonics", static_cast<long>((circle.points.cols() - 1) / 2));
  r.set("residual", circle.residual).set("tail", circle.tail);
  if (!report.failure.empty()) r.set("failure", report.failure);
  report.text = "Quasi-periodic motion" + (model.title.empty() ? "" : ": " + model.title) + "\n\n";
  if (circle.is_good()) {
    report.text += fmt::format(
        "  {} circle of {} harmonics, residual {:.1e} length scales, highest harmonics {:.0e} of "
        "the "
        "largest\n  it turns by {:.9f} in a revolution: lines {:.4f} rpm and multiples beside "
        "those of the speed\n  largest exponent across it {:+.6f} per revolution, along it "
        "{:+.0e}\n",
        circle.is_stable() ? "stable" : "unstable", (circle.points.cols() - 1) / 2, circle.residual,
        circle.tail, circle.rotation / period, circle.rotation / period * speed,
        circle.exponents(0) / period, circle.along / period);
  }
  if (!walks.points.empty()) {
    const ParameterAxis& axis = parameters->along.axis;
    Table table({axis.path + (axis.unit.empty() ? "" : " [" + axis.unit + "]"), "rotation",
                 "exponent per rev", "tail"});
    Record points = Record::array(), ends = Record::array();
    const std::size_t stride = std::max<std::size_t>(1, (walks.points.size() + 24) / 25);
    for (std::size_t i = 0; i < walks.points.size(); ++i) {
      const CirclePoint& s = walks.points[i];
      Record point;
      point.set("value", s.value).set("rotation_per_rev", s.rotation);
      point.set("largest_exponent_per_rev", s.growth).set("tail", s.tail);
      points.add(point);
      if (i % stride != 0 && i + 1 != walks.points.size()) continue;
      table.row({fmt::format("{:.8g}", s.value), fmt::format("{:.8f}", s.rotation),
                 fmt::format("{:+.6f}", s.growth), fmt::format("{:.0e}", s.tail)});
    }
    report.text += "\n" + table.text();
    for (const std::string& end : walks.ends) {
      ends.add(end);
      report.text += "  it ends: " + end + "\n";
    }
    r.set("parameter", axis.path).set("unit", axis.unit).set("points", points).set("ends", ends);
  }
  if (file && circle.is_good()) {
    MotionState on_it;
    on_it.y = circle.points.col(0);
    write_end(*file, at_first, *scene, on_it);
    const Mat map = scene->displacement_map();
    const Mat displacement = map * circle.points.topRows(n / 2);
    std::vector<double> angle;
    for (Eigen::Index j = 0; j < circle.points.cols(); ++j) {
      angle.push_back(2.0 * std::numbers::pi * double(j) / double(circle.points.cols()));
    }
    file->dataset("/torus/angle", angle, {"rad", "angle around the circle", {""}});
    file->dataset("/torus/displacement", Mat(displacement.transpose()),
                  {"m, rad", "displacement of all points at phase 0", {"/torus/angle", ""}});
    file->attribute("/torus", "rotation", circle.rotation / period);
    file->attribute("/torus", "period_revolutions", period);
    file->attribute("/torus", "stable", circle.is_stable() ? 1 : 0);
    if (!walks.points.empty()) {
      std::vector<double> value, rotation, growth, tail;
      for (const CirclePoint& s : walks.points) {
        value.push_back(s.value);
        rotation.push_back(s.rotation);
        growth.push_back(s.growth);
        tail.push_back(s.tail);
      }
      const ParameterAxis& axis = parameters->along.axis;
      file->dataset("/torus/value", value, {axis.unit, axis.path, {""}});
      const std::vector<std::string> axes{"/torus/value"};
      file->dataset("/torus/rotation", rotation, {"", "turns of the circle per revolution", axes});
      file->dataset("/torus/largest_exponent", growth,
                    {"", "largest exponent across the circle, per revolution", axes});
      file->dataset("/torus/tail", tail, {"", "highest harmonics by the largest", axes});
    }
  }
  commit(call, circle.is_good() ? file.get() : nullptr, report);
  return report;
}

}  // namespace

Verb torus_verb() {
  return {
      .name = "torus",
      .group = "Contact",
      .summary =
          "a quasi-periodic motion as an invariant circle, and along a parameter until it locks or "
          "breaks",
      .example = "whirl torus models/two_disk_mac.toml --discard 1500 --harmonics 33",
      .options = {{"over", "PATH=A:B:STEP",
                   "a value of the model along which the circle is followed"},
                  branch_points_option,
                  {"at", "VALUE",
                   "where the first circle is looked for, between first and last; left out: first"},
                  {"period", "N", "revolutions of the map that it is a circle of", "1"},
                  {"harmonics", "N", "of the circle at first, doubled up to 64", "16"},
                  {"revolutions", "N", "sections from which it is guessed", "1000"},
                  {"most", "N", "circles at most", "200"},
                  branch_discard_option,
                  tolerance_option,
                  from_option},
      .run = run_torus,
  };
}

}  // namespace whirl
