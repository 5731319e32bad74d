#pragma once
/// The list of contact geometries, and what is asked of any of them.

#include <variant>

#include "libcontact/geometry/blade_row.hpp"
#include "libcontact/geometry/face.hpp"
#include "libcontact/geometry/ring.hpp"
#include "libcontact/geometry/stop.hpp"

namespace whirl::inline contact {

using AnyGeometry = std::variant<  //
    geometry::Ring,                //
    geometry::Face,                //
    geometry::BladeRow,            //
    geometry::Stop>;

inline std::string_view name_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.name; }, any);
}
inline Closing closing_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.closing; }, any);
}
inline bool rubs_apart(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.rubs_apart; }, any);
}
inline bool may_stick(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.may_stick; }, any);
}
inline bool takes_offset(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.takes_offset; }, any);
}
inline bool turns(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.turns; }, any);
}
inline int places_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.places(); }, any);
}
inline AnyGeometry place_of(const AnyGeometry& any, int i, double Omega) {
  return std::visit([&](const auto& g) { return AnyGeometry(g.place(i, Omega)); }, any);
}
inline double arm_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.arm(); }, any);
}
inline double tip_radius_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.tip_radius(); }, any);
}
inline std::optional<double> rim_radius_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.rim_radius(); }, any);
}
inline std::optional<Vec2> direction_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.direction(); }, any);
}
/// Projects the closing motion on the direction in which the stator is met, if there is one.
inline Mat2 projection_of(const AnyGeometry& any) {
  const auto n = direction_of(any);
  return n ? Mat2(*n * n->transpose()) : Mat2::Identity();
}

}  // namespace whirl::inline contact
