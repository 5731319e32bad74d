#pragma once
/// The list of contact geometries, and what is asked of any of them.

#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include "libcontact/geometry/blade_row.hpp"
#include "libcontact/geometry/ellipse.hpp"
#include "libcontact/geometry/face.hpp"
#include "libcontact/geometry/ring.hpp"
#include "libcontact/geometry/rolling_elements.hpp"
#include "libcontact/geometry/saturation.hpp"
#include "libcontact/geometry/stop.hpp"

namespace whirl::inline contact {

using AnyGeometry = std::variant<  //
    geometry::Ring,                //
    geometry::Face,                //
    geometry::BladeRow,            //
    geometry::Stop,                //
    geometry::Ellipse,             //
    geometry::RollingElements,     //
    geometry::Saturation>;

inline std::string_view name_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.name; }, any);
}
inline Closing closing_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.closing; }, any);
}
inline bool rubs_apart(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.rubs_apart; }, any);
}
/// Whether the depth follows from rates of the motion, too.
inline bool reads_rates(const AnyGeometry& any) {
  return std::visit(
      [](const auto& g) {
        return requires {
          g.reads_rates;
        };
      },
      any);
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
inline bool is_wall(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.is_wall; }, any);
}
inline int places_of(const AnyGeometry& any) {
  return std::visit([](const auto& g) { return g.places(); }, any);
}
inline AnyGeometry place_of(const AnyGeometry& any, int i, const PartSpeeds& speeds) {
  return std::visit([&](const auto& g) { return AnyGeometry(g.place(i, speeds)); }, any);
}
/// The elements of a rolling bearing; null: it is another geometry.
inline const geometry::RollingElements* rolling_elements(const AnyGeometry& any) {
  return std::get_if<geometry::RollingElements>(&any);
}
/// How far the rotor may move from the middle before a place can touch [m]; at most zero where one
/// always may.
inline double slack_of(const AnyGeometry& any, double clearance) {
  const auto* row = rolling_elements(any);
  return row ? geometry::slack_of(*row) : clearance;
}
/// Speed of a place that turns over the rate of the phase; 0 of what stands.
inline double turning_ratio_of(const AnyGeometry& any) {
  return std::visit(
      [](const auto& g) {
        if constexpr (std::remove_cvref_t<decltype(g)>::turns) return g.ratio;
        return 0.0;
      },
      any);
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

/// What f gives of a geometry that is a wall, or what is said of others.
template <class Result, class F>
Result with_wall(const AnyGeometry& any, const Result& of_others, const F& f) {
  return std::visit(
      [&](const auto& g) -> Result {
        if constexpr (std::remove_cvref_t<decltype(g)>::is_wall) {
          return f(g);
        } else {
          return of_others;
        }
      },
      any);
}
/// Numbers of a wall, zero of other geometries.
inline WallNumbers<double> wall_numbers_of(const AnyGeometry& any, double clearance) {
  return with_wall(any, WallNumbers<double>{},
                   [&](const auto& wall) { return wall.numbers(clearance); });
}

/// How far a place at u from the middle is out: the clearance on the surface, in proportion to u.
inline double distance_of(const AnyGeometry& any, double clearance, const Vec2& u) {
  if (const auto n = direction_of(any)) return n->dot(u);
  if (!is_wall(any)) return u.norm();
  const double square = with_wall(
      any, 0.0, [&](const auto& wall) { return wall.square(u(0), u(1), wall.numbers(clearance)); });
  return clearance * std::sqrt(square);
}
/// How far the surface of a geometry that is met all around is from the middle, in a direction of
/// length one.
inline double reach_of(const AnyGeometry& any, double clearance, const Vec2& along) {
  if (!is_wall(any)) return clearance;
  return clearance * clearance / distance_of(any, clearance, clearance * along);
}

/// Speeds over the rate of the phase, each of which a contact that turns repeats with: its places
/// are alike, so that it does when one is where another was; shapes of a race repeat with the race.
inline std::vector<double> repeating_ratios_of(const AnyGeometry& any) {
  std::vector<double> ratios;
  if (turns(any)) ratios.push_back(places_of(any) * turning_ratio_of(any));
  if (const auto* row = rolling_elements(any)) {
    for (const auto& shape : row->shapes) ratios.push_back(row->ratio - shape.ratio / shape.order);
  }
  return ratios;
}

/// The direction in which a place at u from the middle meets a geometry.
inline Vec2 normal_of(const AnyGeometry& any, double clearance, const Vec2& u) {
  if (const auto n = direction_of(any)) return *n;
  if (!(u.norm() > 0.0)) return Vec2::UnitX();
  return with_wall(any, Vec2(u.normalized()), [&](const auto& wall) {
    const WallGap<double> gap = wall.wall(u(0), u(1), wall.numbers(clearance));
    return Vec2(Vec2(gap.nx, gap.ny).normalized());
  });
}
/// What is wrong with the numbers of a wall, if anything is.
inline std::optional<WallProblem> problem_of(const AnyGeometry& any) {
  return with_wall(any, std::optional<WallProblem>(),
                   [](const auto& wall) { return wall.problem(); });
}

}  // namespace whirl::inline contact
