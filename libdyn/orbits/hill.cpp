#include "libdyn/orbits/hill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "libbase/numerics/floquet.hpp"

namespace whirl::inline dyn {

namespace {

constexpr int block = 2;            ///< vectors that Arnoldi's method begins with
constexpr double converged = 1e-9;  ///< change of an eigenvalue over the frequency
constexpr int check_every = 16;     ///< vectors
constexpr int most_vectors = 1000;
constexpr Eigen::Index most_unknowns = 1000;  ///< more than the orbit has
constexpr Eigen::Index most_numbers = 10000;  ///< of a vector, likewise
constexpr double faint = 1e-4;                ///< multipliers below are not looked for
constexpr double least_band = 3.0;            ///< few harmonics are all that there are
constexpr double resolved = 0.7;              ///< of the harmonics: modes that are faster are not

/// (A - d/dt)^-1 on the Fourier coefficients of states, one after another: displacements, then
/// rates.
class InverseHill {
 public:
  InverseHill(const HarmonicEquations& equations, const HarmonicEvaluation& at)
      : equations_(equations),
        at_(at),
        J_(equations.jacobian(at)),
        n_(equations.problem().coordinates()),
        terms_(2 * equations.harmonics() + 1) {}

  Eigen::Index size() const { return StateLayout(n_).size() * terms_; }

  /// Mean harmonic of displacements, by their energy.
  double mean_harmonic(const CVec& x) const {
    double sum = 0.0, moment = 0.0;
    for (Eigen::Index k = 0; k < terms_; ++k) {
      const double energy = x.segment(k * n_, n_).squaredNorm();
      sum += energy;
      moment += energy * static_cast<double>((k + 1) / 2);
    }
    return moment / sum;
  }

  /// With rates v = p' + b_1:   p'' + D p' + K p - B q = -(b_2 + D b_1 + b_1'),
  ///                            q = g_u U p + g_w U (p' + b_1)
  Vec operator()(const Vec& x) const {
    const HarmonicProblem& problem = equations_.problem();
    const double w = equations_.frequency();
    const StateLayout layout(n_);
    const Vec displacement = layout.eta(problem.scale), velocity = layout.rate(problem.scale);
    const Mat b1 = displacement.asDiagonal() * Eigen::Map<const Mat>(x.data(), n_, terms_);
    const Mat b2 =
        velocity.asDiagonal() * Eigen::Map<const Mat>(x.data() + n_ * terms_, n_, terms_);
    const Mat load = -(b2 + problem.D * b1 + w * differentiated(b1));
    const Mat slip = equations_.U() * b1;
    const auto P = equations_.ports();
    Mat q = Mat::Zero(P, terms_);
    if (P > 0) {
      const Mat driven = applied(at_.by_rate, slip);
      const Mat free = equations_.U() * equations_.respond(load, Mat::Zero(P, terms_));
      const Mat rhs = free + equations_.receptance(driven);
      const Mat flat = J_.solve(Eigen::Map<const Mat>(rhs.data(), rhs.size(), 1));
      const Mat u = Eigen::Map<const Mat>(flat.data(), P, terms_);
      q = applied(at_.by_u, u) + applied(at_.by_rate, w * differentiated(u)) + driven;
    }
    const Mat p = equations_.respond(load, q);
    const Mat v = w * differentiated(p) + b1;
    Vec y(size());
    Eigen::Map<Mat>(y.data(), n_, terms_) = displacement.cwiseInverse().asDiagonal() * p;
    Eigen::Map<Mat>(y.data() + n_ * terms_, n_, terms_) = velocity.cwiseInverse().asDiagonal() * v;
    return y;
  }

 private:
  static Mat applied(const Mat& slopes, const Mat& u) {
    const Vec flat = slopes * Eigen::Map<const Vec>(u.data(), u.size());
    return Eigen::Map<const Mat>(flat.data(), u.rows(), u.cols());
  }

  const HarmonicEquations& equations_;
  const HarmonicEvaluation& at_;
  DenseLu<Mat> J_;
  Eigen::Index n_, terms_;
};

struct Ritz {
  Complex lambda;
  double error;  ///< estimated change, over the frequency
  CVec within;   ///< its vector in the space
};

/// Block Arnoldi's method with full orthogonalization, as far as it has got.
class Arnoldi {
 public:
  explicit Arnoldi(const InverseHill& apply) : apply_(apply), V_(apply.size(), 0), H_(0, 0) {
    std::mt19937 random(1);  // any start that is not special
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < block; ++i) {
      Vec v(apply.size());
      for (double& x : v) x = uniform(random);
      orthogonalize(v);
      append(v.normalized());
    }
  }

