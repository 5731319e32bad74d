#include "apps/verbs/torus_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/constants.hpp"
#include "libio/text/table.hpp"

namespace whirl::inline cli {

namespace {

constexpr int largest_denominator = 12;  ///< of a locking that is named
constexpr std::size_t most_rows = 25;    ///< of the table of circles, and the last one

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

std::string end_text(const CircleWalk& walk) {
  if (!walk.branch.end) return "stopped";
  const auto [p, q] = nearest_ratio(walk.points.back().rotation);
  return fmt::format("{} (rotation next to {}/{})", walk.branch.end->text, p, q);
}

long harmonics_in(const InvariantCircle& circle) {
  return static_cast<long>((circle.points.cols() - 1) / 2);
}

void add_circle(Record& record, const InvariantCircle& circle, double speed) {
  const int period = circle.period;
  Record exponents = Record::array();
  for (const double e : circle.exponents) exponents.add(e / period);
  record.set("period_revs", period).set("rotation_per_rev", circle.rotation / period);
  record.set("frequency_rpm", circle.rotation / period * (speed / rpm));
  record.set("exponents_per_rev", exponents).set("along_per_rev", circle.along / period);
  record.set("stable", circle.is_good() ? Record(circle.is_stable()) : Record(nullptr));
  record.set("harmonics", harmonics_in(circle));
  record.set("residual", circle.residual).set("tail", circle.tail);
}

void add_walks(Record& record, const TorusBranch& torus, const ParameterAxis& axis) {
  Record points = Record::array(), ends = Record::array();
  for (const CirclePoint& p : torus.points()) {
    Record point;
    point.set("value", p.value).set("rotation_per_rev", p.rotation);
    point.set("largest_exponent_per_rev", p.growth).set("tail", p.tail);
    points.add(point);
  }
  for (const CircleWalk& walk : torus.walks) ends.add(end_text(walk));
  record.set("parameter", axis.path).set("unit", axis.unit);
  record.set("points", points).set("ends", ends);
}

std::string circle_text(const InvariantCircle& circle, double speed) {
  const double rotation = circle.rotation / circle.period;
  return fmt::format(
      "  {} circle of {} harmonics, residual {:.1e} length scales, highest harmonics {:.0e} of "
      "the "
      "largest\n  it turns by {:.9f} in a revolution: lines {:.4f} rpm and multiples beside "
      "those of the speed\n  largest exponent across it {:+.6f} per revolution, along it "
      "{:+.0e}\n",
      circle.is_stable() ? "stable" : "unstable", harmonics_in(circle), circle.residual,
      circle.tail, rotation, rotation * (speed / rpm), circle.exponents(0) / circle.period,
      circle.along / circle.period);
}

std::string walks_text(const TorusBranch& torus, const ParameterAxis& axis) {
  Table table({axis.path + (axis.unit.empty() ? "" : " [" + axis.unit + "]"), "rotation",
               "exponent per rev", "tail"});
  const std::vector<CirclePoint> points = torus.points();
  const std::size_t stride = std::max<std::size_t>(1, (points.size() + most_rows - 1) / most_rows);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % stride != 0 && i + 1 != points.size()) continue;
    const CirclePoint& p = points[i];
    table.row({fmt::format("{:.8g}", p.value), fmt::format("{:.8f}", p.rotation),
               fmt::format("{:+.6f}", p.growth), fmt::format("{:.0e}", p.tail)});
  }
  std::string text = "\n" + table.text();
  for (const CircleWalk& walk : torus.walks) text += "  it ends: " + end_text(walk) + "\n";
  return text;
}

}  // namespace

std::string failure_text(const TorusBranch& torus) {
  const auto [p, q] = nearest_ratio(torus.motion_rotation);
  return fmt::format("{}; the motion turns by {:.9f} of the circle, {}/{} and {:+.1e}",
                     torus.circle.failure, torus.motion_rotation, p, q,
                     torus.motion_rotation - double(p) / q);
}

void say_torus(Report& report, const Invocation& call, const Model& model, const TorusCall& asked,
               const TorusBranch& torus, std::size_t resumed) {
  const bool is_good = torus.circle.is_good();
  const double speed = asked.scene->contacts.Omega();
  Record& r = report.record;
  add_circle(r, torus.circle, speed);
  if (!report.failure.empty()) r.set("failure", report.failure);
  report.text = "Quasi-periodic motion" + (model.title.empty() ? "" : ": " + model.title) + "\n\n";
  if (is_good) report.text += circle_text(torus.circle, speed);
  if (!torus.walks.empty()) {
    add_walks(r, torus, asked.axis());
    r.set("resumed", static_cast<long>(resumed));
    report.text += walks_text(torus, asked.axis());
    if (resumed > 0) report.text += fmt::format("\n  {} circles were there already\n", resumed);
    if (report.status == 130 && call.has("out")) {
      report.text += "\n  stopped; the same line goes on from there\n";
    }
  }
  if (is_good && call.has("out")) {
    report.text += fmt::format("\n  result: {}\n", call.given.at("out"));
  }
}

}  // namespace whirl::inline cli
