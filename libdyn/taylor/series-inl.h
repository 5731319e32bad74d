// Taylor series, coefficient by coefficient: arithmetic on `Leaf`s builds an expression whose
// coefficient k follows from coefficients up to k of its parts. Included once per number type
// family.

#if defined(WHIRL_SERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SERIES_INL_H
#undef WHIRL_SERIES_INL_H
#else
#define WHIRL_SERIES_INL_H
#endif

#include <array>
#include <type_traits>

#include "libdyn/taylor/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Calls f(i) for i = 0 to Count - 1, written out so that what i indexes can stay in registers;
/// with Count = 0 for i = 0 to n - 1, in a loop.
template <int Count, class F>
HWY_ATTR inline void each(int n, F&& f) {
  if constexpr (Count == 0) {
    for (int i = 0; i < n; ++i) f(i);
  } else {
    [&]<int... i>(std::integer_sequence<int, i...>) HWY_ATTR {
      (f(i), ...);
    }
    (std::make_integer_sequence<int, Count>());
  }
}

/// 1 / of(k) for the orders of a series, as exact as the numbers of a pack.
template <class P, class F>
constexpr auto reciprocals(F of) {
  using Number = typename P::Number;
  std::array<Number, P::most_terms> table{};
  for (int k = 0; k < P::most_terms; ++k) {
    if (of(k) != 0) table[static_cast<size_t>(k)] = Number(1.0) / Number(of(k));
  }
  return table;
}
/// 1 / k.
template <class P>
inline typename P::Number inverse_of(int k) {
  static constexpr auto table = reciprocals<P>([](int i) { return i; });
  return table[static_cast<size_t>(k)];
}
/// 1 / ((k + 1) (k + 2)): coefficient k + 2 of x per coefficient k of x''.
template <class P>
inline typename P::Number twice_integrated(int k) {
  static constexpr auto table = reciprocals<P>([](int i) { return (i + 1) * (i + 2); });
  return table[static_cast<size_t>(k)];
}

/// Marks the types that series arithmetic is about.
struct SeriesTag {};
template <class T>
concept Series = std::is_base_of_v<SeriesTag, std::remove_cvref_t<T>>;

/// The I-th of the two series that an expression is about: its coefficient is handed to at().
template <class P, int I>
struct Leaf : SeriesTag {
  using Number = P;
  HWY_ATTR inline P at(int, const P& first, const P& second) { return I == 0 ? first : second; }
};

/// A constant.
template <class P>
struct Constant : SeriesTag {
  using Number = P;
  P value;
  explicit Constant(const P& v) : value(v) {}
  HWY_ATTR inline P at(int k, const P&, const P&) { return k == 0 ? value : P(0.0); }
};

/// The series that is zero.
template <class P>
struct Zero : SeriesTag {
  using Number = P;
  HWY_ATTR inline P at(int, const P&, const P&) { return P(0.0); }
};
template <class A>
constexpr bool is_zero = false;
template <class P>
constexpr bool is_zero<Zero<P>> = true;
template <class A>
constexpr bool is_constant = false;
template <class P>
constexpr bool is_constant<Constant<P>> = true;

/// factor * a.
template <class A>
struct Scaled : SeriesTag {
  using Number = typename A::Number;
  A a;
  Number factor;
  Scaled(const A& x, const Number& f) : a(x), factor(f) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    return factor * a.at(k, u, v);
  }
};

template <class A, class B>
struct Sum : SeriesTag {
  using Number = typename A::Number;
  A a;
  B b;
  Sum(const A& x, const B& y) : a(x), b(y) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    return a.at(k, u, v) + b.at(k, u, v);
  }
};

/// a b by convolution: c_k = sum_i a_i b_{k-i}.
template <class A, class B>
struct Product : SeriesTag {
  using Number = typename A::Number;
  A a;
  B b;
  Number x[Number::most_terms], y[Number::most_terms];
  Product(const A& p, const B& q) : a(p), b(q) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    x[k] = a.at(k, u, v);
    y[k] = b.at(k, u, v);
    Number sum = x[0] * y[k];
    for (int i = 1; i <= k; ++i) sum = fma(x[i], y[k - i], sum);
    return sum;
  }
};

/// a / b: c_k = (a_k - sum_{i>=1} b_i c_{k-i}) / b_0.
template <class A, class B>
struct Quotient : SeriesTag {
  using Number = typename A::Number;
  A a;
  B b;
  Number y[Number::most_terms], c[Number::most_terms];
  Quotient(const A& p, const B& q) : a(p), b(q) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    y[k] = b.at(k, u, v);
    Number sum = a.at(k, u, v);
    for (int i = 1; i <= k; ++i) sum = fnma(y[i], c[k - i], sum);
    return c[k] = sum / y[0];
  }
};

/// sqrt(a): c_k = (a_k - sum_{0<i<k} c_i c_{k-i}) / (2 c_0).
template <class A>
struct SquareRoot : SeriesTag {
  using Number = typename A::Number;
  A a;
  Number c[Number::most_terms];
  explicit SquareRoot(const A& x) : a(x) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    Number sum = a.at(k, u, v);
    if (k == 0) return c[0] = sqrt(sum);
    for (int i = 1; i < k; ++i) sum = fnma(c[i], c[k - i], sum);
    return c[k] = sum / (c[0] + c[0]);
  }
};

