// Packs: several doubles that are computed with at once. One set of definitions per instruction
// set; included again and again by Highway (see batch.cpp), hence the unusual guard.

#if defined(WHIRL_PACK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_PACK_INL_H
#undef WHIRL_PACK_INL_H
#else
#define WHIRL_PACK_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cstring>
#include <numbers>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// B registers of up to L doubles each, with the arithmetic of one number in every lane.
///
/// No operation mixes lanes: what a lane computes does not depend on its neighbors, nor on B and L.
///
/// The alignment is written out: where code without this instruction set (std::vector) asks for it,
/// g++ would answer with less.
template <size_t L, int B>
struct alignas(8 * L) alignas(hn::Vec<hn::CappedTag<double, L>>) Pack {
  using D = hn::CappedTag<double, L>;
  using Register = hn::Vec<D>;
  using MaskRegister = hn::Mask<D>;
  static constexpr int blocks = B;

  using Number = double;  ///< of a lane
  static constexpr bool is_double = true;
  static constexpr double pi = std::numbers::pi;
  static constexpr double rounding = 1e-15;  ///< what counts as nothing, relative
  static constexpr int most_terms = 27;      ///< of a series: order 20 and those that come with it

  /// Yes or no in every lane.
  struct Mask {
    MaskRegister m[B];
  };

  static int lanes() { return static_cast<int>(B * hn::Lanes(D())); }

  Register v[B];

  Pack() = default;
  // register by register: g++ 12 would copy halves of registers through the stack
  HWY_ATTR Pack(const Pack& other) {
    for (int b = 0; b < B; ++b) v[b] = other.v[b];
  }
  HWY_ATTR Pack& operator=(const Pack& other) {
    for (int b = 0; b < B; ++b) v[b] = other.v[b];
    return *this;
  }
  HWY_ATTR Pack(double x) {
    for (int b = 0; b < B; ++b) v[b] = hn::Set(D(), x);
  }
};

/// Whether numbers bring their slopes along (sloped-inl.h).
template <class P>
constexpr bool carries_slopes = requires {
  typename P::Slopes;
};

/// A number without the slopes that it may carry.
template <class P>
struct Plain {
  using type = P;
};
template <class P>
requires carries_slopes<P>
struct Plain<P> {
  using type = typename P::Value;
};
template <class P>
using PlainOf = typename Plain<P>::type;

/// A number itself, as a V that is its type or that without slopes.
template <class V, class P>
HWY_ATTR inline auto& as(P& x) {
  if constexpr (std::is_same_v<V, std::remove_const_t<P>>) {
    return x;
  } else {
    return x.x;
  }
}

#define WHIRL_UNARY(name, expression)                    \
  template <size_t L, int B>                             \
  HWY_ATTR inline Pack<L, B> name(const Pack<L, B>& x) { \
    Pack<L, B> result;                                   \
    for (int b = 0; b < B; ++b) {                        \
      const auto a = x.v[b];                             \
      result.v[b] = expression;                          \
    }                                                    \
    return result;                                       \
  }
#define WHIRL_BINARY(name, expression)                                        \
  template <size_t L, int B>                                                  \
  HWY_ATTR inline Pack<L, B> name(const Pack<L, B>& x, const Pack<L, B>& y) { \
    Pack<L, B> result;                                                        \
    for (int b = 0; b < B; ++b) {                                             \
      const auto a = x.v[b];                                                  \
      const auto c = y.v[b];                                                  \
      result.v[b] = expression;                                               \
    }                                                                         \
    return result;                                                            \
  }                                                                           \
  template <size_t L, int B>                                                  \
  HWY_ATTR inline Pack<L, B> name(const Pack<L, B>& x, double y) {            \
    return name(x, Pack<L, B>(y));                                            \
  }                                                                           \
  template <size_t L, int B>                                                  \
  HWY_ATTR inline Pack<L, B> name(double x, const Pack<L, B>& y) {            \
    return name(Pack<L, B>(x), y);                                            \
  }

WHIRL_UNARY(operator-, hn::Neg(a))
WHIRL_UNARY(abs, hn::Abs(a))
WHIRL_UNARY(sqrt, hn::Sqrt(a))
WHIRL_UNARY(sinh, hn::Sinh(typename Pack<L, B>::D(), a))
WHIRL_UNARY(asinh, hn::Asinh(typename Pack<L, B>::D(), a))
WHIRL_UNARY(tanh, hn::Tanh(typename Pack<L, B>::D(), a))
WHIRL_UNARY(log, hn::Log(typename Pack<L, B>::D(), a))
WHIRL_UNARY(exp, hn::Exp(typename Pack<L, B>::D(), a))
WHIRL_BINARY(operator+, hn::Add(a, c))
WHIRL_BINARY(operator-, hn::Sub(a, c))
WHIRL_BINARY(operator*, hn::Mul(a, c))
WHIRL_BINARY(operator/, hn::Div(a, c))
WHIRL_BINARY(min, hn::Min(a, c))
WHIRL_BINARY(max, hn::Max(a, c))
#undef WHIRL_UNARY
#undef WHIRL_BINARY

