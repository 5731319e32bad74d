#pragma once
/// Frequency-domain decomposition: modes from the singular values of spectral matrices.

#include <vector>

#include "libbase/numerics/cross_spectra.hpp"
#include "libbase/structs/column.hpp"
#include "libdata/measured/pole.hpp"

namespace whirl::inline data {

/// A peak of the largest singular value.
struct DecomposedMode : Pole {
  double line = 0.0;    ///< frequency of the highest line [rad/s]
  double height = 0.0;  ///< the singular value there [1/Hz]

  static constexpr auto columns() {
    return ColumnList{
        column("line", &DecomposedMode::line, "rad/s", "spectral line of the peak"),
        column("height", &DecomposedMode::height, "1/Hz", "largest singular value there"),
        column("eigenvalue", &DecomposedMode::lambda, "rad/s", "eigenvalue").as("eigenvalue"),
        column("frequency", &DecomposedMode::frequency, "rad/s", "damped natural frequency"),
        column("damping_ratio", &DecomposedMode::damping_ratio, "", "damping ratio"),
        column("log_decrement", &DecomposedMode::log_decrement, "", "logarithmic decrement"),
        column("shape", &DecomposedMode::shape, "", "complex shape, the largest entry one")
            .along("channels")};
  }
};

/// Singular values of spectral matrices, and their vectors.
struct Decomposition {
  double bin = 0.0;  ///< distance of lines [rad/s]
  Mat values;        ///< channels x lines, the largest first
  CMat first;        ///< channels x lines: singular vectors of the largest values
};

/// @source [Brincker2001]; the matrices are Hermitian and have no negative eigenvalues, which are
///         their singular values
Decomposition decomposed(const CrossSpectra& spectra);

/// Peaks of the first singular value, with frequency and damping from their neighborhood.
///
/// A peak is the highest line within three lines to either side, and 3 exp(4 / sqrt(segments))
/// times as high as the lowest line on the way to any higher one: lines of noise scatter by less.
/// The bell of a peak is the spectral matrix along the peak's singular vector u, G_u = u* G u, on
/// the lines around the peak, to where G_u falls below a thirtieth of the peak or rises to more
/// than twice its lowest value so far, as part of another bell. The inverse transform of the bell
/// is the correlation of one oscillator as a rotating pointer,
///
///   r(t) ~ e^(lambda t),   lambda from a straight line through ln r between 0.9 r(0) and 0.3 r(0),
///
/// where r is divided first by the correlation of the window, which would count as damping. A bell
/// of fewer than five lines tells no damping: NaN.
///
/// @source enhanced decomposition [Brincker2001b]; along a singular vector [ZhangWangTamura2010]
std::vector<DecomposedMode> decomposed_modes(const CrossSpectra& spectra, const Decomposition& d);

}  // namespace whirl::inline data
