#pragma once
/// The list of contact laws.

#include <optional>
#include <type_traits>
#include <variant>

#include "libcontact/geometries.hpp"
#include "libcontact/laws/blade_tip.hpp"
#include "libcontact/laws/face.hpp"
#include "libcontact/laws/hertz.hpp"
#include "libcontact/laws/line.hpp"
#include "libcontact/laws/radial.hpp"

namespace whirl::inline contact {

template <class R = double>
using AnyContactLaw = std::variant<  //
    Radial<R>,                       //
    Hertz<R>,                        //
    Line<R>,                         //
    Face<R>,                         //
    BladeTip<R>>;

/// Normal force [N] of any law at a depth [m] and its rate [m/s].
inline double normal_force(const AnyContactLaw<>& law, double depth, double rate) {
  return std::visit([&](const auto& l) { return l.normal(depth, rate); }, law);
}

inline bool is_continuous(const AnyContactLaw<>& law) {
  return std::visit([](const auto& l) { return l.is_continuous(); }, law);
}

/// The factor that a rate [m/s] gives a force which vanishes with the depth, below zero where it
/// would pull; nothing of a law that is not damped like this.
inline std::optional<double> rate_factor(const AnyContactLaw<>& law, double rate) {
  return std::visit(
      [&](const auto& l) -> std::optional<double> {
        if constexpr (requires { l.rate_factor(rate); }) {
          if (l.has_rate_factor()) return l.rate_factor(rate);
        }
        return std::nullopt;
      },
      law);
}

/// Whether the force depends on the rate, so that it may vanish before the depth does.
inline bool is_damped(const AnyContactLaw<>& law) {
  return !is_continuous(law) || rate_factor(law, 0.0).has_value();
}

inline bool is_analytic(const AnyContactLaw<>& law) {
  return std::visit([](const auto& l) { return std::remove_cvref_t<decltype(l)>::is_analytic; },
                    law);
}

/// The depth over the clearance at which the series of a law without one at the surface begins.
inline double least_depth(const AnyContactLaw<>& law) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.least_depth; }) return l.least_depth;
        return 1e-8;
      },
      law);
}

/// Whether a law is for a geometry of its own.
template <class Law>
constexpr bool has_own_geometry = requires(const Law& law) {
  law.own_geometry();
};
/// The geometry that a law is for; nothing: any that laws share.
inline std::optional<AnyGeometry> own_geometry(const AnyContactLaw<>& law) {
  return std::visit(
      [](const auto& l) -> std::optional<AnyGeometry> {
        if constexpr (has_own_geometry<std::remove_cvref_t<decltype(l)>>) {
          return l.own_geometry();
        } else {
          return std::nullopt;
        }
      },
      law);
}

}  // namespace whirl::inline contact
