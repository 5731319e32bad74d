#include "libdyn/orbits/harmonic_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "libbase/error.hpp"
#include "libbase/newton.hpp"

namespace whirl::inline dyn {

namespace {

constexpr double singular = 1e-13;  ///< reciprocal condition of a matrix that is
constexpr double loose = 1e-12;     ///< and of a stiffness that does not hold the rotor
/// Frequency of the springs over that of the phase, squared: between the harmonics.
constexpr double spring_frequency = 2.3;
constexpr int most_halvings = 10;
constexpr int first_harmonics = 10;  ///< a revolution
constexpr double slowest = 0.7;      ///< fall of changes that is believed in
constexpr double unproven = 0.5;     ///< taken for it after one change only
constexpr int most_failures = 3;  ///< numbers of harmonics without an orbit, before it is given up
constexpr double order_digits = 1e-12;  ///< of an order that is a fraction, as decimals have it
constexpr double same = 1e-6;  ///< of harmonics that a shorter period does not have, over all

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

}  // namespace

void HarmonicOptions::check() const {
  if (period < 1 || harmonics < 0 || most_harmonics < 1 || most_steps < 1 || !(tolerance > 0.0) ||
      !(accurate > 0.0)) {
    throw OptionError("harmonic balance: period, harmonics and accuracy must be positive");
  }
  if (harmonics > 0 && harmonics < period) {
    throw OptionError(
        fmt::format("harmonic balance: the speed is harmonic {} of the orbit, there are {}", period,
                    harmonics));
  }
}

namespace {

/// Number of the harmonic of a motion that a load is; nothing where it does not repeat with it.
std::optional<long> harmonic_of(const HarmonicProblem::OrderLoad& load, int period) {
  const long k = std::lround(load.order * period);
  if (k < 1 || std::abs(load.order * period - static_cast<double>(k)) > order_digits * period) {
    return std::nullopt;
  }
  return k;
}

std::string no_harmonic(const HarmonicProblem::OrderLoad& load, int period) {
  return fmt::format("harmonic balance: a force of order {:g} does not repeat with a period of {}",
                     load.order, period);
}

}  // namespace

int HarmonicProblem::highest_load(int period) const {
  int highest = period;
  for (const OrderLoad& load : orders) {
    const auto k = harmonic_of(load, period);
    if (!k) throw OptionError(no_harmonic(load, period));
    highest = std::max(highest, static_cast<int>(*k));
  }
  return highest;
}

HarmonicEquations::HarmonicEquations(const HarmonicProblem& problem, int period, int harmonics)
    : problem_(problem), period_(period), harmonics_(harmonics) {
  const auto n = problem.coordinates();
  Eigen::Index ports = 0;
  for (const PortForces& f : problem.forces) ports += f.U.rows();
  U_.resize(ports, n);
  B_.resize(n, ports);
  Eigen::Index at = 0;
  for (const PortForces& f : problem.forces) {
    U_.middleRows(at, f.U.rows()) = f.U;
    B_.middleCols(at, f.U.rows()) = f.B;
    at += f.U.rows();
  }
  loads_ = Mat::Zero(n, 2 * harmonics + 1);
  loads_.col(0) = problem.f0;
  if (period <= harmonics) {
    loads_.col(2 * period - 1) = problem.fc;
    loads_.col(2 * period) = problem.fs;
  }
  for (const HarmonicProblem::OrderLoad& load : problem.orders) {
    const auto k = harmonic_of(load, period);
    if (!k) throw NumericalError(no_harmonic(load, period));
    if (*k > harmonics) {
      throw NumericalError(fmt::format(
          "harmonic balance: a force is harmonic {} of the orbit, there are {}", *k, harmonics));
    }
    loads_.col(2 * *k - 1) += load.cosine;
    loads_.col(2 * *k) += load.sine;
  }
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

}  // namespace

HarmonicEquations::Evaluation HarmonicEquations::evaluate(const Mat& u, bool slopes) const {
  const Eigen::Index P = ports(), terms = 2 * harmonics_ + 1;
  Evaluation e;
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
    for (const PortSample& sample : samples) {  // coefficients are integrals with 1, 2 cos, 2 sin
      Vec weights = 2.0 * sample.share * harmonic_functions(sample.theta, harmonics_);
      weights(0) *= 0.5;
      e.g.middleRows(first, p) += sample.g * weights.transpose();
    }
    first += p;
  }
  e.residual = u - free_ - receptance(e.g);
  e.has_force = e.residual.allFinite();
  return e;
}

