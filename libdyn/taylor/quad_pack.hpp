#pragma once
/// A pack of one lane in quadruple precision: what the engine uses of Pack, over __float128.

#include <quadmath.h>

#include <cstdint>
#include <numbers>

#include "libdyn/taylor/pack-inl.h"

namespace whirl::inline dyn {
namespace HWY_NAMESPACE {  // that of the templates, which it specializes

/// One number of 113 bits.
struct QuadPack {
  /// Yes or no.
  struct Mask {
    bool m;
  };
  using Number = __float128;
  static constexpr int blocks = 1;
  static constexpr bool is_double = false;
  /// M_PIq in parts that are doubles: its literal is no standard C++.
  static constexpr Number pi =
      Number(std::numbers::pi) + 1.2246467991473532e-16 - 2.9947698097183397e-33;
  static constexpr Number rounding = 1e-33;  ///< what counts as nothing, relative
  static constexpr int most_terms = 34;      ///< of a series: order 30 and those that come with it

  static int lanes() { return 1; }

  Number x;

  QuadPack() = default;
  QuadPack(Number value) : x(value) {}
};

inline QuadPack operator-(const QuadPack& a) {
  return -a.x;
}
inline QuadPack operator+(const QuadPack& a, const QuadPack& b) {
  return a.x + b.x;
}
inline QuadPack operator-(const QuadPack& a, const QuadPack& b) {
  return a.x - b.x;
}
inline QuadPack operator*(const QuadPack& a, const QuadPack& b) {
  return a.x * b.x;
}
inline QuadPack operator/(const QuadPack& a, const QuadPack& b) {
  return a.x / b.x;
}
inline QuadPack min(const QuadPack& a, const QuadPack& b) {
  return a.x < b.x ? a : b;
}
inline QuadPack max(const QuadPack& a, const QuadPack& b) {
  return a.x > b.x ? a : b;
}
/// a b + c, rounded twice: no processor fuses these, and fmaq is slow.
inline QuadPack fma(const QuadPack& a, const QuadPack& b, const QuadPack& c) {
  return a.x * b.x + c.x;
}
/// c - a b.
inline QuadPack fnma(const QuadPack& a, const QuadPack& b, const QuadPack& c) {
  return c.x - a.x * b.x;
}

inline QuadPack abs(const QuadPack& a) {
  return fabsq(a.x);
}
inline QuadPack sqrt(const QuadPack& a) {
  return sqrtq(a.x);
}
inline QuadPack sinh(const QuadPack& a) {
  return sinhq(a.x);
}
inline QuadPack asinh(const QuadPack& a) {
  return asinhq(a.x);
}
inline QuadPack tanh(const QuadPack& a) {
  return tanhq(a.x);
}
inline QuadPack arc_cotangent(const QuadPack& a) {
  return atan2q(1.0, a.x);
}
inline QuadPack log(const QuadPack& a) {
  return logq(a.x);
}
inline QuadPack exp(const QuadPack& a) {
  return expq(a.x);
}
inline QuadPack ninth_root(const QuadPack& a) {
  return powq(a.x, QuadPack::Number(1.0) / 9.0);
}
inline void sin_cos(const QuadPack& a, QuadPack& sine, QuadPack& cosine) {
  sincosq(a.x, &sine.x, &cosine.x);
}
inline QuadPack rough_log2(const QuadPack& a) {
  return log2q(a.x);
}
inline QuadPack rough_exp2(const QuadPack& a) {
  return exp2q(a.x);
}

inline QuadPack::Mask less(const QuadPack& a, const QuadPack& b) {
  return {a.x < b.x};
}
inline QuadPack::Mask less_equal(const QuadPack& a, const QuadPack& b) {
  return {a.x <= b.x};
}
inline QuadPack::Mask both(const QuadPack::Mask& a, const QuadPack::Mask& b) {
  return {a.m && b.m};
}
inline QuadPack::Mask either(const QuadPack::Mask& a, const QuadPack::Mask& b) {
  return {a.m || b.m};
}
inline QuadPack::Mask without(const QuadPack::Mask& a, const QuadPack::Mask& b) {
  return {a.m && !b.m};
}
inline bool any(const QuadPack&, const QuadPack::Mask& a) {
  return a.m;
}
inline uint64_t bits(const QuadPack&, const QuadPack::Mask& a) {
  return a.m ? 1 : 0;
}
template <>
inline QuadPack::Mask mask_of<QuadPack>(uint64_t bits_of) {
  return {(bits_of & 1) != 0};
}
inline QuadPack select(const QuadPack::Mask& m, const QuadPack& yes, const QuadPack& no) {
  return m.m ? yes : no;
}

/// The number, rounded to double.
inline double lane(const QuadPack& a, int) {
  return static_cast<double>(a.x);
}
inline void set_lane(QuadPack& a, int, __float128 value) {
  a.x = value;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
