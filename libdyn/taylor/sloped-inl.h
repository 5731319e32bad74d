// Numbers with slopes: the engine over them moves a motion together with its derivatives.

#if defined(WHIRL_SLOPED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SLOPED_INL_H
#undef WHIRL_SLOPED_INL_H
#else
#define WHIRL_SLOPED_INL_H
#endif

#include <algorithm>
#include <span>

#include "libdyn/system/system_slope.hpp"
#include "libdyn/taylor/events-inl.h"
#include "libdyn/taylor/law_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// A pack of one lane with its derivatives by eight variables, which fill a register, or two halves
/// of one.
///
///   (a b)' = a' b + a b',   f(a)' = f'(a) a'
///
/// Values are made by the operations of a pack of one lane, so that they are the same bits. Slopes
/// decide nothing: comparisons are of values.
///
/// @source [GriewankWalther2008], ch. 3: the forward mode; ch. 13: it goes through series unchanged
struct alignas(64) Sloped {
  using Value = Pack<1, 1>;
  using D = Value::D;
  using Mask = Value::Mask;
  using Number = double;
  static constexpr int columns = 8;
  using Slopes = Pack<8, columns / static_cast<int>(hn::MaxLanes(hn::CappedTag<double, 8>()))>;
  static constexpr int blocks = 1;
  static constexpr bool is_double = true;
  static constexpr double pi = Value::pi;
  static constexpr double rounding = Value::rounding;
  static constexpr int most_terms = Value::most_terms;

  static int lanes() { return 1; }

  Slopes s;
  Value x;

  Sloped() = default;
  HWY_ATTR Sloped(double value) : s(0.0), x(value) {}
  HWY_ATTR explicit Sloped(const Value& value) : s(0.0), x(value) {}
  HWY_ATTR Sloped(const Value& value, const Slopes& slopes) : s(slopes), x(value) {}
};

/// Where every slope takes a register of its own, as in what all processors have, products are
/// calls: spread over the engine they take longer to compile than all the rest.
#if HWY_TARGET == HWY_SCALAR
#define WHIRL_PRODUCT HWY_ATTR HWY_NOINLINE inline
#else
#define WHIRL_PRODUCT HWY_ATTR inline
#endif

/// A value for every slope.
HWY_ATTR inline Sloped::Slopes wide(const Sloped::Value& x) {
  return Sloped::Slopes(hn::GetLane(x.v[0]));
}

HWY_ATTR inline Sloped operator-(const Sloped& a) {
  return {-a.x, -a.s};
}
WHIRL_PRODUCT Sloped operator+(const Sloped& a, const Sloped& b) {
  return {a.x + b.x, a.s + b.s};
}
HWY_ATTR inline Sloped operator+(const Sloped& a, double b) {
  return {a.x + b, a.s};
}
HWY_ATTR inline Sloped operator+(double a, const Sloped& b) {
  return {a + b.x, b.s};
}
WHIRL_PRODUCT Sloped operator-(const Sloped& a, const Sloped& b) {
  return {a.x - b.x, a.s - b.s};
}
HWY_ATTR inline Sloped operator-(const Sloped& a, double b) {
  return {a.x - b, a.s};
}
HWY_ATTR inline Sloped operator-(double a, const Sloped& b) {
  return {a - b.x, -b.s};
}
WHIRL_PRODUCT Sloped operator*(const Sloped& a, const Sloped& b) {
  return {a.x * b.x, fma(wide(a.x), b.s, wide(b.x) * a.s)};
}
WHIRL_PRODUCT Sloped operator*(const Sloped& a, double b) {
  return {a.x * b, a.s * Sloped::Slopes(b)};
}
HWY_ATTR inline Sloped operator*(double a, const Sloped& b) {
  return {a * b.x, Sloped::Slopes(a) * b.s};
}
WHIRL_PRODUCT Sloped operator/(const Sloped& a, const Sloped& b) {
  const Sloped::Value quotient = a.x / b.x, inverse = Sloped::Value(1.0) / b.x;
  return {quotient, fnma(wide(quotient), b.s, a.s) * wide(inverse)};
}
/// a b + c.
WHIRL_PRODUCT Sloped fma(const Sloped& a, const Sloped& b, const Sloped& c) {
  return {fma(a.x, b.x, c.x), fma(wide(a.x), b.s, fma(wide(b.x), a.s, c.s))};
}
/// c - a b.
WHIRL_PRODUCT Sloped fnma(const Sloped& a, const Sloped& b, const Sloped& c) {
  return {fnma(a.x, b.x, c.x), fnma(wide(a.x), b.s, fnma(wide(b.x), a.s, c.s))};
}

/// The same with a number that has no slopes.
HWY_ATTR inline Sloped operator*(const Sloped::Value& a, const Sloped& b) {
  return {a * b.x, wide(a) * b.s};
}
HWY_ATTR inline Sloped fma(const Sloped::Value& a, const Sloped& b, const Sloped& c) {
  return {fma(a, b.x, c.x), fma(wide(a), b.s, c.s)};
}
HWY_ATTR inline Sloped fnma(const Sloped::Value& a, const Sloped& b, const Sloped& c) {
  return {fnma(a, b.x, c.x), fnma(wide(a), b.s, c.s)};
}

/// Whether all slopes are zero.
HWY_ATTR inline bool is_flat(const Sloped& a) {
  return !any(a.s, less(Sloped::Slopes(0.0), abs(a.s)));
}
HWY_ATTR inline bool are_flat(std::span<const Sloped> all) {
  for (const Sloped& a : all) {
    if (!is_flat(a)) return false;
  }
  return true;
}

