#include "libfe/coupling_stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libbase/roots.hpp"
#include "libfe/campbell.hpp"
#include "libfe/properties.hpp"

namespace whirl::inline fe {

namespace {

constexpr double same_mode = 0.8;      ///< MAC from which a mode is the one before
constexpr int steps_along_mode = 200;  ///< along one mode
constexpr double root_tol = 1e-10;     ///< of Q_0, relative

/// The rotor with some cross-coupled stiffness at a station.
class CoupledRotor {
 public:
  CoupledRotor(const Structure& structure, double Omega, const Station& at, int count)
      : structure_(structure), at_(at), Omega_(Omega), count_(count) {
    M_ = Assembler(structure).at(Omega).M;
  }

  std::vector<Mode> modes(double Q) const {
    return complex_modes(coupled(Q), Omega_, count_).oscillatory;
  }

  /// The mode at Q that is most like another one, and how much; looked for near its frequency.
  std::pair<Mode, double> like(const Mode& mode, double Q) const {
    std::pair<Mode, double> best{mode, 0.0};
    const Assembler assembler = coupled(Q);
    for (const Mode& other :
         ModeFinder(assembler).near(Omega_, mode.frequency(), count_).oscillatory) {
      const double agreement = mac(other.shape, mode.shape, M_);
      if (agreement > best.second) best = {other, agreement};
    }
    return best;
  }

 private:
  Assembler coupled(double Q) const {
    Structure s = structure_;
    BearingCoefficients coupling;
    coupling.K << 0.0, Q, -Q, 0.0;
    s.links.push_back(
        {.name = "cross-coupling", .from = at_, .coefficients = constant_bearing(coupling)});
    return Assembler(std::move(s));
  }

  const Structure& structure_;
  Station at_;
  double Omega_;
  int count_;
  Sparse M_;
};

/// One mode along Q.
struct Followed {
  std::vector<double> Q;
  std::vector<Mode> modes;
  double limit = INFINITY;  ///< Q_0

  /// The mode at a Q, by the nearest one known.
  Mode at(const CoupledRotor& rotor, double wanted) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < Q.size(); ++i) {
      if (std::abs(Q[i] - wanted) < std::abs(Q[nearest] - wanted)) nearest = i;
    }
    if (Q[nearest] == wanted) return modes[nearest];
    return rotor.like(modes[nearest], wanted).first;
  }
};

/// Follows a mode up to where it grows, and at least to Q_A.
/// @param size  Q that the mass of the rotor and the damping of the mode would bear [N/m]
Followed follow_coupling(const CoupledRotor& rotor, const Mode& start, double size,
                         double anticipated) {
  constexpr double farthest = 20.0, smallest = 1e-4;
  Followed f{.Q = {0.0}, .modes = {start}};
  double step = 0.05 * size;
  const double last = std::max(farthest * size, 1.01 * anticipated);
  for (int i = 0; i < steps_along_mode && f.Q.back() < last; ++i) {
    const double Q = f.Q.back() + step;
    const auto [mode, agreement] = rotor.like(f.modes.back(), Q);
    if (agreement < same_mode && step > smallest * size) {
      step *= 0.5;
      continue;
    }
    if (agreement < same_mode) return f;  // it is lost
    const double before = f.modes.back().lambda.real(), now = mode.lambda.real();
    if (before < 0.0 && now >= 0.0 && std::isinf(f.limit)) {
      const double from = f.Q.back();
      f.limit = bracketed_root(
          [&](double q) { return rotor.like(f.modes.back(), q).first.lambda.real(); }, from, before,
          Q, now, root_tol * Q);
      if (!std::isfinite(f.limit)) f.limit = Q;
    }
    f.Q.push_back(Q);
    f.modes.push_back(mode);
    if (std::isfinite(f.limit) && Q > std::max(1.3 * f.limit, anticipated)) return f;
    if (std::abs(now - before) < 0.05 * std::abs(start.lambda.real())) step *= 2.0;
  }
  return f;
}

/// Modes at Q = 0 with the shapes that they have at a very small Q: where forward and backward whirl
/// have one eigenvalue, as without gyroscopics, it tells them apart.
std::vector<Mode> split_modes(const CoupledRotor& rotor, double mass) {
  constexpr double very_small = 1e-6;
  const std::vector<Mode> at_zero = rotor.modes(0.0);
  if (at_zero.empty()) return {};
  std::vector<Mode> split = rotor.modes(very_small * mass * std::norm(at_zero.front().lambda));
  for (Mode& mode : split) {
    const auto nearest =
        std::min_element(at_zero.begin(), at_zero.end(), [&](const Mode& a, const Mode& b) {
          return std::abs(a.lambda - mode.lambda) < std::abs(b.lambda - mode.lambda);
        });
    mode.lambda = nearest->lambda;
  }
  return split;
}

/// Those of them that a cross-coupled stiffness may destabilize.
std::vector<Mode> candidates(const std::vector<Mode>& modes, double Omega) {
  std::vector<Mode> found;
  const auto whirls_forward = [](const Mode& m) {
    return m.whirl == Whirl::forward || (m.whirl == Whirl::mixed && m.kappa > 0.0);
  };
  for (const Mode& m : modes) {
    if (whirls_forward(m) && m.frequency() <= Omega) found.push_back(m);
  }
  if (!found.empty()) return found;
  const auto slowest = std::find_if(modes.begin(), modes.end(), whirls_forward);
  if (slowest != modes.end()) found.push_back(*slowest);
  return found;
}

CoupledMode coupled_mode(double Q, const Mode& mode) {
  return {Q, mode.log_decrement(), mode.frequency()};
}

}  // namespace

CouplingStability coupling_stability(const Structure& structure, double Omega, const Station& at,
                                     const CouplingOptions& options) {
  CouplingStability found;
  const CoupledRotor rotor(structure, Omega, at, options.count);
  const double mass = rotor_properties(structure, make_mesh(structure)).mass;
  std::vector<Followed> all;
  for (const Mode& mode : candidates(split_modes(rotor, mass), Omega)) {
    const double zeta = std::max(std::abs(mode.damping_ratio()), 1e-3);
    const double size = 2.0 * zeta * mass * std::norm(mode.lambda);
    all.push_back(follow_coupling(rotor, mode, size, options.anticipated));
  }
  if (all.empty()) return found;
  const auto first = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    if (a.limit != b.limit) return a.limit < b.limit;
    return a.modes.front().log_decrement() < b.modes.front().log_decrement();
  });
  for (const Followed& f : all) {
    const CoupledMode there = coupled_mode(options.anticipated, f.at(rotor, options.anticipated));
    if (!found.at_anticipated || there.log_decrement < found.at_anticipated->log_decrement) {
      found.at_anticipated = there;
    }
  }
  if (std::isfinite(first->limit)) {
    found.at_limit = coupled_mode(first->limit, first->at(rotor, first->limit));
    const double last = std::max(1.25 * first->limit, 1.05 * options.anticipated);
    for (int i = 0; i <= options.steps; ++i) {
      const double Q = last * i / options.steps;
      found.modes.push_back(coupled_mode(Q, first->at(rotor, Q)));
    }
  } else {
    for (std::size_t i = 0; i < first->Q.size(); ++i) {
      found.modes.push_back(coupled_mode(first->Q[i], first->modes[i]));
    }
  }
  return found;
}

}  // namespace whirl::inline fe
