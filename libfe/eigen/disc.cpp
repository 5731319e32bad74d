#include "libfe/eigen/disc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "libbase/numerics/dense_complex.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libfe/eigen/pencil.hpp"

namespace whirl::inline fe {

namespace {

constexpr int largest_basis = 100;  ///< vectors; beyond, more discs cost less than larger ones
constexpr int first_look = 18;      ///< vectors before eigenvalues are computed first
constexpr double growth = 1.4;      ///< of the basis from look to look
constexpr int starts = 2;           ///< vectors at the beginning: isotropic rotors have pairs
constexpr int rounds = 5;           ///< powers of the inverse a fresh vector gets to show something
constexpr double converged = 1e-11;  ///< residual over the size of an eigenvalue of the inverse
constexpr double exhausted = 1e-13;  ///< of its length: what is left of a vector inside the basis
constexpr double rim = 1e-6;         ///< relative distance in which a disc does not end
constexpr double real_axis = 1e-10;  ///< |Im| of an eigenvalue that is real, over its size

/// (A - s I)^-1 of the state (q, p = q' / scale) for a complex s.
struct ShiftedInverse {
  const CSparse &M, &D;
  const ComplexSparseLu& factor;
  Complex s;
  double scale;

  CVec operator()(const Eigen::Ref<const CVec>& in) const {
    const auto n = M.rows();
    const auto q = in.head(n), p = in.tail(n);
    CVec load = M * CVec(scale * p + s * q);
    load += D * q;
    const CVec x = factor.solve(load);
    CVec out(2 * n);
    out.head(n) = -x;
    out.tail(n) = (q - s * x) / scale;
    return out;
  }
};

/// An orthonormal basis that grows by the images of its own vectors.
class KrylovBasis {
 public:
  KrylovBasis(const ShiftedInverse& op, Eigen::Index states)
      : op_(op),
        most_(std::min<Eigen::Index>(largest_basis, states)),
        vectors_(states, most_ + starts + 8),
        projected_(CMat::Zero(vectors_.cols(), most_)) {}

  /// Number of vectors whose images are known.
  Eigen::Index size() const { return done_; }
  bool is_full() const { return done_ >= most_; }
  /// Whether nothing leads out of it.
  bool is_invariant() const { return done_ == columns_; }

  /// Adds a random direction; false if there is none left.
  bool add_fresh() {
    if (columns_ >= vectors_.rows() || columns_ >= vectors_.cols()) return false;
    CVec fresh(vectors_.rows());
    std::normal_distribution<double> normal;
    for (Complex& x : fresh) x = {normal(random_), normal(random_)};
    fresh = op_(fresh);  // what is infinite is no part of it
    return append(fresh, nullptr);
  }

  /// Adds the image of the next vector.
  void advance() {
    CVec image = op_(vectors_.col(done_));
    ++done_;
    append(image, &projected_);
  }

  /// Eigenvalues and vectors of the projection; nothing if they cannot be found.
  std::optional<GeneralModes> ritz() const {
    return general_modes(CMat(projected_.topLeftCorner(done_, done_)));
  }
  /// How far A x is from nu x for a vector y of the projection, x = V y.
  double residual(const CVec& y) const {
    return (projected_.block(done_, 0, columns_ - done_, done_) * y).norm();
  }
  CVec vector(const CVec& y) const { return vectors_.leftCols(done_) * y; }

 private:
  /// Appends the part of v that is new; the other parts go into a column of `to`.
  bool append(CVec& v, CMat* to) {
    const double before = v.norm();
    const auto basis = vectors_.leftCols(columns_);
    for (int twice = 0; twice < 2 && columns_ > 0; ++twice) {
      const CVec parts = basis.adjoint() * v;
      v -= basis * parts;
      if (to) to->col(done_ - 1).head(columns_) += parts;
    }
    const double left = v.norm();
    if (!(left > exhausted * before) || columns_ >= vectors_.cols()) return false;
    if (to) (*to)(columns_, done_ - 1) = left;
    vectors_.col(columns_++) = v / left;
    return true;
  }