/// a b + c, rounded once where the instruction set can.
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> fma(const Pack<L, B>& a, const Pack<L, B>& b, const Pack<L, B>& c) {
  Pack<L, B> r;
  for (int i = 0; i < B; ++i) r.v[i] = hn::MulAdd(a.v[i], b.v[i], c.v[i]);
  return r;
}
/// c - a b.
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> fnma(const Pack<L, B>& a, const Pack<L, B>& b, const Pack<L, B>& c) {
  Pack<L, B> r;
  for (int i = 0; i < B; ++i) r.v[i] = hn::NegMulAdd(a.v[i], b.v[i], c.v[i]);
  return r;
}

/// The angle from 0 to pi whose cotangent is x; exact to rounding where x is large.
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> arc_cotangent(const Pack<L, B>& x) {
  typename Pack<L, B>::D d;
  Pack<L, B> r;
  for (int b = 0; b < B; ++b) {
    const auto size = hn::Max(hn::Abs(x.v[b]), hn::Set(d, 1e-300));
    const auto angle = hn::Atan(d, hn::Div(hn::Set(d, 1.0), size));
    const auto obtuse = hn::Sub(hn::Set(d, std::numbers::pi), angle);
    r.v[b] = hn::IfThenElse(hn::Lt(x.v[b], hn::Zero(d)), obtuse, angle);
  }
  return r;
}

#define WHIRL_COMPARE(name, function)                                                        \
  template <size_t L, int B>                                                                 \
  HWY_ATTR inline typename Pack<L, B>::Mask name(const Pack<L, B>& x, const Pack<L, B>& y) { \
    typename Pack<L, B>::Mask m;                                                             \
    for (int b = 0; b < B; ++b) m.m[b] = hn::function(x.v[b], y.v[b]);                       \
    return m;                                                                                \
  }
WHIRL_COMPARE(less, Lt)
WHIRL_COMPARE(less_equal, Le)
#undef WHIRL_COMPARE

#define WHIRL_MASK(name, expression)                                      \
  template <class M>                                                      \
  HWY_ATTR inline M name(const M& x, const M& y) {                        \
    M result;                                                             \
    for (size_t b = 0; b < sizeof(result.m) / sizeof(result.m[0]); ++b) { \
      const auto a = x.m[b];                                              \
      const auto c = y.m[b];                                              \
      result.m[b] = expression;                                           \
    }                                                                     \
    return result;                                                        \
  }
WHIRL_MASK(both, hn::And(a, c))
WHIRL_MASK(either, hn::Or(a, c))
WHIRL_MASK(without, hn::AndNot(c, a))  ///< x and not y
#undef WHIRL_MASK

/// Whether any lane of a mask says yes; the pack only tells the type.
template <size_t L, int B>
HWY_ATTR inline bool any(const Pack<L, B>&, const typename Pack<L, B>::Mask& m) {
  auto all = m.m[0];
  for (int b = 1; b < B; ++b) all = hn::Or(all, m.m[b]);
  return !hn::AllFalse(typename Pack<L, B>::D(), all);
}

/// Numbers of the lanes of a pack as bits, lane 0 lowest, and back: for bookkeeping between steps.
template <size_t L, int B>
HWY_ATTR inline uint64_t bits(const Pack<L, B>&, const typename Pack<L, B>::Mask& m) {
  typename Pack<L, B>::D d;
  uint64_t all = 0;
  const size_t lanes = hn::Lanes(d);
  for (int b = 0; b < B; ++b) {
    uint8_t bytes[8] = {0};
    hn::StoreMaskBits(d, m.m[b], bytes);
    all |= (static_cast<uint64_t>(bytes[0]) & ((1u << lanes) - 1u))
           << (lanes * static_cast<size_t>(b));
  }
  return all;
}

/// The mask whose lanes are given as bits.
template <class P>
HWY_ATTR inline typename P::Mask mask_of(uint64_t all) {
  typename P::D d;
  typename P::Mask m;
  const size_t lanes = hn::Lanes(d);
  for (int b = 0; b < P::blocks; ++b) {
    const uint8_t byte[8] = {static_cast<uint8_t>(all >> (lanes * static_cast<size_t>(b)))};
    m.m[b] = hn::LoadMaskBits(d, byte);
  }
  return m;
}

