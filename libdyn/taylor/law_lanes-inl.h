// Contact laws in lanes: their parameters, and the series of their forces.

#if defined(WHIRL_LAW_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_LAW_LANES_INL_H
#undef WHIRL_LAW_LANES_INL_H
#else
#define WHIRL_LAW_LANES_INL_H
#endif

#include <tuple>
#include <utility>
#include <variant>

#include "libcontact/laws.hpp"
#include "libdyn/taylor/series-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// indentation() of packs (libcontact/laws/blade_tip.hpp); d >= 0 but for rounding.
template <class P>
requires requires {
  typename P::Mask;
}
HWY_ATTR inline P indentation(const P& d, const P& bend) {
  const P x = P(1.5) * sqrt(P(3.0) * bend) * d;
  const auto tiny = less(x * x, P(0.1 * P::rounding));  // there it is d
  const P safe = select(tiny, P(1.0), x);
  P z = select(tiny, d, d * (P(3.0) * sinh(asinh(safe) / P(3.0)) / safe));
  const P square = bend * (z * z);
  return z - fma(square, z, z - d) / fma(P(3.0), square, P(1.0));
}

/// The same of a series:
///
///   z_k = (d_k - b (z_0 p_k + sum_{0<i<k} z_i s_{k-i})) / (1 + 3 b z_0^2),   s = z^2
///   s_k = 2 z_0 z_k + p_k,   p_k = sum_{0<i<k} z_i z_{k-i}
template <class A>
struct Indentation : SeriesTag {
  using Number = typename A::Number;
  A a;
  Number bend, inverse;
  Number z[Number::most_terms], s[Number::most_terms];
  Indentation(const A& x, const Number& b) : a(x), bend(b) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    const Number d = a.at(k, u, v);
    if (k == 0) {
      z[0] = indentation(d, bend);
      s[0] = z[0] * z[0];
      inverse = Number(1.0) / fma(Number(3.0) * bend, s[0], Number(1.0));
      return z[0];
    }
    Number p(0.0), sum(0.0);
    for (int i = 1; i < k; ++i) {
      p = fma(z[i], z[k - i], p);
      sum = fma(z[i], s[k - i], sum);
    }
    z[k] = fnma(bend, fma(z[0], p, sum), d) * inverse;
    s[k] = fma(z[0] + z[0], z[k], p);
    return z[k];
  }
};
template <Series A>
HWY_ATTR inline auto indentation(const A& a, const typename A::Number& bend) {
  return Indentation<A>(a, bend);
}
/// dz/dd = 1 / (1 + 3 b z^2).
template <int I, class A>
HWY_ATTR inline auto derivative(const Indentation<A>& e) {
  return derivative<I>(e.a) / (1.0 + (e * e) * (typename A::Number(3.0) * e.bend));
}

/// Calls f with the alternative that a variant holds; inlined, unlike std::visit.
template <size_t I = 0, class Variant, class F>
HWY_ATTR inline decltype(auto) with_alternative(Variant& v, F&& f) {
  if constexpr (I + 1 == std::variant_size_v<std::remove_cvref_t<Variant>>) {
    return f(*std::get_if<I>(&v));
  } else {
    if (v.index() == I) return f(*std::get_if<I>(&v));
    return with_alternative<I + 1>(v, f);
  }
}

/// A law over packs, with the series that its normal force needs.
template <class P, class Law>
struct LawWork {
  static constexpr bool is_of_bodies = !has_own_geometry<Law>;  // see Pattern::bodies
  using Force = decltype(std::declval<Law>().normal(Leaf<P, 0>(), Leaf<P, 1>()));
  using RatelessForce = decltype(std::declval<Law>().normal(Leaf<P, 0>(), Zero<P>()));
  Force force;
  RatelessForce rateless;  // of a law that does not depend on the rate

  explicit LawWork(const Law& law)
      : force(law.normal(Leaf<P, 0>(), Leaf<P, 1>())),
        rateless(law.normal(Leaf<P, 0>(), Zero<P>())) {}
  /// Coefficient k of the normal force from those of depth and rate; call for k = 0, 1, 2, ...
  HWY_ATTR inline P normal(int k, const P& depth, const P& rate) {
    return force.at(k, depth, rate);
  }
  HWY_ATTR inline P normal(int k, const P& depth) { return rateless.at(k, depth, depth); }
};

/// Calls f with a law's normal force as an expression of depth and rate, of the depth alone where
/// the rate does not matter.
template <class P>
HWY_ATTR inline void with_force(const AnyContactLaw<P>& any, bool has_rate, const auto& f) {
  with_alternative(any, [&](const auto& law) HWY_ATTR {
    if (has_rate) return f(law.normal(Leaf<P, 0>(), Leaf<P, 1>()));
    return f(law.normal(Leaf<P, 0>(), Zero<P>()));
  });
}

/// Coefficients 0 to N of a law's rate factor, from those of the rate; false: it has none.
template <class P>
HWY_ATTR bool find_rate_factor(const AnyContactLaw<P>& any, const auto& rate, int N, P* to) {
  return with_alternative(any, [&](const auto& law) HWY_ATTR {
    if constexpr (requires { law.rate_factor(Leaf<P, 0>()); }) {
      auto factor = law.rate_factor(Leaf<P, 0>());
      for (int k = 0; k <= N; ++k) to[k] = factor.at(k, rate(k), P(0.0));
      return true;
    } else {
      return false;
    }
  });
}

template <class P, class List>
struct WorkOf;
template <class P, class... Laws>
struct WorkOf<P, std::variant<Laws...>> {
  using type = std::variant<LawWork<P, Laws>...>;
};
template <class P>
using AnyLawWork = typename WorkOf<P, AnyContactLaw<P>>::type;

/// Copies a parameter that the force of a law has in lanes; others are of its geometry.
template <class P, class Member>
HWY_ATTR inline void set_parameter(Member& to, int l, const auto& from) {
  if constexpr (std::is_same_v<Member, P>) set_lane(to, l, from);
}
/// Copies the parameters of a law into a lane, field by field.
template <size_t I = 0, class P>
HWY_ATTR void set_law(AnyContactLaw<P>& to, const AnyContactLaw<>& from, int l) {
  if constexpr (I < std::variant_size_v<AnyContactLaw<>>) {
    if (from.index() != I) return set_law<I + 1>(to, from, l);
    if (to.index() != I) to.template emplace<I>();
    auto& lanes = std::get<I>(to);
    const auto& single = std::get<I>(from);
    using Lanes = std::remove_cvref_t<decltype(lanes)>;
    using Single = std::remove_cvref_t<decltype(single)>;
    std::apply(
        [&](const auto&... of_lanes) HWY_ATTR {
          std::apply(
              [&](const auto&... of_single) HWY_ATTR {
                (set_parameter<P>(lanes.*of_lanes.member, l, single.*of_single.member), ...);
              },
              Single::fields());
        },
        Lanes::fields());
    if constexpr (requires { Single::derived(); }) {
      std::apply(
          [&](const auto&... of_lanes) HWY_ATTR {
            std::apply([&](const auto&... of_single)
                           HWY_ATTR { (set_lane(lanes.*of_lanes, l, single.*of_single), ...); },
                       Single::derived());
          },
          Lanes::derived());
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
