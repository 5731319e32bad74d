// Formulas of Taylor series in which results are used more than once: a list of operations, each
// done once for every coefficient. Included once per number type family.

#if defined(WHIRL_SERIES_TAPE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SERIES_TAPE_INL_H
#undef WHIRL_SERIES_TAPE_INL_H
#else
#define WHIRL_SERIES_TAPE_INL_H
#endif

#include <algorithm>
#include <vector>

#include "libdyn/taylor/series-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

template <class P>
class SeriesTape;

/// A series on a tape: arithmetic with it writes operations down.
template <class P>
struct Recorded {
  SeriesTape<P>* tape = nullptr;
  int index = -1;
};

/// Operations on series, in order. Write a formula down once, then call at() for k = 0, 1, 2, ...
///
///   (a b)_k = sum a_i b_{k-i},   (a / b)_k = (a_k - sum_{i>0} b_i (a / b)_{k-i}) / b_0,
///   c = sqrt(a):    c_k = (a_k - sum_{0<i<k} c_i c_{k-i}) / (2 c_0),
///   c = arccot(a):  c' (1 + a^2) = -a'
///
/// @source [GriewankWalther2008], ch. 13 for the recurrences, ch. 3 for gradients
template <class P>
class SeriesTape {
 public:
  using Var = Recorded<P>;
  enum class Op { input, affine, product, square, quotient, root, arc_cotangent };

  /// Number of coefficients of all series.
  explicit SeriesTape(int terms) : terms_(terms) {}

  /// The next input; at() takes their coefficients in this order.
  Var input() { return record({.op = Op::input, .a = inputs_++}); }

  /// fa a + fb b + constant; b may be left out.
  Var affine(Var a, double fa, double constant, Var b = {}, double fb = 0.0) {
    return record(
        {.op = Op::affine, .a = a.index, .b = b.index, .fa = fa, .fb = fb, .constant = constant});
  }
  Var product(Var a, Var b) {
    if (a.index == b.index) return record({.op = Op::square, .a = a.index});
    return record(
        {.op = Op::product, .a = std::min(a.index, b.index), .b = std::max(a.index, b.index)});
  }
  Var quotient(Var a, Var b) { return record({.op = Op::quotient, .a = a.index, .b = b.index}); }
  Var root(Var a) { return record({.op = Op::root, .a = a.index}); }
  Var arccot(Var a) {
    const Var slope = affine(product(a, a), 1.0, 1.0);
    return record({.op = Op::arc_cotangent, .a = a.index, .b = slope.index});
  }

  /// Derivatives of a series by all inputs, written down as well, from the last operation back; an
  /// input that it does not depend on has a negative index.
  std::vector<Var> gradient(Var of) {
    std::vector<Var> by(static_cast<size_t>(of.index) + 1);  // a negative index: zero
    std::vector<Var> result(static_cast<size_t>(inputs_));
    const auto add = [&](int to, Var change) {
      Var& sum = by[static_cast<size_t>(to)];
      sum = sum.index < 0 ? change : affine(sum, 1.0, 0.0, change, 1.0);
    };
    by.back() = affine(of, 0.0, 1.0);
    for (int i = of.index; i >= 0; --i) {
      const Node n = nodes_[static_cast<size_t>(i)];
      const Var here = var(i), a = var(n.a), b = var(n.b), bar = by[static_cast<size_t>(i)];
      if (bar.index < 0) continue;
      switch (n.op) {
        case Op::input:
          result[static_cast<size_t>(n.a)] = bar;
          break;
        case Op::affine:
          add(n.a, affine(bar, n.fa, 0.0));
          if (n.b >= 0) add(n.b, affine(bar, n.fb, 0.0));
          break;
        case Op::product:
          add(n.a, product(bar, b));
          add(n.b, product(bar, a));
          break;
        case Op::square:
          add(n.a, affine(product(bar, a), 2.0, 0.0));
          break;
        case Op::quotient: {
          const Var over = quotient(bar, b);
          add(n.a, over);
          add(n.b, affine(product(over, here), -1.0, 0.0));
          break;
        }
        case Op::root:
          add(n.a, affine(quotient(bar, here), 0.5, 0.0));
          break;
        case Op::arc_cotangent:
          add(n.a, affine(quotient(bar, b), -1.0, 0.0));
          break;
      }
    }
    return result;
  }

  /// Coefficients of a series.
  const P* series(Var v) const {
    return values_.data() + static_cast<size_t>(v.index) * static_cast<size_t>(terms_);
  }

