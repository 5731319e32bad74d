#include "libfe/analyses/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/analyses/own_frequency_modes.hpp"
#include "libfe/analyses/reduced_modes.hpp"
#include "libfe/assembly/states_apart.hpp"
#include "libfe/eigen/disc.hpp"
#include "libfe/eigen/energy_bounds.hpp"
#include "libfe/eigen/lowest_frequencies.hpp"
#include "libfe/eigen/newton.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "libfe/eigen/refine.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr int dense_after = 160;         ///< dofs: where one disc does not do, all modes at once
constexpr double visible = 1e-3;         ///< of the largest orbit: smaller ones have no sense
constexpr double flat = 1e-4;            ///< axis ratio below which an orbit is a line
constexpr double rigid_share = 1e-5;     ///< of the first flexible omega^2: does not deform
constexpr double rigid_zero = 1e-5;      ///< of the first flexible omega: a rigid body's zero
constexpr double off_axis = 0.05;        ///< Re over Im of a center for modes near a frequency
constexpr double rough = 1e-3;           ///< relative error of an eigenvalue that can be refined
constexpr double fine = 1e-5;            ///< the same among others that are as near
constexpr double apart_from_next = 0.1;  ///< of the distance to the next one: it stays the same
constexpr double settled_step = 1e-13;   ///< of an eigenvalue, relative
constexpr double same_frequency = 1e-9;  ///< relative distance of equal eigenvalues

/// What the modes of a free system are compared with.
struct FreeBody {
  bool is_free = false;
  double first_flexible = 0.0;  ///< [rad/s]; 0: nothing deforms
  double slowest = 0.0;         ///< below all that oscillates, of a stiffness that is singular by
                                ///< states that nothing holds [rad/s]; 0: it is regular
};

FreeBody free_body(const System& system) {
  const StatesApart parts(system.dofs);
  const Sparse K = symmetric_part(stiffness_at_rest(system, parts));
  if (is_supported(K)) {
    if (!parts.has_states() || SparseLu(system.stiffness()).is_regular()) return {};
    const Vec inertia = parts.structure.transpose() * system.M.diagonal();
    return {.slowest = 0.1 * std::sqrt(K.diagonal().minCoeff() / inertia.maxCoeff())};
  }
  Sparse M = symmetric_inertia(system.M);
  if (parts.has_states()) M = parts.structure.transpose() * Sparse(M * parts.structure);
  // joints without mass get plenty, which makes first_flexible low: safe
  const double plenty = M.diagonal().maxCoeff();
  for (int i = 0; i < static_cast<int>(M.rows()); ++i) {
    if (M.coeff(i, i) <= 0.0) M.coeffRef(i, i) = plenty;
  }
  const RealModes real = lowest_real_modes(K, M, std::min(static_cast<int>(M.rows()), 16));
  return {true, real.first_flexible()};
}

/// Size of the strain energy per kinetic energy at unit frequency, |q^H K q| / q^H M q: what skew
/// stiffness does to a whirl counts, too.
double stiffness_ratio(const Sparse& K, const Sparse& M, const CVec& q) {
  const double strain = std::abs((q.adjoint() * (K * q))(0));
  const double inertia = (q.adjoint() * (M * q))(0).real();
  return inertia > 0.0 ? strain / inertia : std::numeric_limits<double>::infinity();
}

/// Whether nothing of a system goes with the spin.
bool stands(const System& system) {
  if (system.Omega == 0.0) return true;
  return !system.circulates() && system.G().squaredNorm() == 0.0;
}

/// At rest, modes with equal eigenvalues are turned so that each moves in one plane.
///
///   A^H (P_x - P_y) A v = mu A^H (P_x + P_y) A v,   mu = 1 in the x-z plane, -1 in the y-z plane
///
/// A: their shapes, P: the dofs of all points that belong to a plane.
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

