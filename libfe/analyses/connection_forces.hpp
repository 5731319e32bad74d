#pragma once
/// Forces of the rotor on its bearings, seals and links, and on oil films that are made linear.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libfe/assembly/assemble.hpp"
#include "libfe/parts/bearings/coefficients.hpp"

namespace whirl::inline fe {

/// A bearing, seal, link or linearized oil film of a structure, a support where it stands, or the
/// teeth of a pair of gears.
struct CarryingPart {
  /// "bearing", "seal", "link", "oil film", "support", "magnetic bearing", "gear"
  std::string_view kind;
  std::string name;
  Point from, to;         ///< the force acts from the first on the second
  bool is_rigid = false;  ///< the force follows from the equations of motion

  /// How far `from` is displaced from `to`, x and y.
  template <class Vector>
  Eigen::Matrix<typename Vector::Scalar, 2, 1> stretch(const DofMap& dofs,
                                                       const Vector& full) const {
    Eigen::Matrix<typename Vector::Scalar, 2, 1> d;
    for (int k = 0; k < 2; ++k) {
      const int a = dofs.full_index(from, k), b = dofs.full_index(to, k);
      d(k) = (a >= 0 ? full(a) : 0.0) - (b >= 0 ? full(b) : 0.0);
    }
    return d;
  }
};

/// The same parts in the order bearings, seals, links, oil films, supports, gears.
std::vector<CarryingPart> carrying_parts(const Assembler& assembler);

/// How a force on a rigid part is made of the equations of motion of all points.
enum class RigidRows {
  nodal,  ///< those of the part's own node: exact for a motion of all coordinates
  /// those of all points, weighted by the shape of the rotor that a displacement of the part makes:
  /// nearly exact for a motion of few modes, the method of mode acceleration
  static_shape
};

/// Forces of the rotor on all carrying_parts, x and y of each in turn, as linear functions of the
/// motion of all points q and of the loads f on them (full vectors, see DofMap):
///
///   F = K q + C q' + M q'' + L f
///
/// With d = u_from - u_to an elastic part has F = K d + C d' + M d'', a rigid one what is missing
/// in the equations of motion of its node, f - M q'' - (C + Omega G) q' - (K + Omega H) q. Moments
/// of clamps are not told. The teeth of gears push along their line of action, by the motion of
/// both wheels with their tilts.
struct ConnectionForces {
  Sparse K, C, M, L;  ///< 2 parts x full vector [N/m ...], [N.s/m ...], [kg ...], [-]

  /// @param Omega, omega  spin, and frequency of the motion that coefficients are taken at [rad/s]
  ConnectionForces(const Assembler& assembler, double Omega, double omega,
                   RigidRows rigid = RigidRows::nodal);

  /// Complex amplitudes under a motion Re(q e^(i omega t)) [N].
  CVec at(double omega, const CVec& q, const CVec& load) const;
  /// Forces of a displacement that lasts [N].
  Vec at_rest(const Vec& q, const Vec& load) const { return K * q + L * load; }
};

}  // namespace whirl::inline fe
