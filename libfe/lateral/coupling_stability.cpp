#include "libfe/lateral/coupling_stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "libbase/numerics/constants.hpp"
#include "libbase/numerics/roots.hpp"
#include "libfe/assembly/properties.hpp"
#include "libfe/assembly/states_apart.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/lateral/inverse_couplings.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

namespace {

constexpr double grows = 1e-8;       ///< real part over size from which a mode grows
constexpr double root_tol = 1e-12;   ///< of a frequency at the border, relative
constexpr double level = 1e-5;       ///< relative difference of frequencies that count as one
constexpr double drift = 1.5;        ///< times a frequency, how far Q may move it
constexpr double fine_step = 0.15;   ///< of the distance to the nearest eigenvalue
constexpr double coarse_step = 0.5;  ///< likewise, where a border below the least known is far off
constexpr double far_off = 0.25;     ///< Q_0 known so far times the receptance there
constexpr double near_axis = 0.25;   ///< of a step: it may cross the axis twice
constexpr double all_rounding = 1e12;  ///< Q times the static receptance
constexpr int most_splits = 12;        ///< of a step
constexpr int most_steps = 200000;     ///< of a scan
constexpr double last_decades = 1e3;   ///< times the fastest eigenvalue, where none was found

/// What is asked of the rotor at one Q.
struct LeastDamped {
  CoupledMode mode{.log_decrement = std::numeric_limits<double>::infinity()};
  bool is_growing = false;
};

/// The rotor with some cross-coupled stiffness at a station.
class CoupledRotor {
 public:
  CoupledRotor(const Structure& structure, double Omega, const Station& at, int count,
               const TurningShaft& shaft)
      : structure_(structure),
        at_(at),
        Omega_(Omega),
        count_(count),
        shaft_(shaft),
        assembler_(structure),
        is_one_of_several_(has_several_shafts(assembler_.mesh())) {
    const System system = assembler_.at(Omega);
    has_all_ = system.size() < dense_below || count >= system.size();
    if (has_all_) count_ = std::max(count, system.size());
    modes_ = modes_of(assembler_);
    own_ = of_shaft(modes_, assembler_);
    const Whirl against = shaft_.turns_against() ? Whirl::forward : Whirl::backward;
    const auto slowest = std::find_if(own_.oscillatory.begin(), own_.oscillatory.end(),
                                      [&](const Mode& m) { return m.whirl != against; });
    const bool has_slowest = slowest != own_.oscillatory.end();
    limit_ = std::max(has_slowest ? drift * slowest->frequency() : 0.0, spin()) * (1.0 + level);
  }

  /// All modes at Q = 0.
  const Modes& modes() const { return modes_; }
  /// Those that move the shaft most, and all that do not oscillate.
  const Modes& own_modes() const { return own_; }
  bool has_all_modes() const { return has_all_; }

  /// The least damped mode at Q of those that level I is about, see coupling_stability.
  LeastDamped at(double Q) const {
    if (Q == 0.0) return least_of(own_, Q);
    const Assembler with_coupling = coupled(Q);
    return least_of(of_shaft(modes_of(with_coupling), with_coupling), Q);
  }

  /// Whether it has a place to come back to.
  bool is_held() const { return is_held_at_rest(assembler_.uncondensed(Omega_, 0.0)); }

  /// 2 x 2 receptance (x, y) of the station [m/N] for motions e^(s t), s = w (i + tilt); NaN where
  /// it is infinite.
  Eigen::Matrix2cd receptance(double w, double tilt) {
    if (!stiffness_ || assembler_.depends_on_whirl()) {
      stiffness_.emplace(assembler_.uncondensed(Omega_, w));
    }
    const DofMap& dofs = assembler_.dofs();
    const Point point = assembler_.point(at_);
    const std::array<int, 2> own{dofs.full_index(point, X), dofs.full_index(point, Y)};
    Eigen::Matrix2cd H = Eigen::Matrix2cd::Constant(Complex(nan, nan));
    if (!stiffness_->factorize(Complex(tilt * w, w), Omega_)) return H;
    for (int j = 0; j < 2; ++j) {
      CVec force = CVec::Zero(dofs.full_size);
      force(own[static_cast<std::size_t>(j)]) = 1.0;
      const CVec full = dofs.T * stiffness_->solve(dofs.T.transpose() * force);
      H(0, j) = full(own[0]), H(1, j) = full(own[1]);
    }
    if (shaft_.turns_against()) H.transposeInPlace();  // Q has the other sign
    return H;
  }