  Eigen::Index done() const { return done_; }
  /// False: nothing new comes, the space is closed.
  bool expand() {
    if (done_ == vectors_) return false;
    Vec v = apply_(V_.col(done_));
    const double size = v.norm();
    const Vec h = orthogonalize(v);
    if (H_.rows() < vectors_ + 1) {
      const auto more = std::min<Eigen::Index>(2 * (vectors_ + 1), apply_.size() + 1);
      H_.conservativeResizeLike(Mat::Zero(more, more));
    }
    H_.col(done_).head(h.size()) = h;
    const double rest = v.norm();
    if (vectors_ < apply_.size() && rest > 1e-14 * size) {
      H_(vectors_, done_) = rest;
      append(v / rest);
    }
    ++done_;
    return true;
  }

  CVec vector(const Ritz& r) const { return V_.leftCols(done_) * r.within; }

  /// Eigenvalues of (A - d/dt) that the space knows.
  std::vector<Ritz> ritz(double frequency) const {
    const auto modes = general_modes(H_.topLeftCorner(done_, done_));
    std::vector<Ritz> found;
    if (!modes) return found;
    const Mat below = H_.block(done_, 0, vectors_ - done_, done_);
    for (Eigen::Index i = 0; i < done_; ++i) {
      const Complex theta = modes->values(i);
      if (theta == 0.0) continue;
      // of 1 / theta to first order
      const double error = (below * modes->vectors.col(i)).norm() / std::norm(theta);
      found.push_back({1.0 / theta, error / frequency, modes->vectors.col(i)});
    }
    return found;
  }

 private:
  /// Takes off what is there already, twice; the coefficients.
  Vec orthogonalize(Vec& v) const {
    Vec h = Vec::Zero(vectors_);
    for (int twice = 0; twice < 2; ++twice) {
      const Vec part = V_.leftCols(vectors_).transpose() * v;
      v.noalias() -= V_.leftCols(vectors_) * part;
      h += part;
    }
    return h;
  }
  void append(const Vec& v) {
    if (V_.cols() <= vectors_) V_.conservativeResize(Eigen::NoChange, 2 * vectors_ + block);
    V_.col(vectors_++) = v;
  }

  const InverseHill& apply_;
  Mat V_, H_;
  Eigen::Index vectors_ = 0, done_ = 0;
};

/// Exponents of a strip of width w: each once. Its lower edge, from -w to 0, is laid into the
/// widest gap between imaginary parts.
std::vector<Complex> within_a_strip(const std::vector<Complex>& all, double w) {
  std::vector<double> edges;
  for (const Complex& lambda : all) {
    const double turns = lambda.imag() / w;
    edges.push_back(turns - std::floor(turns));
  }
  std::sort(edges.begin(), edges.end());
  double edge = 0.5, widest = -1.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double next = i + 1 < edges.size() ? edges[i + 1] : edges.front() + 1.0;
    const double middle = 0.5 * (edges[i] + next), place = middle - std::floor(middle);
    // the nearer to half, the smaller the imaginary parts within: wide enough will do
    const double gap = std::min(next - edges[i], 0.05) - 1e-3 * std::abs(place - 0.5);
    if (gap > widest) widest = gap, edge = place;
  }
  const double low = (edge - 1.0) * w;
  std::vector<Complex> found;
  for (const Complex& lambda : all) {
    if (lambda.imag() >= low && lambda.imag() < low + w) found.push_back(lambda);
  }
  return found;
}

/// Eigenvalues of the mean of A(t).
CVec mean_exponents(const HarmonicEquations& equations, const HarmonicEvaluation& at) {
  const HarmonicProblem& problem = equations.problem();
  const auto P = equations.ports();
  Mat K = equations.stiffness(), D = problem.D;
  if (P > 0) {
    K -= equations.B() * at.by_u.topLeftCorner(P, P) * equations.U();
    D -= equations.B() * at.by_rate.topLeftCorner(P, P) * equations.U();
  }
  const Mat A = StateLayout(problem.coordinates()).first_order(K, D);
  return eigenvalues(problem.scale.cwiseInverse().asDiagonal() * A * problem.scale.asDiagonal());
}

/// Harmonics of the orbit, or more if the modes of a mean ask for it and that is cheap. More than
/// that does not help: the same cut for orbit and deviations is the more exact one.
int enough_harmonics(const HarmonicEquations& equations, const CVec& mean, int orbit) {
  const double w = equations.frequency(), T = 2.0 * std::numbers::pi / w;
  double fastest = 0.0;
  for (const Complex& lambda : mean) {
    if (std::exp(lambda.real() * T) > faint) fastest = std::max(fastest, std::abs(lambda.imag()));
  }
  const auto ports = std::max<Eigen::Index>(equations.ports(), 1);
  const auto n = equations.problem().coordinates();
  const auto most =
      static_cast<double>(std::min(most_unknowns / (2 * ports), most_numbers / (4 * n)));
  if (fastest < std::max(least_band, resolved * orbit) * w) return orbit;
  const double wanted = fastest / (resolved * resolved * w) + 1.0;
  return std::max(orbit, static_cast<int>(std::min(wanted, most)));
}

