#include "libfe/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "libfe/base/error.hpp"
#include "libfe/eigen/dense.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl {

namespace {

constexpr int dense_below = 75;          ///< freedoms; dense solvers are as fast there
constexpr double visible = 1e-3;         ///< of the largest orbit: smaller ones have no sense
constexpr double flat = 1e-4;            ///< axis ratio below which an orbit is a line
constexpr double rigid_share = 1e-5;     ///< of the first flexible omega^2: does not deform
constexpr double overdamped = 0.2;       ///< |Im| over |Re| of an eigenvalue that hardly oscillates
constexpr double same_frequency = 1e-9;  ///< relative distance of equal eigenvalues

/// What the modes of a free system are compared with.
struct FreeBody {
  bool is_free = false;
  double first_flexible = 0.0;  ///< [rad/s]; 0: nothing deforms
};

FreeBody free_body(const System& system) {
  const Sparse K = symmetric_part(system.K);
  if (is_supported(K)) return {};
  Sparse M = system.M;  // joints without mass get plenty, which makes first_flexible low: safe
  const double plenty = M.diagonal().maxCoeff();
  for (int i = 0; i < system.size(); ++i) {
    if (system.M.coeff(i, i) <= 0.0) M.coeffRef(i, i) = plenty;
  }
  const RealModes real = lowest_real_modes(K, M, std::min(system.size(), 16));
  return {true, real.first_flexible()};
}

/// Strain energy per kinetic energy at unit frequency, q^H K q / q^H M q.
double stiffness_ratio(const System& system, const CVec& q) {
  const double strain = (q.adjoint() * (system.K * q))(0).real();
  const double inertia = (q.adjoint() * (system.M * q))(0).real();
  return inertia > 0.0 ? strain / inertia : std::numeric_limits<double>::infinity();
}

/// At rest, modes with equal eigenvalues are turned so that each moves in one plane.
///
///   A^H (P_x - P_y) A v = mu A^H (P_x + P_y) A v,   mu = 1 in the x-z plane, -1 in the y-z plane
///
/// A: their shapes, P: the freedoms of all points that belong to a plane.
void separate_planes(QuadraticModes& modes, const DofMap& dofs) {
  Vec plane = Vec::Zero(dofs.full_size);
  for (const Point& p : dofs.points()) {
    for (const int component : {X, Y, THETA_X, THETA_Y}) {
      const int k = dofs.full_index(p, component);
      if (k >= 0) plane(k) = component == X || component == THETA_Y ? 1.0 : -1.0;
    }
  }
  std::vector<bool> is_done(static_cast<std::size_t>(modes.lambda.size()), false);
  for (Eigen::Index i = 0; i < modes.lambda.size(); ++i) {
    if (modes.lambda(i).imag() == 0.0) continue;  // creeps, or a rigid body's double zero
    std::vector<Eigen::Index> equal;
    for (Eigen::Index j = i; j < modes.lambda.size(); ++j) {
      const double distance = std::abs(modes.lambda(i) - modes.lambda(j));
      if (is_done[j] || distance > same_frequency * std::abs(modes.lambda(i))) continue;
      is_done[j] = true;
      equal.push_back(j);
    }
    if (equal.size() < 2) continue;
    const CMat q = modes.q(Eigen::all, equal);
    const CMat A = dofs.T * q;
    const CMat difference = A.adjoint() * plane.cast<Complex>().asDiagonal() * A;
    const CMat sum = A.adjoint() * plane.cwiseAbs().cast<Complex>().asDiagonal() * A;
    const auto planes = hermitian_modes(difference, sum);
    if (!planes) continue;
    const CMat turned = q * planes->vectors.rowwise().reverse();
    modes.q(Eigen::all, equal) = turned.colwise().normalized();
  }
}

Mode describe(Complex lambda, const CVec& q, const DofMap& dofs) {
  Mode mode{.lambda = lambda, .shape = q};
  const std::vector<Orbit> at = orbits(dofs, q);
  std::size_t largest = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i].major() > at[largest].major()) largest = i;
    mode.kappas.push_back(at[i].kappa());
  }
  mode.whirl = whirl_of(at);
  if (!at.empty() && at[largest].major() > 0.0) {
    // phase: the largest orbit is at its major axis at t = 0
    const CVec full = dofs.T * q;
    const Point p = dofs.points()[largest];
    const Complex x = full(dofs.full_index(p, X)), y = full(dofs.full_index(p, Y));
    const Complex square = x * x + y * y;
    const double angle =
        std::abs(square) > 1e-12 * std::norm(x) ? 0.5 * std::arg(square) : std::arg(x);
    mode.shape *= std::polar(1.0 / at[largest].major(), -angle);
    mode.kappa = at[largest].kappa();
  }
  return mode;
}

