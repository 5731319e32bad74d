#pragma once
/// Which modes make up a motion that is known by its spectra, simulated or measured.

#include <functional>
#include <vector>

#include "libdyn/motions/identify.hpp"

namespace whirl::inline dyn {

/// Spectra of a motion; lines go by their signed number.
struct MotionLines {
  double bin = 0.0;  ///< distance of lines [rad/s]
  Vec total;         ///< magnitude over all points together, in the order of Spectrum::lines [m]
  std::function<double(Eigen::Index)> radius{};  ///< largest radius of a point at a line [m]
  std::function<CVec(Eigen::Index)> shape{};  ///< complex amplitudes that are compared with modes
};

/// The modes of a model at its speed that a motion is compared with.
std::vector<Mode> compared_modes(const Model& model, const Scene& scene,
                                 const IdentifyOptions& options);

/// Identifies the modes in spectra.
///
/// @param shapes   a column per mode, of what `lines.shape` gives
/// @param weights  of the MAC
/// @param forced   frequencies of excitations
Identification identify(const MotionLines& lines, std::vector<Mode> modes, const CMat& shapes,
                        const Sparse& weights, const std::vector<ForcedLine>& forced, double Omega,
                        const IdentifyOptions& options);

}  // namespace whirl::inline dyn
