// Friction of contacts that stick, so that their slip stays zero.

#if defined(WHIRL_STICKING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_STICKING_INL_H
#undef WHIRL_STICKING_INL_H
#else
#define WHIRL_STICKING_INL_H
#endif

#include "libdyn/taylor/motion_lanes-inl.h"
#include "libdyn/taylor/tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// tau of sticking contacts, order by order: what holds their slip at zero, in the motion and in
/// the columns of its variation.
template <class P>
class Sticking {
 public:
  explicit Sticking(MotionLanes<P>& of) : m_(of) {}

  void find_leaders();
  HWY_ATTR void add(int k);
  HWY_ATTR void add_to_column(typename Tangents<P>::Track& track, int k);

 private:
  HWY_ATTR void find_influence();
  HWY_ATTR void solve_influence();

  MotionLanes<P>& m_;
  std::vector<P> influence_;  // of a unit of tau on what must stay zero, its triangular factors
  std::vector<P> work_;
};

/// Of contacts that slip alike, the first that sticks carries the friction of all that do.
template <class P>
void Sticking<P>::find_leaders() {
  for (ContactLanes<P>& c : m_.contacts) c.leading = c.sticking;
  for (size_t p = 0; p < m_.alike.size(); ++p) {
    const auto [first, second] = m_.pattern.alike[p];
    m_.contacts[second].leading &= ~(m_.contacts[first].sticking & m_.alike[p]);
  }
}

/// Solves influence_ x = work_ with its triangular factors; x in work_.
template <class P>
HWY_ATTR void Sticking<P>::solve_influence() {
  const size_t m = m_.contacts.size();
  for (size_t i = 1; i < m; ++i) {
    for (size_t j = 0; j < i; ++j) work_[i] = fnma(influence_[i * m + j], work_[j], work_[i]);
  }
  for (size_t i = m; i-- > 0;) {
    for (size_t j = i + 1; j < m; ++j) work_[i] = fnma(influence_[i * m + j], work_[j], work_[i]);
    work_[i] = work_[i] / influence_[i * m + i];
  }
}

