#include "libfe/analyses/craig_bampton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libfe/assembly/states_apart.hpp"
#include "libfe/eigen/positive_factor.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

/// With inertia where there is none, as lumped masses leave rotations: so little that the fastest
/// coordinate is a million times slower.
Sparse with_inertia_everywhere(const Sparse& M, const Sparse& K) {
  constexpr double faster = 1e6;
  const Vec mass = M.diagonal(), stiffness = K.diagonal();
  double fastest = 0.0;  // [rad^2/s^2]
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (mass(i) > 0.0) fastest = std::max(fastest, stiffness(i) / mass(i));
  }
  Sparse all = M;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (mass(i) == 0.0) all.coeffRef(i, i) = stiffness(i) / (faster * faster * fastest);
  }
  return all;
}

/// The coordinates that are not in a list, in ascending order.
std::vector<int> others(int size, const std::vector<int>& list) {
  std::vector<int> left;
  for (int i = 0; i < size; ++i) {
    if (std::ranges::find(list, i) == list.end()) left.push_back(i);
  }
  return left;
}

}  // namespace

StructureMatrices<Mat> craig_bampton(const StructureMatrices<Sparse>& structure,
                                     const std::vector<int>& interface, int modes) {
  const Sparse ports = unit_columns(structure.size(), interface);
  const Sparse I = unit_columns(structure.size(), others(structure.size(), interface));
  const Sparse K_i = block_of(I, structure.K, I), M_i = block_of(I, structure.M, I);
  const auto inner = static_cast<int>(K_i.rows());
  const auto oscillating = static_cast<int>((M_i.diagonal().array() > 0.0).count());
  const int count = std::min(modes, oscillating);
  Mat shapes(structure.size(), std::ssize(interface) + count);
  shapes.leftCols(std::ssize(interface)) = Mat(ports);
  if (inner > 0) {
    const auto factor = positive_factor(K_i);
    if (!factor) {
      throw NumericalError(
          "the structure moves where its interface is held: it lacks supports, or parts of it hang "
          "together by nothing");
    }
    const Mat coupling(block_of(I, structure.K, ports));
    shapes.leftCols(std::ssize(interface)) -= I * factor->solve(coupling);
    if (count > 0) {
      const RealModes found = lowest_real_modes(K_i, with_inertia_everywhere(M_i, K_i), count);
      shapes.rightCols(count) = I * found.Phi;
    }
  }
  const auto reduced = [&](const Sparse& A) -> Mat { return shapes.transpose() * (A * shapes); };
  return {reduced(structure.M), structure.C.rows() > 0 ? reduced(structure.C) : Mat(),
          reduced(structure.K)};
}

void set_law(Support& support, const StructureMatrices<Mat>& reduced) {
  const auto p = std::ssize(support.acts_on), m = reduced.size() - p;
  const Mat C_all =
      reduced.C.rows() > 0 ? reduced.C : Mat(Mat::Zero(reduced.size(), reduced.size()));
  // modes of unit mass, whatever the file says
  const Mat root = reduced.M.bottomRightCorner(m, m).llt().matrixL();
  const auto scaled = [&](const Mat& A) -> Mat {
    return root.triangularView<Eigen::Lower>().solve(A);
  };
  const auto on_modes = [&](const Mat& A) -> Mat {
    return scaled(scaled(A.bottomRightCorner(m, m)).transpose());
  };
  const Mat K = on_modes(reduced.K), C = on_modes(C_all);
  const Mat P = scaled(reduced.M.bottomLeftCorner(m, p));
  const Mat K_u = scaled(reduced.K.bottomLeftCorner(m, p));  // zero but for rounding
  const Mat in = K * P - K_u, in_rate = C * P - scaled(C_all.bottomLeftCorner(m, p));

  StateCoordinates c;
  c.K_w = K;
  c.C_w = C;
  c.B_0 = in;
  c.B_1 = in_rate;
  c.C_0 = -in.transpose();
  c.C_1 = -in_rate.transpose();
  const Mat Pt = P.transpose();
  c.D = reduced.K.topLeftCorner(p, p) - Pt * K_u + in.transpose() * P;
  c.idle.resize(static_cast<std::size_t>(m));
  StateSpace& law = support.law;
  law.D_rate = C_all.topLeftCorner(p, p) - Pt * scaled(C_all.bottomLeftCorner(m, p)) +
               in_rate.transpose() * P;
  law.D_inertia = reduced.M.topLeftCorner(p, p) - Pt * P;

  // states v and (v' - in_rate u) / rate
  const double rate = std::sqrt(std::max(m > 0 ? K.diagonal().maxCoeff() : 1.0, 1e-300));
  law.A.resize(2 * m, 2 * m);
  law.B.resize(2 * m, p);
  law.C.resize(p, 2 * m);
  law.A << Mat::Zero(m, m), rate * Mat::Identity(m, m), -K / rate, -C;
  law.B << in_rate, (in - C * in_rate) / rate;
  law.C << c.C_0, rate * c.C_1;
  law.D = c.D + c.C_1 * in_rate;
  support.coordinates = c;
}

}  // namespace whirl::inline fe
