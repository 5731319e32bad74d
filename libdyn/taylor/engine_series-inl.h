// Series of the engine: coefficients of all coordinates, order by order.

#if defined(WHIRL_ENGINE_SERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_SERIES_INL_H
#undef WHIRL_ENGINE_SERIES_INL_H
#else
#define WHIRL_ENGINE_SERIES_INL_H
#endif

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Coefficients of  fc cos(angle) + fs sin(angle),  whose angle moves at a rate:
///
///   f_{k+2} = -rate^2 f_k / ((k + 1) (k + 2))
///
/// @param put  is called with a coordinate, an order and the coefficient
template <class P>
template <class V>
HWY_ATTR inline void Engine<P>::oscillate(const V& rate, const V& angle, const std::vector<P>& fc,
                                          const std::vector<P>& fs, const auto& put) const {
  V sine, cosine;
  sin_cos(angle, sine, cosine);
  const V curvature = -(rate * rate);
  V factors[P::most_terms];
  for (int k = 0; k < N; ++k) factors[k] = PlainOf<V>(twice_integrated<V>(k)) * curvature;
  for (const int i : pattern_.forced) {
    const V &of_cosine = as<V>(fc[static_cast<size_t>(i)]),
            &of_sine = as<V>(fs[static_cast<size_t>(i)]);
    V now = fma(of_cosine, cosine, of_sine * sine);
    V next = rate * fma(of_sine, cosine, -(of_cosine * sine));
    put(i, 0, now);
    for (int k = 1; k <= N; ++k) {
      put(i, k, next);
      const V after = factors[k - 1] * now;
      now = next;
      next = after;
    }
  }
}

/// Coefficients of the load; where it does not turn they are zero from the second on.
///
/// @tparam V  P, or its value alone: slopes are left as they are
template <class P>
template <class V>
HWY_ATTR void Engine<P>::find_load() {
  const auto load = [&](int i, int k)
                        HWY_ATTR -> V& { return as<V>(load_[static_cast<size_t>(k * n_ + i)]); };
  oscillate<V>(as<V>(rate_), as<V>(rate_) * as<V>(time_), equations_.fc, equations_.fs,
               [&](int i, int k, const V& f) HWY_ATTR {
                 load(i, k) = k == 0 ? f + as<V>(equations_.f0[static_cast<size_t>(i)]) : f;
               });
  for (const OtherLoadLanes<P>& o : equations_.other_loads) {
    oscillate<V>(as<V>(o.rate), fma(as<V>(o.rate), as<V>(time_), as<V>(o.start)), o.fc, o.fs,
                 [&](int i, int k, const V& f) HWY_ATTR { load(i, k) = load(i, k) + f; });
  }
}

/// Coefficient k of the acceleration, contacts and films apart.
///
/// @tparam V  P, or its value alone where the linear part has no slopes
template <class P>
template <class V>
HWY_ATTR inline void Engine<P>::accelerate(int k, P* to) {
  const P *now = term(k), *rate = term(k + 1);  // x' has coefficients (k + 1) x_{k+1}
  const P *kd = equations_.K.data(), *dd = equations_.D.data(), *load = load_.data() + k * n_;
  const PlainOf<P> whole(k + 1.0);
  for (int i = 0; i < n_; ++i) {
    to[i] = fnma(whole * as<V>(dd[i]), rate[i], fnma(as<V>(kd[i]), now[i], load[i]));
  }
  for (const Pattern::OffDiagonal& row : pattern_.off_diagonal) {
    const P* a = equations_.A.data() + row.begin;
    P of_x(0.0), of_rate(0.0);
    for (const int j : row.of_x) of_x = fma(as<V>(*a++), now[j], of_x);
    for (const int j : row.of_rate) of_rate = fma(as<V>(*a++), rate[j], of_rate);
    to[row.i] = to[row.i] - fma(whole, of_rate, of_x);
  }
}

/// Of contacts that slip alike, the first that sticks carries the friction of all that do.
template <class P>
void Engine<P>::find_leaders() {
  for (ContactLanes<P>& c : contacts_) c.leading = c.sticking;
  for (size_t p = 0; p < alike_.size(); ++p) {
    const auto [first, second] = pattern_.alike[p];
    contacts_[second].leading &= ~(contacts_[first].sticking & alike_[p]);
  }
}

