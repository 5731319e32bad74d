#include "libfe/parts/transfer_function.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"

namespace whirl::inline fe {

namespace {

/// Without zeros before the highest power; a zero polynomial is empty.
std::vector<double> trimmed(const std::vector<double>& p) {
  return {std::ranges::find_if(p, [](double c) { return c != 0.0; }), p.end()};
}

/// Without zero roots that both have.
void cancel_zero_roots(TransferFunction& f) {
  while (f.numerator.size() > 1 && f.denominator.size() > 1 && f.numerator.back() == 0.0 &&
         f.denominator.back() == 0.0) {
    f.numerator.pop_back();
    f.denominator.pop_back();
  }
}

/// A typical size of roots [rad/s].
double rate_of(const std::vector<double>& p) {
  for (std::size_t power = p.size() - 1; power > 0; --power) {  // of the lowest one that is there
    const double lowest = p[power];
    if (lowest != 0.0) return std::pow(std::abs(lowest / p[0]), 1.0 / static_cast<double>(power));
  }
  return 1.0;
}

/// Quotient, highest power first, and what is left in `p`, of the order below that of q.
std::vector<double> divided(std::vector<double>& p, const std::vector<double>& q) {
  std::vector<double> quotient;
  while (p.size() >= q.size()) {
    const double factor = p.front() / q.front();
    quotient.push_back(factor);
    for (std::size_t i = 0; i < q.size(); ++i) p[i] -= factor * q[i];
    p.erase(p.begin());
  }
  return quotient;
}

}  // namespace

std::vector<double> polynomial_product(const std::vector<double>& p, const std::vector<double>& q) {
  std::vector<double> r(p.size() + q.size() - 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  }
  return r;
}

std::vector<double> polynomial_sum(std::vector<double> p, std::vector<double> q) {
  if (p.size() < q.size()) std::swap(p, q);
  for (std::size_t i = 0; i < q.size(); ++i) p[p.size() - q.size() + i] += q[i];
  return p;
}

TransferFunction function_of(const std::vector<PoleResidue>& parts) {
  TransferFunction f{{0.0}, {1.0}};
  for (const auto& [pole, matrix] : parts) {
    const Complex residue = matrix(0, 0);
    TransferFunction part{{residue.real()}, {1.0, -pole.real()}};
    if (pole.imag() != 0.0) {
      part = {{2.0 * residue.real(), -2.0 * (residue * std::conj(pole)).real()},
              {1.0, -2.0 * pole.real(), std::norm(pole)}};
    }
    f.numerator = polynomial_sum(polynomial_product(f.numerator, part.denominator),
                                 polynomial_product(part.numerator, f.denominator));
    f.denominator = polynomial_product(f.denominator, part.denominator);
  }
  return f;
}

TransferFunction dynamic_stiffness_of(const TransferFunction& function, TransferForm form) {
  TransferFunction f = function;
  if (form == TransferForm::receptance || form == TransferForm::mobility) {
    std::swap(f.numerator, f.denominator);
  }
  if (form == TransferForm::impedance || form == TransferForm::mobility) {
    f.numerator.push_back(0.0);
    cancel_zero_roots(f);
  }
  return f;
}

StateSpace state_space(const TransferFunction& dynamic_stiffness) {
  std::vector<double> left = trimmed(dynamic_stiffness.numerator);
  const std::vector<double> q = trimmed(dynamic_stiffness.denominator);
  const auto is_finite = [](double c) { return std::isfinite(c); };
  if (!std::ranges::all_of(left, is_finite) || !std::ranges::all_of(q, is_finite)) {
    throw NumericalError("a coefficient is not finite");
  }
  if (q.empty()) throw NumericalError("the denominator is zero");
  if (left.size() > q.size() + 2) {
    throw NumericalError(
        "the dynamic stiffness grows with more than the square of the frequency, which no spring, "
        "damper and mass do");
  }
  std::vector<double> direct = divided(left, q);
  direct.insert(direct.begin(), 3 - direct.size(), 0.0);

  const auto n = static_cast<Eigen::Index>(q.size()) - 1;
  const auto if_any = [](double value) {
    return value == 0.0 ? Mat() : Mat(Mat::Constant(1, 1, value));
  };
  StateSpace law{Mat::Zero(n, n),   Mat::Zero(n, 1),
                 Mat::Zero(1, n),   Mat::Constant(1, 1, direct[2]),
                 if_any(direct[1]), if_any(direct[0])};
  if (n == 0) return law;
  // companion form over powers of s / rate
  const double rate = rate_of(q);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double power = std::pow(rate, static_cast<double>(i + 1));
    law.A(0, i) = -rate * q[static_cast<std::size_t>(i) + 1] / (q[0] * power);
    if (i > 0) law.A(i, i - 1) = rate;
  }
  law.B(0, 0) = rate;
  left.insert(left.begin(), static_cast<std::size_t>(n) - left.size(), 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double power = std::pow(rate, static_cast<double>(i + 1));
    law.C(0, i) = left[static_cast<std::size_t>(i)] / (q[0] * power);
  }
  return law;
}

StateSpace state_space(const std::vector<PoleResidue>& parts, const Mat& D) {
  constexpr double negligible = 1e-14;  ///< of the largest singular value
  std::vector<Mat> A, B, C;
  for (const auto& [pole, residue] : parts) {
    const Eigen::JacobiSVD<CMat> svd(residue, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Vec sizes = svd.singularValues();
    for (Eigen::Index k = 0; k < sizes.size() && sizes(k) > negligible * sizes(0); ++k) {
      const CVec to = sizes(k) * svd.matrixU().col(k), from = svd.matrixV().col(k).conjugate();
      const bool is_real = pole.imag() == 0.0;
      const int states = is_real ? 1 : 2;
      Mat a(states, states), b(states, D.cols()), c(D.rows(), states);
      if (is_real) {
        a << pole.real();
        Eigen::Index largest = 0;  // vectors of a real residue are real up to a phase
        from.cwiseAbs().maxCoeff(&largest);
        const Complex turn = std::polar(1.0, -std::arg(from(largest)));
        b << (turn * from).real().transpose();
        c << (to / turn).real();
      } else {
        a << pole.real(), -pole.imag(), pole.imag(), pole.real();
        b << from.real().transpose(), from.imag().transpose();
        c << 2.0 * to.real(), -2.0 * to.imag();
      }
      A.push_back(a);
      B.push_back(b);
      C.push_back(c);
    }
  }
  Eigen::Index n = 0;
  for (const Mat& a : A) n += a.rows();
  StateSpace law{Mat::Zero(n, n), Mat(n, D.cols()), Mat(D.rows(), n), D, {}, {}};
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < A.size(); ++k) {
    const Eigen::Index states = A[k].rows();
    law.A.block(at, at, states, states) = A[k];
    law.B.middleRows(at, states) = B[k];
    law.C.middleCols(at, states) = C[k];
    at += states;
  }
  return law;
}

}  // namespace whirl::inline fe
