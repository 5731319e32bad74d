#pragma once
/// Which modes of the rotor the Floquet multipliers of an orbit belong to.

#include <optional>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

/// The mode that the eigenvector of a multiplier is most like.
struct MultiplierMode {
  int mode = 0;      ///< number from 1, as `modes` lists them; 0: there is none
  double mac = 0.0;  ///< how much alike; 1: the same shape, as without contact

  static constexpr auto columns() {
    using M = MultiplierMode;
    return ColumnList{
        column(
            "mode", [](const M& m) { return m.mode > 0 ? std::optional(m.mode) : std::nullopt; },
            "", "number of the mode; null: there is none"),
        column("mac", &M::mac, "", "how much the multiplier is like it")};
  }
};

/// Compares the eigenvectors of an orbit's tangent with the complex modes of the rotor alone, as
/// states at phase 0, weighted with their kinetic energy:
///
///   MAC = |v* W z|^2 / (v* W v  z* W z),   z = (Omega eta, lambda eta),   W = diag(M, M)
///
/// and the same with the conjugate of z. Contacts mix modes: then the best MAC is far from 1.
///
/// @param orbit  with tangents and multipliers
/// @return  one for each multiplier
std::vector<MultiplierMode> modes_of_multipliers(const Scene& scene, const PeriodicOrbit& orbit);

}  // namespace whirl::inline dyn
