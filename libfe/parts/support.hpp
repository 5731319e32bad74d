#pragma once
/// Supports with a dynamic stiffness: pedestals, foundations, casings, controllers.

#include <optional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline fe {

/// A displacement across the shaft that a support sees, or along which its force acts: that of a
/// station less that of another one, along a direction of length one.
struct InterfaceCoordinate {
  Station at, to;
  double x = 1.0, y = 0.0;  ///< the direction
  bool operator==(const InterfaceCoordinate&) const = default;
};

/// A linear law with states z between displacements u and forces f that resist them:
///
///   z' = A z + B u,   f = C z + D u + D_rate u' + D_inertia u''
///
/// n states, p displacements, m forces.
struct StateSpace {
  Mat A;          ///< n x n [1/s]
  Mat B;          ///< n x p
  Mat C;          ///< m x n
  Mat D;          ///< m x p [N/m]
  Mat D_rate;     ///< m x p [N.s/m]; empty: none
  Mat D_inertia;  ///< m x p [kg]; empty: none

  int states() const { return static_cast<int>(A.rows()); }
  int inputs() const { return static_cast<int>(D.cols()); }
  int outputs() const { return static_cast<int>(D.rows()); }
  /// f over u of motions e^(s t), m x p.
  CMat stiffness_at(Complex s) const;
  /// The same of a constant displacement; D where the states never come to rest.
  Mat static_stiffness() const;
  /// The same law for several displacements side by side, which do not see each other.
  StateSpace repeated(int times) const;

  bool operator==(const StateSpace& other) const;
};

/// A state space in coordinates w of unit mass, each of which stands for two states:
///
///   w'' + K_w w + C_w w' = B_0 u + B_1 u',   f = C_0 w + C_1 w' + D u + D_rate u' + D_inertia u''
struct StateCoordinates {
  Mat K_w, C_w;  ///< k x k
  Mat B_0, B_1;  ///< k x p
  Mat C_0, C_1;  ///< m x k
  Mat D;         ///< m x p
  /// Of each coordinate the eigenvalue that is none of the state space, see StateCoordinate.
  std::vector<std::optional<double>> idle;

  int size() const { return static_cast<int>(K_w.rows()); }
  bool operator==(const StateCoordinates& other) const;
};

/// How a law fits the frequency response that it was made from.
struct LawFit {
  int samples = 0, poles = 0;
  double error = 0.0;             ///< root mean square, relative
  double largest = 0.0;           ///< of a sample, relative
  double largest_at = 0.0;        ///< its frequency [rad/s]
  int mirrored = 0;               ///< poles that were made stable
  double least_damping = 0.0;     ///< least part of the stiffness that damps, of its size; < 0: it
                                  ///< gives energy
  double least_damping_at = 0.0;  ///< the frequency where it does so [rad/s]
  bool operator==(const LawFit&) const = default;
};

/// A signal of a law that saturates: what it has beyond +-limit has no effect.
///
///   p = over_states z + over_displacements u + over_rates u'
///   e = what p has beyond its limit,   z' = ... - to_states e,   f = ... - to_forces e
struct SignalLimit {
  std::string name;        ///< "current of axis 1"
  double limit = 0.0;      ///< of |p|, in its unit
  Vec over_states;         ///< n
  Vec over_displacements;  ///< p
  Vec over_rates;          ///< p
  Vec to_states;           ///< n
  Vec to_forces;           ///< m
  double force = 1.0;      ///< that e would make at rest, by which it is told [N per its unit]

  bool operator==(const SignalLimit& other) const;
};

/// A support between stations, bodies or the ground. Its force needs no displacement of the same
/// place: a controller reads the motion at its sensors, and acts elsewhere.
struct Support {
  std::string name;
  std::vector<InterfaceCoordinate> sees;     ///< whose displacements are u
  std::vector<InterfaceCoordinate> acts_on;  ///< on which -f acts
  StateSpace law;
  /// The law in coordinates that are known to keep its symmetry; nothing: its states are paired.
  std::optional<StateCoordinates> coordinates{};
  /// Of a magnetic bearing: so many of the displacements, the first ones, are signals of sensors.
  int sensors = 0;
  std::optional<LawFit> fit{};  ///< nothing: the law is given
  std::vector<SignalLimit> limits{};
  Where where{};
  bool operator==(const Support&) const = default;
};

/// Stations that a support holds or sees, each once.
std::vector<const Station*> places_of(const Support& support);

}  // namespace whirl::inline fe
