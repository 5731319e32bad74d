#pragma once

#include <tuple>
#include <utility>

#include "libbase/structs/field.hpp"
#include "libcontact/geometry.hpp"
#include "libcontact/law.hpp"

namespace whirl::inline contact::geometry {

/// A circle in a clearance that is an ellipse, as a worn or out-of-round ring has it.
///
/// With u and v along the axes of the ellipse, b the clearance, a = aspect b,
///
///   rho^2 = (u / a)^2 + (v / b)^2,   depth = (rho - 1) / |grad rho|
///
/// which is the distance from the wall but for terms of depth^2 over its radius of curvature; on
/// the wall its slope is the normal.
struct Ellipse {
  static constexpr std::string_view name = "ellipse";
  static constexpr Closing closing = Closing::lateral;
  static constexpr bool rubs_apart = false;
  static constexpr bool may_stick = false;
  static constexpr bool takes_offset = true;
  static constexpr bool turns = false;
  static constexpr bool is_wall = true;

  double angle = 0.0;   ///< of the long axis, from +x to +y [rad]
  double aspect = 1.0;  ///< long axis over the short one

  static constexpr auto fields() {
    using enum Range;
    return std::tuple{
        required("angle", &Ellipse::angle, "rad", any, "of an ellipse's long axis, from +x to +y"),
        required("aspect", &Ellipse::aspect, "", positive,
                 "long axis of an ellipse over its short one, 1 or more")};
  }

  std::optional<WallProblem> problem() const {
    if (aspect >= 1.0) return std::nullopt;
    return WallProblem{"aspect", aspect,
                       "1 or more: angle is that of the long axis, clearance half the short one"};
  }

  int places() const { return 1; }
  Ellipse place(int, const PartSpeeds&) const { return *this; }
  double arm() const { return 1.0; }
  double tip_radius() const { return 0.0; }
  std::optional<double> rim_radius() const { return std::nullopt; }
  std::optional<Vec2> direction() const { return std::nullopt; }
  bool operator==(const Ellipse&) const = default;

  WallNumbers<double> numbers(double clearance) const {
    return {std::cos(angle), std::sin(angle), 1.0 / (aspect * clearance), 1.0 / clearance};
  }

  /// u and v over the half axes.
  template <class T>
  WHIRL_INLINE static auto scaled(const T& x, const T& y, const WallNumbers<T>& of) {
    const auto& [cosine, sine, over_a, over_b] = of;
    return std::pair{(cosine * x + sine * y) * over_a, (cosine * y - sine * x) * over_b};
  }
  template <class T>
  WHIRL_INLINE static auto square(const T& x, const T& y, const WallNumbers<T>& of) {
    const auto at = scaled(x, y, of);
    return at.first * at.first + at.second * at.second;
  }
  template <class T>
  WHIRL_INLINE static WallGap<T> wall(const T& x, const T& y, const WallNumbers<T>& of) {
    using std::sqrt;
    const auto& [cosine, sine, a, b] = of;
    const auto at = scaled(x, y, of);
    const auto &u = at.first, &v = at.second;
    const auto square = u * u + v * v, rho = sqrt(square);
    const auto gu = u * a, gv = v * b;  // rho grad rho
    const auto g = sqrt(gu * gu + gv * gv);
    const auto depth = (square - rho) / g;
    const auto outward = 2.0 - rho / square, bend = depth / g;
    const auto along = gu * (outward - bend * (a * a)) / g,
               across = gv * (outward - bend * (b * b)) / g;
    return {depth, cosine * along - sine * across, sine * along + cosine * across};
  }

  template <class T>
  ContactGap<T> gap(const ContactSpace& space, const Instant&, const GapMotion<T>& m) const {
    WallNumbers<T> of;
    std::ranges::copy(numbers(space.clearance), of.begin());
    return gap_to_wall<Ellipse>(m, of, T(space.clearance), T(space.rim_speed));
  }
  double beyond(const ContactGap<double>& gap, const ContactSpace& space) const {
    return (gap.r * gap.r) / (space.clearance * space.clearance) - 1.0;
  }
  std::optional<Polynomial> beyond(const PathPowers& x, const PathPowers& y) const {
    const Vec u = (std::cos(angle) * x + std::sin(angle) * y) / aspect,
              v = std::cos(angle) * y - std::sin(angle) * x;
    return beyond_unit_circle(u, v);
  }
};

}  // namespace whirl::inline contact::geometry