  /// Coefficient k of all series from those of the inputs; call for k = 0, 1, 2, ...
  HWY_ATTR void at(int k, const P* inputs) {
    const size_t terms = static_cast<size_t>(terms_);
    P* c = values_.data();
    P* divisor = divisors_.data();
    for (const Node& n : nodes_) {
      const P* a = values_.data() + static_cast<size_t>(std::max(n.a, 0)) * terms;
      const P* b = values_.data() + static_cast<size_t>(std::max(n.b, 0)) * terms;
      switch (n.op) {
        case Op::input:
          c[k] = inputs[n.a];
          break;
        case Op::affine: {
          P sum = P(n.fa) * a[k];
          if (n.b >= 0) sum = fma(P(n.fb), b[k], sum);
          c[k] = k == 0 ? sum + P(n.constant) : sum;
          break;
        }
        case Op::product:
          c[k] = convolve(a, b, 0, k, k);
          break;
        case Op::square:
          c[k] = square_term(a, 0, k);
          break;
        case Op::quotient:
          if (k == 0) {
            *divisor = P(1.0) / b[0];
            c[0] = a[0] / b[0];
          } else {
            c[k] = (a[k] - convolve(b, c, 1, k, k)) * *divisor;
          }
          break;
        case Op::root:
          if (k == 0) {
            c[0] = sqrt(a[0]);
            *divisor = P(0.5) / c[0];
          } else {
            c[k] = (a[k] - square_term(c, 1, k)) * *divisor;
          }
          break;
        case Op::arc_cotangent:
          if (k == 0) {
            c[0] = arc_cotangent(a[0]);
            *divisor = P(1.0) / b[0];
          } else {
            P sum = P(static_cast<double>(k)) * a[k];
            for (int i = 1; i < k; ++i) {
              sum = fma(P(static_cast<double>(i)) * c[i], b[k - i], sum);
            }
            c[k] = -(sum * *divisor) * P(inverse_of<P>(k));
          }
          break;
      }
      c += terms;
      ++divisor;
    }
  }

 private:
  struct Node {
    Op op;
    int a = -1, b = -1;
    double fa = 0.0, fb = 0.0, constant = 0.0;
    bool operator==(const Node&) const = default;
  };

  Var var(int index) { return {this, index}; }

  /// Writes an operation down, unless it is there already.
  Var record(const Node& n) {
    const auto found = std::find(nodes_.begin(), nodes_.end(), n);
    if (found != nodes_.end()) return var(static_cast<int>(found - nodes_.begin()));
    nodes_.push_back(n);
    values_.assign(nodes_.size() * static_cast<size_t>(terms_), P(0.0));
    divisors_.assign(nodes_.size(), P(1.0));
    return var(static_cast<int>(nodes_.size()) - 1);
  }

  /// sum of a_i b_{k-i} for i = first to last, in two chains.
  static HWY_ATTR inline P convolve(const P* a, const P* b, int first, int last, int k) {
    P even(0.0), odd(0.0);
    int i = first;
    for (; i < last; i += 2) {
      even = fma(a[i], b[k - i], even);
      odd = fma(a[i + 1], b[k - i - 1], odd);
    }
    if (i == last) even = fma(a[i], b[k - i], even);
    return even + odd;
  }
  /// sum of a_i a_{k-i} for i = first to k - first.
  static HWY_ATTR inline P square_term(const P* a, int first, int k) {
    const P half = convolve(a, a, first, (k + 1) / 2 - 1, k);
    const P sum = half + half;
    return k % 2 == 0 && k / 2 >= first ? fma(a[k / 2], a[k / 2], sum) : sum;
  }

  int terms_;
  int inputs_ = 0;
  std::vector<Node> nodes_;
  std::vector<P> values_;    // series after series
  std::vector<P> divisors_;  // per operation, of its recurrence
};

template <class P>
Recorded<P> operator+(Recorded<P> a, Recorded<P> b) {
  return a.tape->affine(a, 1.0, 0.0, b, 1.0);
}
template <class P>
Recorded<P> operator-(Recorded<P> a, Recorded<P> b) {
  return a.tape->affine(a, 1.0, 0.0, b, -1.0);
}
template <class P>
Recorded<P> operator-(Recorded<P> a) {
  return a.tape->affine(a, -1.0, 0.0);
}
template <class P>
Recorded<P> operator+(Recorded<P> a, double b) {
  return a.tape->affine(a, 1.0, b);
}
template <class P>
Recorded<P> operator+(double a, Recorded<P> b) {
  return b + a;
}
template <class P>
Recorded<P> operator-(double a, Recorded<P> b) {
  return b.tape->affine(b, -1.0, a);
}
template <class P>
Recorded<P> operator*(double a, Recorded<P> b) {
  return b.tape->affine(b, a, 0.0);
}
template <class P>
Recorded<P> operator*(Recorded<P> a, Recorded<P> b) {
  return a.tape->product(a, b);
}
template <class P>
Recorded<P> operator/(Recorded<P> a, Recorded<P> b) {
  return a.tape->quotient(a, b);
}
template <class P>
Recorded<P> sqrt(Recorded<P> a) {
  return a.tape->root(a);
}
template <class P>
Recorded<P> arc_cotangent(Recorded<P> a) {
  return a.tape->arccot(a);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
