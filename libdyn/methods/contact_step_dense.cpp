// Dense output of a collocation step.

#include <algorithm>
#include <cmath>

#include "libdyn/legendre.hpp"
#include "libdyn/methods/contact_step.hpp"

namespace whirl {

namespace {

constexpr int points = 14;
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
  return dense_piece(from, rung_.level(), 0.0, 1.0, limit, from.y, a_, give);
}

bool ContactStep::dense_piece(const MotionState& from, int level, double start, double width,
                              double limit, const Vec& y, const Vec& a,
                              const std::function<bool(const Step&, const Vec&)>& give) {
  LinearFlow& flow = families_[static_cast<std::size_t>(rung_.family())]->flow;
  const Interpolation& table = interpolation();
  const double h = size(rung_), rate = system_.phase_rate();
  const Eigen::Vector3d load = load_at(from.phase + start * h * rate);
  const double part = std::min(1.0, (limit - start) / width);  // of the piece
  Mat values(points, y.size());
  Vec z = y;
  for (int i = 0; i < points; ++i) {
    z = y;
    if (i > 0) flow.advance(level, table.s(i) * part, load, a, touching_, z);
    values.row(i) = z.transpose();
  }
  const Mat legendre = table.to_legendre * values;
  const double error =
      (legendre.bottomRows(2).array().rowwise() / system_.state_scale().transpose().array())
          .abs()
          .maxCoeff();
  if (error > tolerance_ && level < rung_.level() + finest) {
    Vec half = a;
    flow.restrict_to_half(false, touching_, half);
    if (!dense_piece(from, level + 1, start, 0.5 * width, limit, y, half, give)) return false;
    const double middle = start + 0.5 * width;
    if (middle >= limit) return true;
    z = y;
    flow.advance(level + 1, 1.0, load, half, touching_, z);
    half = a;
    flow.restrict_to_half(true, touching_, half);
    return dense_piece(from, level + 1, middle, 0.5 * width, limit, z, half, give);
  }
  const auto n = system_.coordinates();
  const Mat powers = (table.to_powers * legendre).transpose();
  Step step;
  step.revolution = from.revolution;
  step.phase = from.phase + start * h * rate;
  step.h = part * width * h;
  step.turn = step.h * rate;
  step.q = powers.topRows(n);
  step.v = powers.bottomRows(n);
  step.contacts = from.contacts;
  return give(step, z);
}

}  // namespace whirl