/// Coefficients x_{k+2} from those up to k + 1:  x'' = f - K x - D x' - sum B F.
template <class P>
HWY_ATTR void Engine<P>::series() {
  laws_.clear();
  find_leaders();
  for (ContactLanes<P>& c : contacts_) {
    c.begin(active_);
    if (c.disk && !c.is_evaluated) {  // most of many blades: nothing is built for their force
      laws_.emplace_back(std::in_place_type<LawWork<P, Radial<P>>>, Radial<P>{});
      continue;
    }
    with_alternative(c.law, [&](const auto& law) HWY_ATTR {
      using Law = std::remove_cvref_t<decltype(law)>;
      laws_.emplace_back(std::in_place_type<LawWork<P, Law>>, law);
    });
  }
  if (!is_rotor_in_stator()) return series_of_any();
  with_alternative(laws_[0], [&](auto& law) HWY_ATTR {
    if constexpr (std::remove_cvref_t<decltype(law)>::is_of_bodies) {
      if constexpr (carries_slopes<P>) {
        is_flat_&& contacts_[0].rows_are_flat ? series_of_bodies<2, false, PlainOf<P>>(law)
                                              : series_of_bodies<2, false, P>(law);
      } else {
        pattern_.is_isotropic ? series_of_bodies<2, true, P>(law)
                              : series_of_bodies<2, false, P>(law);
      }
    }
  });
}

/// The same for any system.
template <class P>
HWY_ATTR void Engine<P>::series_of_any() {
  std::copy(y_.begin(), y_.end(), term(0));
  is_flat_ ? find_load<PlainOf<P>>() : find_load<P>();
  bool any_sticks = false;
  for (const ContactLanes<P>& c : contacts_) any_sticks = any_sticks || (c.sticking & active_) != 0;
  for (const auto& disk : disks_) {
    disk->start(time_);
    extend(*disk, contacts_, term(0), 0);
  }
  for (int k = 0; k <= N; ++k) {
    P* acceleration = term(k + 2);  // not yet integrated
    for (const auto& disk : disks_) extend(*disk, contacts_, term(k + 1), k + 1);
    for (size_t i = 0; i < contacts_.size(); ++i) {  // before all else: this takes longest
      ContactLanes<P>& c = contacts_[i];
      if (c.disk && !c.is_evaluated) continue;  // in find_events, if at all
      if (k == 0) c.first_geometry(term(0));
      if (c.is_ahead) {
        c.geometry(term(k + 1), k + 1, true);
      } else if (k > 0) {
        c.geometry(term(k), k, c.is_evaluated);
      }
      if (c.rub && c.is_ahead) c.rub->velocity(term(k + 1), k);
      if (c.is_evaluated) c.force(laws_[i], k);
    }
    is_flat_ ? accelerate<PlainOf<P>>(k, acceleration) : accelerate<P>(k, acceleration);
    for (const ContactLanes<P>& c : contacts_) {
      if (!c.is_evaluated) continue;
      c.push(acceleration, c.fx, c.fy);
      if (c.rub) c.rub->push(acceleration, c.rub->fx, c.rub->fy);
    }
    for (const auto& film : films_) film->add(term(k), term(k + 1), k, acceleration);
    if (any_sticks) stick(k);
    const PlainOf<P> scale(twice_integrated<P>(k));
    for (int i = 0; i < n_; ++i) acceleration[i] = scale * acceleration[i];
  }
  // to be as good as the state, the square of the distance needs two more
  for (const auto& disk : disks_) extend(*disk, contacts_, term(N + 2), N + 2);
  for (ContactLanes<P>& c : contacts_) {
    if (c.disk && !c.is_evaluated) continue;
    if (!c.is_ahead) c.geometry(term(N + 1), N + 1, false);
    c.geometry(term(N + 2), N + 2, false);
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
/// do not stick, or leave it to another that slips alike, have a one on the diagonal and zero on
/// the right.
template <class P>
HWY_ATTR void Engine<P>::stick(int k) {
  const size_t m = contacts_.size();
  P* acceleration = term(k + 2);  // not yet integrated
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
        influence_[i * m + j] = select(mask_of<P>(c.leading), effect, P(i == j ? 1.0 : 0.0));
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
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    c.displacement(acceleration, ax, ay);
    P sum = fma(c.dx[0], ay, -(c.dy[0] * ax));
    for (int j = 1; j <= k; ++j) sum = fma(c.dx[j], c.ay[k - j], fnma(c.dy[j], c.ax[k - j], sum));
    sum = fma(c.rim, P(k + 1.0) * c.r[k + 1], sum);
    work_[i] = select(mask_of<P>(c.leading), sum, P(0.0));
  }
  solve_influence();
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    const P tau = work_[i];
    c.tau[k] = c.tau[k] + tau;
    c.push(acceleration, -(tau * c.dy[0]), tau * c.dx[0]);
  }
  for (ContactLanes<P>& c : contacts_) {
    if ((c.sticking & active_) == 0) continue;
    c.displacement(acceleration, c.ax[k], c.ay[k]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
