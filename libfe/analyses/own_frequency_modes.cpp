#include "libfe/analyses/own_frequency_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "libbase/error.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/eigen/newton.hpp"

namespace whirl::inline fe {

namespace {

constexpr double own_within = 1e-13;  ///< relative distance of a frequency from that of its system
constexpr double own_enough = 1e-10;  ///< the same where rounding allows no less
constexpr double stride = 0.2;        ///< of a frequency, while no own frequency is passed
constexpr double closest = 1e-6;      ///< relative distance to where a mode is lost
constexpr double settled_pair = 1e-15;  ///< relative step of an eigenvalue that is found
constexpr double alike_after = 0.9;     ///< MAC of a mode before and after a step
constexpr double near_after = 0.15;     ///< relative step of an eigenvalue that is followed
constexpr int most_halvings = 6;        ///< of a step
constexpr int most_secants = 80;
constexpr int spare = 4;  ///< modes followed beyond those wanted, which may come below them
constexpr double same_pair = 1e-8;  ///< relative distance
constexpr double same_space = 0.1;  ///< of the energy of a shape: outside of those of equal modes
constexpr double known_shape = 0.99, known_frequency = 0.02;  ///< of a mode that is not followed
constexpr double looked_beside =
    0.1;                        ///< of a frequency: looking at one is looking at those around it
constexpr double window = 0.5;  ///< of a frequency: modes around it that may be at home there

/// q^H W p.
Complex product(const CVec& q, const Sparse& W, const CVec& p) {
  return q.dot(CVec(W * p));
}

/// An eigenpair of the system at a frequency.
struct PairAtFrequency : EigenPair {
  double omega = 0.0;  ///< of the system [rad/s]

  double gap() const { return lambda.imag() - omega; }
};

/// The eigenpair of another system that is near; none: Newton's iteration does not converge.
std::optional<PairAtFrequency> solved(const System& system, double omega,
                                      const PairAtFrequency& start) {
  PairAtFrequency pair{{start.lambda, start.q}, omega};
  if (!PairNewton(system.M, system.D(), system.stiffness()).converge(pair, settled_pair))
    return std::nullopt;
  return pair;
}

/// Follows an eigenpair to another frequency by its shape; none: it is lost on the way.
std::optional<PairAtFrequency> followed(const SystemAtFrequency& system,
                                        const PairAtFrequency& from, double omega, int depth = 0) {
  const System there = system(omega);
  const auto pair = solved(there, omega, from);
  const bool is_same = pair &&
                       std::abs(pair->lambda - from.lambda) <= near_after * std::abs(from.lambda) &&
                       mac(pair->q, from.q, there.M) >= alike_after;
  if (is_same) return pair;
  if (depth == most_halvings) return std::nullopt;
  const auto middle = followed(system, from, 0.5 * (from.omega + omega), depth + 1);
  return middle ? followed(system, *middle, omega, depth + 1) : std::nullopt;
}

/// The pair at the frequency that is its own; none: it stops oscillating before.
std::optional<PairAtFrequency> at_own_frequency(const SystemAtFrequency& system,
                                                const PairAtFrequency& start) {
  PairAtFrequency here = start, best = start;
  std::optional<PairAtFrequency> below, above;  // own frequencies are higher and lower there
  double barrier = std::numeric_limits<double>::infinity();  // lost from here on
  double next = start.lambda.imag();
  for (int i = 0; i < most_secants; ++i) {
    (here.gap() > 0.0 ? below : above) = here;
    const double gap = std::abs(here.gap()), least = std::abs(best.gap());
    if (gap <= own_within * here.omega) return here;
    // what does not shrink any more is rounding
    if (i > 0 && gap >= 0.5 * least && least <= own_enough * best.omega) return best;
    if (gap < least) best = here;
    const double low = below ? below->omega : 0.0;
    const double high = std::min(above ? above->omega : barrier, barrier);
    if (!(next > low && next < high)) {
      next = std::isfinite(high) ? 0.5 * (low + high) : here.omega + here.gap();
    }
    // the nearest one is wanted: a table may have several on the way
    const double most = stride * here.lambda.imag();
    if (!below || !above) next = std::clamp(next, here.omega - most, here.omega + most);
    if (next == low || next == high || next == here.omega) break;
    const auto there = followed(system, here, next);
    if (!there || !(there->lambda.imag() > 0.0)) {
      if (next < here.omega) return std::nullopt;
      barrier = next;  // the next one is halfway to it
      here = below ? *below : here;
      if (barrier - here.omega <= closest * barrier) return std::nullopt;
      continue;
    }
    const double slope = (there->gap() - here.gap()) / (there->omega - here.omega);
    const bool helps = slope < 0.0 && std::abs(there->gap()) < 0.5 * std::abs(here.gap());
    here = *there;
    next = helps || !below || !above ? here.omega - here.gap() / std::min(slope, -0.1)
                                     : 0.5 * (below->omega + above->omega);
  }
  if (std::abs(best.gap()) <= own_enough * best.omega) return best;
  return std::nullopt;
}

/// Whether two matrices differ by rounding alone.
bool are_equal(const Sparse& A, const Sparse& B) {
  constexpr double tolerance = 1e-15;
  const Sparse difference = A - B;
  for (int j = 0; j < difference.outerSize(); ++j) {
    for (Sparse::InnerIterator it(difference, j); it; ++it) {
      const double scale = std::abs(B.coeff(it.row(), it.col()));
      if (std::abs(it.value()) > tolerance * scale) return false;
    }
  }
  return true;
}

bool are_equal(const System& a, const System& b) {
  return are_equal(a.K, b.K) && are_equal(a.C, b.C) && are_equal(a.M, b.M);
}

/// Own modes as they are found.
class OwnModes {
 public:
  OwnModes(const SystemAtFrequency& system, int count, Completeness completeness)
      : system_(system), count_(count), wanted_(count + spare), completeness_(completeness) {}

