#include "libdyn/flow/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int most_doublings = 64;
constexpr double resonant = 1e-14;  ///< reciprocal condition number of a resonance
constexpr double careful = 1.0 - 1e-9;
/// Reciprocal condition number of modes that a motion is not told from: their sums lose six digits.
constexpr double dependent = 1e-6;
constexpr double undamped = 1e-12;  ///< decay by the fastest eigenvalue that rounding may be
constexpr double careful_of_modes = 1.0 - 1e-6;
constexpr double equal = 1e-6;  ///< difference of equal eigenvalues over their decay

/// y_p of y' = A y + F (1, cos, sin); nothing at a resonance or with a free rigid-body motion.
std::optional<Mat> periodic_motion(const ContactSystem& system) {
  const auto n = system.coordinates();
  const double w = system.phase_rate();
  const StateLayout layout = system.layout();
  Mat y = Mat::Zero(layout.size(), 3);
  auto eta = layout.eta(y), rate = layout.rate(y);
  if (!system.constant_load().isZero(0.0)) {
    const DenseLu<Mat> K(system.K());
    if (!(K.rcond() > resonant)) return std::nullopt;
    eta.col(0) = K.solve(system.constant_load());
  }
  const ReducedExcitation& load = system.synchronous_load();
  if (!load.is_zero()) {
    // (K - w^2 + i w D) q = cosine - i sine, eta = Re(q e^(i phase))
    const CMat dynamic = (system.K() - w * w * Mat::Identity(n, n)).cast<Complex>() +
                         Complex(0.0, w) * system.D().cast<Complex>();
    const DenseLu<CMat> lu(dynamic);
    if (!(lu.rcond() > resonant)) return std::nullopt;
    const CVec q =
        lu.solve(load.cosine.cast<Complex>() - Complex(0.0, 1.0) * load.sine.cast<Complex>());
    eta.col(1) = q.real();
    eta.col(2) = -q.imag();
    rate.col(1) = -w * q.imag();
    rate.col(2) = -w * q.real();
  }
  return y;
}

/// Largest distance of an ellipse center + c cos + s sin from the origin, from above.
double largest_radius(const Vec2& center, const Vec2& c, const Vec2& s) {
  constexpr int samples = 256;
  constexpr double spacing = 2.0 * std::numbers::pi / samples;
  double largest = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u = center + std::cos(spacing * i) * c + std::sin(spacing * i) * s;
    largest = std::max(largest, u.norm());
  }
  // between samples: the distance of an arc from its chord's ends
  return largest + (c.norm() + s.norm()) * spacing * spacing / 8.0;
}

/// Solution of A^T P + P A = -Q, or nothing if e^(A t) does not decay.
std::optional<Mat> lyapunov(const Mat& A, const Mat& Q) {
  // integral of e^(A^T t) Q e^(A t) over a short time by series, then P <- P + E^T P E, E <- E E
  const double h = 0.125 / balanced_norm(A);
  Mat E = Mat::Identity(A.rows(), A.cols()), power = E, P = h * Q, term = P;
  for (int m = 1; m < 16; ++m) {
    power = (h / m * (A * power)).eval();
    E += power;
    term = (h / (m + 1) * (A.transpose() * term + term * A)).eval();
    P += term;
  }
  for (int k = 0; k < most_doublings; ++k) {
    const Mat more = E.transpose() * P * E;
    if (!more.allFinite()) return std::nullopt;
    P += more;
    if (more.diagonal().cwiseAbs().cwiseQuotient(P.diagonal()).maxCoeff() < 1e-12) return P;
    E = (E * E).eval();
  }
  return std::nullopt;
}