Modes sorted(QuadraticModes found, const System& system, const FreeBody& body, int count) {
  if (system.Omega == 0.0) separate_planes(found, system.dofs);
  Modes modes;
  for (Eigen::Index i = 0; i < found.lambda.size(); ++i) {
    const Complex lambda = found.lambda(i);
    const CVec q = found.q.col(i);
    const bool is_rigid =
        body.is_free && std::abs(stiffness_ratio(system, q)) <=
                            rigid_share * body.first_flexible * body.first_flexible;
    if (is_rigid) {
      modes.rigid_body.push_back(describe(lambda, q, system.dofs));
    } else if (lambda.imag() <= overdamped * std::abs(lambda.real())) {
      modes.overdamped.push_back(lambda);
    } else {
      modes.oscillatory.push_back(describe(lambda, q, system.dofs));
    }
  }
  const auto by_frequency = [](const Mode& a, const Mode& b) {
    return a.frequency() < b.frequency();
  };
  std::stable_sort(modes.oscillatory.begin(), modes.oscillatory.end(), by_frequency);
  std::stable_sort(modes.rigid_body.begin(), modes.rigid_body.end(), by_frequency);
  std::stable_sort(modes.overdamped.begin(), modes.overdamped.end(),
                   [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  if (static_cast<int>(modes.oscillatory.size()) > count) modes.oscillatory.resize(count);
  return modes;
}

/// Free systems are shifted by a part of their first flexible frequency, if they have one.
double shift_for(const FreeBody& body) {
  if (!body.is_free) return 0.0;
  return body.first_flexible > 0.0 ? -0.3 * body.first_flexible : -1.0;
}

/// The lowest modes by Arnoldi. Overdamped and rigid ones do not count: `others` is how many of
/// them to expect, and is raised if there are more.
Modes arnoldi_modes(const QuadraticSolver& solver, const System& system, const FreeBody& body,
                    int count, int& others) {
  for (;;) {
    const int pairs = std::min(count + others, system.size() - 1);
    QuadraticModes found = solver.lowest(system.D(), pairs);
    const bool is_all = found.lambda.size() >= system.size() || pairs == system.size() - 1;
    Modes modes = sorted(std::move(found), system, body, count);
    const int missing = count - static_cast<int>(modes.oscillatory.size());
    if (missing <= 0 || is_all) return modes;
    others += missing;
  }
}

/// How many modes beside the oscillatory ones to expect among the lowest of an unknown system.
int usual_others(const FreeBody& body) {
  return body.is_free ? 8 : 4;
}

}  // namespace

double Mode::log_decrement() const {
  const double zeta = damping_ratio();
  return 2.0 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta);
}

std::vector<Orbit> orbits(const DofMap& dofs, const CVec& shape) {
  const CVec full = dofs.T * shape;
  std::vector<Orbit> result;
  for (const Point& p : dofs.points()) {
    result.emplace_back(full(dofs.full_index(p, X)), full(dofs.full_index(p, Y)));
  }
  return result;
}

Whirl whirl_of(const std::vector<Orbit>& orbits) {
  double largest = 0.0;
  for (const Orbit& orbit : orbits) largest = std::max(largest, orbit.major());
  bool forward = false, backward = false;
  for (const Orbit& orbit : orbits) {
    if (orbit.major() < visible * largest || std::abs(orbit.kappa()) < flat) continue;
    (orbit.kappa() > 0.0 ? forward : backward) = true;
  }
  if (forward && backward) return Whirl::mixed;
  if (forward) return Whirl::forward;
  return backward ? Whirl::backward : Whirl::planar;
}

Modes complex_modes(const System& system, int count) {
  const FreeBody body = free_body(system);
  if (system.size() < dense_below) {
    return sorted(dense_quadratic_modes(system.M, system.D(), system.K, shift_for(body)), system,
                  body, count);
  }
  const QuadraticSolver solver(system.M, system.K, shift_for(body));
  int others = usual_others(body);
  return arnoldi_modes(solver, system, body, count, others);
}

struct ModeFinder::State {
  const Assembler& assembler;
  System base;
  FreeBody body;
  std::unique_ptr<QuadraticSolver> solver;
  int others = 0;  ///< modes that do not oscillate, seen so far among the lowest
};

ModeFinder::ModeFinder(const Assembler& assembler)
    : state_(std::make_unique<State>(State{assembler, assembler.at(0.0), {}, nullptr})) {
  if (assembler.depends_on_speed()) return;
  state_->body = free_body(state_->base);
  if (state_->base.size() >= dense_below) {
    state_->solver =
        std::make_unique<QuadraticSolver>(state_->base.M, state_->base.K, shift_for(state_->body));
  }
}

ModeFinder::~ModeFinder() = default;

System ModeFinder::system(double Omega) const {
  if (state_->assembler.depends_on_speed()) return state_->assembler.at(Omega);
  System system = state_->base;
  system.Omega = Omega;
  return system;
}

Modes ModeFinder::at(double Omega, int count) const {
  const System at_speed = system(Omega);
  if (state_->assembler.depends_on_speed()) return complex_modes(at_speed, count);
  const FreeBody& body = state_->body;
  if (state_->solver) {
    return arnoldi_modes(*state_->solver, at_speed, body, count, state_->others);
  }
  return sorted(dense_quadratic_modes(at_speed.M, at_speed.D(), at_speed.K, shift_for(body)),
                at_speed, body, count);
}

}  // namespace whirl
