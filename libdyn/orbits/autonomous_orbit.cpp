#include "libdyn/orbits/autonomous_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/floquet.hpp"
#include "libbase/numerics/newton.hpp"
#include "libbase/system/interruption.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/system/require_coordinates.hpp"
#include "libdyn/taylor/batch.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double isotropic = 1e-9;   ///< relative, to which rotations must not matter
constexpr double nearby = 0.3;       ///< of the way that a motion goes, for a recurrence
constexpr int most_parts = 128;      ///< of a period, that are tried as a shorter one
constexpr double same_place = 1e-6;  ///< of states after a shorter period
constexpr double still = 1e-7;       ///< motions below stand still [length scales]

/// A quarter turn about the axis, in reduced coordinates.
Mat quarter_turn(const Scene& scene) {
  const Mat map = scene.displacement_map();
  const DofMap& dofs = scene.reduced.dofs;
  const Eigen::Index n = map.cols();
  const std::vector<Point> points = dofs.points();
  Mat rows(4 * std::ssize(points), n), turned = rows;
  rows.setZero();
  turned.setZero();
  Eigen::Index k = 0;
  for (const Point& p : points) {
    for (const auto& [a, b] : {std::pair{X, Y}, {THETA_X, THETA_Y}}) {
      const int x = dofs.full_index(p, a), y = dofs.full_index(p, b);
      if (x < 0 || y < 0) continue;
      rows.row(k) = map.row(x), rows.row(k + 1) = map.row(y);
      turned.row(k) = -map.row(y), turned.row(k + 1) = map.row(x);
      k += 2;
    }
  }
  Mat S(n, n);
  for (Eigen::Index j = 0; j < n; ++j) S.col(j) = least_squares(rows, turned.col(j));
  if ((rows * S - turned).norm() > isotropic * rows.norm() ||
      (S * S + Mat::Identity(n, n)).norm() > isotropic * std::sqrt(double(n))) {
    throw NumericalError(
        "the rotating frame: the reduced motions are not closed under rotation, as those of "
        "bearings that differ along x and y");
  }
  return S;
}

/// Coordinates turned by an angle.
Mat turn_of(const Mat& S, double angle) {
  return std::cos(angle) * Mat::Identity(S.rows(), S.cols()) + std::sin(angle) * S;
}

/// A state turned by an angle.
Mat rotation(const Mat& S, double angle) {
  return StateLayout(S.rows()).to_both(turn_of(S, angle));
}

/// Where a motion begins that is z as seen from the rotor and ends at phase 0, where both frames
/// are the same, after an angle of the rotor [rad].
MotionState start_before(const Mat& S, const Vec& z, double angle) {
  MotionState start;
  start.phase = std::clamp(std::ceil(angle / turn) * turn - angle, 0.0, std::nextafter(turn, 0.0));
  start.y = rotation(S, start.phase) * z;
  return start;
}

NumericalError not_in_the_rotating_frame(const std::string& refusal) {
  return NumericalError(fmt::format("{}: {}", rotating_abilities.who, refusal));
}

/// Whether accelerations turn with the state and the phase, in contact and out of it.
void require_isotropy(const ContactSystem& system, const Mat& S) {
  const StateLayout layout = system.layout();
  Vec a(layout.coordinates()), b(layout.coordinates());
  for (const double size : {0.3, 3.0, 30.0}) {
    for (const double angle : {0.7, 2.9, 4.4}) {
      const Vec y = size * system.state_scale().cwiseProduct(
                               Vec::LinSpaced(layout.size(), -1.0, 1.0).array().sin().matrix());
      const Mat R = turn_of(S, angle);
      const Vec turned = layout.to_both(R) * y;
      system.acceleration(0.0, y.data(), a.data());
      system.acceleration(angle, turned.data(), b.data());
      if ((b - R * a).norm() > isotropic * a.norm()) {
        throw not_in_the_rotating_frame(rotating_abilities.refusal(Need::directions));
      }
    }
  }
}

}  // namespace

