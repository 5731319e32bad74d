#include "libdyn/methods/arkode.hpp"

#include <arkode/arkode_arkstep.h>

#include <memory>
#include <optional>

#include "libdyn/methods/sundials.hpp"

namespace whirl::inline dyn {

namespace {

using namespace sundials;

constexpr int degree = 5;  ///< of the interpolant, whose derivatives ARKODE gives up to this one

struct ArkodeMemoryFree {
  void operator()(void* memory) const { ARKStepFree(&memory); }
};

constexpr Solver arkode{
    .name = "ARKODE",
    .step = [](void* memory, realtype to, N_Vector y,
               realtype* t) { return ARKStepEvolve(memory, to, y, t, ARK_ONE_STEP); },
    .restart = ARKStepReset,  // one-step methods keep the length of their steps
    .watch = ARKStepRootInit,
    .set_root_direction = ARKStepSetRootDirection,
    .set_no_inactive_root_warning = ARKStepSetNoInactiveRootWarn,
    .set_stop_time = ARKStepSetStopTime,
    .found_roots = ARKStepGetRootInfo,
    .degree = [](void*) { return degree; },
    .derivative = ARKStepGetDky};

Integration run(bool is_implicit, const ContactSystem& system, MotionState& state, long revolutions,
                const IntegrationOptions& options, const Observer& observer) {
  Motion motion(system, state, options.tolerance);
  const std::unique_ptr<void, ArkodeMemoryFree> memory(
      ARKStepCreate(is_implicit ? nullptr : Motion::rhs, is_implicit ? Motion::rhs : nullptr,
                    motion.start(), motion.y(), motion.context()));
  void* ark = memory.get();
  ARKStepSetErrHandlerFn(ark, no_messages, nullptr);
  ARKStepSVtolerances(ark, options.tolerance, motion.weight());
  ARKStepSetUserData(ark, &motion);
  ARKStepSetMaxNumSteps(ark, most_steps_per_revolution);
  ARKStepSetInterpolantDegree(ark, degree);
  if (options.fixed_step > 0.0) ARKStepSetFixedStep(ark, options.fixed_step);
  std::optional<NewtonSolver> newton;
  if (is_implicit) {
    ARKStepSetTableNum(ark, ARKODE_ESDIRK547L2SA2_7_4_5, ARKODE_ERK_NONE);
    newton.emplace(motion.y(), motion.context());
    ARKStepSetLinearSolver(ark, newton->linear.get(), newton->jacobian.get());
    // a new Jacobian for every step: with one from before an event Newton's method creeps, and is
    // taken to have converged thousands of tolerances away
    ARKStepSetLSetupFrequency(ark, 1);
    ARKStepSetJacEvalFrequency(ark, 1);
  } else {
    ARKStepSetTableNum(ark, ARKODE_DIRK_NONE, ARKODE_DORMAND_PRINCE_7_4_5);
  }
  return motion.run(arkode, ark, revolutions, observer);
}

}  // namespace

Integration Arkode::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                              const IntegrationOptions& options, const Observer& observer) {
  return run(false, system, state, revolutions, options, observer);
}

Integration ArkodeDirk::integrate(const ContactSystem& system, MotionState& state, long revolutions,
                                  const IntegrationOptions& options, const Observer& observer) {
  return run(true, system, state, revolutions, options, observer);
}

}  // namespace whirl::inline dyn
