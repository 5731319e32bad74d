#pragma once
/// What the solvers of SUNDIALS share: their vectors, the equations of motion as they call them,
/// and the loop over steps, contact events and revolutions.

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "libdyn/system/events.hpp"
#include "libdyn/system/trajectory.hpp"

namespace whirl::inline dyn::sundials {

template <auto release>
struct Releaser {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
struct ContextFree {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
};
using Context = std::unique_ptr<_SUNContext, ContextFree>;
using Vector = std::unique_ptr<_generic_N_Vector, Releaser<N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Releaser<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Releaser<SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, Releaser<SUNNonlinSolFree>>;

Context new_context();

/// The numbers of a vector.
Eigen::Map<Vec> values(N_Vector v);

/// Silences a solver's own messages; what went wrong is in the outcome.
inline void no_messages(int, const char*, const char*, char*, void*) {}

/// Matrix and solver of Newton's method for implicit formulas; Jacobians by differences.
struct NewtonSolver {
  Matrix jacobian;
  LinearSolver linear;
  NewtonSolver(N_Vector y, SUNContext context);
};

constexpr long most_steps_per_revolution = 1'000'000;

using RootFunctions = int (*)(realtype, N_Vector, realtype*, void*);

/// The functions of one solver, which all take its memory first.
struct Solver {
  std::string_view name;  ///< in messages
  int (*step)(void*, realtype to, N_Vector y, realtype* t);
  int (*restart)(void*, realtype t, N_Vector y);
  int (*watch)(void*, int count, RootFunctions functions);
  int (*set_root_direction)(void*, int* directions);
  int (*set_no_inactive_root_warning)(void*);
  int (*set_stop_time)(void*, realtype t);
  int (*found_roots)(void*, int* found);
  int (*degree)(void*);  ///< of the interpolant of the last step
  int (*derivative)(void*, realtype t, int k, N_Vector dky);  ///< of the interpolant
};

/// A motion on its way through a solver. Time begins with the revolution.
///
/// Make a Motion, then the solver from its context and vectors, with `rhs` as the derivative and
/// the Motion as user data; then run.
class Motion {
 public:
  Motion(const ContactSystem& system, MotionState& state, double tolerance);
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  SUNContext context() const { return context_.get(); }
  N_Vector y() const { return y_.get(); }
  /// Absolute tolerances.
  N_Vector weight() const { return weight_.get(); }
  Instant instant(double t) const { return {t * system_.phase_rate(), state_.revolution}; }
  double start() const { return state_.phase / system_.phase_rate(); }

  /// y' of the contacts' present states, for the solver.
  static int rhs(realtype t, N_Vector y, N_Vector dy, void* motion);

  Integration run(const Solver& solver, void* memory, long revolutions, const Observer& observer);

 private:
  static int root_functions(realtype t, N_Vector y, realtype* g, void* motion);
  void restart(const Solver& solver, void* memory, double t);
  /// Applies the events at the roots that the solver has found.
  void apply_roots(const Solver& solver, void* memory);
  void find_roots();
  void apply_events_at_start();
  void watch(const Solver& solver, void* memory);
  void dense(const Solver& solver, void* memory, double from, double to, Step& step);

  const ContactSystem& system_;
  MotionState& state_;
  EventWatcher watcher_;
  Context context_;
  Vector y_, weight_, work_;
  std::vector<std::pair<int, EventKind>> roots_;  ///< that can end the contacts' present states
  Integration result_;
};

}  // namespace whirl::inline dyn::sundials
