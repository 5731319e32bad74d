#include "libdyn/linear/step_response.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libdyn/system/film_equilibrium.hpp"
#include "libdyn/system/layout.hpp"
#include "libdyn/system/scene.hpp"
#include "libfe/assembly/support_equations.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double near_end = 0.02;   ///< within which a response has settled
constexpr double singular = 1e-14;  ///< reciprocal condition number of a stiffness

/// The closed loops in few coordinates: eta'' = b - K eta - D eta'.
class ReducedLoops {
 public:
  ReducedLoops(const Scene& scene, double h)
      : back_(scene.displacement_map()),
        mass_(scene.reduced.M),
        K_(mass_.solve(scene.reduced.stiffness())),
        D_(mass_.solve(scene.reduced.D())),
        layout_(K_.rows()),
        h_(h) {}

  /// The motion of a row at instants h apart.
  /// @param load   of the full vector, that acts from time 0 on
  /// @param kick   of the full vector, its impulse at time 0
  Vec response(const Vec& row, const Vec& load, const Vec& kick, std::size_t count) const {
    const Eigen::Index size = layout_.size();
    Mat A = Mat::Zero(size + 1, size + 1);
    A.topLeftCorner(size, size) = layout_.first_order(K_, D_);
    A.col(size).segment(layout_.place_of_rate(0), layout_.coordinates()) = accelerations(load);
    const Mat step = (h_ * A).exp();
    const Vec seen = back_.transpose() * row;
    Vec y = Vec::Zero(size + 1), found(static_cast<Eigen::Index>(count));
    y(size) = 1.0;
    layout_.rate(y) = accelerations(kick);
    for (double& value : found) {
      value = seen.dot(layout_.eta(y));
      y = (step * y).eval();
    }
    return found;
  }
  /// Where a response ends; NaN where nothing holds the rotor.
  double end(const Vec& row, const Vec& load) const {
    const DenseLu<Mat> factor(K_);
    if (!(factor.rcond() > singular)) return nan;
    return Vec(back_.transpose() * row).dot(Vec(factor.solve(accelerations(load))));
  }

 private:
  Vec accelerations(const Vec& full) const { return mass_.solve(Vec(back_.transpose() * full)); }

  Mat back_;
  DenseLu<Mat> mass_;
  Mat K_, D_;
  StateLayout layout_;
  double h_;
};

/// The instant at which a response first gets to a share of its end; NaN: never.
double first_at(double share, const Vec& response, double end, const std::vector<double>& times) {
  for (Eigen::Index k = 1; k < response.size(); ++k) {
    const double before = response(k - 1) / end - share, now = response(k) / end - share;
    if (before < 0.0 && now >= 0.0) {
      const auto i = static_cast<std::size_t>(k);
      return times[i - 1] + (times[i] - times[i - 1]) * before / (before - now);
    }
  }
  return nan;
}

void measure(LoopStep& step, const std::vector<double>& times) {
  step.force_largest = step.force.cwiseAbs().maxCoeff();
  const double end = step.reference_end;
  if (!(std::abs(end) > 0.0)) return;
  const Vec part = step.reference / end;
  step.overshoot = std::max(part.maxCoeff() - 1.0, 0.0);
  step.rise_time =
      first_at(0.9, step.reference, end, times) - first_at(0.1, step.reference, end, times);
  Eigen::Index last = part.size();
  while (last > 0 && std::abs(part(last - 1) - 1.0) <= near_end) --last;
  if (last < part.size()) step.settling_time = times[static_cast<std::size_t>(last)];
}

}  // namespace

StepResponse step_response(const Model& model, double duration, int count) {
  Model linear = model;
  linear.structure = linear_structure(model);
  linear.contacts.clear();
  linear.films.clear();
  const Scene scene = make_scene(linear);
  const Assembler& assembler = scene.assembler;
  const Structure& structure = assembler.structure();
  StepResponse result{.speed = model.speed, .times = {}, .steps = {}};
  const double h = duration / count;
  for (int k = 0; k <= count; ++k) result.times.push_back(k * h);
  const ReducedLoops closed(scene, h);
  for (std::size_t s = 0; s < structure.supports.size(); ++s) {
    const Support& support = structure.supports[s];
    for (int sensor = 0; sensor < support.sensors; ++sensor) {
      const SensorRows rows = sensor_rows(structure, assembler.mesh(), assembler.dofs(), s, sensor);
      LoopStep& step = result.steps.emplace_back();
      step.bearing = support.name;
      step.axis = sensor + 1;
      const Vec none = Vec::Zero(rows.sees.size());
      const std::size_t instants = result.times.size();
      step.reference = closed.response(rows.sees, rows.stiffness, rows.damping, instants);
      step.force = closed.response(rows.sees, rows.acts_on, none, instants);
      step.reference_end = closed.end(rows.sees, rows.stiffness);
      step.force_end = closed.end(rows.sees, rows.acts_on);
      measure(step, result.times);
    }
  }
  if (result.steps.empty()) {
    throw ModelError({}, "",
                     "the model has no control loop: add a [[magnetic_bearing]], or a [[support]] "
                     "with sensors");
  }
  return result;
}

}  // namespace whirl::inline dyn