/// log(multiplier) / T; of multipliers that are too small for a number, the eigenvalues that they
/// are made of.
CVec exponents_of(const CVec& multipliers, const std::vector<Complex>& eigenvalues, double T) {
  std::vector<Complex> vanished;
  for (const Complex& lambda : eigenvalues) {
    if (std::exp(lambda * T) == 0.0) vanished.push_back(lambda);
  }
  std::sort(vanished.begin(), vanished.end(),
            [](const Complex& a, const Complex& b) { return a.real() > b.real(); });
  CVec exponents = multipliers;
  auto next = vanished.begin();
  for (Complex& rate : exponents) {
    if (rate == 0.0 && next != vanished.end()) {
      rate = {next->real(), std::remainder(next->imag(), 2.0 * std::numbers::pi / T)};
      ++next;
    } else {
      rate = std::log(rate) / T;
    }
  }
  return exponents;
}

/// Makes real what has no conjugate: real exponents at a strip's edge get imaginary parts of the
/// truncation's size.
void remove_stray_imaginary_parts(CVec& values) {
  CVec result = values;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const Complex conjugate = std::conj(values(i));
    bool has_partner = false;
    for (Eigen::Index j = 0; j < values.size(); ++j) {
      const double away = std::abs(conjugate - values(j));
      has_partner = has_partner || (j != i && away < std::abs(values(i).imag()));
    }
    if (!has_partner) result(i) = std::copysign(std::abs(values(i)), values(i).real());
  }
  values = result;
}

}  // namespace

HillStability hill_stability(const HarmonicProblem& problem, const HarmonicOrbit& orbit) {
  HillStability result;
  const HarmonicEquations first(problem, orbit.motion.period, orbit.harmonics());
  const auto at_first = first.evaluate(orbit.ports.coefficients, true);
  if (!at_first.has_force) {
    result.failure = "a force is not defined on the orbit";
    return result;
  }
  const CVec mean = mean_exponents(first, at_first);
  const int H = enough_harmonics(first, mean, orbit.harmonics());
  const HarmonicEquations equations(problem, orbit.motion.period, H);
  const auto at = equations.evaluate(with_harmonics(orbit.ports.coefficients, H), true);
  const InverseHill inverse(equations, at);
  result.harmonics = H;
  const double w = equations.frequency(), T = 2.0 * std::numbers::pi / w;
  const auto states = static_cast<std::size_t>(mean.size());
  const double band = std::max(least_band, resolved * H), far = std::hypot(w, std::log(faint) / T);
  std::vector<Complex> all;
  for (const Complex& lambda : mean) {
    if (std::abs(lambda.imag()) > band * w) all.push_back(lambda);
  }
  result.averaged = static_cast<int>(all.size());

  const auto is_good = [w](const Ritz& r) {
    return r.error < converged * std::max(1.0, std::abs(r.lambda) / w);
  };
  Arnoldi arnoldi(inverse);
  std::vector<Complex> strip;
  for (bool goes_on = true; goes_on;) {
    do {
      goes_on = arnoldi.done() < most_vectors && arnoldi.expand();
    } while (goes_on && arnoldi.done() % std::max<Eigen::Index>(check_every, arnoldi.done() / 4));
    const std::vector<Ritz> ritz = arnoldi.ritz(w);
    double reached = std::numeric_limits<double>::infinity();  // all that is nearer is known
    std::vector<Complex> near;
    for (const Ritz& r : ritz) {
      if (!is_good(r)) {
        reached = std::min(reached, std::abs(r.lambda));
      } else if (std::abs(r.lambda.imag()) < 1.01 * w &&
                 inverse.mean_harmonic(arnoldi.vector(r)) < band) {
        near.push_back(r.lambda);
      }
    }
    strip = within_a_strip(near, w);
    if (reached > far || strip.size() + all.size() >= states) break;
  }
  all.insert(all.end(), strip.begin(), strip.end());
  if (all.size() > states) all.resize(states);
  result.missing = static_cast<int>(states - all.size());
  result.multipliers.resize(std::ssize(all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    result.multipliers(static_cast<Eigen::Index>(i)) = std::exp(all[i] * T);
  }
  remove_stray_imaginary_parts(result.multipliers);
  sort_by_size(result.multipliers);
  result.exponents = exponents_of(result.multipliers, all, T);
  return result;
}

}  // namespace whirl::inline dyn
