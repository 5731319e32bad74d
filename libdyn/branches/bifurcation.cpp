#include "libdyn/branches/bifurcation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libbase/numerics/dense.hpp"

namespace whirl::inline dyn {

namespace {

/// Product of factors by its sign and its smallest factor.
class SignedProduct {
 public:
  void multiply(const Complex& factor) {
    const double size = std::abs(factor);
    smallest_ = std::min(smallest_, size);
    product_ *= size > 0.0 ? factor / size : Complex(1.0);
  }
  double value() const { return std::copysign(smallest_, product_.real()); }

 private:
  Complex product_{1.0};
  double smallest_ = std::numeric_limits<double>::infinity();
};

/// The direction that a nearly singular matrix takes to zero, of length 1.
std::optional<Vec> null_direction(const Mat& A) {
  const Eigen::Index n = A.rows();
  // a shift keeps an exactly singular matrix solvable and does not move its null vector
  Mat shifted = A;
  shifted.diagonal().array() += 1e-14 * std::max(1.0, A.cwiseAbs().maxCoeff());
  const DenseLu<Mat> lu(shifted);
  Vec v = Vec::LinSpaced(n, 1.0, 2.0);
  double growth = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vec next = lu.solve(v.normalized());
    if (!next.allFinite()) return std::nullopt;
    growth = next.norm();
    v = next;
  }
  if (growth < 1e3) return std::nullopt;  // not singular
  return v.normalized();
}

}  // namespace

double test_function(BifurcationKind kind, const BranchPoint& point) {
  SignedProduct product;
  const CVec& mu = point.multipliers;
  switch (kind) {
    case BifurcationKind::fold:
      return point.tangent(point.tangent.size() - 1);
    case BifurcationKind::period_doubling:
      for (const Complex& m : mu) product.multiply(m + 1.0);
      return product.value();
    case BifurcationKind::pitchfork:
      for (const Complex& m : mu) product.multiply(m - 1.0);
      return product.value();
    case BifurcationKind::neimark_sacker:
      for (Eigen::Index i = 0; i < mu.size(); ++i) {
        for (Eigen::Index j = 0; j < i; ++j) product.multiply(mu(i) * mu(j) - 1.0);
      }
      return mu.size() > 1 ? product.value() : 1.0;
    case BifurcationKind::grazing:
      break;
  }
  return 1.0;
}

Complex critical_multiplier(BifurcationKind kind, const CVec& mu) {
  if (kind == BifurcationKind::grazing || mu.size() == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (kind == BifurcationKind::neimark_sacker) {
    Complex found = mu(0);
    double smallest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < mu.size(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        const double size = std::abs(mu(i) * mu(j) - 1.0);
        if (size < smallest) {
          smallest = size;
          found = mu(i).imag() > 0.0 ? mu(i) : mu(j);
        }
      }
    }
    return found;
  }
  const double at = kind == BifurcationKind::period_doubling ? -1.0 : 1.0;
  return *std::min_element(mu.begin(), mu.end(), [&](const Complex& a, const Complex& b) {
    return std::abs(a - at) < std::abs(b - at);
  });
}

std::optional<SwitchedBranch> switch_branch(const FlowAt& flow_at, const Vec& scale, int period,
                                            const Bifurcation& at) {
  const Eigen::Index n = scale.size(), size = n * period;
  PeriodicOrbit orbit{.period = period};
  for (int i = 0; i < period; ++i) orbit.states.push_back(at.at.state(scale, i));
  Flow flow = flow_at(at.at.value);
  flow.scale = scale;
  if (shoot(flow, orbit).size() == 0) return std::nullopt;
  Mat J = shooting_jacobian(orbit.tangents);
  SwitchedBranch next{period, at.at};
  next.start.multipliers.resize(0);
  const double u = at.at.z(size);
  if (at.kind == BifurcationKind::period_doubling) {
    // what comes back with the other sign: A_m ... A_1 v = -v
    J.block((period - 1) * n, 0, n, n).diagonal().array() += 2.0;
    const auto v = null_direction(J);
    if (!v) return std::nullopt;
    next.period = 2 * period;
    for (ContactMeasure& c : next.start.contacts) c.impacts *= 2.0;
    next.start.z.resize(2 * size + 1);
    next.start.z << at.at.z.head(size), at.at.z.head(size), u;
    next.start.tangent.resize(2 * size + 1);
    next.start.tangent << *v, -*v, 0.0;
  } else if (at.kind == BifurcationKind::pitchfork) {
    // the other direction of the null space, across the tangent
    const auto v = null_direction(J);
    if (!v) return std::nullopt;
    next.start.tangent = Vec::Zero(size + 1);
    next.start.tangent.head(size) = *v;
    // as a step along the branch is no way to leave it
    const Vec along = at.at.tangent;
    const double n_states = static_cast<double>(size);
    const auto dot = [&](const Vec& a, const Vec& b) {
      return a.head(size).dot(b.head(size)) / n_states + a(size) * b(size);
    };
    next.start.tangent -= dot(along, next.start.tangent) / dot(along, along) * along;
  } else {
    return std::nullopt;
  }
  const Eigen::Index all = next.start.z.size() - 1;
  next.start.tangent /=
      std::sqrt(next.start.tangent.head(all).squaredNorm() / static_cast<double>(all) +
                next.start.tangent(all) * next.start.tangent(all));
  next.start.step = 1e-3;
  return next;
}

}  // namespace whirl::inline dyn
