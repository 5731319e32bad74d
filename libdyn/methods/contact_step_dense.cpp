// Dense output of a collocation step.

#include <algorithm>
#include <cmath>

#include "libbase/numerics/legendre.hpp"
#include "libdyn/methods/contact_step.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int points = StepTables::samples;
constexpr int finest = 30;  ///< halvings of a step

/// Maps to coefficients, made once.
struct Interpolation {
  Vec s = chebyshev_points(points);
  Mat to_legendre = values_to_legendre(s);
  Mat to_powers = legendre_to_powers(points);
};
const Interpolation& interpolation() {
  static const Interpolation table;
  return table;
}

}  // namespace

bool ContactStep::dense(const MotionState& from, double limit,
                        const std::function<bool(const Step&, const Vec&)>& give) {
  return dense_piece(from, {forces_.motion().rung.level(), 0.0, 1.0}, limit, from.y,
                     forces_.motion().a, give);
}

bool ContactStep::dense_piece(const MotionState& from, const Part& part, double limit, const Vec& y,
                              const Vec& a,
                              const std::function<bool(const Step&, const Vec&)>& give) {
  const Rung rung = forces_.motion().rung;
  LinearFlow& flow = tables_.flow(rung);
  const Interpolation& table = interpolation();
  const double h = size(rung), rate = system_.phase_rate();
  const Eigen::Vector3d load = load_at(from.phase + part.start * h * rate);
  const StateLayout layout = system_.layout();
  bool is_short = flow.size(part.level) <= longest_piece_;
  if (is_short) {
    Vec all(y.size() + 3 + a.size());
    all << y, load, a;
    Mat values(layout.size(), points);
    values.col(0) = y;
    Eigen::Map<Vec>(values.col(1).data(), layout.size() * (points - 1)).noalias() =
        tables_.dense(rung, part.level) * all;
    const Mat legendre = values * table.to_legendre.transpose();
    // a motion that has grown has no finer digits than its size allows
    const Vec weight =
        system_.state_scale().cwiseMax(values.cwiseAbs().rowwise().maxCoeff() / StepForces::grown);
    const double error =
        (legendre.rightCols(2).array().colwise() / weight.array()).abs().maxCoeff();
    is_short = error <= tolerance_ ||
               part.level >= std::min(rung.level() + finest, LinearFlow::levels - 1);
    // the next step begins with pieces as long as these, or longer ones if they are too good
    longest_piece_ = is_short ? flow.size(part.level) * (error < 1e-2 * tolerance_ ? 2.1 : 1.1)
                              : flow.size(part.level) * 0.6;
    if (is_short) {
      Mat powers = legendre * table.to_powers.transpose();
      const double share = std::min(1.0, (limit - part.start) / part.width);
      double scale = 1.0;
      for (int k = 0; k < points && share < 1.0; ++k, scale *= share) powers.col(k) *= scale;
      Step step;
      step.set(system_.clock(), {from.phase + part.start * h * rate, from.revolution},
               share * part.width * h);
      step.q = layout.eta(powers);
      step.v = layout.rate(powers);
      step.contacts = from.contacts;
      return give(step, powers.rowwise().sum());
    }
  }
  const double middle = part.start + 0.5 * part.width;
  Vec half = a, z = y;
  flow.restrict_to_half(false, forces_.motion().touching, half);
  flow.advance(part.level + 1, 1.0, load, half, forces_.motion().touching, z);
  if (!dense_piece(from, {part.level + 1, part.start, 0.5 * part.width}, limit, y, half, give)) {
    return false;
  }
  if (middle >= limit) return true;
  half = a;
  flow.restrict_to_half(true, forces_.motion().touching, half);
  return dense_piece(from, {part.level + 1, middle, 0.5 * part.width}, limit, z, half, give);
}

}  // namespace whirl::inline dyn
