#include "libfe/eigen/disc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "libbase/numerics/dense_complex.hpp"
#include "libbase/numerics/sparse_lu.hpp"
#include "libbase/system/interruption.hpp"
#include "libfe/eigen/pencil.hpp"
#include "libfe/eigen/positive_factor.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr int first_look = 18;           ///< vectors before eigenvalues are computed first
constexpr double most_growth = 1.3;      ///< of the basis from look to look
constexpr double margin_of_size = 1.05;  ///< of the basis that a radius is expected to take
constexpr int starts = 2;                ///< vectors at the beginning: isotropic rotors have pairs
constexpr int rounds = 5;  ///< powers of the inverse a fresh vector gets to show something
constexpr double converged = 1e-10;  ///< residual over the size of an eigenvalue of the inverse
constexpr double exhausted = 1e-13;  ///< of its length: what is left of a vector inside the basis
constexpr double least_energy =
    1e-10;                           ///< below minus this share of its terms an energy is negative
constexpr double no_energy = 1e-14;  ///< below this share it is zero
constexpr double rim = 1e-6;         ///< relative distance in which a disc does not end
constexpr double real_axis = 1e-10;  ///< |Im| of an eigenvalue that is real, over its size

template <class Scalar>
using VecOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using MatOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// (A - s I)^-1 of the state (q, p = q' / scale).
template <class Scalar>
struct ShiftedInverse {
  const Sparse &M, &D;
  std::function<VecOf<Scalar>(const VecOf<Scalar>&)> solve;  ///< (s^2 M + s D + K)^-1
  Scalar s;
  double scale;

  VecOf<Scalar> operator()(const VecOf<Scalar>& in) const {
    const auto n = M.rows();
    const auto q = in.head(n), p = in.tail(n);
    VecOf<Scalar> load = M * VecOf<Scalar>(scale * p + s * q);
    load += D * q;
    const VecOf<Scalar> x = solve(load);
    VecOf<Scalar> out(2 * n);
    out.head(n) = -x;
    out.tail(n) = (q - s * x) / scale;
    return out;
  }
};

/// The inner product of states: the energy q^T K q + q'^T M q', in which an operator without
/// damping is normal about zero (elsewhere K + s^2 M takes the place of K), so that values that
/// have not converged do not stray; without matrices the Euclidean one.
struct Energy {
  Sparse K, M;  ///< symmetric; K positive definite; M in units of p

  bool is_euclidean() const { return K.rows() == 0; }
  template <class Scalar>
  VecOf<Scalar> weigh(const VecOf<Scalar>& state) const {
    VecOf<Scalar> result(state.size());
    result.head(K.rows()).noalias() = K * state.head(K.rows());
    result.tail(K.rows()).noalias() = M * state.tail(K.rows());
    return result;
  }
};

/// An orthonormal basis that grows by the images of its own vectors.
template <class Scalar>
class KrylovBasis {
 public:
  KrylovBasis(const ShiftedInverse<Scalar>& op, const Energy& energy, Eigen::Index states,
              Eigen::Index most)
      : op_(op),
        energy_(energy),
        most_(std::min(most, states)),
        vectors_(states, most_ + 2 * rounds + starts + 4),
        weighed_(energy.is_euclidean() ? 0 : states, vectors_.cols()),
        projected_(MatOf<Scalar>::Zero(vectors_.cols(), most_ + 2 * rounds)) {}

  /// Number of vectors whose images are known.
  Eigen::Index size() const { return done_; }
  bool is_full() const { return done_ >= most_ || columns_ >= vectors_.cols(); }
  /// Whether fresh vectors can be followed beyond that.
  bool has_room() const { return done_ < projected_.cols() && columns_ < vectors_.cols(); }
  /// Whether all energies are those of a positive inertia: else nothing is known.
  bool is_sound() const { return is_sound_; }
  double effort() const { return static_cast<double>(done_) / static_cast<double>(most_); }
  /// Whether nothing leads out of it.
  bool is_invariant() const { return done_ == columns_; }

