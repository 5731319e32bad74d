#include "bench/odeint.hpp"

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

namespace whirl {

namespace {

namespace odeint = boost::numeric::odeint;

using State = std::array<double, 8>;  ///< x_r, y_r, x_s, y_s and their rates

/// Displacements by the gap, time by the angle of rotation.
struct RightHandSide {
  double wr, ws, dr, ds;          ///< k / (m Omega^2), c / (m Omega)
  double kr, ks;                  ///< contact stiffness likewise
  double unbalance, gravity, mu;  ///< e / gap, g / (gap Omega^2)
  double rim;                     ///< radius of the contact by the gap

  explicit RightHandSide(const test::RotorStator& p)
      : wr(p.kr / (p.mr * p.Omega * p.Omega)),
        ws(p.ks / (p.ms * p.Omega * p.Omega)),
        dr(p.cr / (p.mr * p.Omega)),
        ds(p.cs / (p.ms * p.Omega)),
        kr(p.kC / (p.mr * p.Omega * p.Omega)),
        ks(p.kC / (p.ms * p.Omega * p.Omega)),
        unbalance(p.e / p.gap),
        gravity(p.gravity / (p.gap * p.Omega * p.Omega)),
        mu(p.mu),
        rim(p.R / p.gap) {}

  void operator()(const State& y, State& dy, double t) const {
    for (std::size_t i = 0; i < 4; ++i) dy[i] = y[i + 4];
    dy[4] = -wr * y[0] - dr * y[4] + unbalance * std::cos(t);
    dy[5] = -wr * y[1] - dr * y[5] + unbalance * std::sin(t) - gravity;
    dy[6] = -ws * y[2] - ds * y[6];
    dy[7] = -ws * y[3] - ds * y[7] - gravity;
    const double dx = y[0] - y[2], dyy = y[1] - y[3];
    const double r = std::sqrt(dx * dx + dyy * dyy);
    if (r <= 1.0) return;
    const double nx = dx / r, ny = dyy / r;
    const double slip = rim - ny * (y[4] - y[6]) + nx * (y[5] - y[7]);
    const double friction = slip >= 0.0 ? mu : -mu;
    const double fx = -(r - 1.0) * (nx - friction * ny), fy = -(r - 1.0) * (ny + friction * nx);
    dy[4] += kr * fx;
    dy[5] += kr * fy;
    dy[6] -= ks * fx;
    dy[7] -= ks * fy;
  }
};

}  // namespace

Candidate odeint_candidate(const test::RotorStator& rotor) {
  const RightHandSide rhs(rotor);
  const double gap = rotor.gap, speed = rotor.gap * rotor.Omega;
  return {"odeint-dopri5", [=](MotionState& state, long revolutions, double tolerance) {
            State y;
            for (std::size_t i = 0; i < 8; ++i) {
              y[i] = state.y(static_cast<Eigen::Index>(i)) / (i < 4 ? gap : speed);
            }
            Integration result;
            long evaluations = 0;
            const auto counted = [&](const State& from, State& to, double t) {
              ++evaluations;
              rhs(from, to, t);
            };
            const auto stepper =
                odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<State>());
            const double end = 2.0 * test::pi * static_cast<double>(revolutions);
            result.cost.steps =
                static_cast<long>(odeint::integrate_adaptive(stepper, counted, y, 0.0, end, 1e-3));
            result.cost.evaluations = evaluations;
            for (std::size_t i = 0; i < 8; ++i) {
              state.y(static_cast<Eigen::Index>(i)) = y[i] * (i < 4 ? gap : speed);
            }
            state.revolution += revolutions;
            return result;
          }};
}

}  // namespace whirl
