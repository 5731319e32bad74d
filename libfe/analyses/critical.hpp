#pragma once
/// Critical speeds: speeds at which an excitation of a given order meets a natural frequency.

#include <limits>
#include <string>
#include <vector>

#include "libbase/structs/column.hpp"
#include "libfe/analyses/modes.hpp"

namespace whirl::inline fe {

struct CriticalOptions {
  int count = 6;           ///< lowest ones wanted
  double order = 1.0;      ///< excitation frequency over spin speed; 1: unbalance
  double start = 0.0;      ///< speed whose stiffness the search begins with [rad/s]
  bool has_damped = true;  ///< look for the damped ones too, which takes most of the time
  std::string by{};        ///< further shaft that excites, by its speed; empty: the first, by order
};

/// A critical speed of the undamped system, and of the damped one where it has one nearby.
struct Critical {
  double speed = 0.0;         ///< of the first shaft, undamped [rad/s]
  double damped_speed = 0.0;  ///< Im lambda(Omega) = order * Omega [rad/s]; NaN if there is none
  Whirl whirl = Whirl::planar;
  CVec shape;        ///< coordinates of the system
  std::string note;  ///< why there is no damped speed; empty if there is one
  double damping_ratio = std::numeric_limits<double>::quiet_NaN();  ///< at the damped speed
  double order = 1.0;           ///< of the excitation; NaN: a shaft of a speed of its own excites
  std::string shaft = "shaft";  ///< that excites; "shaft" is the first one

  bool is_heavily_damped() const { return damping_ratio > heavy_damping; }
  /// "1x", "speed of hp".
  std::string excitation() const;

  static constexpr auto columns() {
    using enum Written;
    return ColumnList{
        column("speed", &Critical::speed, "rad/s", "undamped critical speed"),
        column("damped_speed", &Critical::damped_speed, "rad/s", "damped critical speed"),
        column("damping_ratio", &Critical::damping_ratio, "",
               "damping ratio at the damped critical speed")
            .maybe(),
        column("whirl", &Critical::whirl, "", "sense of whirl"),
        column("excitation", &Critical::excitation, "", "order of the excitation, or whose speed")
            .only(in_json),
        column("shaft", &Critical::shaft, "", "shaft that excites; \"shaft\": the first one")
            .maybe(),
        column("heavily_damped", &Critical::is_heavily_damped, "", "damping ratio above 0.5")
            .only(in_json),
        column("note", &Critical::note, "", "why there is no damped speed").only(in_json).maybe()};
  }
};

/// Critical speeds of one order of the first shaft, and by further shafts, as a result.
struct CriticalSpeeds {
  std::vector<Critical> criticals;
  double order = 1.0;

  static constexpr std::string_view group = "/critical";
  static constexpr auto columns() {
    constexpr double most_order = 1e6;
    return ColumnList{rows(&CriticalSpeeds::criticals, "criticals"),
                      column("order", &CriticalSpeeds::order, "", "excitation frequency over speed")
                          .within(valid::from_to(valid::positive.least, most_order))
                          .only(Written::in_file)};
  }
};

/// Critical speeds directly from the pencil with omega = order * Omega.
///
///   K q = omega^2 (M - i G / order) q
///
/// Forward and backward ones come together; a disk with Ip > Id has no forward tilting one. Where
/// stiffness depends on speed, each is iterated until it is a critical speed of the stiffness at
/// itself. The damped ones start from these and follow Im lambda(Omega) = order * Omega; where one
/// cannot be found, its note says why, and the others come.
///
/// Where shafts have speeds of their own, G is not in proportion to Omega: see excited_modes.hpp.
/// By a further shaft they are the speeds Omega of the first one at which its own speed is a
/// natural frequency. Where its own speed does not change any more, as a constant one, those are
/// told that lie below the highest one by the first shaft.
///
/// @throws ModelError      if the rotor is free, or there is no further shaft of the name
/// @throws NumericalError  if the eigensolver of the undamped pencil fails
/// @source [Friswell2010], sec. 6.5
std::vector<Critical> critical_speeds(const Assembler& assembler, const CriticalOptions& options);

/// The same by the first shaft, then by each further one whose speed has another size. An order
/// other than one is of the first shaft alone.
std::vector<Critical> critical_speeds_by_all(const Assembler& assembler,
                                             const CriticalOptions& options);

/// Those of one system without damping, the lowest ones in ascending order; damped_speed is NaN.
/// @throws NumericalError  if the eigensolver fails, or the stiffness is not positive definite
std::vector<Critical> undamped_criticals(const System& system, const CriticalOptions& options);

}  // namespace whirl::inline fe
