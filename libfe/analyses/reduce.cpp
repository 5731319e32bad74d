#include "libfe/analyses/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/reduction_error.hpp"
#include "libfe/analyses/static_shapes.hpp"
#include "libfe/assembly/states_apart.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr double dependent = 1e-7;  ///< of its M-norm: what is left of a shape that repeats others
constexpr int largest_basis = 60;
constexpr int small_system = 12;  ///< dofs that are not worth reducing

/// Adds the part of `shapes` that is new, M-orthonormal.
void append_orthonormal(Mat& basis, const Mat& shapes, const Sparse& M) {
  for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
    Vec v = shapes.col(j);
    const double before = std::sqrt(v.dot(M * v));
    if (!(before > 0.0)) continue;
    v /= before;
    for (int twice = 0; twice < 2; ++twice) {
      if (basis.cols() > 0) v -= basis * (basis.transpose() * (M * v));
    }
    const double left = std::sqrt(v.dot(M * v));
    if (left < dependent) continue;
    basis.conservativeResize(M.rows(), basis.cols() + 1);
    basis.col(basis.cols() - 1) = v / left;
  }
}

/// K_s^-1 f for every load f; free systems by a shift that leaves their rigid modes aside.
Mat static_shapes(const Sparse& K, const Sparse& M, const Mat& loads, const RealModes& modes) {
  Sparse A = K;
  if (modes.rigid > 0) {
    const double flexible = modes.first_flexible();  // 0: nothing deforms, K = 0
    A = K + (flexible > 0.0 ? 0.09 * flexible * flexible : 1.0) * M;
  }
  const SparseLu solver(A);
  if (!solver.is_regular()) throw NumericalError("static shapes: the stiffness is singular");
  return solver.solve(loads);
}

/// Basis of damped modes: the rigid ones, real and imaginary parts of the lowest others.
Mat damped_basis(const Modes& modes, const Mat& rigid, const Sparse& M, int size) {
  Mat basis = rigid.leftCols(std::min<Eigen::Index>(size, rigid.cols()));
  for (const Mode& mode : modes.oscillatory) {
    if (basis.cols() + 1 > size) break;
    Mat parts(M.rows(), 2);
    parts << mode.shape.real(), mode.shape.imag();
    append_orthonormal(basis, parts, M);
  }
  return basis;
}

/// The matrices of the structure, whose shapes are sought; coordinates of states stay as they are.
struct ShapesOf {
  StatesApart parts;
  Sparse K, M;

  explicit ShapesOf(const System& system)
      : parts(system.dofs),
        K(symmetric_part(parts.has_states() ? stiffness_at_rest(system, parts) : system.K)),
        M(symmetric_inertia(without_states(system.M))) {}

  int size() const { return static_cast<int>(K.rows()); }
  Sparse without_states(const Sparse& A) const {
    if (!parts.has_states()) return A;
    return parts.structure.transpose() * Sparse(A * parts.structure);
  }
  Mat of_structure(const Mat& shapes) const {
    return parts.has_states() ? Mat(parts.structure.transpose() * shapes) : shapes;
  }
  /// How the states push the structure, a column for each kind of push.
  Mat loads_of_states(const System& system) const {
    Mat loads(size(), 2 * parts.states.cols());
    if (parts.has_states()) {
      loads << Mat(parts.structure.transpose() * Sparse(system.K * parts.states)),
          Mat(parts.structure.transpose() * Sparse(system.C * parts.states));
    }
    return loads;
  }
  /// Shapes of the structure, over all coordinates.
  Mat in_all(const Mat& shapes) const {
    return parts.has_states() ? Mat(parts.structure * shapes) : shapes;
  }
  /// And one of each state.
  Mat with_states(const Mat& shapes) const {
    Mat all(parts.structure.rows(), shapes.cols() + parts.states.cols());
    all << in_all(shapes), Mat(parts.states);
    return all;
  }
};

/// Shapes in the span of a basis that are orthonormal with respect to M, and orthogonal with
/// respect to K.
Mat ritz_shapes(const Sparse& K_s, const Sparse& M_s, const Mat& basis) {
  if (basis.cols() == 0) throw NumericalError("the reduction has no shape: nothing oscillates");
  const Mat M = basis.transpose() * (M_s * basis);
  const Mat K = basis.transpose() * (K_s * basis);
  const auto ritz = symmetric_modes(0.5 * (K + K.transpose()), M);
  if (!ritz) {
    throw NumericalError("the basis of the reduction has no inertia in some direction");
  }
  Mat Phi = basis * ritz->vectors;
  for (Eigen::Index j = 0; j < Phi.cols(); ++j) {
    Eigen::Index largest = 0;
    Phi.col(j).cwiseAbs().maxCoeff(&largest);
    if (Phi(largest, j) < 0.0) Phi.col(j) *= -1.0;
  }
  return Phi;
}

/// The system in the shapes that a basis of its structure makes, and its states.
ReducedSystem projected(const System& system, const ShapesOf& shapes, const Mat& basis) {
  if (!shapes.parts.has_states()) return project(system, basis);
  return in_shapes(system, shapes.with_states(ritz_shapes(shapes.K, shapes.M, basis)));
}