/// Nothing where a revolution is too long beside the fastest motion, nor under loads that do not
/// repeat with it.
std::optional<LinearFlow> flow_over_a_revolution(const ContactSystem& system) {
  // what saturates is not told from displacements alone
  const bool saturates = has_need(system, Need::saturation);
  if (saturates || !LinearFlow::abilities.can(system)) return std::nullopt;
  try {
    return LinearFlow(system, system.period(), 1);
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace

FreeFlight::FreeFlight(const ContactSystem& system)
    : system_(system), flow_(flow_over_a_revolution(system)) {}

void FreeFlight::prepare() {
  is_prepared_ = true;
  if (!flow_) return;  // whoever asks whether it decays wants to finish it
  const StateLayout layout = system_.layout();
  const auto motion = periodic_motion(system_);
  if (!motion) return;
  periodic_ = *motion;
  const auto eta = layout.eta(periodic_);

  // weights what contacts see, and everything a little
  Mat Q = Mat::Zero(layout.size(), layout.size());
  Q.diagonal() = 1e-4 * system_.state_scale().cwiseAbs2().cwiseInverse();
  for (const ReducedContact& c : system_.contacts()) {
    if (c.place > 0) continue;
    const Mat U = projection_of(c.geometry) * c.U;
    layout.eta(Q).leftCols(layout.coordinates()) += U.transpose() * U / (c.clearance * c.clearance);
  }
  const auto P = lyapunov(first_order_matrix(system_), Q);
  if (!P) return;
  P_ = 0.5 * (*P + P->transpose());
  if (!(symmetric_modes(P_).values(0) > 0.0)) return;
  const DenseLu<Mat> factors(P_);
  decays_ = true;
  for (const ReducedContact& c : system_.contacts()) {
    if (c.place > 0) continue;  // as for the first: none touches before u has the slack
    Mat rows = Mat::Zero(layout.size(), 2);
    const Mat2 seen = projection_of(c.geometry);
    const Mat U = seen * c.U;
    layout.eta(rows) = U.transpose();
    const Mat spread = rows.transpose() * factors.solve(rows);
    const double reach = symmetric_modes(0.5 * (spread + spread.transpose())).values(1);
    const double left =
        careful * slack_of(c.geometry, c.clearance) -
        largest_radius(U * eta.col(0) - seen * c.offset, U * eta.col(1), U * eta.col(2));
    left_.push_back(left);
    room_.push_back(left > 0.0 ? careful * left * left / reach : -1.0);
  }
}

bool FreeFlight::is_certain(const MotionState& state) {
  if (!flow_) return false;
  if (system_.contacts().empty()) return true;
  for (const ContactState& c : state.contacts) {
    if (c.touch != Touch::apart) return false;
  }
  if (!is_prepared_) prepare();
  if (!decays_) return false;
  const Vec z = state.y - steady_state(state.phase);
  const double size = z.dot(P_ * z);
  return std::all_of(room_.begin(), room_.end(), [&](double room) { return size < room; }) ||
         is_certain_by_modes(z);
}

bool FreeFlight::decays() {
  if (!is_prepared_) prepare();
  return decays_;
}

Vec FreeFlight::steady_state(double phase) const {
  return periodic_ * load_at(phase);
}

void FreeFlight::prepare_modes() {
  has_modes_ = true;
  const Vec scale = system_.state_scale();
  const auto modes = general_modes(scale.cwiseInverse().asDiagonal() * first_order_matrix(system_) *
                                   scale.asDiagonal());
  if (!modes) return;
  const double fastest = modes->values.cwiseAbs().maxCoeff();
  if (!(modes->values.real().maxCoeff() < -undamped * fastest)) return;
  const DenseLu<CMat> factors(modes->vectors);
  if (!(factors.rcond() > dependent)) return;
  const StateLayout layout = system_.layout();
  const Mat to_scale = scale.cwiseInverse().asDiagonal();
  to_modes_ = factors.solve(to_scale.cast<Complex>());
  seen_.resize(2 * std::ssize(left_), layout.size());
  Eigen::Index row = 0;
  for (const ReducedContact& c : system_.contacts()) {
    if (c.place > 0) continue;
    seen_.middleRows(row, 2) = projection_of(c.geometry) * c.U * layout.eta(scale).asDiagonal() *
                               layout.eta(modes->vectors);
    row += 2;
  }
  apart_ = Vec::Zero(layout.size());
  for (Eigen::Index j = 0; j < layout.size(); ++j) {
    groups_.push_back(j);
    for (Eigen::Index first = 0; first < j; ++first) {
      const double damping_times =
          std::abs(modes->values(j) - modes->values(first)) / std::abs(modes->values(first).real());
      if (groups_[static_cast<std::size_t>(first)] != first || damping_times > equal) continue;
      groups_.back() = first;
      apart_(j) = damping_times;
      break;
    }
  }
}

bool FreeFlight::is_certain_by_modes(const Vec& z) {
  if (!has_modes_) prepare_modes();
  if (to_modes_.size() == 0) return false;
  const CVec w = to_modes_ * z;
  for (Eigen::Index i = 0; i < std::ssize(left_); ++i) {
    const CMat moved = seen_.middleRows(2 * i, 2) * w.asDiagonal();
    CMat together = CMat::Zero(2, w.size());
    double reached = 0.0;
    for (Eigen::Index j = 0; j < w.size(); ++j) {
      together.col(groups_[static_cast<std::size_t>(j)]) += moved.col(j);
      reached += apart_(j) * moved.col(j).norm();
    }
    for (Eigen::Index g = 0; g < w.size(); ++g) {
      reached += Orbit(together(0, g), together(1, g)).major();
    }
    if (!(reached < careful_of_modes * left_[static_cast<std::size_t>(i)])) return false;
  }
  return true;
}

void FreeFlight::finish(MotionState& state, long last_revolution) {
  if (!is_prepared_) prepare();
  const double whole = 2.0 * std::numbers::pi;
  if (state.phase > 0.0 && state.revolution < last_revolution) {
    flow_->advance(0, 1.0 - state.phase / whole, load_at(state.phase), {}, {}, state.y);
    state.phase = 0.0;
    ++state.revolution;
  }
  if (state.revolution >= last_revolution) return;

  // y <- (I + X) y + b for one revolution; about y_p there is no b
  const bool has_center = periodic_.size() > 0;
  const Eigen::Vector3d load = load_at(0.0);
  Mat X = flow_->table(0).X;
  Vec b = flow_->table(0).L * load, center = Vec::Zero(state.y.size());
  if (has_center) {
    center = periodic_ * load;
    b.setZero();
  }
  Vec z = state.y - center;
  for (long left = last_revolution - state.revolution;;) {
    if (left % 2 == 1) z += (X * z + b).eval();
    left /= 2;
    if (left == 0) break;
    b += (b + X * b).eval();
    X = (2.0 * X + X * X).eval();
  }
  state.y = z + center;
  state.revolution = last_revolution;
}

}  // namespace whirl::inline dyn
