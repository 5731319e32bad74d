// Series of the engine: coefficients of all coordinates, order by order.

#if defined(WHIRL_ENGINE_SERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_SERIES_INL_H
#undef WHIRL_ENGINE_SERIES_INL_H
#else
#define WHIRL_ENGINE_SERIES_INL_H
#endif

#include "libdyn/batch/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl {
namespace HWY_NAMESPACE {

/// Coefficient k + 1 of displacements and velocities, contacts apart.
template <class P>
HWY_ATTR inline void Engine<P>::linear(int k, const P& sine, const P& cosine, const P& inverse) {
  const P* now = term(k);
  P* next = term(k + 1);
  const P *kd = equations_.K.data(), *dd = equations_.D.data(), *fc = equations_.fc.data(),
          *fs = equations_.fs.data();
  for (int i = 0; i < n_; ++i) {
    const P rate = now[n_ + i];
    P sum = fma(fc[i], cosine, fs[i] * sine);
    sum = fnma(kd[i], now[i], sum);
    sum = fnma(dd[i], rate, sum);
    next[i] = rate * inverse;
    next[n_ + i] = sum * inverse;
  }
  for (const Pattern::OffDiagonal& row : pattern_.off_diagonal) {
    P sum(0.0);
    const P* a = equations_.A.data() + row.begin;
    for (const int source : row.source) sum = fma(*a++, now[source], sum);
    next[n_ + row.i] = fnma(sum, inverse, next[n_ + row.i]);
  }
}

/// Coefficients x_{k+1}, v_{k+1} from those up to k:  v' = f - K x - D v - sum B F,  x' = v.
template <class P>
HWY_ATTR void Engine<P>::series() {
  P sine, cosine;
  sin_cos(rate_ * time_, sine, cosine);
  std::copy(y_.begin(), y_.end(), term(0));
  laws_.clear();
  bool any_sticks = false;
  for (ContactLanes<P>& c : contacts_) {
    c.begin(active_);
    any_sticks = any_sticks || (c.sticking & active_) != 0;
    with_alternative(c.law, [&](const auto& law) HWY_ATTR {
      using Law = std::remove_cvref_t<decltype(law)>;
      laws_.emplace_back(std::in_place_type<LawWork<P, Law>>, law);
    });
  }
  const size_t contacts = contacts_.size();
  P fx, fy;
  for (int k = 0; k <= N; ++k) {
    const P inverse(inverse_of<P>(k + 1));
    linear(k, sine, cosine, inverse);
    P* acceleration = term(k + 1) + n_;
    if (k == 0) {
      for (int i = 0; i < n_; ++i)
        acceleration[i] = acceleration[i] + equations_.f0[static_cast<size_t>(i)];
    }
    for (size_t i = 0; i < contacts; ++i) {
      ContactLanes<P>& c = contacts_[i];
      if (k == 0) c.first_geometry(term(0));
      if (c.is_ahead) {
        c.geometry(term(k + 1), k + 1);
      } else if (k > 0) {
        c.geometry(term(k), k);
      }
      if (!c.is_evaluated) continue;
      c.force(laws_[i], k, fx, fy);
      c.push(acceleration, fx * inverse, fy * inverse);
    }
    if (any_sticks) stick(k, inverse);
    const P turn = rate_ * inverse;
    const P turned = -(turn * sine);
    sine = turn * cosine;
    cosine = turned;
  }
  for (int i = 0; i < n_; ++i)
    term(N + 2)[i] = term(N + 1)[n_ + i] * P(Number(1.0) / Number(N + 2));
  // the distance needs two more coefficients to be as good as the state
  for (ContactLanes<P>& c : contacts_) {
    if (!c.is_ahead) c.geometry(term(N + 1), N + 1);
    c.geometry(term(N + 2), N + 2);
  }
}

/// Solves influence_ x = work_ with its triangular factors; x in work_.
template <class P>
HWY_ATTR void Engine<P>::solve_influence() {
  const size_t m = contacts_.size();
  for (size_t i = 1; i < m; ++i) {
    for (size_t j = 0; j < i; ++j) work_[i] = fnma(influence_[i * m + j], work_[j], work_[i]);
  }
  for (size_t i = m; i-- > 0;) {
    for (size_t j = i + 1; j < m; ++j) work_[i] = fnma(influence_[i * m + j], work_[j], work_[i]);
    work_[i] = work_[i] / influence_[i * m + i];
  }
}

/// tau_k of sticking contacts, from a slip velocity that stays zero.
///
///   Omega R + (d x d') / r = 0   =>   d x d'' = -Omega R r'
///
/// Coefficient k of this is linear in the tau_k of all sticking contacts; lanes and contacts that
/// do not stick have a one on the diagonal and zero on the right.
template <class P>
HWY_ATTR void Engine<P>::stick(int k, const P& inverse) {
  const size_t m = contacts_.size();
  P* acceleration = term(k + 1) + n_;
  P ax, ay;
  if (k == 0) {  // what a unit of tau_j does to the left side of contact i
    influence_.assign(m * m, P(0.0));
    for (size_t j = 0; j < m; ++j) {
      work_.assign(static_cast<size_t>(n_), P(0.0));
      contacts_[j].push(work_.data(), -contacts_[j].dy[0], contacts_[j].dx[0]);
      for (size_t i = 0; i < m; ++i) {
        const ContactLanes<P>& c = contacts_[i];
        c.displacement(work_.data(), ax, ay);
        const P effect = fma(c.dy[0], ax, -(c.dx[0] * ay));
        influence_[i * m + j] = select(mask_of<P>(c.sticking), effect, P(i == j ? 1.0 : 0.0));
      }
    }
    for (size_t p = 0; p < m; ++p) {  // L U; the matrix is that of a kinetic energy: no pivoting
      for (size_t i = p + 1; i < m; ++i) {
        const P factor = influence_[i * m + p] / influence_[p * m + p];
        influence_[i * m + p] = factor;
        for (size_t j = p + 1; j < m; ++j) {
          influence_[i * m + j] = fnma(factor, influence_[p * m + j], influence_[i * m + j]);
        }
      }
    }
  }
  work_.assign(m, P(0.0));
  const P whole(k + 1.0);
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    c.displacement(acceleration, ax, ay);
    P sum = fma(c.dx[0], whole * ay, -(c.dy[0] * (whole * ax)));
    for (int j = 1; j <= k; ++j) sum = fma(c.dx[j], c.ay[k - j], fnma(c.dy[j], c.ax[k - j], sum));
    sum = fma(c.rim, whole * c.r[k + 1], sum);
    work_[i] = select(mask_of<P>(c.sticking), sum, P(0.0));
  }
  solve_influence();
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    const P tau = work_[i];
    c.tau[k] = c.tau[k] + tau;
    c.push(acceleration, -(tau * c.dy[0]) * inverse, tau * c.dx[0] * inverse);
  }
  for (ContactLanes<P>& c : contacts_) {
    if ((c.sticking & active_) == 0) continue;
    c.displacement(acceleration, ax, ay);
    c.ax[k] = whole * ax;
    c.ay[k] = whole * ay;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl
HWY_AFTER_NAMESPACE();

#endif  // guard
