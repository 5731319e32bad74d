#include "libfe/analyses/critical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libbase/error.hpp"
#include "libbase/numerics/constants.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libfe/analyses/excited_modes.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/eigen/hermitian.hpp"
#include "libfe/eigen/symmetric.hpp"

namespace whirl::inline fe {

namespace {

constexpr double speed_tol = 1e-12;
constexpr double damped_tol = 1e-10;  ///< of a speed, |Im lambda - order * Omega|
constexpr double rounding_of_gaps =
    1e-7;                              ///< of a speed: smaller gaps that do not shrink are rounding
constexpr double least_alike = 0.3;    ///< MAC of a mode that goes on from speed to speed
constexpr double surely_alike = 0.95;  ///< likewise, that need not be compared with others
constexpr double range = 2.0;          ///< damped speeds beyond so many times are not looked for
constexpr double rounding = 1e-13;     ///< of the largest nu: smaller ones have no finite speed

}  // namespace

std::vector<Critical> undamped_criticals(const System& system, const CriticalOptions& options) {
  const Sparse K = symmetric_part(system.stiffness());
  if (!system.dofs.states.empty() && !is_supported(K)) {
    throw NumericalError(
        "undamped critical speeds need supports that are springs and masses: this one has a "
        "controller, or damping between its states; campbell follows the damped modes");
  }
  const HermitianModes modes = largest_hermitian(symmetric_inertia(system.M), system.G(),
                                                 1.0 / options.order, K, options.count);
  std::vector<Critical> criticals;
  for (Eigen::Index i = 0; i < modes.nu.size(); ++i) {
    // no real speed: a disk that stiffens faster than it spins, or dofs without inertia
    if (modes.nu(i) <= rounding * modes.nu(0)) break;
    const CVec q = modes.q.col(i);
    Critical critical{.speed = 1.0 / (options.order * std::sqrt(modes.nu(i))),
                      .damped_speed = nan,
                      .whirl = whirl_of(orbits(system.dofs, q)),
                      .shape = q};
    critical.order = options.order;
    criticals.push_back(std::move(critical));
  }
  return criticals;
}

namespace {

/// Iterates the i-th critical speed of the stiffness at Omega until it is Omega itself.
Critical self_consistent(const Assembler& assembler, const CriticalOptions& options, std::size_t i,
                         Critical start) {
  const auto at = [&](double Omega) {
    std::vector<Critical> all =
        undamped_criticals(assembler.at(Omega, options.order * Omega), options);
    return i < all.size() ? all[i] : Critical{.speed = nan};
  };
  double a = start.speed;
  Critical at_a = at(a);
  double b = at_a.speed;
  for (int it = 0; it < 100 && std::isfinite(b); ++it) {
    const Critical at_b = at(b);
    if (std::abs(at_b.speed - b) <= speed_tol * b) return at_b;
    const double slope = (at_b.speed - at_a.speed) / (b - a);  // of the map Omega -> critical
    double next = at_b.speed;
    if (std::abs(slope) < 0.9) next = b + (at_b.speed - b) / (1.0 - slope);
    a = b;
    at_a = at_b;
    b = next;
  }
  start.speed = nan;
  return start;
}

/// Where damped critical speeds are looked for.
struct DampedSearch {
  const ModeFinder& finder;
  const Structure& structure;
  const CriticalOptions& options;

  /// Frequency of the excitation [rad/s].
  double excitation(double Omega) const { return excitation_at(structure, options, Omega); }
};

/// Follows the mode of an undamped critical speed through spin speeds by its shape.
class DampedMode {
 public:
  DampedMode(const DampedSearch& search, const Critical& undamped)
      : search_(search), finder_(search.finder), shape_(undamped.shape) {}

  /// Im lambda - order * Omega; NaN: no mode is like the one before.
  double gap(double Omega) {
    const Sparse M = finder_.system(Omega).M;
    std::optional<Mode> found;
    if (mode_) found = finder_.followed(*mode_, Omega, search_.excitation(Omega));
    if (!found || mac(found->shape, shape_, M) < surely_alike) found = most_alike(Omega, M);
    if (!found) return nan;
    mode_ = std::move(found);
    shape_ = mode_->shape;
    return mode_->frequency() - search_.excitation(Omega);
  }

  /// Of the mode that was found last.
  double damping_ratio() const { return mode_ ? mode_->damping_ratio() : nan; }

 private:
  /// Of all modes near the line of the excitation; nothing: none is like the one before.
  std::optional<Mode> most_alike(double Omega, const Sparse& M) const {
    double best = least_alike;
    std::optional<Mode> result;
    Modes modes = finder_.near(Omega, search_.excitation(Omega), search_.options.count + 6);
    for (Mode& mode : modes.oscillatory) {
      const double agreement = mac(mode.shape, shape_, M);
      if (agreement <= best) continue;
      best = agreement;
      result = std::move(mode);
    }
    return result;
  }

