#pragma once
/// The flow map of a rotor with its contacts, by the Taylor engine.

#include <memory>

#include "libbase/numerics/dense.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

constexpr double flow_tolerance = 1e-13;  ///< of steps for orbits and their multipliers

/// @throws ModelError  for forces with a frequency of their own, whose motions never repeat
void require_periodic_loads(const ContactSystem& system);
/// @throws ModelError  for a map that is not the same in every revolution
void require_loads_of_a_revolution(const Flow& flow);

/// From phase 0 to phase 0, with event-exact tangents; the contacts follow from the states.
/// @param system  must live as long as the flow
/// @throws ModelError  as require_periodic_loads
Flow flow_of(const ContactSystem& system, double tolerance = flow_tolerance);

/// The states of a scene for those of a first one, whose basis may be another.
///
///   y = P y_first,  P = (Phi^T M Phi)^-1 Phi^T M Phi_first  for displacements and velocities
class BasisChange {
 public:
  /// @throws NumericalError  if the bases have nothing in common
  BasisChange(const Scene& scene, const Scene& first);
  bool is_none() const { return !back_; }
  const Mat& matrix() const { return P_; }  ///< P
  Vec to(const Vec& y_first) const;         ///< P y_first
  Mat back(const Mat& y) const;             ///< P^-1 y

 private:
  Mat P_;
  std::shared_ptr<const DenseLu<Mat>> back_;
};

/// The same of a scene at another value of a parameter, for the states of a first scene.
///
/// Orbits and multipliers are exactly those of the scene; their coordinates are continuous in the
/// parameter, whatever order and signs the modes of its basis have.
///
/// @throws NumericalError  if the bases have nothing in common
Flow flow_of(std::shared_ptr<const Scene> scene, const Scene& first,
             double tolerance = flow_tolerance);

}  // namespace whirl::inline dyn
