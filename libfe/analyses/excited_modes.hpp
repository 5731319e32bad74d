#pragma once
/// Places along a path at which an excitation meets a natural frequency, where the shafts of a
/// rotor turn at any speeds.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "libfe/analyses/critical.hpp"
#include "libfe/parts/structure.hpp"

namespace whirl::inline fe {

/// A rotor at one place: its further shafts turn at their speeds at Omega.
struct ExcitedRotor {
  Structure structure;
  double Omega = 0.0;       ///< of the first shaft [rad/s]
  double excitation = 0.0;  ///< frequency [rad/s]; 0: there is none
};
/// The rotor along a path, as over the speed of the first shaft.
using ExcitedRotorAt = std::function<ExcitedRotor(double s)>;

/// The structure with ratios in place of own speeds: those that its further shafts have to the
/// first one at a speed [rad/s], which is above zero.
Structure with_ratios_at(Structure structure, double Omega);

/// A place where the excitation is a natural frequency; the speed of the critical one is that of
/// the first shaft there.
struct ExcitedPlace {
  double s = 0.0;
  Critical critical;
};

/// Undamped natural frequencies beside an excitation along a path.
///
/// With the speeds w_j of the shafts at s, and the excitation f(s), the Hermitian pencil
///
///   K q = nu (M - i sum_j (w_j / f) G_j) q
///
/// has an eigenvalue nu = 1 / f^2 where f is a natural frequency. Eigenvalues in their order are
/// continuous over s, so that each f^2 nu_k = 1 is bracketed without following shapes. Where K
/// depends on speed or frequency it is that of both at s.
///
/// Not safe to share between threads: what is found at a place is kept.
class ExcitedModes {
 public:
  /// @param count  of places wanted
  ExcitedModes(ExcitedRotorAt rotor, int count);

  /// How many natural frequencies the excitation is above; nothing where they cannot be computed.
  std::optional<std::size_t> below(double s);
  /// The next place where the k-th lowest one could be met, judged from here [unit of s]: exact
  /// where all speeds are in proportion to s; infinite: nowhere.
  double guess(double s, std::size_t k);
  /// Whether the excitation is above all natural frequencies that it can ever meet.
  bool is_above_all(double s);

  /// All places between neighboring ones of a grid, in ascending order.
  /// @param grid  ascending, above zero
  /// @throws NumericalError  if nothing can be computed at any of them
  std::vector<ExcitedPlace> places(const std::vector<double>& grid);

 private:
  const std::vector<double>* try_at(double s);
  std::vector<Critical> solved(double s);
  double gap(double s, std::size_t k);
  void add_between(double a, double b, std::size_t k, std::vector<ExcitedPlace>& to);
  void add_turning(double a, double b, double c, std::size_t k, std::vector<ExcitedPlace>& to);

  ExcitedRotorAt rotor_;
  std::size_t count_;
  std::map<double, std::vector<double>> known_;  ///< f sqrt(nu_k), falling; empty: not computable
  std::string why_not_;                          ///< of the first place that is not computable
};

/// The lowest critical speeds of the first shaft in a structure whose shafts may have speeds of
/// their own, with damped_speed NaN.
/// @throws ModelError      if there is no further shaft of the name in the options
/// @throws NumericalError  if the eigensolver fails
std::vector<Critical> excited_criticals(const Structure& structure, const CriticalOptions& options);

/// Frequency of the excitation that options name, at a speed of the first shaft [rad/s].
double excitation_at(const Structure& structure, const CriticalOptions& options, double Omega);

}  // namespace whirl::inline fe