/// a^(1/9):  9 k a_0 c_k = sum_{0<i<=k} (10 i - 9 k) a_i c_{k-i}.
template <class A>
struct NinthRoot : SeriesTag {
  using Number = typename A::Number;
  A a;
  Number inverse;
  Number x[Number::most_terms], c[Number::most_terms];
  explicit NinthRoot(const A& of) : a(of) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    x[k] = a.at(k, u, v);
    if (k == 0) {
      inverse = Number(1.0) / x[0];
      return c[0] = ninth_root(x[0]);
    }
    Number sum(0.0);
    for (int i = 1; i <= k; ++i) sum = fma(Number(10.0 * i - 9.0 * k) * x[i], c[k - i], sum);
    return c[k] = sum * (inverse / Number(9.0 * k));
  }
};

template <Series A, Series B>
HWY_ATTR inline auto operator+(const A& a, const B& b) {
  if constexpr (is_zero<A>) {
    return b;
  } else if constexpr (is_zero<B>) {
    return a;
  } else {
    return Sum<A, B>(a, b);
  }
}
template <Series A>
HWY_ATTR inline auto operator*(const typename A::Number& f, const A& a) {
  if constexpr (is_zero<A>) {
    return a;
  } else if constexpr (is_constant<A>) {
    return Constant<typename A::Number>(f * a.value);
  } else {
    return Scaled<A>(a, f);
  }
}
template <Series A>
HWY_ATTR inline auto operator*(const A& a, const typename A::Number& f) {
  return f * a;
}
template <Series A>
HWY_ATTR inline auto operator*(double f, const A& a) {
  return typename A::Number(f) * a;
}
template <Series A>
HWY_ATTR inline auto operator-(const A& a) {
  return typename A::Number(-1.0) * a;
}
template <Series A, Series B>
HWY_ATTR inline auto operator-(const A& a, const B& b) {
  return a + (-b);
}
template <Series A>
HWY_ATTR inline auto operator+(double f, const A& a) {
  using P = typename A::Number;
  return Constant<P>(P(f)) + a;
}
template <Series A>
HWY_ATTR inline auto operator+(const A& a, double f) {
  return f + a;
}
template <Series A>
HWY_ATTR inline auto operator-(const A& a, double f) {
  return (-f) + a;
}
template <Series A>
HWY_ATTR inline auto operator-(double f, const A& a) {
  return f + (-a);
}
template <Series A, Series B>
HWY_ATTR inline auto operator*(const A& a, const B& b) {
  if constexpr (is_zero<A>) {
    return a;
  } else if constexpr (is_zero<B>) {
    return b;
  } else if constexpr (is_constant<A>) {
    return a.value * b;
  } else if constexpr (is_constant<B>) {
    return a * b.value;
  } else {
    return Product<A, B>(a, b);
  }
}
template <Series A, Series B>
HWY_ATTR inline auto operator/(const A& a, const B& b) {
  if constexpr (is_zero<A>) {
    return a;
  } else {
    return Quotient<A, B>(a, b);
  }
}
template <Series A>
HWY_ATTR inline auto sqrt(const A& a) {
  return SquareRoot<A>(a);
}
template <Series A>
HWY_ATTR inline auto ninth_root(const A& a) {
  return NinthRoot<A>(a);
}

// ---- derivatives of expressions by one of their leaves ------------------------------------------

/// Derivative by leaf I.
template <int I, class P, int J>
HWY_ATTR inline auto derivative(const Leaf<P, J>&) {
  if constexpr (I == J) {
    return Constant<P>(P(1.0));
  } else {
    return Zero<P>();
  }
}
template <int I, class P>
HWY_ATTR inline auto derivative(const Constant<P>&) {
  return Zero<P>();
}
template <int I, class A>
HWY_ATTR inline auto derivative(const Scaled<A>& e) {
  return derivative<I>(e.a) * e.factor;
}
template <int I, class A, class B>
HWY_ATTR inline auto derivative(const Sum<A, B>& e) {
  return derivative<I>(e.a) + derivative<I>(e.b);
}
template <int I, class A, class B>
HWY_ATTR inline auto derivative(const Product<A, B>& e) {
  return derivative<I>(e.a) * e.b + e.a * derivative<I>(e.b);
}
template <int I, class A, class B>
HWY_ATTR inline auto derivative(const Quotient<A, B>& e) {  // (a' - (a / b) b') / b
  const auto by_b = -e * derivative<I>(e.b);
  return (derivative<I>(e.a) + by_b) / e.b;
}
template <int I, class A>
HWY_ATTR inline auto derivative(const SquareRoot<A>& e) {
  return derivative<I>(e.a) / (2.0 * e);
}
template <int I, class A>
HWY_ATTR inline auto derivative(const NinthRoot<A>& e) {
  return derivative<I>(e.a) * (e / (9.0 * e.a));
}

// ---- whole series -------------------------------------------------------------------------------

/// Coefficient k of a b.
template <class P>
HWY_ATTR inline P product_term(const P* a, const P* b, int k) {
  P sum = a[0] * b[k];
  for (int i = 1; i <= k; ++i) sum = fma(a[i], b[k - i], sum);
  return sum;
}
/// Coefficients 0 to N of a b.
template <class P>
HWY_ATTR void multiply(const P* a, const P* b, P* to, int N) {
  for (int k = 0; k <= N; ++k) to[k] = product_term(a, b, k);
}
/// Coefficients 0 to N of a / b in the lanes of `where`, zero elsewhere.
template <class P>
HWY_ATTR void divide(const P* a, const P* b, P* to, int N, const typename P::Mask& where) {
  const P inverse = P(1.0) / select(where, b[0], P(1.0));
  for (int k = 0; k <= N; ++k) {
    P sum = a[k];
    for (int i = 1; i <= k; ++i) sum = fnma(b[i], to[k - i], sum);
    to[k] = select(where, sum * inverse, P(0.0));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
