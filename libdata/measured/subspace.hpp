#pragma once
/// Covariance-driven stochastic subspace identification: modes from the responses of a structure to
/// forces that nobody knows.

#include <vector>

#include "libdata/measured/pole.hpp"

namespace whirl::inline data {

/// Sums of products of samples that are some samples apart, S_k = sum over t of y(t + k) y(t)^T.
struct OutputProducts {
  std::vector<Mat> sums;  ///< channels x channels, of lags 0, 1, ...
  double count = 0.0;     ///< products in each sum

  /// The products of both stretches together.
  OutputProducts& operator+=(const OutputProducts& other);
  OutputProducts& operator-=(const OutputProducts& other);
};

/// Products that begin in a stretch of a record.
///
/// @param samples  times x channels, of mean zero
/// @param lags     number of lags, from 0 on
/// @param first    beginning of the stretch; count: its samples, first + count + lags <= times + 1
OutputProducts output_products(const Mat& samples, int lags, Eigen::Index first,
                               Eigen::Index count);

/// Models of all orders up to a largest one, from one decomposition.
///
/// With covariances R_k = E[y(t + k) y(t)^T] of a linear system under white noise, R_k = C A^(k-1)
/// G, so that the block Toeplitz matrix of R_1 ... R_(2i-1) is the product of an observability
/// matrix O and a controllability matrix,
///
///   T = [R_i ... R_1; R_(i+1) ... R_2; ...; R_(2i-1) ... R_i] = U S V^T,   O = U S^(1/2)
///
/// C is the first block of O, and A is its shift: O without its last block, times A, is O without
/// its first block, by least squares. The scale S^(1/2) changes coordinates only and is left out. O
/// of order n is the first n columns of U, so that one QR decomposition gives the A of every order.
///
/// @source [PeetersDeRoeck1999]; all orders from one QR [DoehlerMevel2012]
class SubspaceModels {
 public:
  /// @param products    lags 0 to 2 block_rows - 1
  /// @param most_order  at most channels (block_rows - 1)
  SubspaceModels(const OutputProducts& products, int block_rows, int most_order);

  /// The largest order; below what was asked for where the data are of a system of lower order.
  int most_order() const { return static_cast<int>(R_.cols()); }
  const Vec& singular_values() const { return singular_values_; }  ///< of T, descending

  /// Oscillating poles of the model of an order, ascending in frequency; oscillations may grow,
  /// too.
  ///
  /// A = e^(A_c dt): lambda = ln(mu) / dt, shape = C psi.
  /// @param spacing  time between samples [s]
  std::vector<Pole> poles(int order, double spacing) const;

 private:
  Vec singular_values_;
  Mat C_;            ///< channels x most_order
  Mat R_, shifted_;  ///< R A = shifted for the largest order; for others, their upper left corners
};

}  // namespace whirl::inline data