  /// Adds a random direction; false if there is none left.
  bool add_fresh() {
    if (columns_ >= vectors_.rows() || columns_ >= vectors_.cols()) return false;
    VecOf<Scalar> fresh(vectors_.rows());
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < fresh.size(); ++i) {
      if constexpr (std::is_same_v<Scalar, Complex>) {
        fresh(i) = {normal(random_), normal(random_)};
      } else {
        fresh(i) = normal(random_);
      }
    }
    fresh = op_(fresh);  // what is infinite is no part of it
    return append(std::move(fresh), nullptr);
  }

  /// Adds the image of the next vector.
  void advance() {
    VecOf<Scalar> image = op_(vectors_.col(done_++));
    append(std::move(image), &projected_);
  }
  /// Adds the image of the newest vector, which leaves others waiting.
  void advance_newest() {
    const Eigen::Index newest = columns_ - 1;
    vectors_.col(done_).swap(vectors_.col(newest));
    if (!energy_.is_euclidean()) weighed_.col(done_).swap(weighed_.col(newest));
    projected_.row(done_).swap(projected_.row(newest));
    advance();
  }

  /// Eigenvalues and vectors of the projection; nothing if they cannot be found.
  std::optional<GeneralModes> ritz() const {
    return general_modes(MatOf<Scalar>(projected_.topLeftCorner(done_, done_)));
  }
  /// How far A x is from nu x for a vector y of the projection, x = V y.
  double residual(const CVec& y) const {
    return (projected_.block(done_, 0, columns_ - done_, done_) * y).norm();
  }
  /// The displacements of such a vector.
  CVec displacements(const CVec& y) const {
    return vectors_.topLeftCorner(vectors_.rows() / 2, done_) * y;
  }

 private:
  /// Appends the part of v that is new; the other parts go into a column of `to`.
  bool append(VecOf<Scalar> v, MatOf<Scalar>* to) {
    const double before = v.norm();
    for (int twice = 0; twice < 2 && columns_ > 0; ++twice) {
      const VecOf<Scalar> parts = duals().leftCols(columns_).adjoint() * v;
      v.noalias() -= vectors_.leftCols(columns_) * parts;
      if (to) to->col(done_ - 1).head(columns_) += parts;
    }
    double left = v.norm();
    if (!(left > exhausted * before) || columns_ >= vectors_.cols()) return false;
    if (!energy_.is_euclidean()) {
      const VecOf<Scalar> weighed = energy_.weigh(v);
      const double square = std::real(weighed.dot(v));
      const double size = weighed.cwiseProduct(v).cwiseAbs().sum();
      is_sound_ = is_sound_ && square > -least_energy * size;
      if (!(square > no_energy * size)) return false;  // motion of what has no inertia
      left = std::sqrt(square);
      weighed_.col(columns_) = weighed / left;
    }
    if (to) (*to)(columns_, done_ - 1) = left;
    vectors_.col(columns_++) = v / left;
    return true;
  }
  /// What makes coordinates of a vector by its products with them.
  const MatOf<Scalar>& duals() const { return energy_.is_euclidean() ? vectors_ : weighed_; }

  const ShiftedInverse<Scalar>& op_;
  const Energy& energy_;
  Eigen::Index most_;
  MatOf<Scalar> vectors_, weighed_, projected_;
  Eigen::Index done_ = 0, columns_ = 0;
  bool is_sound_ = true;
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

template <class Scalar>
Look look_at(const KrylovBasis<Scalar>& basis) {
  Look look;
  const auto ritz = basis.is_sound() ? basis.ritz() : std::nullopt;
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

/// The size at which to look next. Frequencies of a beam, and so the radius, grow with the square
/// of their number.
Eigen::Index next_size(Eigen::Index size, double radius, double wanted) {
  const double most = most_growth * static_cast<double>(size);
  const double expected = margin_of_size * static_cast<double>(size) * std::sqrt(wanted / radius);
  return std::max(size + 3, static_cast<Eigen::Index>(std::min(most, expected)));
}

/// The disc of an operator: grown until it is as wanted, or as far as it goes. Nothing where the
/// inertia of the energy is not positive.
template <class Scalar>
std::optional<DiscModes> grown(const ShiftedInverse<Scalar>& op, const Energy& energy,
                               const DiscSolver::WantedRadius& wanted,
                               const DiscSolver::Growth& growth) {
  const auto n = op.M.rows();
  const Complex center = op.s;
  KrylovBasis<Scalar> basis(op, energy, 2 * n, growth.most);
  for (int i = 0; i < starts; ++i) basis.add_fresh();
  Look look;
  Look before;  // a fresh vector joined
  bool is_last = false;
  std::vector<Complex> lambda;
  for (Eigen::Index next = first_look;;) {
    while (basis.size() < next && !basis.is_full() && !basis.is_invariant()) basis.advance();
    interruption_point();
    look = look_at(basis);
    lambda.clear();
    for (const Complex nu : look.nu) {
      Complex each = center + 1.0 / nu;
      if (std::abs(each.imag()) <= real_axis * std::abs(each)) each.imag(0.0);
      lambda.push_back(each);
    }
    const std::optional<double> radius = wanted(look.radius, lambda, basis.effort());
    const bool is_enough = !radius || look.radius >= *radius;
    const bool is_confirmed = !growth.is_confirmed ||
                              (before.radius > 0.0 && look.within(before.radius) == before.size());
    if ((is_enough && is_confirmed) || is_last || !basis.is_sound()) break;
    if (is_enough || basis.is_full() || basis.is_invariant()) {
      is_last = basis.is_full();
      if (!basis.add_fresh()) break;
      before = is_enough ? look : Look{};
      for (int i = 0; i < rounds && basis.has_room() && !basis.is_invariant(); ++i) {
        basis.advance_newest();
      }
      next = basis.size();
    } else {
      next = next_size(basis.size(), look.radius, *radius);
    }
  }
  if (!basis.is_sound()) return std::nullopt;
  DiscModes disc{center, look.radius, CVec(look.size()), CMat(n, look.size())};
  for (int i = 0; i < look.size(); ++i) {
    disc.lambda(i) = lambda[static_cast<std::size_t>(i)];
    disc.q.col(i) = basis.displacements(look.vectors[static_cast<std::size_t>(i)]).normalized();
  }
  return disc;
}

/// Solves with a real sparse matrix: L D L^T where it is symmetric and positive, else L U.
class RealFactor {
 public:
  explicit RealFactor(const Sparse& A) {
    if (is_symmetric(A)) ldlt_ = positive_factor(A);
    if (!ldlt_) lu_ = SparseLu(A);
  }
  bool is_positive() const { return ldlt_ != nullptr; }
  bool is_regular() const { return is_positive() || lu_.is_regular(); }
  Vec solve(const Vec& b) const { return ldlt_ ? Vec(ldlt_->solve(b)) : Vec(lu_.solve(b)); }

 private:
  std::unique_ptr<Ldlt> ldlt_;
  SparseLu lu_;
};

/// A typical low frequency, by inverse iteration: velocities are measured in it.
double low_frequency(const RealFactor& factor, const Sparse& M, const Sparse& K) {
  Vec v = Vec::Ones(M.rows());
  for (int i = 0; i < 3; ++i) v = factor.solve(M * v).normalized();
  const double found = std::sqrt(std::abs(v.dot(K * v) / v.dot(M * v)));
  return std::isfinite(found) && found > 0.0 ? found : 1.0;
}

}  // namespace

