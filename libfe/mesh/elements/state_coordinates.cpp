#include "libfe/mesh/elements/state_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"

namespace whirl::inline fe {

namespace {

constexpr double alike = 1e-3;  ///< relative distance of real poles that are not paired
constexpr double singular = 1e-14;

/// The row l of a coordinate that stands for both states of a block of the Schur form.
struct PairRow {
  int first = 0;            ///< state
  double a = 1.0, b = 0.0;  ///< l over the two states
};

/// l with [l; l T] regular, for two real poles; nothing: none is good enough.
std::optional<PairRow> pair_of_real_poles(const Mat& T, int first) {
  const double p = T(first, first), q = T(first + 1, first + 1), t = T(first, first + 1);
  const double sign = t * (q - p) < 0.0 ? -1.0 : 1.0;
  const double determinant = t + sign * (q - p);
  const double size = std::abs(p) + std::abs(q);
  if (std::abs(determinant) <= alike * size) return std::nullopt;
  return PairRow{first, 1.0, sign};
}

/// Adds the second state of a real pole, w' = z - alpha w, to A.
void add_idle_state(Mat& A, int pole, double alpha) {
  const Eigen::Index n = A.rows();
  A.conservativeResize(n + 1, n + 1);
  A.row(n).setZero();
  A.col(n).setZero();
  A(n, pole) = 1.0;
  A(n, n) = -alpha;
}

/// Which states make a coordinate, and A with the idle ones.
struct Pairing {
  Mat A, L;
  std::vector<std::optional<double>> idle;
};

Pairing pairs_of(const Mat& T) {
  const auto n = static_cast<int>(T.rows());
  Pairing made{T, {}, {}};
  const double largest = T.cwiseAbs().maxCoeff();
  std::vector<PairRow> rows;
  for (int i = 0; i < n; ++i) {
    const bool has_next = i + 1 < n;
    if (has_next && T(i + 1, i) != 0.0) {
      rows.push_back({i++});
      made.idle.emplace_back();
      continue;
    }
    const bool next_is_real = has_next && (i + 2 == n || T(i + 2, i + 1) == 0.0);
    if (const auto pair = next_is_real ? pair_of_real_poles(T, i) : std::nullopt) {
      rows.push_back(*pair);
      ++i;
      made.idle.emplace_back();
      continue;
    }
    const double pole = T(i, i);
    const double alpha = pole != 0.0 ? 2.0 * std::abs(pole) : std::max(largest, 1.0);
    rows.push_back({static_cast<int>(made.A.rows())});
    add_idle_state(made.A, i, alpha);
    made.idle.emplace_back(-alpha);
  }
  made.L = Mat::Zero(std::ssize(rows), made.A.rows());
  for (Eigen::Index k = 0; k < made.L.rows(); ++k) {
    const auto& [first, a, b] = rows[static_cast<std::size_t>(k)];
    made.L(k, first) = a;
    if (b != 0.0) made.L(k, first + 1) = b;
  }
  return made;
}

/// Makes u enter each coordinate as strongly as the coordinate enters f.
void balance(StateCoordinates& c) {
  for (Eigen::Index k = 0; k < c.size(); ++k) {
    const double rate = std::sqrt(std::max(std::abs(c.K_w(k, k)), c.C_w(k, k) * c.C_w(k, k)));
    const double in = c.B_0.row(k).norm() + rate * c.B_1.row(k).norm();
    const double out = c.C_0.col(k).norm() + rate * c.C_1.col(k).norm();
    if (!(in > 0.0) || !(out > 0.0)) continue;
    const double scale = std::sqrt(in / out);  // w = scale times the new one
    c.B_0.row(k) /= scale;
    c.B_1.row(k) /= scale;
    for (Mat* M : {&c.K_w, &c.C_w}) {
      M->row(k) /= scale;
      M->col(k) *= scale;
    }
    c.C_0.col(k) *= scale;
    c.C_1.col(k) *= scale;
  }
}

}  // namespace

StateCoordinates state_coordinates(const StateSpace& law) {
  StateCoordinates c;
  const int n = law.states();
  if (n == 0) {
    c.D = law.D;
    c.K_w = c.C_w = Mat(0, 0);
    c.B_0 = c.B_1 = Mat(0, law.inputs());
    c.C_0 = c.C_1 = Mat(law.outputs(), 0);
    return c;
  }
  const auto schur = schur_form(law.A);
  if (!schur) throw NumericalError("the poles of a support cannot be computed");
  const Pairing pairing = pairs_of(schur->T);
  const Mat& A = pairing.A;
  const Mat& L = pairing.L;
  Mat B = Mat::Zero(A.rows(), law.inputs()), C = Mat::Zero(law.outputs(), A.rows());
  B.topRows(n) = schur->U.transpose() * law.B;
  C.leftCols(n) = law.C * schur->U;

  const Eigen::Index k = L.rows();
  const double rate = std::max(A.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Mat S(A.rows(), A.rows());
  S << L, L * A / rate;
  const DenseLu<Mat> states(S);
  if (!(states.rcond() > singular)) {
    throw NumericalError("the states of a support cannot be paired");
  }
  Mat back = states.solve(Mat::Identity(A.rows(), A.rows()));
  back.rightCols(k) /= rate;
  const Mat X = L * A * A * back, Y = C * back;
  const Mat LB = L * B;
  c.K_w = -X.leftCols(k);
  c.C_w = -X.rightCols(k);
  c.B_1 = LB;
  c.B_0 = L * A * B - X.rightCols(k) * LB;
  c.C_0 = Y.leftCols(k);
  c.C_1 = Y.rightCols(k);
  c.D = law.D - Y.rightCols(k) * LB;
  c.idle = pairing.idle;
  balance(c);
  return c;
}

double following_rate(const StateSpace& law) {
  if (law.states() == 0) return 1.0;
  const double fastest = eigenvalues(law.A).cwiseAbs().maxCoeff();
  return fastest > 0.0 ? 2.0 * fastest : 1.0;
}

StateCoordinates followed_states(const StateSpace& law) {
  const Eigen::Index n = law.states();
  const double alpha = following_rate(law);
  StateCoordinates c;
  c.C_w = alpha * Mat::Identity(n, n) - law.A;
  c.K_w = -alpha * law.A;
  c.B_0 = law.B;
  c.B_1 = Mat::Zero(n, law.inputs());
  c.C_0 = alpha * law.C;
  c.C_1 = law.C;
  c.D = law.D;
  c.idle.assign(static_cast<std::size_t>(n), -alpha);
  return c;
}

StateCoordinates state_coordinates(const Support& support) {
  if (support.coordinates) return *support.coordinates;
  return support.limits.empty() ? state_coordinates(support.law) : followed_states(support.law);
}

}  // namespace whirl::inline fe