 private:
  LeastDamped least_of(const Modes& modes, double Q) const {
    LeastDamped least;
    const auto add = [&](Complex lambda, bool counts) {
      const bool is_growing = lambda.real() > grows * std::abs(lambda);
      if (!is_growing && !counts) return;
      const double frequency = std::abs(lambda.imag());
      const double decrement = -2.0 * std::numbers::pi * lambda.real() / frequency;
      least.is_growing = least.is_growing || is_growing;
      if (decrement < least.mode.log_decrement) least.mode = {Q, decrement, frequency};
    };
    for (const Mode& m : modes.oscillatory) add(m.lambda, m.frequency() <= limit_);
    for (const Complex lambda : modes.overdamped) add(lambda, false);
    for (const Mode& m : modes.rigid_body) add(m.lambda, false);  // Q may drive them, too
    if (std::isinf(least.mode.log_decrement) && !least.is_growing && !modes.oscillatory.empty()) {
      add(modes.oscillatory.front().lambda, true);
    }
    least.mode.coupling = Q;
    return least;
  }

  /// Speed of the shaft [rad/s].
  double spin() const { return shaft_.order() * Omega_; }

  Modes of_shaft(Modes modes, const Assembler& assembler) const {
    if (!is_one_of_several_) return modes;
    const DofMap dofs = assembler.at(Omega_).dofs;
    const auto is_of_another = [&](const Mode& m) {
      return shaft_moved_most(assembler.mesh(), dofs, m.shape) != shaft_.number;
    };
    std::erase_if(modes.oscillatory, is_of_another);
    std::erase_if(modes.rigid_body, is_of_another);
    return modes;
  }

  /// All of a small rotor; of a large one as many of the lowest as reach beyond its speed.
  Modes modes_of(const Assembler& assembler) const {
    Modes modes = complex_modes(assembler, Omega_, count_);
    for (int count = 2 * count_; static_cast<int>(modes.oscillatory.size()) * 2 == count &&
                                 modes.oscillatory.back().frequency() < spin();
         count *= 2) {
      modes = complex_modes(assembler, Omega_, count);
    }
    return modes;
  }

  Assembler coupled(double Q) const {
    Structure s = structure_;
    BearingCoefficients coupling;
    coupling.K << 0.0, Q, -Q, 0.0;
    if (shaft_.turns_against()) coupling.K *= -1.0;
    // a force of the gas, not a spring: damping in proportion to stiffness has no part in it
    s.linearized.push_back(
        {"cross-coupling", at_, {}, [coupling](double, double) { return coupling; }});
    return Assembler(std::move(s));
  }

  const Structure& structure_;
  Station at_;
  double Omega_;
  int count_;
  TurningShaft shaft_;
  Assembler assembler_;
  bool is_one_of_several_;
  Modes modes_, own_{};  ///< at Q = 0
  double limit_ = 0.0;   ///< frequency up to which every mode counts [rad/s]
  bool has_all_ = false;
  std::optional<DynamicStiffness> stiffness_{};
};

/// Where an eigenvalue is on the imaginary axis.
struct Border {
  double Q, w;
  int more;  ///< eigenvalues beyond it right of the axis: one more, or one less
};

/// Follows the imaginary axis, and finds each Q at which an eigenvalue is on it.
///
/// What has no damping is on it from the start: then s = w (i + 1e-8) is followed, and grows what
/// is right of that.
class BorderScan {
 public:
  explicit BorderScan(CoupledRotor& rotor) : rotor_(rotor) {
    const auto add = [&](Complex lambda) {
      if (std::abs(lambda) == 0.0) return;
      poles_.push_back(lambda);
      top_ = std::max(top_, 1.5 * std::abs(lambda));
      bottom_ = std::min(bottom_, 1e-3 * std::abs(lambda));
      if (std::abs(lambda.real()) < grows * std::abs(lambda)) tilt_ = grows;
    };
    for (const Mode& m : rotor.modes().oscillatory) add(m.lambda);
    for (const Complex lambda : rotor.modes().overdamped) add(lambda);
  }