struct DiscSolver::State {
  Sparse M, D, K;
  /// For complex centers, whose order of elimination is found once.
  struct ComplexPart {
    Pencil pencil;
    ComplexSparseLu factor;
  };
  std::optional<ComplexPart> complex{};

  ComplexPart& complex_part() {
    if (!complex) {
      Pencil pencil(M, D, K);
      ComplexSparseLu factor(pencil.at(0.0));
      complex = ComplexPart{std::move(pencil), std::move(factor)};
    }
    return *complex;
  }
};

DiscSolver::DiscSolver(const Sparse& M, const Sparse& D, const Sparse& K)
    : state_(std::make_unique<State>(State{M, D, K})) {}

DiscSolver::~DiscSolver() = default;
DiscSolver::DiscSolver(DiscSolver&&) noexcept = default;
DiscSolver& DiscSolver::operator=(DiscSolver&&) noexcept = default;

DiscModes DiscSolver::around(Complex center, double radius, int count, const Growth& growth) const {
  return around(
      center,
      [&](double, std::span<const Complex> lambda, double) {
        return std::optional(std::ssize(lambda) >= count ? 0.0 : radius);
      },
      growth);
}

DiscModes DiscSolver::around(Complex center, const WantedRadius& wanted,
                             const Growth& growth) const {
  State& state = *state_;
  const DiscModes none{center, 0.0, CVec(0), CMat(state.M.rows(), 0)};
  if (center.imag() == 0.0) {
    const double s = center.real();
    const RealFactor factor(s == 0.0 ? state.K : Sparse(s * s * state.M + s * state.D + state.K));
    if (!factor.is_regular()) return none;
    const double scale = s != 0.0 ? std::abs(s) : low_frequency(factor, state.M, state.K);
    const auto solve = [&](const Vec& b) { return factor.solve(b); };
    Energy energy{symmetric_part(state.K), scale * scale * symmetric_part(state.M)};
    if (s != 0.0) energy.K += (s * s) * symmetric_part(state.M);
    const bool is_factor_of_it = s == 0.0 && factor.is_positive();
    if (!is_factor_of_it && !is_supported(energy.K)) energy = {};
    const ShiftedInverse<double> op{state.M, state.D, solve, s, scale};
    auto disc = grown<double>(op, energy, wanted, growth);
    if (!disc) disc = grown<double>(op, {}, wanted, growth);
    return *std::move(disc);
  }
  auto& [pencil, factor] = state.complex_part();
  if (!factor.factorize(pencil.at(center))) return none;
  const auto solve = [&lu = factor](const CVec& b) { return lu.solve(b); };
  return *grown<Complex>({pencil.M(), pencil.D(), solve, center, std::abs(center)}, {}, wanted,
                         growth);
}

}  // namespace whirl::inline fe
