#include "libbase/numerics/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::inline base {

Vec harmonic_functions(double theta, int harmonics) {
  Vec phi(2 * harmonics + 1);
  phi(0) = 1.0;
  const Complex turn = std::polar(1.0, theta);
  Complex z = 1.0;
  for (int k = 1; k <= harmonics; ++k) {
    // afresh now and then, before rounding adds up
    z = k % 16 == 0 ? std::polar(1.0, k * theta) : z * turn;
    phi(2 * k - 1) = z.real();
    phi(2 * k) = z.imag();
  }
  return phi;
}

Vec harmonic_slopes(double theta, int harmonics) {
  return differentiated(harmonic_functions(theta, harmonics).transpose()).transpose() * -1.0;
}

Mat fourier_coefficients(const Mat& values, int harmonics) {
  const auto N = values.cols();
  Mat c = Mat::Zero(values.rows(), 2 * harmonics + 1);
  for (Eigen::Index i = 0; i < N; ++i) {
    const double theta = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(N);
    c.noalias() += values.col(i) * harmonic_functions(theta, harmonics).transpose();
  }
  c *= 2.0 / static_cast<double>(N);
  c.col(0) *= 0.5;
  return c;
}

Mat differentiated(const Mat& c) {
  Mat d = Mat::Zero(c.rows(), c.cols());
  for (Eigen::Index k = 1; k <= c.cols() / 2; ++k) {
    d.col(2 * k - 1) = static_cast<double>(k) * c.col(2 * k);
    d.col(2 * k) = -static_cast<double>(k) * c.col(2 * k - 1);
  }
  return d;
}

Mat with_harmonics(const Mat& c, int harmonics) {
  Mat other = Mat::Zero(c.rows(), 2 * harmonics + 1);
  const auto common = std::min(c.cols(), other.cols());
  other.leftCols(common) = c.leftCols(common);
  return other;
}

Periodic::Instant Periodic::at(double theta) const {
  const Vec phi = harmonic_functions(theta, harmonics());
  Instant now{coefficients * phi, Vec::Zero(coefficients.rows())};
  for (int k = 1; k <= harmonics(); ++k) {
    now.rate +=
        k * (phi(2 * k - 1) * coefficients.col(2 * k) - phi(2 * k) * coefficients.col(2 * k - 1));
  }
  now.rate *= frequency();
  return now;
}

}  // namespace whirl::inline base