  bool has_undamped() const { return tilt_ > 0.0; }

  /// Every Q > 0 at the border that is not far above the least one, ascending.
  std::vector<Border> found() {
    double w = bottom_;
    InverseCouplings here = at(w);
    most_ = all_rounding / here.size();
    at_rest(here);
    for (int i = 0; i < most_steps && !is_over(w, here); ++i) {
      const double next = w + step(w, here);
      here = walk(w, here, next, 0);
      w = next;
    }
    std::sort(found_.begin(), found_.end(),
              [](const Border& a, const Border& b) { return a.Q < b.Q; });
    return found_;
  }

 private:
  InverseCouplings at(double w) { return InverseCouplings(rotor_.receptance(w, tilt_)); }

  /// Beyond all eigenvalues receptances fall: once they are too small for the least Q, no less
  /// follows.
  bool is_over(double w, const InverseCouplings& here) const {
    if (w < top_) return false;
    return w > last_decades * top_ || least_ * here.size() < 1.0;
  }

  void add(double Q, double w, bool is_right) {
    if (!(Q > 0.0 && Q < most_)) return;
    found_.push_back({Q, w, is_right ? 1 : -1});
    if (is_right) least_ = std::min(least_, Q);
  }

  /// From w to next, in halves where it is not clear what is between.
  InverseCouplings walk(double w, const InverseCouplings& here, double next, int halvings) {
    const InverseCouplings there = at(next).as(here.p);
    if (halvings < most_splits && (!there.is_like(here) || is_near(here, there, halvings))) {
      const double middle = 0.5 * (w + next);
      return walk(middle, walk(w, here, middle, halvings + 1), next, halvings + 1);
    }
    for (const std::size_t k : {0, 1}) add_between(w, here, next, there, k);
    return there;
  }

  /// Whether one may have been real and positive twice on the way.
  bool is_near(const InverseCouplings& here, const InverseCouplings& there, int halvings) const {
    constexpr int enough = 4;
    if (halvings >= enough) return false;
    for (const std::size_t k : {0, 1}) {
      const Complex from = here.p[k], to = there.p[k];
      if (from.real() <= 0.0 && to.real() <= 0.0) continue;
      if (least_ * std::max(std::abs(from), std::abs(to)) < 1.0 - near_axis) continue;
      if (from.imag() * to.imag() > 0.0 &&
          std::min(std::abs(from.imag()), std::abs(to.imag())) < near_axis * std::abs(to - from)) {
        return true;
      }
    }
    return false;
  }

  /// Where one of them is real and positive between two frequencies. With dp / dQ < 0, the
  /// eigenvalue goes right where Im p falls over w.
  void add_between(double w, const InverseCouplings& here, double next,
                   const InverseCouplings& there, std::size_t k) {
    const Complex from = here.p[k], to = there.p[k];
    if (!(from.imag() * to.imag() < 0.0) || (from.real() <= 0.0 && to.real() <= 0.0)) return;
    const auto between = [&](double v) {
      const double share = (v - w) / (next - w);
      const std::array<Complex, 2> expected{here.p[0] + share * (there.p[0] - here.p[0]),
                                            here.p[1] + share * (there.p[1] - here.p[1])};
      return at(v).as(expected).p[k];
    };
    const double root = bracketed_root([&](double v) { return between(v).imag(); }, w, from.imag(),
                                       next, to.imag(), root_tol * next);
    if (std::isfinite(root)) add(1.0 / between(root).real(), root, from.imag() > 0.0);
  }

