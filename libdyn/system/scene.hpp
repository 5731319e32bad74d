#pragma once
/// A model made ready for computing at one speed: assembled, reduced, with its contacts.

#include "libbase/numerics/dense.hpp"
#include "libdyn/system/contact_system.hpp"
#include "libdyn/system/trajectory.hpp"
#include "libfe/analyses/reduction_error.hpp"

namespace whirl::inline dyn {

struct Model;

struct Scene {
  Assembler assembler;
  System system;  ///< all dofs, at the operating speed
  ReducedSystem reduced;
  ReductionError error;  ///< of the reduction
  ContactSystem contacts;

  /// Displacements of all points (a full vector, see DofMap) from reduced ones: full = map * eta.
  Mat displacement_map() const { return reduced.dofs.T * reduced.Phi; }
};

/// Whether the error of a reduction to a given number of modes is estimated, which takes most of
/// the time. Where the number follows from `tolerance`, the error is always estimated.
enum class ReductionEstimate { no, yes };

/// Assembles and reduces a model at its operating speed.
///
/// @throws ModelError      as Assembler, and for contacts, oil films, unbalances or forces at
///                         stations without inertia
/// @throws NumericalError  as reduce
Scene make_scene(const Model& model, ReductionEstimate wanted = ReductionEstimate::yes);

/// The scene of a model whose structure has been assembled already.
Scene make_scene(Assembler assembler, const Model& model, ReductionEstimate wanted);

/// A scene with other laws of its contacts and films, at the same stations and speed.
Scene with_contacts(const Scene& scene, const Model& model);

/// Reduced coordinates of motions q of all dofs, the nearest in kinetic energy:
/// eta = (Phi^T M Phi)^-1 Phi^T M q. Takes memory and time in proportion to the dofs.
class NearestCoordinates {
 public:
  explicit NearestCoordinates(const Scene& scene);

  Vec of(const Vec& q) const { return mass_.solve(weighted_ * q); }
  /// The matrix that makes eta of q, coordinates x dofs.
  Mat matrix() const { return mass_.solve(weighted_); }
  const DenseLu<Mat>& mass() const { return mass_; }  ///< Phi^T M Phi

 private:
  Mat weighted_;  ///< Phi^T M
  DenseLu<Mat> mass_;
};

/// Motion of all points at an instant, as stored in results.
struct FullState {
  Vec displacement, velocity;  ///< full vectors
};

/// Motion of all points of a state.
FullState full_state(const Scene& scene, const MotionState& state);

}  // namespace whirl::inline dyn