ReducedSystem unreduced(const System& system) {
  return {system.mapped([](const Sparse& A) { return Mat(A); }),
          Mat::Identity(system.size(), system.size()), system.dofs};
}

}  // namespace

ReducedSystem in_shapes(const System& system, const Mat& Phi) {
  const auto small = [&](const Sparse& A) -> Mat {
    if (A.nonZeros() == 0) return Mat::Zero(Phi.cols(), Phi.cols());
    return Phi.transpose() * (A * Phi);
  };
  return {system.mapped(small), Phi, system.dofs};
}

ReducedSystem project(const System& system, const Mat& basis) {
  return in_shapes(system, ritz_shapes(system.K, symmetric_inertia(system.M), basis));
}

ReducedSystem reduce(const System& system, const Reduction& how, const std::vector<Vec>& ports,
                     const std::vector<Vec>& others, ReductionError* error) {
  const int n = system.size();
  if ((system.M.diagonal().array() <= 0.0).any()) {
    throw NumericalError(
        "a freedom without inertia has a damper of its own, so that the motion cannot be "
        "integrated as it stands: give the shaft a density or its station a mass");
  }
  ReductionMethod method = how.method;
  if (method == ReductionMethod::automatic) {
    method = n <= small_system ? ReductionMethod::none : ReductionMethod::modal_residual;
  }
  const bool is_whole = method == ReductionMethod::none || how.modes >= n;
  if (is_whole) {
    if (error) *error = {};
    return unreduced(system);
  }

  const ShapesOf shapes(system);
  const Sparse& K = shapes.K;
  const Sparse& M = shapes.M;
  const int most = how.modes > 0 ? how.modes : std::min(n, largest_basis);
  double band = how.band > 0.0 ? how.band : 2.0 * std::abs(system.Omega);

  RealModes real{.Phi = Mat(shapes.size(), 0)};
  Modes damped;
  Mat residual(shapes.size(), 0);
  if (method == ReductionMethod::damped) {
    damped = complex_modes(system, (most + 1) / 2);
    if (!damped.rigid_body.empty()) real = lowest_real_modes(K, M, std::min(shapes.size(), 16));
    if (band == 0.0 && !damped.oscillatory.empty()) {
      band = 3.0 * damped.oscillatory.front().frequency();
    }
  } else {
    for (int count = most + 1;; count *= 2) {  // beyond the rigid ones of a free system
      real = lowest_real_modes(K, M, count);
      if (real.first_flexible() > 0.0 || count >= shapes.size()) break;
    }
    if (band == 0.0) band = 3.0 * real.first_flexible();
  }
  if (method == ReductionMethod::modal_residual) {
    std::vector<Vec> rows = ports;
    rows.insert(rows.end(), others.begin(), others.end());
    Mat loads(n, std::ssize(rows));
    for (Eigen::Index i = 0; i < loads.cols(); ++i)
      loads.col(i) = rows[static_cast<std::size_t>(i)];
    loads = shapes.of_structure(loads);
    if (shapes.parts.has_states()) {
      const Mat pushes = shapes.loads_of_states(system);
      loads.conservativeResize(Eigen::NoChange, loads.cols() + pushes.cols());
      loads.rightCols(pushes.cols()) = pushes;
    }
    if (loads.cols() > 0) residual = static_shapes(K, M, loads, real);
  }
  const auto with = [&](int modes) {
    if (method == ReductionMethod::damped) {
      const Mat rigid = shapes.in_all(real.Phi.leftCols(real.rigid));
      return project(system, damped_basis(damped, rigid, symmetric_inertia(system.M), modes));
    }
    Mat basis = real.Phi.leftCols(std::min<Eigen::Index>(modes, real.Phi.cols()));
    append_orthonormal(basis, residual, M);
    return projected(system, shapes, basis);
  };

  ReducedSystem reduced;
  ReductionError found;
  std::optional<WholeSystem> whole;
  for (int modes = how.modes > 0 ? how.modes : std::min(4, most);; modes += 2) {
    reduced = with(std::min(modes, most));
    if (how.modes > 0 && !error) break;
    if (!whole) whole.emplace(system, ports, band);
    found = whole->error_of(reduced);
    found.within_tolerance = std::max(found.eigenvalue(), found.receptance) <= how.tolerance;
    if (found.within_tolerance || modes >= most) break;
  }
  if (error) *error = found;
  return reduced;
}

ReducedSystem with_static_shapes(const System& system, const ReducedSystem& reduced,
                                 const Mat& loads) {
  const ShapesOf shapes(system);
  constexpr int few = 16;  // modes, more than can be rigid
  const RealModes modes = lowest_real_modes(shapes.K, shapes.M, std::min(shapes.size(), few));
  Mat basis(shapes.size(), 0);
  append_orthonormal(basis, shapes.of_structure(reduced.Phi), shapes.M);
  const Eigen::Index before = basis.cols();
  append_orthonormal(basis, static_shapes(shapes.K, shapes.M, shapes.of_structure(loads), modes),
                     shapes.M);
  return basis.cols() == before ? reduced : projected(system, shapes, basis);
}

}  // namespace whirl::inline fe
