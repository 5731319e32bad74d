#pragma once
/// Casings and foundations of finite element programs, in few coordinates.

#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libfe/parts/support.hpp"

namespace whirl::inline fe {

/// Matrices of a structure: M q'' + C q' + K q = f, symmetric.
template <class Matrix>
struct StructureMatrices {
  Matrix M, C, K;  ///< n x n; C without rows: no damping

  int size() const { return static_cast<int>(K.rows()); }
};

/// The structure in the displacements of an interface, which come first, and the lowest modes with
/// the interface held: constraint modes -K_ii^-1 K_ib and modes K_ii phi = omega^2 M_ii phi.
///
/// @param interface  coordinates that something is attached to, from 0
/// @param modes      how many; all, if there are not more. Coordinates without inertia, as the
///                   rotations of lumped masses, make none
/// @throws NumericalError  if the structure moves with its interface held, or the modes do not
///                         converge
/// @source [CraigBampton1968]
StructureMatrices<Mat> craig_bampton(const StructureMatrices<Sparse>& structure,
                                     const std::vector<int>& interface, int modes);

/// Makes such a structure the law of a support, in coordinates in which its matrices stay
/// symmetric.
///
/// With w the amplitudes of the modes and P their inertia beside that of the interface, v = w + P u
/// has no inertia force of u in its equation:
///
///   v'' + C_w v' + K_w v = K_w P u + (C_w P - C_wu) u'
///
/// @param support  whose law it becomes; the coordinates that it acts on are the first ones
void set_law(Support& support, const StructureMatrices<Mat>& reduced);

}  // namespace whirl::inline fe
