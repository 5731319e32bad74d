#pragma once
/// Contacts and films with the derivatives of their numbers by a parameter.

#include <array>
#include <optional>
#include <vector>

#include "libcontact/dual_functions.hpp"
#include "libdyn/system/number_slopes.hpp"

namespace whirl::inline dyn {

/// A number with its derivative by one parameter.
using ByParameter = Dual<1>;

/// A contact whose numbers bring their derivatives along.
///
/// Derivatives of the rows U, B, V and B_t are not part of this: the force on a motion that is
/// known where the contact acts does not depend on these rows.
struct SlopedContact {
  ReducedContact contact;
  AnyContactLaw<ByParameter> law;
  std::array<ByParameter, 2> offset;  ///< [m]
  ByParameter clearance;              ///< [m]
  ByParameter rim_speed;              ///< [m/s]
  ByParameter mu;
  ByParameter tolerance;    ///< of a smoothed sign of the slip [m/s]
  ByParameter tip;          ///< radius of a place about the rotor's axis [m]
  ByParameter tip_speed;    ///< speed of that place [m/s]
  ByParameter turning;      ///< speed of what turns [rad/s]
  ByParameter ratio;        ///< of that to the rate of the phase
  ByParameter start, play;  ///< of a rolling element: its angle at time 0 [rad]; [m]
  /// What an element sees of a shape of a race, as RaceShape.
  struct Shape {
    ByParameter height, start, ratio, speed, sharpness;
  };
  std::vector<Shape> shapes;      ///< of the races of rolling elements
  Vec2 turned_normal;             ///< derivative of a stop's direction, else zero
  WallNumbers<ByParameter> wall;  ///< of a wall

  /// Kinematics on a motion.
  /// @param motion  displacement from the rotor's axis at rest, and rates
  ContactGap<ByParameter> gap(const Instant& at, GapMotion<ByParameter> motion) const;
};

/// Contact number i of a system.
SlopedContact sloped_contact(const ContactSystem& system, std::size_t i,
                             const NumberSlopes& slopes);

/// A film whose numbers bring their derivatives along.
struct SlopedFilm {
  std::array<ByParameter, 2> offset;  ///< [m]
  ByParameter inverse;                ///< 1 / clearance [1/m]
  ByParameter inverse_rate;           ///< 1 / (clearance rate) [s/m]
  ByParameter factor;                 ///< of the force [N]
  ByParameter spin;                   ///< as of FilmAtSpeed
  AnyFilmLaw law;

  /// Force on the journal [N]; nothing outside the bearing.
  /// @param u, u_rate  displacement from the bearing [m] and its rate [m/s]
  std::optional<std::array<ByParameter, 2>> force(const std::array<ByParameter, 2>& u,
                                                  const std::array<ByParameter, 2>& u_rate) const;
};

/// Film number i of a system.
SlopedFilm sloped_film(const ContactSystem& system, std::size_t i, const NumberSlopes& slopes);

}  // namespace whirl::inline dyn
