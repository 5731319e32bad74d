#pragma once

#include <string_view>
#include <tuple>

#include "libbase/field.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// Hertz contact of curved elastic surfaces.
///
///   N = k d^(3/2),   d = depth
///
/// For two spheres, or a ball in a ring, k = (4/3) E* sqrt(R*), with 1/E* the sum of (1 - nu^2) / E
/// and 1/R* that of the curvatures.
///
/// @source [Hertz1882], [Johnson1985]
template <class R = double>
struct Hertz {
  static constexpr std::string_view name = "hertz";
  static constexpr bool is_analytic = false;

  R k{};  ///< contact stiffness [N/m^1.5]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("hertz_stiffness", &Hertz::k, "N/m^1.5", positive, "k in N = k d^1.5")};
  }

  bool is_continuous() const { return true; }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto&) const {
    return k * (d * depth_root(d));
  }
};

}  // namespace whirl::inline contact