AutonomousOrbit find_autonomous_orbit(const AutonomousFlow& flow, const Vec& start, double period,
                                      int most_steps) {
  const Eigen::Index n = start.size();
  struct Passed {
    Vec state;
    double period;
    AutonomousFlow::Result arrival{};
    Mat tangent{};
    Vec gap{};  ///< and the motion along itself: 0
    double residual = std::numeric_limits<double>::infinity();
  };
  const Vec to_scale = flow.scale.cwiseInverse();
  const auto passed = [&](Vec state, double time) {
    Passed p{std::move(state), time};
    if (!(time > 0.1 * period && time < 10.0 * period)) {
      p.arrival.failure = "no periodic orbit: the period runs away";
      return p;
    }
    p.arrival = flow.go(p.state, time, WithTangent::yes);
    if (p.arrival.failure) return p;
    if (!p.arrival.end.allFinite() || !p.arrival.tangent.allFinite()) {
      p.arrival.failure = "the motion or its tangent is not finite";
      return p;
    }
    p.tangent = to_scale.asDiagonal() * p.arrival.tangent * flow.scale.asDiagonal();
    p.gap = Vec::Zero(n + 1);
    p.gap.head(n) = (p.arrival.end - p.state).cwiseProduct(to_scale);
    p.residual = p.gap.lpNorm<Eigen::Infinity>();
    return p;
  };
  const auto rate = [&](const Passed& p, const Vec& y) -> Vec {
    return flow.rate(y).cwiseProduct(to_scale) * p.period;
  };
  Passed at = passed(start, period);
  NewtonSearch search = newton(
      at,
      [&](const Passed& p) {
        return newton_step(autonomous_jacobian(p.tangent, rate(p, p.state), rate(p, p.arrival.end)),
                           p.gap);
      },
      [&](const Passed& p, const Vec& step) {
        return passed(p.state - flow.scale.cwiseProduct(step.head(n)), p.period * (1.0 - step(n)));
      },
      {.most_steps = most_steps});
  AutonomousOrbit cycle{.state = at.state, .period = at.period, .residual = at.residual};
  cycle.failure = at.arrival.failure;
  if (search.has_converged()) {
    cycle.multipliers = multipliers_across(at.tangent);
    cycle.contacts = at.arrival.contacts;
  } else if (search.end != NewtonEnd::undefined) {
    cycle.failure =
        search.failure("no periodic orbit", "the equations for state and period are singular");
  }
  cycle.residuals = std::move(search.residuals);
  return cycle;
}

Mat rotation(const Scene& scene, double angle) {
  return rotation(quarter_turn(scene), angle);
}

Mat autonomous_jacobian(const Mat& tangent, const Vec& start, const Vec& end) {
  Mat J(tangent.rows() + 1, tangent.cols() + 1);
  J << shooting_jacobian({&tangent, 1}), end, start.transpose(), 0.0;
  return J;
}

AutonomousOrbit shorten(const AutonomousFlow& flow, const AutonomousOrbit& cycle) {
  if (!cycle.is_good()) return cycle;
  for (int parts = most_parts; parts > 1; --parts) {
    const AutonomousFlow::Result at = flow.go(cycle.state, cycle.period / parts, WithTangent::no);
    if (at.failure) continue;
    const Vec gap = (at.end - cycle.state).cwiseQuotient(flow.scale);
    if (gap.lpNorm<Eigen::Infinity>() > same_place) continue;
    AutonomousOrbit shorter = find_autonomous_orbit(flow, cycle.state, cycle.period / parts);
    if (shorter.is_good()) return shorter;
  }
  return cycle;
}

MotionState rotating_start(const Scene& scene, const Vec& z, double revolutions) {
  return start_before(quarter_turn(scene), z, turn * revolutions);
}

AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, double tolerance) {
  const ContactSystem& system = scene->contacts;
  require_coordinates(system);
  if (!rotating_abilities.can(system)) {
    throw not_in_the_rotating_frame(rotating_abilities.refusal(system));
  }
  const Mat S = quarter_turn(*scene);
  require_isotropy(system, S);
  const double Omega = system.Omega();
  return {system.state_scale(), system.period(),
          [scene, S, tolerance](const Vec& z, double time,
                                WithTangent wanted) -> AutonomousFlow::Result {
            interruption_point();
            const double angle = scene->contacts.Omega() * time;
            Trajectory t{.system = &scene->contacts,
                         .state = start_before(S, z, angle),
                         .revolutions = static_cast<long>(std::ceil(angle / turn))};
            const Mat R = rotation(S, t.state.phase);
            integrate_single(
                t,
                {.tolerance = tolerance, .measures = true, .tangent = wanted == WithTangent::yes});
            if (t.outcome != Outcome::reached_end) return {.failure = t.failure};
            AutonomousFlow::Result at{.end = t.state.y, .contacts = shares_of(t.contacts, time)};
            if (wanted == WithTangent::yes) at.tangent = t.tangent * R;
            return at;
          },
          [scene, S, Omega](const Vec& z) -> Vec {
            const StateLayout layout = scene->contacts.layout();
            Vec rate(layout.size()), a(layout.coordinates());
            scene->contacts.acceleration(0.0, z.data(), a.data());
            layout.eta(rate) = layout.rate(z) - Omega * (S * layout.eta(z));
            layout.rate(rate) = a - Omega * (S * layout.rate(z));
            return rate;
          }};
}

AutonomousFlow rotating_flow(std::shared_ptr<const Scene> scene, const Scene& first,
                             double tolerance) {
  const AutonomousFlow own = rotating_flow(scene, tolerance);
  AutonomousFlow flow = own;
  flow.scale = first.contacts.state_scale();
  if (scene->reduced.Phi == first.reduced.Phi) return flow;
  const BasisChange change(*scene, first);
  flow.go = [own, change](const Vec& z, double time, WithTangent wanted) {
    AutonomousFlow::Result at = own.go(change.to(z), time, wanted);
    if (at.failure) return at;
    at.end = change.back(at.end);
    if (wanted == WithTangent::yes) at.tangent = change.back(at.tangent * change.matrix());
    return at;
  };
  flow.rate = [own, change](const Vec& z) -> Vec { return change.back(own.rate(change.to(z))); };
  return flow;
}

std::optional<double> recurrence(const Scene& scene, const Vec& start, long revolutions) {
  const ContactSystem& system = scene.contacts;
  const Mat S = quarter_turn(scene);
  Trajectory t{.system = &system, .revolutions = revolutions};
  t.state.y = start;
  std::vector<double> times, distances;
  Vec y(system.size());
  integrate_single(t, {}, [&](const Step& step) {
    for (int k = 1; k <= 4; ++k) {
      step.at(k / 4.0, y.data());
      const double phase = step.angle(k / 4.0);
      const Vec z = rotation(S, -phase) * y;
      times.push_back((static_cast<double>(step.revolution) + phase / turn) * system.period());
      distances.push_back(distance(system, z, start));
    }
    return true;
  });
  if (t.outcome != Outcome::reached_end || distances.empty()) return std::nullopt;
  const double farthest = *std::max_element(distances.begin(), distances.end());
  if (farthest < still) return std::nullopt;
  double nearest = nearby * farthest;
  std::optional<double> found;
  bool has_left = false;
  for (std::size_t i = 1; i + 1 < times.size(); ++i) {
    has_left = has_left || distances[i] > nearby * farthest;
    if (!has_left || distances[i] > distances[i - 1] || distances[i] > distances[i + 1]) continue;
    if (distances[i] < 0.5 * nearest) {  // a later one must be much nearer
      nearest = distances[i];
      found = times[i];
    }
  }
  return found;
}

}  // namespace whirl::inline dyn