  const ShiftedInverse& op_;
  Eigen::Index most_;
  CMat vectors_, projected_;
  Eigen::Index done_ = 0, columns_ = 0;
  std::mt19937 random_{1};
};

/// What is known of the disc with a basis.
struct Look {
  double radius = 0.0;        ///< complete to here
  std::vector<CVec> vectors;  ///< of the projection, one for each eigenvalue in the disc
  std::vector<Complex> nu;    ///< 1 / (lambda - center), largest first
  int size() const { return static_cast<int>(nu.size()); }
  /// How many are in a disc of another radius.
  int within(double other) const {
    return static_cast<int>(std::count_if(
        nu.begin(), nu.end(), [&](Complex each) { return 1.0 <= other * std::abs(each); }));
  }
};

Look look_at(const KrylovBasis& basis) {
  Look look;
  const auto ritz = basis.ritz();
  if (!ritz) return look;
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(ritz->values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(ritz->values(a)) > std::abs(ritz->values(b));
  });
  double edge = 0.0;  // |nu| at which an eigenvalue may be that is not converged
  std::vector<Eigen::Index> inside;
  for (const Eigen::Index i : order) {
    const double size = std::abs(ritz->values(i));
    const double residual = basis.residual(ritz->vectors.col(i));
    if (residual > converged * size) {
      edge = std::max(edge, size + residual);
    } else {
      inside.push_back(i);
    }
  }
  // a projection without open ends has all that is finite
  const auto distance = [&](Eigen::Index i) { return 1.0 / std::abs(ritz->values(i)); };
  double radius = edge > 0.0 ? 1.0 / edge : infinity;
  while (!inside.empty() && distance(inside.back()) > (1.0 - rim) * radius) {
    radius = std::min(radius, distance(inside.back()));
    inside.pop_back();
  }
  const double last = inside.empty() ? 0.0 : distance(inside.back());
  look.radius = std::isfinite(radius) ? 0.5 * (last + radius) : infinity;
  for (const Eigen::Index i : inside) {
    look.nu.push_back(ritz->values(i));
    look.vectors.push_back(ritz->vectors.col(i));
  }
  return look;
}

}  // namespace

/// The equations, whose order of elimination is found once.
struct DiscSolver::State {
  Pencil pencil;
  ComplexSparseLu factor;
};

DiscSolver::DiscSolver(const Sparse& M, const Sparse& D, const Sparse& K) {
  Pencil pencil(M, D, K);
  ComplexSparseLu factor(pencil.at(0.0));
  state_ = std::make_unique<State>(State{std::move(pencil), std::move(factor)});
}

DiscSolver::~DiscSolver() = default;
DiscSolver::DiscSolver(DiscSolver&&) noexcept = default;
DiscSolver& DiscSolver::operator=(DiscSolver&&) noexcept = default;

DiscModes DiscSolver::around(Complex center, double radius, int count) const {
  State& s = *state_;
  const auto n = s.pencil.M().rows();
  DiscModes disc{center, 0.0, CVec(0), CMat(n, 0)};
  if (!s.factor.factorize(s.pencil.at(center))) return disc;
  const double scale = std::max(std::abs(center), radius < 1e300 ? 1e-3 * radius : 0.0);
  const ShiftedInverse op{s.pencil.M(), s.pencil.D(), s.factor, center, scale > 0.0 ? scale : 1.0};
  KrylovBasis basis(op, 2 * n);
  for (int i = 0; i < starts; ++i) basis.add_fresh();
  int fresh = starts;
  Look look;
  Look before;  // a fresh vector joined
  for (Eigen::Index next = first_look;;) {
    while (basis.size() < next && !basis.is_full() && !basis.is_invariant()) basis.advance();
    look = look_at(basis);
    const bool is_enough = look.radius >= radius || look.size() >= count;
    if (is_enough && before.radius > 0.0 && look.within(before.radius) == before.size()) break;
    if (basis.is_full()) break;
    if (is_enough || basis.is_invariant()) {
      if (!basis.add_fresh()) break;
      before = is_enough ? look : Look{};
      next = basis.size() + rounds * ++fresh;
    } else {
      next = std::max(basis.size() + 4, static_cast<Eigen::Index>(growth * basis.size()));
    }
  }
  disc.radius = look.radius;
  disc.lambda.resize(look.size());
  disc.q.resize(n, look.size());
  for (int i = 0; i < look.size(); ++i) {
    Complex lambda = center + 1.0 / look.nu[static_cast<std::size_t>(i)];
    if (std::abs(lambda.imag()) <= real_axis * std::abs(lambda)) lambda.imag(0.0);
    disc.lambda(i) = lambda;
    disc.q.col(i) = basis.vector(look.vectors[static_cast<std::size_t>(i)]).head(n).normalized();
  }
  return disc;
}

}  // namespace whirl::inline fe
