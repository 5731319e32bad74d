#pragma once

#include <string_view>
#include <tuple>

#include "libbase/structs/field.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact {

/// Contact along a line, as of cylindrical rollers with crowned ends.
///
///   N = k d (d / 1 um)^(1/9),   d = depth
///
/// A force in proportion to d^(10/9); k is the force over the depth at a depth of 1 um.
///
/// @source [Palmgren1959]: measured on rollers in rings; [Harris2006], ch. 6
template <class R = double>
struct Line {
  static constexpr std::string_view name = "line";
  static constexpr bool is_analytic = false;
  static constexpr double least_depth = 1e-11;  ///< its slope rises steeply from the surface on
  static constexpr double of_micrometer = 4.641588833612779;  ///< (1e6)^(1/9)

  R k{};  ///< contact stiffness at 1 um [N/m]

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("line_stiffness", &Line::k, "N/m", positive, "k in N = k d (d / 1 um)^(1/9)")};
  }

  bool is_continuous() const { return true; }

  WHIRL_INLINE constexpr auto normal(const auto& d, const auto&) const {
    return (k * R(of_micrometer)) * (d * depth_ninth_root(d));
  }
};

}  // namespace whirl::inline contact
