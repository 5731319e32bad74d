#include "libdyn/orbits/harmonic_equations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/system/interruption.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double singular = 1e-13;  ///< reciprocal condition of a matrix that is
constexpr double loose = 1e-12;     ///< and of a stiffness that does not hold the rotor
/// Frequency of the springs over that of the phase, squared: between the harmonics.
constexpr double spring_frequency = 2.3;
constexpr double order_digits = 1e-12;  ///< of an order that is a fraction, as decimals have it

/// Amplitude c - i s of harmonic k; x = Re(amplitude e^(i k theta)).
CMat amplitude(const Mat& c, Eigen::Index k) {
  if (k == 0) return c.col(0).cast<Complex>();
  CMat z(c.rows(), 1);
  z.real() = c.col(2 * k - 1);
  z.imag() = -c.col(2 * k);
  return z;
}
void set_amplitude(Mat& c, Eigen::Index k, const CMat& z) {
  if (k == 0) {
    c.col(0) = z.col(0).real();
  } else {
    c.col(2 * k - 1) = z.col(0).real();
    c.col(2 * k) = -z.col(0).imag();
  }
}

/// Number of the harmonic of a motion that a load is; nothing where it does not repeat with it.
std::optional<long> harmonic_of(const HarmonicProblem::Load& load, int period) {
  const long k = std::lround(load.order * period);
  if (k < 0 || std::abs(load.order * period - static_cast<double>(k)) > order_digits * period) {
    return std::nullopt;
  }
  return k;
}

std::string no_harmonic(const HarmonicProblem::Load& load, int period) {
  return fmt::format("harmonic balance: a force of order {:g} does not repeat with a period of {}",
                     load.order, period);
}

}  // namespace

int HarmonicProblem::highest_load(int period) const {
  int highest = period;
  for (const Load& load : loads) {
    const auto k = harmonic_of(load, period);
    if (!k) throw OptionError(no_harmonic(load, period));
    highest = std::max(highest, static_cast<int>(*k));
  }
  return highest;
}

namespace {

/// U and B of all forces together.
struct Places {
  Mat U, B;
};
Places places_of(const HarmonicProblem& problem) {
  const auto n = problem.coordinates();
  Eigen::Index ports = 0;
  for (const PortForces& f : problem.forces) ports += f.U.rows();
  Places all{Mat(ports, n), Mat(n, ports)};
  Eigen::Index at = 0;
  for (const PortForces& f : problem.forces) {
    all.U.middleRows(at, f.U.rows()) = f.U;
    all.B.middleCols(at, f.U.rows()) = f.B;
    at += f.U.rows();
  }
  return all;
}

/// Fourier coefficients of the loads.
/// @throws NumericalError  where one is none of the harmonics
Mat loads_of(const HarmonicProblem& problem, int period, int harmonics) {
  Mat loads = Mat::Zero(problem.coordinates(), 2 * harmonics + 1);
  for (const HarmonicProblem::Load& load : problem.loads) {
    if (load.cosine.isZero(0.0) && load.sine.isZero(0.0)) continue;
    const auto k = harmonic_of(load, period);
    if (!k) throw NumericalError(no_harmonic(load, period));
    if (*k > harmonics) {
      throw NumericalError(fmt::format(
          "harmonic balance: a force is harmonic {} of the orbit, there are {}", *k, harmonics));
    }
    if (*k == 0) {
      loads.col(0) += load.cosine;
    } else {
      loads.col(2 * *k - 1) += load.cosine;
      loads.col(2 * *k) += load.sine;
    }
  }
  return loads;
}

}  // namespace

HarmonicEquations::HarmonicEquations(const HarmonicProblem& problem, int period, int harmonics)
    : problem_(problem), period_(period), harmonics_(harmonics) {
  Places places = places_of(problem);
  U_ = std::move(places.U);
  B_ = std::move(places.B);
  const Eigen::Index ports = U_.rows();
  loads_ = loads_of(problem, period, harmonics);
  springs_ = Vec::Zero(ports);
  int unheld = factorize();
  if (unheld >= 0 && ports > 0) {
    for (Eigen::Index j = 0; j < ports; ++j) {
      const double mobility = U_.row(j).dot(B_.col(j));
      if (mobility > 0.0) springs_(j) = spring_frequency * problem.rate * problem.rate / mobility;
    }
    unheld = factorize();
  }
  if (unheld >= 0) {
    throw NumericalError(unheld == 0 ? std::string("harmonic balance: nothing holds the rotor")
                                     : fmt::format("harmonic balance: order {}/{} of the speed "
                                                   "excites an undamped resonance",
                                                   unheld, period));
  }
  for (const DenseLu<CMat>& Z : Z_) {
    H_.push_back(U_.cast<Complex>() * Z.solve(B_.cast<Complex>()));
  }
  free_ = U_ * respond(loads_, Mat::Zero(ports, 2 * harmonics + 1));
}

