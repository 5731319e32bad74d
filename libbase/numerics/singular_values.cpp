#include "libbase/numerics/singular_values.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace whirl::inline base {

LeftSingular left_singular(const Mat& A) {
  const Eigen::BDCSVD<Mat> svd(A, Eigen::ComputeThinU);
  return {svd.singularValues(), svd.matrixU()};
}

ThinQr thin_qr(const Mat& A) {
  const Eigen::HouseholderQR<Mat> qr(A);
  return {qr.householderQ() * Mat::Identity(A.rows(), A.cols()),
          Mat(qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>())};
}

}  // namespace whirl::inline base
