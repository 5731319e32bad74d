#include "libfe/unbalance.hpp"

#include <fmt/format.h>

#include "libfe/base/error.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"

namespace whirl {

UnbalanceResponse unbalance_response(const Assembler& assembler, const std::vector<double>& speeds,
                                     const std::vector<Point>& points) {
  const auto np = static_cast<Eigen::Index>(points.size());
  const auto ns = static_cast<Eigen::Index>(speeds.size());
  UnbalanceResponse response{speeds, points, CMat(np, ns), CMat(np, ns)};
  System system = assembler.uncondensed(0.0);
  const CVec force = system.dofs.T.transpose() * assembler.unbalance();
  DynamicStiffness stiffness(system.M, system.C, system.G, system.K);

  for (Eigen::Index s = 0; s < ns; ++s) {
    const double Omega = speeds[static_cast<std::size_t>(s)];
    if (assembler.depends_on_speed()) {
      system = assembler.uncondensed(Omega);
      stiffness = DynamicStiffness(system.M, system.C, system.G, system.K);
    }
    if (Omega == 0.0) {
      response.x.col(s).setZero();
      response.y.col(s).setZero();
      continue;
    }
    const auto q = stiffness.solve(Omega, Omega, Omega * Omega * force);
    if (!q) {
      throw NumericalError(fmt::format(
          "the rotor has an undamped resonance at {:g} rad/s: the unbalance response is unbounded",
          Omega));
    }
    const CVec full = system.dofs.T * *q;
    for (Eigen::Index p = 0; p < np; ++p) {
      const Point& point = points[static_cast<std::size_t>(p)];
      response.x(p, s) = full(system.dofs.full_index(point, X));
      response.y(p, s) = full(system.dofs.full_index(point, Y));
    }
  }
  return response;
}

}  // namespace whirl
