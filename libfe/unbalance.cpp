#include "libfe/unbalance.hpp"

#include <fmt/format.h>

#include "libbase/error.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"

namespace whirl::inline fe {

struct UnbalanceSolver::State {
  const Assembler& assembler;
  CVec force;  ///< of unbalance over Omega^2, in the coordinates of the system
  CVec bow;    ///< force of the bow, likewise; empty: none
  std::optional<DynamicStiffness> stiffness{};  ///< of the last speed, if it depends on that
};

UnbalanceSolver::UnbalanceSolver(const Assembler& assembler) {
  const Sparse& T = assembler.dofs().T;
  CVec force = T.transpose() * assembler.unbalance();
  CVec bow;
  if (!assembler.structure().bow.z.empty()) bow = T.transpose() * assembler.bow();
  state_ = std::make_unique<State>(State{assembler, std::move(force), std::move(bow)});
}

UnbalanceSolver::~UnbalanceSolver() = default;

const DofMap& UnbalanceSolver::dofs() const {
  return state_->assembler.dofs();
}

std::optional<CVec> UnbalanceSolver::at(double Omega) {
  State& s = *state_;
  if (Omega == 0.0 && s.bow.size() == 0) return CVec(CVec::Zero(dofs().full_size));
  if (!s.stiffness || s.assembler.depends_on_speed()) {
    const System system = s.assembler.uncondensed(Omega);
    s.stiffness.emplace(system.M, system.C, system.G, system.K);
  }
  CVec force = Omega * Omega * s.force;
  if (s.bow.size() > 0) force += s.bow;
  const auto q = s.stiffness->solve(Omega, Omega, force);
  if (!q) return {};
  return CVec(dofs().T * *q);
}

std::optional<CVec> UnbalanceSolver::at(double Omega, const std::vector<Point>& points) {
  const auto full = at(Omega);
  if (!full) return {};
  const auto count = static_cast<Eigen::Index>(points.size());
  CVec u(2 * count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const Point& point = points[static_cast<std::size_t>(p)];
    u(p) = (*full)(dofs().full_index(point, X));
    u(p + count) = (*full)(dofs().full_index(point, Y));
  }
  return u;
}

UnbalanceResponse unbalance_response(const Assembler& assembler, const std::vector<double>& speeds,
                                     const std::vector<Point>& points) {
  const auto np = static_cast<Eigen::Index>(points.size());
  const auto ns = static_cast<Eigen::Index>(speeds.size());
  UnbalanceResponse response{speeds, points, CMat(np, ns), CMat(np, ns)};
  UnbalanceSolver solver(assembler);
  for (Eigen::Index s = 0; s < ns; ++s) {
    const double Omega = speeds[static_cast<std::size_t>(s)];
    const auto u = solver.at(Omega, points);
    if (!u) {
      throw NumericalError(fmt::format(
          "the rotor has an undamped resonance at {:g} rad/s: the unbalance response is unbounded",
          Omega));
    }
    response.x.col(s) = u->head(np);
    response.y.col(s) = u->tail(np);
  }
  return response;
}

}  // namespace whirl::inline fe
