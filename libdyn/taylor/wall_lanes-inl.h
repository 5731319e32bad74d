// Walls that are no circles, in all lanes: their gap runs on tapes.

#if defined(WHIRL_WALL_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_WALL_LANES_INL_H
#undef WHIRL_WALL_LANES_INL_H
#else
#define WHIRL_WALL_LANES_INL_H
#endif

#include <array>
#include <utility>

#include "libdyn/system/contact_system.hpp"
#include "libdyn/taylor/law_lanes-inl.h"
#include "libdyn/taylor/pattern.hpp"
#include "libdyn/taylor/series_tape-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// The series of a wall along a motion d from its middle. Away from the wall only its square() is
/// asked for, which is smooth everywhere; beyond it also depth and normal, which are not smooth in
/// the middle: there lanes that are not asked are given a place on the wall.
template <class P>
struct WallLanes {
  using Number = typename P::Number;

  const AnyGeometry& geometry;
  WallNumbers<P> numbers;
  P harmless_x{1.0}, harmless_y{0.0};  // a place on the wall
  SeriesTape<P> apart, beyond;
  Recorded<P> square, depth, nx, ny;
  std::vector<Recorded<P>> slopes_of_nx, slopes_of_ny;  // by x and y, if asked for

  /// @param terms  coefficients of all series
  WallLanes(const AnyGeometry& of, int terms, bool has_slopes)
      : geometry(of), apart(terms), beyond(terms) {
    numbers.fill(P(1.0));
    with_wall(of, 0, [&](const auto& wall) {
      const auto [x, y, shape] = inputs_of(apart);
      square = wall.square(x, y, shape);
      const auto [u, v, same_shape] = inputs_of(beyond);
      const WallGap<Recorded<P>> gap = wall.wall(u, v, same_shape);
      depth = gap.depth;
      nx = gap.nx;
      ny = gap.ny;
      return 0;
    });
    if (!has_slopes) return;
    slopes_of_nx = beyond.gradient(nx);
    slopes_of_ny = beyond.gradient(ny);
  }
  // what is recorded points to the tapes
  WallLanes(const WallLanes&) = delete;
  WallLanes& operator=(const WallLanes&) = delete;

  HWY_ATTR void load(const ReducedContact& from, int l) {
    const WallNumbers<double> of = wall_numbers_of(from.geometry, from.clearance);
    for (size_t i = 0; i < of.size(); ++i) set_lane(numbers[i], l, of[i]);
    set_lane(harmless_x, l, reach_of(from.geometry, from.clearance, Vec2::UnitX()));
  }

  /// Coefficient k of the square.
  HWY_ATTR P square_at(int k, const P& x, const P& y) {
    const auto inputs = inputs_at(k, x, y);
    apart.at(k, inputs.data());
    return apart.series(square)[k];
  }
  /// Coefficient k of depth and normal in lanes that are asked.
  HWY_ATTR void move_beyond(int k, const P& x, const P& y, const typename P::Mask& asked) {
    const auto inputs = inputs_at(k, select(asked, x, k == 0 ? harmless_x : P(0.0)),
                                  select(asked, y, k == 0 ? harmless_y : P(0.0)));
    beyond.at(k, inputs.data());
  }

  /// The square at one place.
  HWY_ATTR P square_of(const P& x, const P& y) const {
    return with_alternative(geometry, [&](const auto& wall) HWY_ATTR -> P {
      if constexpr (std::remove_cvref_t<decltype(wall)>::is_wall) {
        return wall.square(x, y, numbers);
      } else {
        return P(0.0);
      }
    });
  }
  /// Depth and normal at one place, which is beside the wall.
  HWY_ATTR WallGap<P> at(const P& x, const P& y) const {
    return with_alternative(geometry, [&](const auto& wall) HWY_ATTR -> WallGap<P> {
      if constexpr (std::remove_cvref_t<decltype(wall)>::is_wall) {
        return wall.wall(x, y, numbers);
      } else {
        return {P(0.0), P(0.0), P(0.0)};
      }
    });
  }

 private:
  struct Inputs {
    Recorded<P> x, y;
    WallNumbers<Recorded<P>> shape;
  };
  static Inputs inputs_of(SeriesTape<P>& tape) {
    const auto x = tape.input(), y = tape.input();
    Inputs inputs{x, y, {}};
    for (Recorded<P>& number : inputs.shape) number = tape.input();
    return inputs;
  }
  HWY_ATTR std::array<P, 6> inputs_at(int k, const P& x, const P& y) const {
    const P none(0.0);
    if (k > 0) return {x, y, none, none, none, none};
    return {x, y, numbers[0], numbers[1], numbers[2], numbers[3]};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