Mat HarmonicEquations::jacobian(const Evaluation& at) const {
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

Vec HarmonicOrbit::state(int i) const {
  const auto now = motion.at(2.0 * std::numbers::pi * i / motion.period);
  Vec y(2 * now.x.size());
  y << now.x, now.rate;
  return y;
}

int shortest_period(const HarmonicOrbit& orbit) {
  const Mat& c =
      orbit.ports.coefficients.rows() > 0 ? orbit.ports.coefficients : orbit.motion.coefficients;
  const int period = orbit.motion.period;
  for (int p = 1; p < period; ++p) {
    if (period % p != 0) continue;
    double others = 0.0;
    for (Eigen::Index k = 1; k <= c.cols() / 2; ++k) {
      if (k % (period / p) == 0) continue;
      others = std::max(others, c.middleCols(2 * k - 1, 2).cwiseAbs().maxCoeff());
    }
    if (others < same * c.cwiseAbs().maxCoeff()) return p;
  }
  return period;
}

double distance(const Periodic& a, const Periodic& b) {
  const int H = std::max(a.harmonics(), b.harmonics());
  const Periodic between{with_harmonics(a.coefficients, H) - with_harmonics(b.coefficients, H),
                         a.period, a.rate};
  if (between.coefficients.rows() == 0) return 0.0;
  double largest = 0.0;
  const int N = 4 * H + 1;
  for (int i = 0; i < N; ++i) {
    const Vec phi = harmonic_functions(2.0 * std::numbers::pi * i / N, H);
    largest = std::max(largest, (between.coefficients * phi).cwiseAbs().maxCoeff());
  }
  return largest;
}

namespace {

/// Newton's method at one number of harmonics, from displacements at the forces.
HarmonicOrbit solve(const HarmonicEquations& equations, Mat u, const HarmonicOptions& options) {
  const HarmonicProblem& problem = equations.problem();
  struct Balance {
    Mat u;
    HarmonicEquations::Evaluation of{};
    double residual = std::numeric_limits<double>::infinity();
  };
  const auto balance = [&](Mat at) {
    Balance b{std::move(at)};
    b.of = equations.evaluate(b.u, false);
    if (!b.of.has_force) return b;
    const bool is_linear = b.of.residual.size() == 0;
    b.residual = is_linear ? 0.0 : b.of.residual.lpNorm<Eigen::Infinity>() / problem.length_scale;
    return b;
  };
  Balance at = balance(std::move(u));
  NewtonSearch search = newton(
      at,
      [&](const Balance& b) {
        return newton_step(equations.jacobian(equations.evaluate(b.u, true)),
                           b.of.residual.reshaped());
      },
      [&](const Balance& b, const Vec& step) {
        return balance(b.u - step.reshaped(b.u.rows(), b.u.cols()));
      },
      {.most_steps = options.most_steps,
       .accurate = options.accurate,
       .most_halvings = most_halvings,
       .worse = 1.0});
  HarmonicOrbit orbit;
  orbit.ports = {at.u, options.period, problem.rate};
  orbit.motion = {equations.motion(at.of.g), options.period, problem.rate};
  orbit.residual = at.residual;
  if (search.end == NewtonEnd::undefined) {
    orbit.failure =
        "no orbit: a force is not defined on the motion, such as that of an oil film "
        "outside its bearing";
  } else if (!search.has_converged()) {
    orbit.failure =
        search.failure("no orbit", "the equations are singular, as where branches meet or turn");
  }
  orbit.residuals = std::move(search.residuals);
  return orbit;
}

}  // namespace

HarmonicOrbit find_harmonic_orbit(const HarmonicProblem& problem, const Mat& start,
                                  const HarmonicOptions& options) {
  options.check();
  const bool is_adaptive = options.harmonics == 0;
  const int most = is_adaptive ? options.most_harmonics * options.period : options.harmonics;
  const int needed = problem.highest_load(options.period);
  if (needed > most) {
    throw OptionError(fmt::format(
        "harmonic balance: a force is harmonic {} of the orbit, there are {}", needed, most));
  }
  int H = std::min(first_harmonics * options.period, most);
  // half as many before, to tell how far the motion still moves
  if (!is_adaptive) H = most >= 4 * options.period ? (most + 1) / 2 : most;
  H = std::max(H, std::min(needed, most));
  HarmonicOrbit found;
  std::vector<HarmonicOrbit::Level> levels;
  double change = std::numeric_limits<double>::quiet_NaN(), fall = unproven;
  int failures = 0;
  for (;; H = std::min(2 * H, most)) {
    const HarmonicEquations equations(problem, options.period, H);
    const bool goes_on = !levels.empty() && found.is_good();
    const Mat from = goes_on ? found.ports.coefficients : equations.U() * start;
    HarmonicOrbit next = solve(equations, with_harmonics(from, H), options);
    if (goes_on && !next.is_good()) {  // from the start again
      HarmonicOrbit again = solve(equations, with_harmonics(equations.U() * start, H), options);
      if (again.is_good()) next = std::move(again);
    }
    const double last = change;
    change = std::numeric_limits<double>::quiet_NaN();
    if (goes_on && next.is_good()) {
      change = distance(next.ports, found.ports) / problem.length_scale;
      fall = std::isfinite(last) && last > 0.0 ? std::clamp(change / last, 0.0, slowest) : unproven;
    }
    levels.push_back({H, static_cast<int>(next.residuals.size()) - 1, change});
    found = std::move(next);
    found.truncation = change * fall / (1.0 - fall);
    if (problem.forces.empty() && H >= options.period) found.truncation = 0.0;  // linear: exact
    failures = found.is_good() ? 0 : failures + 1;
    if (H >= most || failures == most_failures) break;
    if (is_adaptive && found.truncation < options.tolerance) break;
  }
  found.levels = std::move(levels);
  return found;
}

}  // namespace whirl::inline dyn
