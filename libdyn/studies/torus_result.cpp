#include "libdyn/studies/torus_result.hpp"

#include <fmt/format.h>

#include <cmath>

#include "libbase/numerics/constants.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int largest_denominator = 12;  ///< of a locking that is named

/// A ratio of small integers.
struct Ratio {
  int p = 0, q = 1;
  double value() const { return double(p) / q; }
};

/// The one next to a rotation, to name what it locks to.
Ratio nearest_ratio(double rotation) {
  Ratio best;
  for (int q = 1; q <= largest_denominator; ++q) {
    const Ratio next{static_cast<int>(std::lround(rotation * q)), q};
    const double gain = std::abs(rotation - best.value()) - std::abs(rotation - next.value());
    if (gain > 1e-12) best = next;
  }
  return best;
}

std::string end_text(const CircleWalk& walk) {
  if (!walk.branch.end) return "stopped";
  const Ratio ratio = nearest_ratio(walk.points.back().rotation);
  return fmt::format("{} (rotation next to {}/{})", walk.branch.end->text, ratio.p, ratio.q);
}

/// Why there is no circle, and the ratio near which the motion turns.
std::string failure_text(const TorusBranch& torus) {
  const Ratio ratio = nearest_ratio(torus.motion_rotation);
  return fmt::format("{}; the motion turns by {:.9f} of the circle, {}/{} and {:+.1e}",
                     torus.circle.failure.text(), torus.motion_rotation, ratio.p, ratio.q,
                     torus.motion_rotation - ratio.value());
}

}  // namespace

std::optional<bool> TorusResult::is_stable() const {
  return is_good ? std::optional(stability == 1) : std::nullopt;
}

std::optional<std::string> TorusResult::path() const {
  return circles.empty() ? std::nullopt : std::optional(parameter.path);
}

std::optional<std::string> TorusResult::unit() const {
  return circles.empty() ? std::nullopt : std::optional(parameter.unit);
}

TorusResult torus_result(const Scene& scene, const TorusBranch& torus,
                         const ParameterName& parameter) {
  const InvariantCircle& circle = torus.circle;
  const double period = circle.period;
  const Eigen::Index count = circle.points.cols();
  TorusResult result{.angles = Vec(count),
                     .rotation = circle.rotation / period,
                     .period = circle.period,
                     .is_good = circle.is_good(),
                     .stability = circle.is_stable() ? 1 : 0,
                     .is_complete = torus.is_complete ? 1 : 0,
                     .exponents = circle.exponents / period,
                     .along = circle.along / period,
                     .harmonics = static_cast<int>((count - 1) / 2),
                     .residual = circle.residual,
                     .tail = circle.tail,
                     .parameter = parameter};
  for (Eigen::Index j = 0; j < count; ++j) {
    result.angles(j) = turn * static_cast<double>(j) / static_cast<double>(count);
  }
  const Mat coordinates = scene.contacts.layout().eta(circle.points);
  result.displacement = (scene.displacement_map() * coordinates).transpose();
  result.frequency = result.rotation * scene.contacts.Omega();
  if (!circle.is_good()) result.failure = failure_text(torus);
  for (const CirclePoint& p : torus.points()) result.circles.push_back({p});
  for (const CircleWalk& walk : torus.walks) {
    result.walks.push_back({EndTexts(walk.branch)});
    result.ends.push_back(end_text(walk));
  }
  return result;
}

}  // namespace whirl::inline dyn