template <size_t L, int B>
HWY_ATTR inline Pack<L, B> select(const typename Pack<L, B>::Mask& m, const Pack<L, B>& yes,
                                  const Pack<L, B>& no) {
  Pack<L, B> r;
  for (int b = 0; b < B; ++b) r.v[b] = hn::IfThenElse(m.m[b], yes.v[b], no.v[b]);
  return r;
}

/// Sine and cosine, |x| <= 39000.
template <size_t L, int B>
HWY_ATTR inline void sin_cos(const Pack<L, B>& x, Pack<L, B>& sine, Pack<L, B>& cosine) {
  typename Pack<L, B>::D d;
  for (int b = 0; b < B; ++b) {
    sine.v[b] = hn::Sin(d, x.v[b]);
    cosine.v[b] = hn::Cos(d, x.v[b]);
  }
}

/// Binary logarithm to 1e-3, of positive normal numbers: for step sizes.
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> rough_log2(const Pack<L, B>& x) {
  using P = Pack<L, B>;
  typename P::D d;
  const hn::RebindToSigned<typename P::D> di;
  P result;
  for (int b = 0; b < B; ++b) {
    const auto i = hn::BitCast(di, x.v[b]);
    const auto exponent = hn::Sub(hn::ShiftRight<52>(i), hn::Set(di, 1023));
    const auto fraction = hn::And(i, hn::Set(di, 0x000FFFFFFFFFFFFFLL));
    const auto m = hn::Sub(hn::BitCast(d, hn::Or(fraction, hn::Set(di, 0x3FF0000000000000LL))),
                           hn::Set(d, 1.0));  // 0 <= m < 1
    auto p = hn::MulAdd(m, hn::Set(d, 0.15638611), hn::Set(d, -0.57725065));
    p = hn::Mul(m, hn::MulAdd(p, m, hn::Set(d, 1.42086454)));
    result.v[b] = hn::Add(hn::ConvertTo(d, exponent), p);
  }
  return result;
}

/// 2^x to 2e-3, |x| < 1000.
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> rough_exp2(const Pack<L, B>& x) {
  using P = Pack<L, B>;
  typename P::D d;
  const hn::RebindToSigned<typename P::D> di;
  P result;
  for (int b = 0; b < B; ++b) {
    const auto whole = hn::Floor(x.v[b]);
    const auto f = hn::Sub(x.v[b], whole);  // 0 <= f < 1
    auto p = hn::MulAdd(f, hn::Set(d, 0.07912522), hn::Set(d, 0.22494631));
    p = hn::MulAdd(p, f, hn::Set(d, 0.69592847));
    p = hn::MulAdd(p, f, hn::Set(d, 1.0));
    const auto power = hn::ShiftLeft<52>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 1023)));
    result.v[b] = hn::Mul(p, hn::BitCast(d, power));
  }
  return result;
}

/// x^(1/9) of positive numbers: Newton's method from a guess to 1e-3, whose error goes with its
/// square.
template <class P>
HWY_ATTR inline P ninth_root_of(const P& x, int steps) {
  P y = rough_exp2(rough_log2(x) * P(1.0 / 9.0));
  for (int i = 0; i < steps; ++i) {
    const P y2 = y * y, y4 = y2 * y2, y8 = y4 * y4;
    y = y - (y * y8 - x) / (P(9.0) * y8);
  }
  return y;
}
template <size_t L, int B>
HWY_ATTR inline Pack<L, B> ninth_root(const Pack<L, B>& x) {
  return ninth_root_of(x, 4);
}

/// Where lane i of a pack is in its memory [bytes].
template <class P>
inline size_t offset_of_lane(int i) {
  const size_t lanes = hn::Lanes(typename P::D()), ui = static_cast<size_t>(i);
  return ui / lanes * sizeof(typename P::Register) + ui % lanes * sizeof(double);
}
template <size_t L, int B>
inline double lane(const Pack<L, B>& x, int i) {
  double value;
  std::memcpy(&value, reinterpret_cast<const char*>(&x) + offset_of_lane<Pack<L, B>>(i),
              sizeof value);
  return value;
}
template <size_t L, int B>
inline void set_lane(Pack<L, B>& x, int i, double value) {
  std::memcpy(reinterpret_cast<char*>(&x) + offset_of_lane<Pack<L, B>>(i), &value, sizeof value);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
