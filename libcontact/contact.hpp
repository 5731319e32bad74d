#pragma once

#include <string>
#include <tuple>

#include "libcontact/friction.hpp"
#include "libcontact/laws.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline contact {

/// A place where the rotor may touch a stator, as the model file says it.
struct Contact {
  std::string name;
  Station at;
  Station against;  ///< the ground or a body
  /// Radius of a ring, half the short axis of an ellipse, distance to a stop or face [m].
  double clearance = 0.0;
  Vec2 offset = Vec2::Zero();  ///< middle of the clearance [m]
  Friction friction;
  AnyContactLaw<> law;
  AnyGeometry geometry{};  ///< of a law that has none of its own
  Where where{};

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{required("clearance", &Contact::clearance, "m", positive,
                               "radius of the clearance circle")};
  }
};

inline AnyGeometry geometry_of(const Contact& contact) {
  return own_geometry(contact.law).value_or(contact.geometry);
}

}  // namespace whirl::inline contact
