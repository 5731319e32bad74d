#pragma once
/// Responses of linear systems to random forces, exact at the samples, for tests of identification.

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "libbase/numerics/linalg.hpp"
#include "libbase/numerics/random.hpp"

namespace whirl::test {

/// Numbers of the normal distribution, the same on every machine.
inline Mat normal_numbers(std::mt19937_64& random, Eigen::Index rows, Eigen::Index columns) {
  return Mat::NullaryExpr(rows, columns,
                          [&](Eigen::Index, Eigen::Index) { return random_normal(random); });
}

/// e^A, by scaling, Taylor series and squaring.
inline Mat exponential(const Mat& A) {
  const int halvings = std::max(0, 3 + std::ilogb(A.cwiseAbs().rowwise().sum().maxCoeff()));
  const Mat small = std::ldexp(1.0, -halvings) * A;
  Mat sum = Mat::Identity(A.rows(), A.cols()), term = sum;
  for (int k = 1; k <= 16; ++k) sum += term = term * small / k;
  for (int k = 0; k < halvings; ++k) sum = sum * sum;
  return sum;
}

/// M q'' + C q' + K q = f under forces of normal distribution on every coordinate, each constant
/// between samples and independent of all others: exact at the samples by the matrix exponential.
///
/// @param warm  samples before the record, in which the start is forgotten
/// @return      displacements, times x coordinates
inline Mat random_response(const Mat& M, const Mat& C, const Mat& K, double spacing,
                           Eigen::Index samples, std::mt19937_64& random,
                           Eigen::Index warm = 2000) {
  const auto n = M.rows();
  const Mat inverse = M.inverse();
  Mat A = Mat::Zero(3 * n, 3 * n);  // (q, q', f), f' = 0
  A.block(0, n, n, n).setIdentity();
  A.block(n, 0, n, n) = -inverse * K;
  A.block(n, n, n, n) = -inverse * C;
  A.block(n, 2 * n, n, n) = inverse;
  const Mat step = exponential(spacing * A).topRows(2 * n);
  Mat record(samples, n);
  Vec y = Vec::Zero(3 * n);
  for (Eigen::Index t = -warm; t < samples; ++t) {
    if (t >= 0) record.row(t) = y.head(n).transpose();
    y.tail(n) = normal_numbers(random, n, 1);
    y.head(2 * n) = (step * y).eval();
  }
  return record;
}

/// What channels read of modes that noise drives, each by itself: y(t) = Re sum shape z(t),
///
///   z(t + dt) = e^(lambda dt) z(t) + sqrt(1 - |e^(lambda dt)|^2) w(t)
///
/// with complex w of variance one.
///
/// so that covariances at the samples are those of the eigenvalues, exactly.
///
/// @param shapes  channels x modes
/// @return        times x channels
inline Mat modal_response(const CVec& eigenvalues, const CMat& shapes, double spacing,
                          Eigen::Index samples, std::mt19937_64& random, Eigen::Index warm = 2000) {
  const CVec step = (spacing * eigenvalues).array().exp();
  const Vec size = (0.5 * (1.0 - step.cwiseAbs2().array())).sqrt();
  Mat record(samples, shapes.rows());
  CVec z = CVec::Zero(step.size());
  for (Eigen::Index t = -warm; t < samples; ++t) {
    if (t >= 0) record.row(t) = (shapes * z).real().transpose();
    const Mat w = normal_numbers(random, z.size(), 2);
    z = step.cwiseProduct(z) +
        size.cast<Complex>().cwiseProduct(w.col(0) + Complex(0, 1) * w.col(1));
  }
  return record;
}

/// Noise of sensors: a share of each channel's standard deviation.
inline Mat with_noise(const Mat& record, double share, std::mt19937_64& random) {
  const Eigen::RowVectorXd deviation =
      (record.rowwise() - record.colwise().mean()).colwise().norm() /
      std::sqrt(static_cast<double>(record.rows()));
  return record +
         share * normal_numbers(random, record.rows(), record.cols()) * deviation.asDiagonal();
}

/// Masses in a row, the first sprung to the ground, the last free.
struct MassChain {
  Mat M, C, K;
  Vec frequencies;  ///< undamped, of the modes [rad/s]
  Mat shapes;       ///< columns, of mass one
};
/// With the same damping ratio in every mode.
///
///   omega_j = 2 sqrt(k / m) sin((2 j - 1) pi / (2 (2 n + 1))),
///   phi_ij ~ sin((2 j - 1) i pi / (2 n + 1))
///
/// @source [Blevins1979], chains of equal masses
inline MassChain mass_chain(int n, double m, double k, double zeta) {
  MassChain chain{m * Mat::Identity(n, n), Mat(), Mat::Zero(n, n), Vec(n), Mat(n, n)};
  for (int i = 0; i < n; ++i) {
    chain.K(i, i) = i + 1 < n ? 2.0 * k : k;
    if (i > 0) chain.K(i, i - 1) = chain.K(i - 1, i) = -k;
  }
  const double angle = std::numbers::pi / (2.0 * n + 1.0);
  for (int j = 0; j < n; ++j) {
    chain.frequencies(j) = 2.0 * std::sqrt(k / m) * std::sin(0.5 * (2 * j + 1) * angle);
    for (int i = 0; i < n; ++i) chain.shapes(i, j) = std::sin((2 * j + 1) * (i + 1) * angle);
    chain.shapes.col(j) /= std::sqrt(m) * chain.shapes.col(j).norm();
  }
  const Mat modal = chain.M * chain.shapes;
  chain.C = modal * Vec(2.0 * zeta * chain.frequencies).asDiagonal() * modal.transpose();
  return chain;
}

}  // namespace whirl::test
