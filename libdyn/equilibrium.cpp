#include "libdyn/equilibrium.hpp"

#include "libdyn/methods/kinsol.hpp"
#include "libfe/base/error.hpp"
#include "libfe/eigen/dense.hpp"

namespace whirl {

namespace {

/// What is left over of the balance, as accelerations; returns whether a contact pushes.
bool imbalance(const ContactSystem& system, const Vec& eta, Vec& left) {
  const int n = system.coordinates();
  Vec y = Vec::Zero(2 * n);
  y.head(n) = eta;
  left = system.constant_load() - system.K() * eta;
  bool pushes = false;
  for (const ReducedContact& c : system.contacts()) {
    const ContactForces f = kinematics(c, 0.0, y.data(), n);
    if (f.depth <= 0.0) continue;
    pushes = true;
    left -= c.B * (f.normal * f.n);
  }
  return pushes;
}

}  // namespace

Vec equilibrium(const ContactSystem& system) {
  const DenseLu<Mat> K(system.K());
  if (!(K.rcond() > 1e-16)) throw NumericalError("the rotor has no equilibrium: it is not held");
  const Vec sag = K.solve(system.constant_load());
  Vec left;
  if (!imbalance(system, sag, left)) return sag;
  const auto found =
      find_root([&](const Vec& eta, Vec& f) { imbalance(system, eta, f); }, sag,
                system.state_scale().head(system.coordinates()), left.cwiseAbs().maxCoeff());
  if (!found) throw NumericalError("the equilibrium of the rotor in its stators was not found");
  return *found;
}

}  // namespace whirl
