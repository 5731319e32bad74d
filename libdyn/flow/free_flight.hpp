#pragma once
/// Motion without contact: whether no contact can happen any more, and the motion in closed form.

#include <optional>

#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Free motion of a system whose contacts are all apart, in closed form.
///
///   y(t) = y_p(phase) + e^(A t) (y(0) - y_p(phase(0))),   y_p = X0 + Xc cos(phase) + Xs sin(phase)
///
/// No contact can ever happen again if for each one
///
///   max |U y_p - offset| + |U P^(-1) U^T|^(1/2) (z^T P z)^(1/2) < clearance,   z = y - y_p,
///
/// where A^T P + P A = -Q with Q > 0: z^T P z never grows, and it bounds |U z| by the inequality of
/// Cauchy and Schwarz. No eigenvector is involved, so that defective modes are no exception. The
/// same is certain if
///
///   max |U y_p - offset| + sum_g a_g < clearance,   z = sum_j w_j v_j,   A v_j = lambda_j v_j,
///
/// with a_g the major semi-axis of Re(sum_j w_j U v_j e^(i t)) over a group g of modes whose
/// eigenvalues are equal, since these modes stay in step. This bound is exact where one mode whirls
/// along a circle; it is left out where the v_j are nearly dependent. Nothing is certain if the
/// free motion does not decay (undamped or rigid-body modes), if a revolution is too long beside
/// the fastest motion to be computed at once (see LinearFlow), or under loads of other frequencies
/// than the speed.
///
/// @source [Kailath1980], sec. 2.6 (Lyapunov's equation); P by doubling [Smith1968]
class FreeFlight {
 public:
  explicit FreeFlight(const ContactSystem& system);

  /// Whether no contact can ever happen from this state on.
  bool is_certain(const MotionState& state);

  /// Whether the free motion of a system without oil films decays towards y_p, so that it can be
  /// finished.
  bool decays();
  /// y_p at a phase, after decays() has said that the free motion decays to it.
  Vec steady_state(double phase) const;

  /// Moves a state to phase 0 of revolution number last_revolution, in a time that does not grow
  /// with the number of revolutions.
  void finish(MotionState& state, long last_revolution);

 private:
  void prepare();
  void prepare_modes();
  bool is_certain_by_modes(const Vec& z);

  const ContactSystem& system_;
  std::optional<LinearFlow> flow_;
  bool is_prepared_ = false, decays_ = false;
  Mat periodic_;              ///< y_p = periodic_ (1, cos phase, sin phase)
  Mat P_;                     ///< of the quadratic bound
  std::vector<double> left_;  ///< per contact: how far y_p stays away from the contact [m]
  std::vector<double> room_;  ///< per contact: the largest z^T P z that cannot reach the contact
  bool has_modes_ = false;    ///< whether modes were looked for
  CMat to_modes_;             ///< w = to_modes_ z; empty: the modes are nearly dependent
  CMat seen_;                 ///< U v_j, two rows for each contact [m]
  std::vector<Eigen::Index> groups_;  ///< of each mode: the first one with its eigenvalue
  Vec apart_;  ///< how far a mode gets from the first of its group in a damping time, relative
};

}  // namespace whirl::inline dyn