  const DampedSearch& search_;
  const ModeFinder& finder_;
  CVec shape_;                ///< of the mode so far
  std::optional<Mode> mode_;  ///< nothing: only its undamped shape is known
};

constexpr const char* lost_text = "its mode does not oscillate, or changes beyond recognition";

/// Speed beside one of a gap, from which secants go on.
double second_speed(const DampedSearch& search, double a, double gap) {
  if (search.options.by.empty()) return a + gap / search.options.order * 0.5;
  constexpr double step = 1e-3;  // an own speed may stay, or fall
  const double slope = (search.excitation((1.0 + step) * a) - search.excitation(a)) / (step * a);
  if (slope > 0.0) return a + std::clamp(0.5 * gap / slope, -0.1 * a, 0.1 * a);
  return (1.0 + step) * a;
}

/// Solves Im lambda(Omega) = order * Omega by secants from an undamped critical speed.
void find_damped(const DampedSearch& search, Critical& critical) {
  DampedMode mode(search, critical);
  const double start = critical.speed;
  const auto is_in_range = [&](double Omega) {
    return Omega > start / range && Omega < range * start;
  };
  const auto found = [&](double Omega) {
    critical.damped_speed = Omega;
    critical.damping_ratio = mode.damping_ratio();
    critical.note.clear();
  };
  double a = start, ga = mode.gap(a);
  critical.note = lost_text;
  if (!std::isfinite(ga)) return;
  if (std::abs(ga) <= damped_tol * a) return found(a);
  double b = second_speed(search, a, ga);
  for (int it = 0; it < 60; ++it) {
    if (!is_in_range(b)) {
      critical.note = "it would be far from the undamped one";
      return;
    }
    const double gb = mode.gap(b);
    if (!std::isfinite(gb)) return;
    // the first step is half a one: only secants that no longer help are at the end of digits
    const double last = std::abs(ga), now = std::abs(gb);
    const bool is_rounding =
        it > 0 && last <= rounding_of_gaps * a && now > 0.5 * last && now < 2.0 * last;
    if (std::abs(gb) <= damped_tol * b || is_rounding) return found(b);
    if (gb == ga) break;
    const double next = b - gb * (b - a) / (gb - ga);
    a = b, ga = gb;
    b = next;
  }
  critical.note = "the iteration does not converge";
}

/// Takes a damped speed off all undamped ones that lead to it but the nearest. Twins, as of planes
/// that are alike, keep one each.
void tell_apart(std::vector<Critical>& criticals) {
  constexpr double same = 1e-8, twins = 1e-3;  // relative
  const auto distance = [](const Critical& c) { return std::abs(c.damped_speed - c.speed); };
  for (std::size_t i = 0; i < criticals.size(); ++i) {
    for (std::size_t j = i + 1; j < criticals.size(); ++j) {
      Critical &a = criticals[i], &b = criticals[j];
      const bool is_shared = std::abs(a.damped_speed - b.damped_speed) < same * a.damped_speed;
      if (!is_shared || std::abs(a.speed - b.speed) < twins * a.speed) continue;  // false for NaN
      Critical& other = distance(a) <= distance(b) ? b : a;
      other.damped_speed = other.damping_ratio = nan;
      other.note = "the mode that its shape leads to is that of another critical speed";
    }
  }
}

}  // namespace

std::string Critical::excitation() const {
  return std::isnan(order) ? "speed of " + shaft : fmt::format("{:g}x", order);
}

namespace {

/// Undamped ones of a rotor whose shafts have constant ratios.
std::vector<Critical> direct_criticals(const Assembler& assembler, const CriticalOptions& options) {
  std::vector<Critical> criticals = undamped_criticals(assembler.at(options.start), options);
  if (!assembler.depends_on_speed()) return criticals;
  std::vector<Critical> iterated;
  for (std::size_t i = 0; i < criticals.size(); ++i) {
    const Critical c = self_consistent(assembler, options, i, criticals[i]);
    if (std::isfinite(c.speed)) iterated.push_back(c);
  }
  std::sort(iterated.begin(), iterated.end(),
            [](const Critical& a, const Critical& b) { return a.speed < b.speed; });
  return iterated;
}

/// A shaft of a ratio excites as an order of the first one does.
CriticalOptions by_order(const Structure& structure, CriticalOptions options) {
  const auto shaft = structure.shaft_named(options.by);
  if (!shaft) {
    throw ModelError({}, "rotor", fmt::format("there is no rotor named \"{}\"", options.by));
  }
  if (*shaft == 0) return options;
  const Rotor& rotor = structure.rotors[static_cast<std::size_t>(*shaft) - 1];
  if (rotor.has_own_speed()) return options;
  options.order = std::abs(rotor.ratio);
  options.by.clear();
  return options;
}

}  // namespace

std::vector<Critical> critical_speeds(const Assembler& assembler, const CriticalOptions& given) {
  const Structure& structure = assembler.structure();
  const CriticalOptions options = by_order(structure, given);
  if (options.order == 0.0) return {};  // a shaft that stands
  require_supports(assembler, options.start, "critical speeds need");
  std::vector<Critical> criticals = structure.rotor_of_own_speed()
                                        ? excited_criticals(structure, options)
                                        : direct_criticals(assembler, options);
  for (Critical& c : criticals) {
    if (!given.by.empty()) c.shaft = given.by;
  }
  if (!options.has_damped) return criticals;
  const ModeFinder finder(assembler);
  for (Critical& c : criticals) {
    try {
      find_damped({finder, structure, options}, c);
    } catch (const NumericalError& error) {
      c.note = error.what();
    }
  }
  tell_apart(criticals);
  return criticals;
}

std::vector<Critical> critical_speeds_by_all(const Assembler& assembler,
                                             const CriticalOptions& options) {
  std::vector<Critical> all = critical_speeds(assembler, options);
  if (options.order != 1.0) return all;
  for (const Rotor& rotor : assembler.structure().rotors) {
    if (!rotor.has_own_speed() && std::abs(rotor.ratio) == 1.0) continue;
    CriticalOptions by = options;
    by.by = rotor.name;
    for (Critical& c : critical_speeds(assembler, by)) all.push_back(std::move(c));
  }
  return all;
}

}  // namespace whirl::inline fe