  Modes found() {
    Modes rest = look(0.0);
    for (int looks = 1; looks < 3 * wanted_; ++looks) {
      const auto next = next_frequency();
      if (!next) break;
      try {
        look(*next);
      } catch (const NumericalError&) {  // no modes there, whose stiffness may be negative
      }
    }
    sort();
    Modes modes{{}, std::move(rest.overdamped), std::move(rest.rigid_body), rest.completeness};
    for (const Found& f : found_) {
      if (!oscillates(f.pair.lambda)) {
        modes.overdamped.push_back(f.pair.lambda);
      } else if (static_cast<int>(modes.oscillatory.size()) < count_) {
        modes.oscillatory.push_back(mode_of(f.pair.lambda, f.pair.q, dofs_));
      }
    }
    std::stable_sort(modes.overdamped.begin(), modes.overdamped.end(),
                     [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
    return modes;
  }

 private:
  struct Found {
    PairAtFrequency pair;
    bool is_seen = false;  ///< the system at its frequency is one whose modes are known
  };

  /// Whether all modes of a system near this frequency have been looked at.
  bool is_beside_a_look(double frequency) const {
    return std::any_of(looks_.begin(), looks_.end(), [&](double look) {
      return std::abs(look - frequency) <= looked_beside * look;
    });
  }

  /// Modes of the system at a frequency; those that are at home nearby become found.
  Modes look(double omega) {
    looks_.push_back(omega);
    const System here = system_(omega);
    dofs_ = here.dofs;
    Modes modes = complex_modes(here, wanted_, completeness_);
    for (const Mode& mode : modes.oscillatory) {
      const double f = mode.frequency();
      if (omega > 0.0 && std::abs(f - omega) > window * omega) continue;
      const PairAtFrequency start{{mode.lambda, mode.shape.normalized()}, omega};
      if (omega > 0.0 && is_known(start, here.M, known_frequency, 1.0 - known_shape)) continue;
      if (are_equal(system_(f), here)) {
        add({{mode.lambda, start.q}, f}, here.M, true);
      } else if (const auto pair = at_own_frequency(system_, start)) {
        add(*pair, here.M, false);
      }
    }
    return modes;
  }

  /// Whether a shape is one of the found modes whose eigenvalues are as near, or of their space.
  bool is_known(const PairAtFrequency& pair, const Sparse& M, double distance,
                double outside) const {
    std::vector<const CVec*> equal;
    for (const Found& f : found_) {
      const double apart = std::abs(f.pair.lambda - pair.lambda);
      if (apart <= distance * std::abs(pair.lambda)) equal.push_back(&f.pair.q);
    }
    if (equal.empty()) return false;
    CMat basis(pair.q.size(), static_cast<Eigen::Index>(equal.size()));
    for (std::size_t i = 0; i < equal.size(); ++i) {
      basis.col(static_cast<Eigen::Index>(i)) = *equal[i];
    }
    CVec left = pair.q;
    const double whole = product(left, M, left).real();
    orthogonalize(left, basis, M);
    return product(left, M, left).real() <= outside * whole;
  }

  /// Takes the part of a shape away that columns of a basis have, one after another.
  static void orthogonalize(CVec& q, CMat& basis, const Sparse& M) {
    for (Eigen::Index i = 0; i < basis.cols(); ++i) {
      CVec b = basis.col(i);
      for (Eigen::Index k = 0; k < i; ++k) b -= product(basis.col(k), M, b) * basis.col(k);
      const double size = product(b, M, b).real();
      if (!(size > same_pair * product(basis.col(i), M, basis.col(i)).real())) {
        basis.col(i).setZero();
        continue;
      }
      basis.col(i) = b / std::sqrt(size);
      q -= product(basis.col(i), M, q) * basis.col(i);
    }
  }

  void add(PairAtFrequency pair, const Sparse& M, bool is_seen) {
    if (is_known(pair, M, same_pair, same_space)) return;
    found_.push_back({std::move(pair), is_seen});
  }

  void sort() {
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
      return a.pair.lambda.imag() < b.pair.lambda.imag();
    });
  }

  /// Of the lowest found modes, the first one at whose frequency nobody has looked.
  std::optional<double> next_frequency() {
    sort();
    int rank = 0;
    for (const Found& f : found_) {
      if (rank++ == count_) break;
      const double frequency = f.pair.lambda.imag();
      if (!f.is_seen && !is_beside_a_look(frequency)) return frequency;
    }
    return std::nullopt;
  }

  const SystemAtFrequency& system_;
  int count_, wanted_;
  Completeness completeness_;
  std::vector<Found> found_;
  std::vector<double> looks_;  ///< frequencies whose systems have been asked for all their modes
  DofMap dofs_;
};

}  // namespace

Modes own_frequency_modes(const SystemAtFrequency& system, int count, Completeness completeness) {
  return OwnModes(system, count, completeness).found();
}

}  // namespace whirl::inline fe
