#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "libcontact/friction.hpp"
#include "libcontact/laws.hpp"
#include "libfe/parts/station.hpp"

namespace whirl::inline contact {

/// Which limit of which support of the structure a contact stands for.
struct LimitOfSupport {
  std::size_t support = 0, limit = 0;
  bool operator==(const LimitOfSupport&) const = default;
};

/// A place where the rotor may touch a stator, as the model file says it; or an element of the
/// equations that is one of them to the solvers: a rolling bearing, or a limit of a signal.
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
  std::optional<LimitOfSupport> limits{};
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

/// Whether a contact is a rolling bearing, which carries the rotor, and not one with a stator.
inline bool is_rolling_bearing(const Contact& contact) {
  return std::holds_alternative<geometry::RollingElements>(contact.geometry);
}

/// Whether a contact is one between the rotor and a stator: no rolling bearing, no limit.
inline bool is_with_stator(const Contact& contact) {
  return !is_rolling_bearing(contact) && !contact.limits;
}

/// The rolling bearings among contacts, or the contacts with stators among them.
inline std::vector<Contact> rolling_bearings(const std::vector<Contact>& all) {
  std::vector<Contact> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), is_rolling_bearing);
  return found;
}
inline std::vector<Contact> stator_contacts(const std::vector<Contact>& all) {
  std::vector<Contact> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), is_with_stator);
  return found;
}

}  // namespace whirl::inline contact