int HarmonicEquations::factorize() {
  const auto n = problem_.coordinates();
  K_ = problem_.K + B_ * springs_.asDiagonal() * U_;
  if (!(DenseLu<Mat>(K_).rcond() > loose)) return 0;
  Z_.clear();
  for (int k = 0; k <= harmonics_; ++k) {
    const double w = k * frequency();
    CMat Z(n, n);
    Z.real() = K_;
    Z.real().diagonal().array() -= w * w;
    Z.imag() = w * problem_.D;
    Z_.emplace_back(Z);
    if (!(Z_.back().rcond() > singular)) return k;
  }
  return -1;
}

Mat HarmonicEquations::respond(const Mat& b, const Mat& q) const {
  const Mat all = b + B_ * q;
  Mat x(b.rows(), b.cols());
  for (Eigen::Index k = 0; k <= harmonics_; ++k) {
    set_amplitude(x, k, Z_[static_cast<std::size_t>(k)].solve(amplitude(all, k)));
  }
  return x;
}

Mat HarmonicEquations::motion(const Mat& g) const {
  return respond(loads_, g);
}

Mat HarmonicEquations::receptance(const Mat& q) const {
  Mat u(q.rows(), q.cols());
  for (Eigen::Index k = 0; k <= harmonics_; ++k) {
    set_amplitude(u, k, H_[static_cast<std::size_t>(k)] * amplitude(q, k));
  }
  return u;
}

namespace {

/// Adds the Fourier coefficients of v(theta) phi_b(theta) to columns b, v being the slopes of one
/// place's forces: its own coefficients C_m, S_m up to 2 H have them all,
///
///   2 cos k cos l = cos(k - l) + cos(k + l),   2 sin k cos l = sin(k - l) + sin(k + l), ...
///
/// @param first, all  number of its first port, and of all ports
void add_integrals(const std::vector<PortSample>& samples, PortMat PortSample::*slopes,
                   Eigen::Index ports, Eigen::Index H, Eigen::Index first, Eigen::Index all,
                   Mat& to) {
  Mat sums = Mat::Zero(ports * ports, 4 * H + 1);
  for (const PortSample& sample : samples) {
    const PortMat& v = sample.*slopes;
    const Eigen::Map<const Vec> flat(v.data(), v.size());
    if (flat.isZero(0.0)) continue;
    sums +=
        sample.share * flat * harmonic_functions(sample.theta, static_cast<int>(2 * H)).transpose();
  }
  if (sums.isZero(0.0)) return;
  for (Eigen::Index j = 0; j < ports; ++j) {
    for (Eigen::Index i = 0; i < ports; ++i) {
      const auto sum = sums.row(j * ports + i);
      const auto C = [&](Eigen::Index m) { return m == 0 ? sum(0) : sum(2 * std::abs(m) - 1); };
      const auto S = [&](Eigen::Index m) {
        return m == 0 ? 0.0 : m > 0 ? sum(2 * m) : -sum(-2 * m);
      };
      const auto at = [&](Eigen::Index a, Eigen::Index b) -> double& {
        return to(a * all + first + i, b * all + first + j);
      };
      for (Eigen::Index l = 0; l <= H; ++l) {
        const Eigen::Index cos_l = l == 0 ? 0 : 2 * l - 1, sin_l = 2 * l;
        at(0, cos_l) += C(l);
        if (l > 0) at(0, sin_l) += S(l);
        for (Eigen::Index k = 1; k <= H; ++k) {
          at(2 * k - 1, cos_l) += C(k - l) + C(k + l);
          at(2 * k, cos_l) += S(k + l) + S(k - l);
          if (l == 0) continue;
          at(2 * k - 1, sin_l) += S(k + l) - S(k - l);
          at(2 * k, sin_l) += C(k - l) - C(k + l);
        }
      }
    }
  }
}

/// Adds the Fourier coefficients of sampled forces: integrals with 1, 2 cos, 2 sin.
void add_coefficients(const std::vector<PortSample>& samples, int harmonics, Eigen::Ref<Mat> to) {
  for (const PortSample& sample : samples) {
    Vec weights = 2.0 * sample.share * harmonic_functions(sample.theta, harmonics);
    weights(0) *= 0.5;
    to += sample.g * weights.transpose();
  }
}

}  // namespace

