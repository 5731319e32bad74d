#include "libdyn/methods/cvode.hpp"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <optional>

#include "libdyn/methods/sundials.hpp"

namespace whirl::inline dyn {

namespace {

using namespace sundials;

struct CvodeMemoryFree {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

constexpr Solver cvode{.name = "CVODE",
                       .step = [](void* memory, realtype to, N_Vector y,
                                  realtype* t) { return CVode(memory, to, y, t, CV_ONE_STEP); },
                       .restart = CVodeReInit,
                       .watch = CVodeRootInit,
                       .set_root_direction = CVodeSetRootDirection,
                       .set_no_inactive_root_warning = CVodeSetNoInactiveRootWarn,
                       .set_stop_time = CVodeSetStopTime,
                       .found_roots = CVodeGetRootInfo,
                       .degree =
                           [](void* memory) {
                             int order = 1;
                             CVodeGetLastOrder(memory, &order);
                             return order;
                           },
                       .derivative = CVodeGetDky};

Integration run(int method, const ContactSystem& system, MotionState& state, long revolutions,
                const IntegrationOptions& options, const Observer& observer) {
  Motion motion(system, state, options.tolerance);
  const std::unique_ptr<void, CvodeMemoryFree> memory(CVodeCreate(method, motion.context()));
  void* cv = memory.get();
  CVodeSetErrHandlerFn(cv, no_messages, nullptr);
  CVodeInit(cv, Motion::rhs, motion.start(), motion.y());
  CVodeSVtolerances(cv, options.tolerance, motion.weight());
  CVodeSetUserData(cv, &motion);
  CVodeSetMaxNumSteps(cv, most_steps_per_revolution);
  std::optional<NewtonSolver> newton;
  NonlinearSolver fixed_point;
  if (method == CV_BDF) {
    newton.emplace(motion.y(), motion.context());
    CVodeSetLinearSolver(cv, newton->linear.get(), newton->jacobian.get());
  } else {
    fixed_point.reset(SUNNonlinSol_FixedPoint(motion.y(), 0, motion.context()));
    CVodeSetNonlinearSolver(cv, fixed_point.get());
  }
  return motion.run(cvode, cv, revolutions, observer);
}

}  // namespace

Integration CvodeAdams::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                                  const IntegrationOptions& options, const Observer& observer) {
  return run(CV_ADAMS, system, state, revolutions, options, observer);
}

Integration CvodeBdf::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                                const IntegrationOptions& options, const Observer& observer) {
  return run(CV_BDF, system, state, revolutions, options, observer);
}

}  // namespace whirl::inline dyn