/// What a unit of tau_j does to the left side of contact i, in triangular factors.
template <class P>
HWY_ATTR void Sticking<P>::find_influence() {
  const size_t m = m_.contacts.size();
  P ax, ay;
  influence_.assign(m * m, P(0.0));
  for (size_t j = 0; j < m; ++j) {
    work_.assign(static_cast<size_t>(m_.n), P(0.0));
    m_.contacts[j].push(work_.data(), -m_.contacts[j].dy[0], m_.contacts[j].dx[0]);
    for (size_t i = 0; i < m; ++i) {
      const ContactLanes<P>& c = m_.contacts[i];
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

/// tau_k of sticking contacts, from a slip velocity that stays zero.
///
///   Omega R + (d x d') / r = 0   =>   d x d'' = -Omega R r'
///
/// Coefficient k of this is linear in the tau_k of all sticking contacts; lanes and contacts that
/// do not stick, or leave it to another that slips alike, have a one on the diagonal and zero on
/// the right.
template <class P>
HWY_ATTR void Sticking<P>::add(int k) {
  const size_t m = m_.contacts.size();
  P* acceleration = m_.term(k + 2);  // not yet integrated
  P ax, ay;
  if (k == 0) find_influence();
  work_.assign(m, P(0.0));
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    c.displacement(acceleration, ax, ay);
    P sum = fma(c.dx[0], ay, -(c.dy[0] * ax));
    for (int j = 1; j <= k; ++j) sum = fma(c.dx[j], c.ay[k - j], fnma(c.dy[j], c.ax[k - j], sum));
    sum = fma(c.rim, P(k + 1.0) * c.r[k + 1], sum);
    work_[i] = select(mask_of<P>(c.leading), sum, P(0.0));
  }
  solve_influence();
  for (size_t i = 0; i < m; ++i) {
    ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    const P tau = work_[i];
    c.tau[k] = c.tau[k] + tau;
    c.push(acceleration, -(tau * c.dy[0]), tau * c.dx[0]);
  }
  for (ContactLanes<P>& c : m_.contacts) {
    if ((c.sticking & m_.active) == 0) continue;
    c.displacement(acceleration, c.ax[k], c.ay[k]);
  }
}

/// Change of the friction of sticking contacts, so that a column stays without slip:
///
///   d(d) x d'' + d x d(d'') + Omega R d(r)' = 0
template <class P>
HWY_ATTR void Sticking<P>::add_to_column(typename Tangents<P>::Track& track, int k) {
  const size_t m = m_.contacts.size();
  const auto term = [&](int of) { return track.terms.data() + of * m_.n; };
  P* acceleration = term(k + 2);  // not yet integrated
  P ax, ay;
  work_.assign(m, P(0.0));
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    auto& u = track.contacts[i];
    const typename P::Mask sticks = mask_of<P>(c.sticking);
    P fx(0.0), fy(0.0);  // of the changes of tau found so far
    for (int j = 0; j < k; ++j) {
      fx = fnma(u.tau[j], c.dy[k - j], fx);
      fy = fma(u.tau[j], c.dx[k - j], fy);
    }
    c.push(acceleration, fx, fy);
    if (c.rows.is_plane) {  // its d and r do not change
      u.r[k + 1] = P(0.0);
      continue;
    }
    c.displacement(term(k + 1), u.dx[k + 1], u.dy[k + 1]);
    if (k == 0) u.r[0] = fma(c.dx[0], u.dx[0], c.dy[0] * u.dy[0]) / c.r[0];
    P along(0.0);
    for (int j = 0; j <= k + 1; ++j) {
      along = fma(c.dx[j], u.dx[k + 1 - j], fma(c.dy[j], u.dy[k + 1 - j], along));
    }
    for (int j = 1; j <= k + 1; ++j) along = fnma(c.r[j], u.r[k + 1 - j], along);
    u.r[k + 1] = select(sticks, along / c.r[0], P(0.0));
  }
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    auto& u = track.contacts[i];
    c.displacement(acceleration, ax, ay);
    P sum = fma(c.dx[0], ay, -(c.dy[0] * ax));
    for (int j = 1; j <= k; ++j) sum = fma(c.dx[j], u.ay[k - j], fnma(c.dy[j], u.ax[k - j], sum));
    for (int j = 0; j <= k && !c.rows.is_plane; ++j) {
      sum = fma(u.dx[j], c.ay[k - j], fnma(u.dy[j], c.ax[k - j], sum));
    }
    sum = fma(c.rim, P(k + 1.0) * u.r[k + 1], sum);
    work_[i] = select(mask_of<P>(c.leading), sum, P(0.0));
  }
  solve_influence();
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    const P tau = work_[i];
    track.contacts[i].tau[k] = tau;
    c.push(acceleration, -(tau * c.dy[0]), tau * c.dx[0]);
  }
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.sticking & m_.active) == 0) continue;
    c.displacement(acceleration, track.contacts[i].ax[k], track.contacts[i].ay[k]);
  }
}

/// Lanes in which a contact sticks that slips as contact i would.
template <class P>
uint64_t joins_sticking(const MotionLanes<P>& m, size_t i) {
  uint64_t lanes = 0;
  for (size_t p = 0; p < m.alike.size(); ++p) {
    const auto [first, second] = m.pattern.alike[p];
    if (first == i) lanes |= m.alike[p] & m.contacts[second].sticking;
    if (second == i) lanes |= m.alike[p] & m.contacts[first].sticking;
  }
  return lanes;
}

/// Takes off the slip that sticking contacts of a lane have gathered by rounding and truncation.
template <class P>
HWY_ATTR void remove_slip(MotionLanes<P>& m, const ContactSystem& system, int l) {
  if constexpr (!P::is_double) return;  // what double computes would be worse than what is left
  const uint64_t bit = uint64_t{1} << l;
  const auto sticks = [&](const ContactLanes<P>& c) { return (c.sticking & bit) != 0; };
  if (std::none_of(m.contacts.begin(), m.contacts.end(), sticks)) return;
  const ContactStates states = m.contacts_of(l);
  Vec y = m.state_of(l);
  system.remove_slip(y.data(), states);
  m.set_state(l, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
