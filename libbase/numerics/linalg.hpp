#pragma once
/// Names of the matrix types that all libraries share. Dense is `Mat`, complex starts with C.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

namespace whirl::inline base {

using Complex = std::complex<double>;
using Vec = Eigen::VectorXd;
using Mat = Eigen::MatrixXd;
using CVec = Eigen::VectorXcd;
using CMat = Eigen::MatrixXcd;
using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
using Sparse = Eigen::SparseMatrix<double>;
using CSparse = Eigen::SparseMatrix<Complex>;
using Triplet = Eigen::Triplet<double>;

}  // namespace whirl::inline base