/// How far refinement may move an eigenvalue.
double reach_of(Complex lambda, const CVec& all) {
  double next = std::numeric_limits<double>::infinity();  // distance of the nearest other one
  for (const Complex other : all) {
    if (other != lambda) next = std::min(next, std::abs(other - lambda));
  }
  return std::abs(lambda) * std::clamp(apart_from_next * next / std::abs(lambda), fine, rough);
}

/// Finds eigenvalues of states that move nothing and that nothing moves, see StateCoordinate.
class IdleStates {
 public:
  explicit IdleStates(const DofMap& dofs) : T_(dofs.T) {
    for (const StateCoordinate& state : dofs.states) {
      if (state.idle) idle_.push_back(state);
    }
  }
  /// Whether a pair is one of them: its shape is in coordinates that have this eigenvalue.
  bool contain(Complex lambda, const CVec& q) const {
    constexpr double same = 1e-6;  // relative
    if (idle_.empty()) return false;
    const CVec full = T_ * q;
    double share = 0.0;
    for (const StateCoordinate& state : idle_) {
      if (std::abs(lambda - *state.idle) <= same * std::abs(*state.idle))
        share += std::norm(full(state.index));
    }
    return share >= (1.0 - same) * full.squaredNorm();
  }

 private:
  const Sparse& T_;
  std::vector<StateCoordinate> idle_;
};

Modes sorted(QuadraticModes found, const System& system, const FreeBody& body, int count) {
  if (stands(system)) separate_planes(found, system.dofs);
  const Sparse D = system.D(), K = system.stiffness();
  Refinement refinement(system.M, D, K);
  const IdleStates idle(system.dofs);
  Modes modes;
  for (Eigen::Index i = 0; i < found.lambda.size(); ++i) {
    Complex lambda = found.lambda(i);
    CVec q = found.q.col(i);
    if (idle.contain(lambda, q)) continue;
    const bool is_rigid =
        body.is_free &&
        stiffness_ratio(K, system.M, q) <= rigid_share * body.first_flexible * body.first_flexible;
    if (is_rigid) {
      // a double zero comes as a small pair of any sign, which is no damping
      const bool is_zero = std::abs(lambda) <= rigid_zero * body.first_flexible;
      modes.rigid_body.push_back(mode_of(is_zero ? Complex(0.0) : lambda, q, system.dofs));
    } else if (oscillates(lambda)) {
      modes.oscillatory.push_back(mode_of(lambda, q, system.dofs));
    } else if (refinement.improve(lambda, q, reach_of(lambda, found.lambda)) &&
               !refinement.is_infinite(lambda, q)) {
      modes.overdamped.push_back(lambda);
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
  std::vector<Mode> refined;
  for (Mode& mode : modes.oscillatory) {
    Complex lambda = mode.lambda;
    CVec q = mode.shape;
    if (!refinement.improve(lambda, q, reach_of(lambda, found.lambda))) continue;
    if (lambda != mode.lambda) mode = mode_of(lambda, q, system.dofs);
    refined.push_back(std::move(mode));
  }
  modes.oscillatory = std::move(refined);
  return modes;
}

/// Free systems are shifted by a part of their first flexible frequency, if they have one.
double shift_for(const FreeBody& body) {
  if (!body.is_free) return -body.slowest;
  return body.first_flexible > 0.0 ? -0.3 * body.first_flexible : -1.0;
}

/// What is known of a system before its modes are.
struct Knowledge {
  FreeBody body;
  EnergyBounds bounds;
};

/// The lowest modes by discs that cover where they can be, or nothing: if there are too many.
std::optional<Modes> searched_modes(const System& system, const Knowledge& known, int count,
                                    Completeness completeness) {
  int rigid = 0;
  while (2 * (count + rigid) < system.size()) {
    FrequencySearch search{.count = count + rigid,
                           .slope = 1.0 / hardly_oscillating,
                           .center = shift_for(known.body),
                           .bounds = known.bounds,
                           .is_proven = completeness == Completeness::proven};
    if (system.size() <= dense_after) search.most_discs = 1;
    QuadraticModes found;
    try {
      found = lowest_frequencies(system.M, system.D(), system.stiffness(), search);
    } catch (const NumericalError&) {
      return std::nullopt;
    }
    const bool is_all = (found.lambda.imag().array() > 0.0).count() < search.count;
    Modes modes = sorted(std::move(found), system, known.body, count);
    const int missing = count - static_cast<int>(modes.oscillatory.size());
    if (missing <= 0 || is_all) return modes;
    rigid += missing;
  }
  return std::nullopt;
}

/// The lowest modes of a large system.
Modes sparse_modes(const System& system, const Knowledge& known, int count) {
  if (auto modes = searched_modes(system, known, count, Completeness::proven)) {
    return *std::move(modes);
  }
  // all at once takes longer for large systems, but does not depend on where modes are
  return sorted(
      dense_quadratic_modes(system.M, system.D(), system.stiffness(), shift_for(known.body)),
      system, known.body, count);
}

/// The first of them that are found, or nothing: if these are too few.
std::optional<Modes> unproven_modes(const System& system, int count) {
  auto modes = searched_modes(system, {.body = free_body(system)}, count, Completeness::unproven);
  if (!modes || std::ssize(modes->oscillatory) < count) return std::nullopt;
  modes->completeness = Completeness::unproven;
  return modes;
}

Knowledge knowledge_of(const System& system) {
  return {.body = free_body(system), .bounds = energy_bounds(system.D(), system.stiffness())};
}

}  // namespace

double Mode::log_decrement() const {
  const double zeta = damping_ratio();
  return 2.0 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta);
}

