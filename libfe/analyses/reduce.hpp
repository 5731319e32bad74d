#pragma once
/// Reduction of a system to the few shapes that a scene needs.

#include <array>
#include <tuple>
#include <vector>

#include "libbase/structs/field.hpp"
#include "libfe/assembly/assemble.hpp"

namespace whirl::inline fe {

enum class ReductionMethod {
  automatic,       ///< none up to 12 dofs, modal_residual above
  modal,           ///< lowest undamped modes at rest
  modal_residual,  ///< and static shapes of given loads
  damped,          ///< real and imaginary parts of the damped modes at speed
  none             ///< every freedom
};
constexpr auto choices(ReductionMethod) {
  return std::array{Choice<ReductionMethod>{"modal", ReductionMethod::modal},
                    Choice<ReductionMethod>{"modal+residual", ReductionMethod::modal_residual},
                    Choice<ReductionMethod>{"damped", ReductionMethod::damped},
                    Choice<ReductionMethod>{"none", ReductionMethod::none}};
}

struct Reduction {
  ReductionMethod method = ReductionMethod::automatic;
  int modes = 0;            ///< size without static shapes; 0: as many as the tolerance needs
  double tolerance = 1e-3;  ///< of eigenvalues in the band and of the receptance at `ports`
  double band = 0.0;        ///< highest frequency of interest [rad/s]; 0: twice the spin

  bool operator==(const Reduction&) const = default;

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        alternative("method", &Reduction::method, "", any, "how the rotor is reduced"),
        alternative("modes", &Reduction::modes, "", positive,
                    "left out: as many as the tolerance needs"),
        optional("tolerance", &Reduction::tolerance, "", positive,
                 "of eigenvalues and contact receptances in the band"),
        alternative("band", &Reduction::band, "rad/s", positive,
                    "highest frequency of interest; left out: twice the speed")};
  }
};

/// Equations of motion in few coordinates, q = Phi eta, m x m. Every matrix is reduced by itself,
/// so that they hold at another speed Omega as well as those of the System do.
struct ReducedSystem : EquationsOfMotion<Mat> {
  Mat Phi;  ///< n x m; Phi^T M Phi = I, Phi^T K Phi diagonal but for skew parts ("none": identity)
  DofMap dofs;  ///< of the system that was reduced
};

struct ReductionError;

/// Reduces a system.
///
///   modal           K_s phi = omega^2 M phi at rest, with K_s the symmetric part of K
///   modal+residual  and K_s^-1 r for every row r of `ports` and `others`, made orthonormal
///   damped          Re and Im of the damped modes at speed, so that these are exact with real
///                   coordinates: one complex mode makes two of the `modes`
///   none            every freedom, M must be regular
///   automatic       none up to 12 dofs, modal+residual above
///
/// Damping, gyroscopics and skew stiffness are projected, not diagonalized: they stay full.
/// Where the number of modes is not given, it grows until both errors are below the tolerance.
///
/// @param system   n x n matrices; M positive definite
/// @param ports    rows of the points where contact forces act: their receptance is checked
/// @param others   rows of further points with forces of their own: dampers, unbalances; a bow's
///                 load
/// @param error    if not null, receives the error of the basis
/// @throws NumericalError  if M is singular, or an eigensolver fails
/// @source [Friswell2010], ch. 2; static shapes after [CraigChang1977]
ReducedSystem reduce(const System& system, const Reduction& how, const std::vector<Vec>& ports,
                     const std::vector<Vec>& others, ReductionError* error = nullptr);

/// A system in given shapes, n x m: Phi^T M Phi and so on.
ReducedSystem in_shapes(const System& system, const Mat& Phi);

/// Projects a system on a basis, M-orthonormal after a small eigenproblem.
ReducedSystem project(const System& system, const Mat& basis);

}  // namespace whirl::inline fe
