#pragma once
/// Contact forces of a collocation step.

#include <vector>

#include "libdyn/methods/step_tables.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn {

/// Kinematics of a contact that neither turns nor rubs apart.
inline ContactForces forces_at(const ReducedContact& contact, const Vec2& d, const Vec2& w) {
  return kinematics(contact, 0.0, {{d(0), d(1)}, {w(0), w(1)}, {w(0), w(1)}});
}

/// Motion of the contacts at the nodes of a step under forces.
///
///   u_i = free_i (y, 1, cos phase, sin phase) + sum_b kernel_ib a_b
///
/// which is the exact linear motion, with a the Legendre coefficients of all forces.
struct NodeMotion {
  static constexpr int terms = StepTables::terms;

  StepTables& tables;
  Rung rung{};
  std::vector<int> touching{};
  Eigen::Vector3d load{};
  Vec a{};                           ///< of all contacts, x and y
  std::vector<Mat> free{}, under{};  ///< per contact: nodes x 4; under forces, of those in touch

  NodeMotion(const ContactSystem& system, StepTables& of);

  /// A step from a state, without forces yet.
  void begin(Rung of, const MotionState& from);
  /// Finds the motion of what touches under the forces.
  /// @param with_rates  else displacements alone
  void evaluate(bool with_rates);
  /// Motion of any contact at the nodes, or at the places of free motion if nothing touches: x 4.
  Mat of(std::size_t contact) const;
  auto force_of(int contact) { return a.segment(2 * contact * terms, 2 * terms); }
  auto force_of(int contact) const { return a.segment(2 * contact * terms, 2 * terms); }
};

/// Finds the forces of the contacts in touch over a step: coefficients of the forces that the laws
/// give at the nodes, a = projection f(u), solved by Picard iteration, or by Newton's method where
/// Picard iteration does not contract. A contact that sticks has the condition of no
/// slip in place of its friction law; of several contacts that slip alike the first one has this
/// condition, and carries the friction of all.
class StepForces {
 public:
  static constexpr double grown = 1e3;  ///< scales, beyond which errors are over a state's size

  StepForces(const ContactSystem& system, StepTables& tables, double tolerance);

  /// False if the forces were not found.
  bool solve(Rung rung, const MotionState& from);

  /// Of the last solve.
  const NodeMotion& motion() const { return nodes_; }
  double error() const { return error_; }
  long evaluations() const { return evaluations_; }

 private:
  Vec2 node_force(int contact, const ContactState& state, const double* node, int stride);
  bool picard(const MotionState& from);
  bool newton(const MotionState& from);
  /// Adds the derivatives of the residual of touching contact p at node k by all forces.
  void add_slopes(const MotionState& from, const StepNodes& table, Eigen::Index p, int k,
                  const Vec2& force, const Vec2& value, Mat& J);
  void residual(const MotionState& from, int contact, const double* dw, const Vec2& force,
                Vec2& out);
  void estimate();

  static constexpr int terms = StepTables::terms, rows = StepTables::rows;
  const ContactSystem& system_;
  StepTables& tables_;
  std::vector<char> rate_matters_;
  std::vector<double> weight_;  ///< velocity per force and time, in units of the tolerance

  // of the last solve
  NodeMotion nodes_;
  double state_size_ = 1.0;  ///< of the state where the step starts, over `grown`; 1 or more
  Mat node_forces_;
  double error_ = 0.0;  ///< over the tolerance
  long evaluations_ = 0;
};

}  // namespace whirl::inline dyn