  /// Real eigenvalues at zero: the rotor leaves its place without oscillating.
  void at_rest(const InverseCouplings& above) {
    if (!rotor_.is_held()) return;
    const InverseCouplings rest = at(0.0).as(above.p);
    for (const std::size_t k : {0, 1}) {
      const Complex p = rest.p[k];
      if (std::abs(p.imag()) <= root_tol * std::abs(p)) {
        add(1.0 / p.real(), 0.0, above.p[k].imag() < 0.0);
      }
    }
  }

  /// How far the receptance stays much the same.
  double step(double w, const InverseCouplings& here) const {
    double distance = top_ + w;
    for (const Complex pole : poles_) {
      distance = std::min(distance, std::abs(Complex(tilt_ * w, w) - pole));
    }
    return (least_ * here.size() < far_off ? coarse_step : fine_step) * distance;
  }

  CoupledRotor& rotor_;
  std::vector<Complex> poles_{};
  std::vector<Border> found_{};
  double top_ = 0.0, bottom_ = std::numeric_limits<double>::infinity();  ///< of the scan [rad/s]
  double tilt_ = 0.0;                                                    ///< of what is followed
  double least_ = std::numeric_limits<double>::infinity();               ///< Q known so far
  double most_ = 0.0;  ///< Q beyond which all is rounding
};

/// The least Q above which a mode grows; nothing: there is none.
/// @param size  Q that is large [N/m]
std::optional<CoupledMode> first_growth(CoupledRotor& rotor, double size) {
  constexpr double tiny = 1e-6;  // of it: a rotor without damping bears none
  const LeastDamped own = rotor.at(0.0);
  if (own.is_growing || (!rotor.is_held() && rotor.at(tiny * size).is_growing)) return own.mode;
  BorderScan scan(rotor);
  int right = 0;  // eigenvalues
  for (const Border& border : scan.found()) {
    right = std::max(0, right + border.more);
    if (right == 0) continue;
    if (scan.has_undamped() && border.Q < tiny * size) return own.mode;
    return CoupledMode{border.Q, 0.0, border.w};
  }
  return {};
}

/// Where the curve ends.
double last_coupling(const CouplingStability& found, double anticipated, double size) {
  constexpr double beyond = 1.25, beyond_anticipated = 1.05;
  const bool has_limit = found.at_limit && found.at_limit->coupling > 0.0;
  return std::max(has_limit ? beyond * found.at_limit->coupling : size,
                  beyond_anticipated * anticipated);
}

}  // namespace

CoupledMode least_damped_mode(const Structure& structure, double Omega, const Station& at,
                              int count, const TurningShaft& shaft) {
  return CoupledRotor(structure, Omega, at, count, shaft).at(0.0).mode;
}

CouplingStability coupling_stability(const Structure& structure, double Omega, const Station& at,
                                     const CouplingOptions& options) {
  CouplingStability found;
  CoupledRotor rotor(structure, Omega, at, options.count, options.shaft);
  const std::vector<Mode>& oscillatory = rotor.own_modes().oscillatory;
  const std::vector<Complex>& overdamped = rotor.own_modes().overdamped;
  if (oscillatory.empty() && overdamped.empty()) return found;
  const double mass = rotor_properties(structure, make_mesh(structure)).mass;
  const double size =
      mass * std::norm(oscillatory.empty() ? overdamped.front() : oscillatory.front().lambda);
  found.at_limit = first_growth(rotor, size);
  found.at_anticipated = rotor.at(options.anticipated).mode;
  const double last = last_coupling(found, options.anticipated, size);
  for (int i = 0; i <= options.steps; ++i) {
    const double Q = last * i / options.steps;
    const LeastDamped least = rotor.at(Q);
    found.modes.push_back(least.mode);
    if (rotor.has_all_modes() || !least.is_growing) continue;
    // receptances tell the border to more digits than eigenvalues do
    if (found.at_limit && Q >= found.at_limit->coupling) continue;
    // driven by a mode beyond the known ones, which the scan went past
    CouplingOptions more = options;
    more.count = 2 * options.count;
    return coupling_stability(structure, Omega, at, more);
  }
  return found;
}

}  // namespace whirl::inline fe
