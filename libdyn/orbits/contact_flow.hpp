#pragma once
/// The flow map of a rotor with its contacts, by the Taylor engine.

#include <memory>

#include "libbase/numerics/dense.hpp"
#include "libdyn/orbits/shooting.hpp"
#include "libdyn/system/abilities.hpp"
#include "libdyn/system/scene.hpp"

namespace whirl::inline dyn {

constexpr double flow_tolerance = 1e-13;  ///< of steps for orbits and their multipliers

/// What never repeats has no orbit.
inline constexpr std::array never_repeat{Need::own_frequencies, Need::irrational_orders};
inline constexpr Abilities orbit_abilities{
    "orbits and return maps", never_repeat,
    "it makes a torus of every motion that has the frequency of the speed, too; simulate and "
    "classify these, or give the force an order of the speed"};

/// Branches and circles are of maps that are the same in every revolution.
inline constexpr std::array change_by_revolution{Need::own_frequencies, Need::irrational_orders,
                                                 Need::several_revolutions};
inline constexpr Abilities branch_abilities{
    "branches and circles", change_by_revolution,
    "give the forces orders that are whole numbers, or look for one orbit of their period"};
/// @throws ModelError  for a map that is not the same in every revolution
void require_loads_of_a_revolution(const Flow& flow);

/// The flow from phase 0 to phase 0, with event-exact tangents; what contacts do at a start follows
/// from its state.
/// @param system  must live as long as the flow
/// @throws ModelError  for a system beyond orbit_abilities
Flow flow_of(const ContactSystem& system, double tolerance = flow_tolerance);

/// The change from states of a first scene to those of a scene whose basis may be another.
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

/// The flow of a scene at another value of a parameter, for states in the basis of a first scene.
///
/// Orbits and multipliers are exactly those of the scene; the coordinates of orbits are continuous
/// in the parameter, whatever order and signs the modes of the scene's basis have.
///
/// @throws NumericalError  if the bases have nothing in common
Flow flow_of(std::shared_ptr<const Scene> scene, const Scene& first,
             double tolerance = flow_tolerance);

}  // namespace whirl::inline dyn
