#pragma once

#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// Hertz contact of curved elastic surfaces, with optional damping after Hunt and Crossley.
///
///   N = k d^(3/2) (1 + (3/2) alpha d'),   d = depth, d' = its rate
///
/// For two spheres, or a ball in a ring, k = (4/3) E* sqrt(R*), with 1/E* the sum of (1 - nu^2) / E
/// and 1/R* that of the curvatures. A slow impact at v gives back (1 - alpha v) v. The force is
/// continuous at d = 0 with damping, too; it ends before the surfaces part where something else
/// pulls them apart faster than 2 / (3 alpha).
///
/// @source [Hertz1882], [Johnson1985]; [HuntCrossley1975] for the damping
template <class R = double>
struct Hertz {
  static constexpr std::string_view name = "hertz";
  static constexpr bool is_analytic = false;

  R k{};      ///< contact stiffness [N/m^1.5]
  R alpha{};  ///< dissipation factor [s/m]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("hertz_stiffness", &Hertz::k, "N/m^1.5", positive, "k in N = k d^1.5"),
        optional("dissipation", &Hertz::alpha, "s/m", nonnegative,
                 "alpha in N = k d^1.5 (1 + 1.5 alpha d'), never pulling")};
  }

  bool is_continuous() const { return true; }
  bool has_rate_factor() const { return alpha != R(0.0); }
  WHIRL_INLINE constexpr auto rate_factor(const auto& d_rate) const {
    return 1.0 + (R(1.5) * alpha) * d_rate;
  }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto& d_rate) const {
    return (k * rate_factor(d_rate)) * (d * depth_root(d));
  }
};

}  // namespace whirl::inline contact
