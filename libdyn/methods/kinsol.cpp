#include "libdyn/methods/kinsol.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>

#include <memory>

#include "libdyn/methods/sundials.hpp"

namespace whirl::inline dyn {

namespace {

using sundials::values;
using Function = std::function<void(const Vec&, Vec&)>;

int evaluate(N_Vector x, N_Vector to, void* function) {
  Vec f(N_VGetLength_Serial(x));
  (*static_cast<const Function*>(function))(values(x), f);
  values(to) = f;
  return f.allFinite() ? 0 : 1;
}

struct Release {
  void operator()(void* memory) const { KINFree(&memory); }
};

}  // namespace

std::optional<Vec> find_root(const Function& f, const Vec& guess, const Vec& scale, double size) {
  const sundials::Context context = sundials::new_context();
  const auto vector = [&](const Vec& from) {
    sundials::Vector v(N_VNew_Serial(from.size(), context.get()));
    values(v.get()) = from;
    return v;
  };
  const sundials::Vector x = vector(guess), x_scale = vector(scale.cwiseInverse()),
                         f_scale = vector(Vec::Constant(guess.size(), 1.0 / size));
  const std::unique_ptr<void, Release> solver(KINCreate(context.get()));
  const sundials::NewtonSolver newton(x.get(), context.get());
  KINSetErrHandlerFn(solver.get(), sundials::no_messages, nullptr);
  KINInit(solver.get(), evaluate, x.get());
  KINSetUserData(solver.get(), const_cast<Function*>(&f));
  KINSetLinearSolver(solver.get(), newton.linear.get(), newton.jacobian.get());
  KINSetMaxSetupCalls(solver.get(), 1);  // a Jacobian in every iteration
  KINSetFuncNormTol(solver.get(), 1e-13);
  KINSetScaledStepTol(solver.get(), 1e-14);
  if (KINSol(solver.get(), x.get(), KIN_LINESEARCH, x_scale.get(), f_scale.get()) < 0) {
    return std::nullopt;
  }
  return Vec(values(x.get()));
}

}  // namespace whirl::inline dyn
