// Taylor series, coefficient by coefficient: arithmetic on `Leaf`s builds an expression whose
// coefficient k follows from coefficients up to k of its parts. Included once per number type
// family.

#if defined(WHIRL_SERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SERIES_INL_H
#undef WHIRL_SERIES_INL_H
#else
#define WHIRL_SERIES_INL_H
#endif

#include <type_traits>

#include "libdyn/batch/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl {
namespace HWY_NAMESPACE {

/// Most coefficients of a series: order 20 and the three that come with it.
constexpr int most_terms = 27;

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
  Number x[most_terms], y[most_terms];
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
  Number y[most_terms], c[most_terms];
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
  Number c[most_terms];
  explicit SquareRoot(const A& x) : a(x) {}
  HWY_ATTR inline Number at(int k, const Number& u, const Number& v) {
    Number sum = a.at(k, u, v);
    if (k == 0) return c[0] = sqrt(sum);
    for (int i = 1; i < k; ++i) sum = fnma(c[i], c[k - i], sum);
    return c[k] = sum / (c[0] + c[0]);
  }
};

template <Series A, Series B>
HWY_ATTR inline auto operator+(const A& a, const B& b) {
  return Sum<A, B>(a, b);
}
template <Series A>
HWY_ATTR inline auto operator*(const typename A::Number& f, const A& a) {
  return Scaled<A>(a, f);
}
template <Series A>
HWY_ATTR inline auto operator*(const A& a, const typename A::Number& f) {
  return Scaled<A>(a, f);
}
template <Series A>
HWY_ATTR inline auto operator*(double f, const A& a) {
  return Scaled<A>(a, typename A::Number(f));
}
template <Series A>
HWY_ATTR inline auto operator-(const A& a) {
  return Scaled<A>(a, typename A::Number(-1.0));
}
template <Series A, Series B>
HWY_ATTR inline auto operator-(const A& a, const B& b) {
  return a + (-b);
}
template <Series A>
HWY_ATTR inline auto operator+(double f, const A& a) {
  using P = typename A::Number;
  return Sum<Constant<P>, A>(Constant<P>(P(f)), a);
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
  return Product<A, B>(a, b);
}
template <Series A, Series B>
HWY_ATTR inline auto operator/(const A& a, const B& b) {
  return Quotient<A, B>(a, b);
}
template <Series A>
HWY_ATTR inline auto sqrt(const A& a) {
  return SquareRoot<A>(a);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl
HWY_AFTER_NAMESPACE();

#endif  // guard