ModesAtPoints::ModesAtPoints(Modes modes, const DofMap& dofs)
    : Modes(std::move(modes)),
      shape(dofs.full_size, static_cast<Eigen::Index>(oscillatory.size())) {
  for (Eigen::Index i = 0; i < shape.cols(); ++i) {
    shape.col(i) = dofs.T * oscillatory[static_cast<std::size_t>(i)].shape;
  }
}

std::vector<double> ModesAtPoints::real_roots() const {
  std::vector<double> roots;
  for (const Complex& root : overdamped) roots.push_back(root.real());
  return roots;
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

Whirl most_frequent(const std::vector<Whirl>& seen) {
  Whirl most = Whirl::planar;
  std::ptrdiff_t times = 0;
  for (const auto& [name, whirl] : choices(Whirl{})) {
    const auto here = std::count(seen.begin(), seen.end(), whirl);
    if (here > times) times = here, most = whirl;
  }
  return most;
}

Mode mode_of(Complex lambda, const CVec& q, const DofMap& dofs) {
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

std::vector<Mode> reduced_modes(const ReducedSystem& reduced, int count) {
  // about a shift below all frequencies, as stiffness may leave something free
  const Mat K = reduced.stiffness();
  double lowest = 1.0;
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    const double square = K(i, i) / reduced.M(i, i);
    if (square > 0.0) lowest = std::min(i > 0 ? lowest : square, square);
  }
  QuadraticModes found = dense_quadratic_modes(reduced.M.sparseView(), reduced.D().sparseView(),
                                               K.sparseView(), -0.1 * std::sqrt(lowest));
  found.q = reduced.Phi * found.q;
  if (reduced.Omega == 0.0) separate_planes(found, reduced.dofs);
  std::vector<Mode> modes;
  for (Eigen::Index i = 0; i < found.lambda.size(); ++i) {
    if (!oscillates(found.lambda(i))) continue;
    modes.push_back(mode_of(found.lambda(i), found.q.col(i), reduced.dofs));
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& a, const Mode& b) { return a.frequency() < b.frequency(); });
  if (static_cast<int>(modes.size()) > count) modes.resize(static_cast<std::size_t>(count));
  return modes;
}