/// f(a) of value and f'(a).
HWY_ATTR inline Sloped chained(const Sloped& a, const Sloped::Value& value,
                               const Sloped::Value& by_a) {
  return {value, wide(by_a) * a.s};
}
HWY_ATTR inline Sloped sqrt(const Sloped& a) {
  const Sloped::Value root = sqrt(a.x);
  return chained(a, root, Sloped::Value(0.5) / root);
}
HWY_ATTR inline Sloped tanh(const Sloped& a) {
  const Sloped::Value y = tanh(a.x);
  return chained(a, y, fnma(y, y, Sloped::Value(1.0)));
}
HWY_ATTR inline Sloped log(const Sloped& a) {
  return chained(a, log(a.x), Sloped::Value(1.0) / a.x);
}
HWY_ATTR inline Sloped exp(const Sloped& a) {
  const Sloped::Value y = exp(a.x);
  return chained(a, y, y);
}
HWY_ATTR inline Sloped ninth_root(const Sloped& a) {
  const Sloped::Value y = ninth_root(a.x);
  return chained(a, y, y / (Sloped::Value(9.0) * a.x));
}
HWY_ATTR inline Sloped arc_cotangent(const Sloped& a) {
  return chained(a, arc_cotangent(a.x), Sloped::Value(-1.0) / fma(a.x, a.x, Sloped::Value(1.0)));
}
HWY_ATTR inline void sin_cos(const Sloped& a, Sloped& sine, Sloped& cosine) {
  Sloped::Value s, c;
  sin_cos(a.x, s, c);
  sine = chained(a, s, c);
  cosine = chained(a, c, -s);
}

HWY_ATTR inline Sloped::Mask less(const Sloped& a, const Sloped& b) {
  return less(a.x, b.x);
}
HWY_ATTR inline Sloped::Mask less_equal(const Sloped& a, const Sloped& b) {
  return less_equal(a.x, b.x);
}
HWY_ATTR inline bool any(const Sloped& a, const Sloped::Mask& m) {
  return any(a.x, m);
}
HWY_ATTR inline uint64_t bits(const Sloped& a, const Sloped::Mask& m) {
  return bits(a.x, m);
}
HWY_ATTR inline Sloped select(const Sloped::Mask& m, const Sloped& yes, const Sloped& no) {
  return hn::AllFalse(Sloped::D(), m.m[0]) ? no : yes;
}
HWY_ATTR inline Sloped abs(const Sloped& a) {
  return select(less(a.x, Sloped::Value(0.0)), -a, a);
}
HWY_ATTR inline Sloped min(const Sloped& a, const Sloped& b) {
  return {min(a.x, b.x), select(less(b.x, a.x), b, a).s};
}
/// The larger value with the slopes of a: where b is a bound that keeps a off a singular place, a
/// moves on as it would.
HWY_ATTR inline Sloped max(const Sloped& a, const Sloped& b) {
  return {max(a.x, b.x), a.s};
}
/// For step sizes, which have no slopes.
HWY_ATTR inline Sloped rough_log2(const Sloped& a) {
  return {rough_log2(a.x), Sloped::Slopes(0.0)};
}
HWY_ATTR inline Sloped rough_exp2(const Sloped& a) {
  return {rough_exp2(a.x), Sloped::Slopes(0.0)};
}

/// z + b z^3 = d:  z' = (d' - z^3 b') / (1 + 3 b z^2).
HWY_ATTR inline Sloped indentation(const Sloped& d, const Sloped& bend) {
  const Sloped::Value z = indentation(d.x, bend.x), square = z * z;
  const Sloped::Value inverse =
      Sloped::Value(1.0) / fma(Sloped::Value(3.0) * bend.x, square, Sloped::Value(1.0));
  return {z, fnma(wide(square * z), bend.s, d.s) * wide(inverse)};
}

/// The value. Lane 0 is the number itself, the others are for neighbors of a system (set_lane).
HWY_ATTR inline double lane(const Sloped& a, int) {
  return lane(a.x, 0);
}
/// Lane in which a neighbor says its number, for the slope of a column.
inline int lane_of_neighbor(int column, int neighbor) {
  return 1 + column * static_cast<int>(neighbor_places.size()) + neighbor;
}
/// In lane 0 sets the value, without slopes; in that of a neighbor adds its share of a slope [per
/// step of its parameter].
HWY_ATTR inline void set_lane(Sloped& a, int l, double value) {
  if (l == 0) {
    a = Sloped(value);
    return;
  }
  constexpr int neighbors = static_cast<int>(neighbor_places.size());
  const int column = (l - 1) / neighbors;
  const double weight = neighbor_weights[static_cast<size_t>((l - 1) % neighbors)];
  set_lane(a.s, column, lane(a.s, column) + weight * value);
}

/// By values alone. The slopes of h are then those of the zero,  h' = -g' / (dg / dt).
HWY_ATTR inline Sloped::Mask first_downward_zero(const Sloped* g, int degree, const Sloped& sign,
                                                 const Sloped& scale, Sloped& h,
                                                 const Sloped::Mask& active,
                                                 const Sloped::Mask& surface) {
  Sloped::Value values[2 * Sloped::most_terms];
  for (int k = 0; k <= degree; ++k) values[k] = g[k].x;
  const auto fell =
      first_downward_zero<Sloped::Value>(values, degree, sign.x, scale.x, h.x, active, surface);
  if (any(h, fell)) {
    Sloped value, rate;
    horner(g, degree, Sloped(h.x, Sloped::Slopes(0.0)), value, rate);
    h.s = -(value.s * wide(Sloped::Value(1.0) / rate.x));
  }
  return fell;
}

#undef WHIRL_PRODUCT

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
