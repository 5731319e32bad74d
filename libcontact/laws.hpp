#pragma once
/// The list of contact laws.

#include <type_traits>
#include <variant>

#include "libcontact/laws/blade_tip.hpp"
#include "libcontact/laws/face.hpp"
#include "libcontact/laws/hertz.hpp"
#include "libcontact/laws/radial.hpp"

namespace whirl {

template <class R = double>
using AnyContactLaw = std::variant<  //
    Radial<R>,                       //
    Hertz<R>,                        //
    Face<R>,                         //
    BladeTip<R>>;

/// Normal force [N] of any law at a depth [m] and its rate [m/s].
inline double normal_force(const AnyContactLaw<>& law, double depth, double rate) {
  return std::visit([&](const auto& l) { return l.normal(depth, rate); }, law);
}

inline bool is_continuous(const AnyContactLaw<>& law) {
  return std::visit([](const auto& l) { return l.is_continuous(); }, law);
}

inline bool is_analytic(const AnyContactLaw<>& law) {
  return std::visit([](const auto& l) { return std::remove_cvref_t<decltype(l)>::is_analytic; },
                    law);
}

inline Geometry geometry_of(const AnyContactLaw<>& law) {
  return std::visit([](const auto& l) { return std::remove_cvref_t<decltype(l)>::geometry; }, law);
}

/// Whether friction may switch its sign and stick at once, or only smoothly.
inline bool can_stick(Geometry geometry) {
  return geometry == Geometry::ring;
}

}  // namespace whirl