Modes complex_modes(const System& system, int count, Completeness completeness) {
  if (system.size() >= dense_below) {
    if (completeness == Completeness::unproven) {
      if (auto modes = unproven_modes(system, count)) return *std::move(modes);
    }
    return sparse_modes(system, knowledge_of(system), count);
  }
  const FreeBody body = free_body(system);
  return sorted(dense_quadratic_modes(system.M, system.D(), system.stiffness(), shift_for(body)),
                system, body, count);
}

Modes complex_modes(const Assembler& assembler, double Omega, int count,
                    Completeness completeness) {
  if (!assembler.depends_on_whirl()) {
    return complex_modes(assembler.at(Omega), count, completeness);
  }
  return own_frequency_modes([&](double omega) { return assembler.at(Omega, omega); }, count,
                             completeness);
}

struct ModeFinder::State {
  const Assembler& assembler;
  System base;
  Knowledge known;

  System at(double Omega) const {
    if (assembler.depends_on_speed()) return assembler.at(Omega);
    System system = base;
    system.Omega = Omega;
    return system;
  }
  /// With the coefficients of a whirl frequency [rad/s].
  System at(double Omega, double frequency) const {
    return assembler.depends_on_whirl() ? assembler.at(Omega, frequency) : at(Omega);
  }
};

ModeFinder::ModeFinder(const Assembler& assembler)
    : state_(std::make_unique<State>(State{assembler, {}, {}})) {
  if (assembler.depends_on_speed()) return;
  state_->base = assembler.at(0.0);
  if (state_->base.size() >= dense_below) {
    state_->known = knowledge_of(state_->base);
  } else {
    state_->known.body = free_body(state_->base);
  }
}

ModeFinder::~ModeFinder() = default;

System ModeFinder::system(double Omega) const {
  return state_->at(Omega);
}

Modes ModeFinder::at(double Omega, int count) const {
  if (state_->assembler.depends_on_speed()) return complex_modes(state_->assembler, Omega, count);
  const System at_speed = system(Omega);
  if (at_speed.size() >= dense_below) return sparse_modes(at_speed, state_->known, count);
  const FreeBody& body = state_->known.body;
  return sorted(
      dense_quadratic_modes(at_speed.M, at_speed.D(), at_speed.stiffness(), shift_for(body)),
      at_speed, body, count);
}

std::optional<Mode> ModeFinder::followed(const Mode& mode, double Omega, double frequency) const {
  const System beside = state_->at(Omega, frequency);
  EigenPair pair{mode.lambda, mode.shape};
  if (!PairNewton(beside.M, beside.D(), beside.stiffness()).converge(pair, settled_step)) return {};
  if (!oscillates(pair.lambda)) return {};
  return mode_of(pair.lambda, pair.q, beside.dofs);
}

Modes ModeFinder::near(double Omega, double frequency, int count) const {
  const bool is_own = state_->assembler.depends_on_whirl();
  const System at_speed = state_->at(Omega, frequency);
  const auto all = [&] { return is_own ? complex_modes(at_speed, count) : at(Omega, count); };
  if (at_speed.size() < dense_below) return all();
  const FreeBody body = state_->assembler.depends_on_speed() ? FreeBody{} : state_->known.body;
  // undamped eigenvalues are on the axis: the center is not
  const Complex center{off_axis * frequency, frequency};
  const double everywhere = std::numeric_limits<double>::infinity();
  DiscModes disc =
      DiscSolver(at_speed.M, at_speed.D(), at_speed.stiffness()).around(center, everywhere, count);
  if (disc.lambda.size() == 0) return all();
  QuadraticModes found{std::move(disc.lambda), std::move(disc.q)};
  for (Eigen::Index i = 0; i < found.lambda.size(); ++i) {
    if (found.lambda(i).imag() >= 0.0) continue;
    found.lambda(i) = std::conj(found.lambda(i));
    found.q.col(i) = found.q.col(i).conjugate().eval();
  }
  return sorted(std::move(found), at_speed, body, std::numeric_limits<int>::max());
}

}  // namespace whirl::inline fe
