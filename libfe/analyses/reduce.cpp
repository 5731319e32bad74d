#include "libfe/analyses/reduce.hpp"

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/analyses/modes.hpp"
#include "libfe/analyses/static_shapes.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/eigen/quadratic.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr double dependent = 1e-7;  ///< of its M-norm: what is left of a shape that repeats others
constexpr int band_samples = 25;    ///< frequencies at which receptances are compared
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
  if (basis.cols() == 0) throw NumericalError("the reduction has no shape: nothing oscillates");
  const Mat M = basis.transpose() * (symmetric_inertia(system.M) * basis);
  const Mat K = basis.transpose() * (system.K * basis);
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
  return in_shapes(system, Phi);
}

ReductionError reduction_error(const System& system, const ReducedSystem& reduced,
                               const std::vector<Vec>& ports, double band) {
  ReductionError error{.band = band};
  int wanted = std::max(4, reduced.size());
  Modes full = complex_modes(system, wanted);
  const auto ends_within = [&] {
    return static_cast<int>(full.oscillatory.size()) == wanted &&
           full.oscillatory.back().frequency() <= band;
  };
  while (wanted < 2 * largest_basis && ends_within()) full = complex_modes(system, wanted *= 2);
  const QuadraticModes small = dense_quadratic_modes(
      Mat(reduced.M).sparseView(), Mat(reduced.D()).sparseView(), reduced.stiffness().sparseView(),
      full.rigid_body.empty() ? 0.0 : -0.1 * std::max(1.0, band));
  for (const Mode& mode : full.oscillatory) {
    if (mode.frequency() > band) break;
    ReductionError::Pair pair{mode.lambda, 0.0};
    for (Eigen::Index i = 0; i < small.lambda.size(); ++i) {
      const Complex lambda = small.lambda(i);
      if (std::abs(lambda - pair.full) < std::abs(pair.reduced - pair.full)) pair.reduced = lambda;
    }
    error.pairs.push_back(pair);
  }
  if (ports.empty()) return error;

  const auto count = static_cast<Eigen::Index>(ports.size());
  CMat rows(system.size(), count);
  for (Eigen::Index j = 0; j < count; ++j)
    rows.col(j) = ports[static_cast<std::size_t>(j)].cast<Complex>();
  const CMat small_rows = reduced.Phi.transpose().cast<Complex>() * rows;
  const Mat small_K = reduced.stiffness(), small_D = reduced.D();
  DynamicStiffness stiffness(system);
  double static_size = 0.0;  // of the receptance at the lowest frequency
  for (int s = 0; s < band_samples; ++s) {
    const double w = band * (s + 0.5) / band_samples;
    CMat exact(count, count);
    bool is_regular = true;
    for (Eigen::Index j = 0; j < count; ++j) {
      const auto q = stiffness.solve(w, system.Omega, rows.col(j));
      is_regular = is_regular && q;
      if (q) exact.col(j) = rows.transpose() * *q;
    }
    if (!is_regular) continue;
    const CMat Z =
        (small_K - w * w * reduced.M).cast<Complex>() + Complex(0.0, w) * small_D.cast<Complex>();
    const CMat approximate = small_rows.transpose() * DenseLu<CMat>(Z).solve(small_rows);
    // at an antiresonance the static receptance is the measure, not the vanishing one
    if (static_size == 0.0) static_size = exact.norm();
    error.receptance =
        std::max(error.receptance, (approximate - exact).norm() / (exact.norm() + static_size));
  }
  return error;
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

  const Sparse K = symmetric_part(system.K), M = symmetric_inertia(system.M);
  const int most = how.modes > 0 ? how.modes : std::min(n, largest_basis);
  double band = how.band > 0.0 ? how.band : 2.0 * std::abs(system.Omega);

  RealModes real;
  Modes damped;
  Mat residual(n, 0);
  if (method == ReductionMethod::damped) {
    damped = complex_modes(system, (most + 1) / 2);
    if (!damped.rigid_body.empty()) real = lowest_real_modes(K, M, std::min(n, 16));
    if (band == 0.0 && !damped.oscillatory.empty()) {
      band = 3.0 * damped.oscillatory.front().frequency();
    }
  } else {
    for (int count = most + 1;; count *= 2) {  // beyond the rigid ones of a free system
      real = lowest_real_modes(K, M, count);
      if (real.first_flexible() > 0.0 || count >= n) break;
    }
    if (band == 0.0) band = 3.0 * real.first_flexible();
  }
  if (method == ReductionMethod::modal_residual) {
    std::vector<Vec> rows = ports;
    rows.insert(rows.end(), others.begin(), others.end());
    Mat loads(n, std::ssize(rows));
    for (Eigen::Index i = 0; i < loads.cols(); ++i)
      loads.col(i) = rows[static_cast<std::size_t>(i)];
    if (!rows.empty()) residual = static_shapes(K, M, loads, real);
  }
  const auto with = [&](int modes) {
    if (method == ReductionMethod::damped) {
      return project(system, damped_basis(damped, real.Phi.leftCols(real.rigid), M, modes));
    }
    Mat basis = real.Phi.leftCols(std::min<Eigen::Index>(modes, real.Phi.cols()));
    append_orthonormal(basis, residual, M);
    return project(system, basis);
  };

  ReducedSystem reduced;
  ReductionError found;
  for (int modes = how.modes > 0 ? how.modes : std::min(4, most);; modes += 2) {
    reduced = with(std::min(modes, most));
    if (how.modes > 0 && !error) break;
    found = reduction_error(system, reduced, ports, band);
    found.within_tolerance = std::max(found.eigenvalue(), found.receptance) <= how.tolerance;
    if (found.within_tolerance || modes >= most) break;
  }
  if (error) *error = found;
  return reduced;
}

ReducedSystem with_static_shapes(const System& system, const ReducedSystem& reduced,
                                 const Mat& loads) {
  const Sparse K = symmetric_part(system.K), M = symmetric_inertia(system.M);
  constexpr int few = 16;  // modes, more than can be rigid
  const RealModes modes = lowest_real_modes(K, M, std::min(system.size(), few));
  Mat basis(system.size(), 0);
  append_orthonormal(basis, reduced.Phi, M);
  append_orthonormal(basis, static_shapes(K, M, loads, modes), M);
  return basis.cols() == reduced.Phi.cols() ? reduced : project(system, basis);
}

}  // namespace whirl::inline fe
