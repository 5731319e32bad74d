#pragma once
/// Lyapunov exponents from the growth of tangents, and how well they are known.

#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline dyn {

struct ExponentEstimate {
  Vec exponents;  ///< descending [1/revolution]
  /// An exponent of zero comes out within +-this [1/revolution]: (1 + ln T) / T for T revolutions,
  /// as tangents of a torus grow no faster than T.
  double zero = 0.0;
  /// The largest exponent of 99 of 100 motions is within +-this of its limit [1/revolution].
  double resolution = 0.0;
};

/// Means of the growth per revolution, without the first quarter of the revolutions, in which
/// tangents turn to where they grow most.
///
///   resolution = 2 zero + 2.5 s / sqrt(16),   s: standard deviation of the means of 16 batches
///
/// The first term is for what is bounded, the second one for chance; the factors are measured:
/// bench/exponent_coverage.cpp, docs/validation.md.
///
/// @param growths  logarithms of what orthogonal tangents have grown by, a row for each tangent, a
///                 column per revolution, at least one of each
/// @source [Benettin1980] for the means
ExponentEstimate estimate_exponents(const Mat& growths);

/// How exponents settle: estimates from the first revolutions alone.
struct ExponentPath {
  std::vector<double> revolutions;  ///< that each estimate is of
  Mat exponents;                    ///< descending, a column per estimate [1/revolution]
};

/// The path at so many numbers of revolutions at most, evenly spread up to all revolutions.
ExponentPath exponent_path(const Mat& growths, Eigen::Index most);

}  // namespace whirl::inline dyn