HarmonicEvaluation HarmonicEquations::evaluate(const Mat& u, bool slopes) const {
  interruption_point();
  const Eigen::Index P = ports(), terms = 2 * harmonics_ + 1;
  HarmonicEvaluation e;
  e.g = springs_.asDiagonal() * u;
  if (slopes) {
    e.by_u = Mat::Zero(P * terms, P * terms);
    e.by_rate = Mat::Zero(P * terms, P * terms);
    for (Eigen::Index b = 0; b < terms; ++b) {
      e.by_u.block(b * P, b * P, P, P).diagonal() = springs_;
    }
  }
  Eigen::Index first = 0;
  std::vector<PortSample> samples;
  for (const PortForces& force : problem_.forces) {
    const Eigen::Index p = force.U.rows();
    samples.clear();
    if (!force.sample({u.middleRows(first, p), period_, problem_.rate}, samples)) return e;
    if (slopes) {
      add_integrals(samples, &PortSample::by_u, p, harmonics_, first, P, e.by_u);
      add_integrals(samples, &PortSample::by_rate, p, harmonics_, first, P, e.by_rate);
    }
    add_coefficients(samples, harmonics_, e.g.middleRows(first, p));
    first += p;
  }
  e.residual = u - free_ - receptance(e.g);
  e.has_force = e.residual.allFinite();
  return e;
}

Mat HarmonicEquations::jacobian(const HarmonicEvaluation& at) const {
  const Eigen::Index P = ports(), size = at.by_u.rows();
  // dg/du with u' = w (k s_k cos - k c_k sin): columns of the rates move to those of u
  Mat slopes = at.by_u;
  for (int k = 1; k <= harmonics_; ++k) {
    const double w = k * frequency();
    slopes.middleCols(2 * k * P, P) += w * at.by_rate.middleCols((2 * k - 1) * P, P);
    slopes.middleCols((2 * k - 1) * P, P) -= w * at.by_rate.middleCols(2 * k * P, P);
  }
  Mat J = Mat::Identity(size, size);
  J.topRows(P) -= H_[0].real() * slopes.topRows(P);
  for (int k = 1; k <= harmonics_; ++k) {
    const Mat R = H_[static_cast<std::size_t>(k)].real(),
              I = H_[static_cast<std::size_t>(k)].imag();
    const auto c = slopes.middleRows((2 * k - 1) * P, P), s = slopes.middleRows(2 * k * P, P);
    J.middleRows((2 * k - 1) * P, P) -= R * c + I * s;
    J.middleRows(2 * k * P, P) -= R * s - I * c;
  }
  return J;
}

std::optional<Mat> HarmonicEquations::slope(const Mat& u, const Mat& g,
                                            const HarmonicProblem& by) const {
  Mat g_slope = Mat::Zero(u.rows(), u.cols());
  Eigen::Index first = 0;
  std::vector<PortSample> samples;
  for (const PortForces& force : by.forces) {
    const Eigen::Index p = force.U.rows();
    samples.clear();
    if (!force.sample({u.middleRows(first, p), period_, problem_.rate}, samples)) {
      return std::nullopt;
    }
    add_coefficients(samples, harmonics_, g_slope.middleRows(first, p));
    first += p;
  }
  const Places places = places_of(by);
  Vec spring_slopes = Vec::Zero(ports());
  for (Eigen::Index j = 0; j < ports(); ++j) {
    if (springs_(j) == 0.0) continue;
    const double mobility = U_.row(j).dot(B_.col(j)),
                 changed = places.U.row(j).dot(B_.col(j)) + U_.row(j).dot(places.B.col(j));
    spring_slopes(j) = springs_(j) * (2.0 * by.rate / problem_.rate - changed / mobility);
  }
  const Mat x = motion(g), rates = differentiated(x);  // by theta
  const double w = frequency(), w_slope = by.rate / period_;
  Mat forces = loads_of(by, period_, harmonics_) + places.B * (g - springs_.asDiagonal() * U_ * x);
  forces -= by.K * x + B_ * (springs_.asDiagonal() * (places.U * x));
  forces -= (w_slope * problem_.D + w * by.D) * rates + 2.0 * w * w_slope * differentiated(rates);
  g_slope += spring_slopes.asDiagonal() * (u - U_ * x);
  Mat slope = -(places.U * x) - U_ * respond(forces, g_slope);
  if (!slope.allFinite()) return std::nullopt;
  return slope;
}

}  // namespace whirl::inline dyn
