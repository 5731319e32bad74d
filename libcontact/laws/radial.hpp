#pragma once

#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// Linear contact with optional damping.
///
///   N = k d + c d',   d = depth, d' = its rate
///
/// Without damping the force is continuous at d = 0; with it, it starts with c d' and ends where it
/// would begin to pull, before the surfaces part.
///
/// @source Kelvin-Voigt model
template <class R = double>
struct Radial {
  static constexpr std::string_view name = "radial";
  static constexpr bool is_analytic = true;

  R k{};  ///< contact stiffness [N/m]
  R c{};  ///< contact damping [N.s/m]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{required("stiffness", &Radial::k, "N/m", positive, "k in N = k d + c d'"),
                      optional("damping", &Radial::c, "N.s/m", nonnegative,
                               "c in N = k d + c d', never pulling")};
  }

  /// Whether the force vanishes with the depth whatever its rate.
  bool is_continuous() const { return c == R(0.0); }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto& d_rate) const {
    return k * d + c * d_rate;
  }
};

}  // namespace whirl::inline contact
