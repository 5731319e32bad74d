// The motions in all lanes: what every part of the engine looks at.

#if defined(WHIRL_MOTION_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_MOTION_LANES_INL_H
#undef WHIRL_MOTION_LANES_INL_H
#else
#define WHIRL_MOTION_LANES_INL_H
#endif

#include <algorithm>
#include <memory>
#include <vector>

#include "libdyn/taylor/blade_disks-inl.h"
#include "libdyn/taylor/clock_lanes-inl.h"
#include "libdyn/taylor/contact_loading-inl.h"
#include "libdyn/taylor/equation_lanes-inl.h"
#include "libdyn/taylor/film_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Orders of series: that of the first step, and the largest one of any.
struct SeriesOrders {
  int first, most;
};

/// A motion per lane: its equations, its state at the start of a step, its series in the step.
template <class P>
struct MotionLanes {
  using Number = typename P::Number;

  const Pattern& pattern;
  int N, n;             ///< order of the series in this step, coordinates
  int most;             ///< largest order that there is memory for
  uint64_t active = 0;  ///< lanes that have a motion

  ClockLanes<P> clock;
  EquationLanes<P> equations;
  std::vector<ContactLanes<P>> contacts;
  std::vector<uint64_t> alike;  ///< per pair of Pattern::alike, the lanes in which they slip alike
  std::vector<std::unique_ptr<BladeLanes<P>>> disks;  ///< of contacts with blades
  std::vector<std::unique_ptr<FilmLanes<P>>> films;
  std::vector<P> scale;     ///< 1 / state_scale of the coordinates
  bool is_analytic = true;  ///< all laws are, and there is no film

  std::vector<P> y;      ///< states at the start of the step
  std::vector<P> terms;  ///< coefficients 0 to N + 2 of the coordinates, order after order

  MotionLanes(const Pattern& of, SeriesOrders orders, bool has_slopes)
      : pattern(of), N(orders.first), n(of.n), most(orders.most), equations(of, most + 1) {
    terms.assign(static_cast<size_t>(n) * static_cast<size_t>(most + 3), P(0.0));
    scale.assign(static_cast<size_t>(n), P(1.0));
    y.assign(static_cast<size_t>(layout().size()), P(0.0));
    contacts.reserve(pattern.contacts.size());
    for (const Pattern::ContactRows& rows : pattern.contacts) {
      contacts.emplace_back(rows, most, has_slopes);
      is_analytic = is_analytic && rows.is_analytic;
    }
    disks = disks_of(pattern, contacts);
    alike.assign(pattern.alike.size(), 0);
    for (const Pattern::FilmRows& rows : pattern.films) {
      films.push_back(std::make_unique<FilmLanes<P>>(rows, most, has_slopes));
      is_analytic = false;  // near the wall steps get as short as at a surface
    }
  }

  // parts of the engine refer to it
  MotionLanes(const MotionLanes&) = delete;
  MotionLanes& operator=(const MotionLanes&) = delete;

  StateLayout layout() const { return n; }
  /// Coefficient k of all coordinates.
  HWY_ATTR inline P* term(int k) {
    return terms.data() + static_cast<size_t>(k) * static_cast<size_t>(n);
  }
  /// Whether the kernel of bodies can make this step.
  bool is_rotor_in_stator() const { return pattern.bodies == 2 && !contacts[0].any_has_tau; }
  bool any_sticks() const {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const ContactLanes<P>& c) { return (c.sticking & active) != 0; });
  }

  HWY_ATTR void load(const ContactSystem& s, const MotionState& at, int l);
  HWY_ATTR void load_system(const ContactSystem& s, const MotionState& at, int l);
  HWY_ATTR Vec state_of(int l) const;
  HWY_ATTR void set_state(int l, const Vec& of_lane);
  HWY_ATTR ContactStates contacts_of(int l) const;
  template <int Bodies>
  HWY_ATTR void evaluate(const P* series, const P& h, P* to) const;
};

/// Whether anything asks in which revolution a motion is.
template <class P>
bool counts_revolutions(const MotionLanes<P>& m) {
  return !m.equations.other_loads.empty() || !m.disks.empty();
}

/// Tells all that counts revolutions that a lane begins one.
template <class P>
HWY_ATTR void tell_revolution(MotionLanes<P>& m, const ContactSystem& s, typename P::Number rate,
                              long revolution, int l) {
  m.equations.begin_revolution(s, rate, revolution, l);
  begin_turning(m.disks, m.contacts, s, revolution, l);
}

/// A motion into a lane; its contacts are known.
template <class P>
HWY_ATTR void MotionLanes<P>::load(const ContactSystem& s, const MotionState& at, int l) {
  load_system(s, at, l);
  set_state(l, at.y);
  for (size_t c = 0; c < contacts.size(); ++c) {
    contacts[c].load(s.contacts()[c], at.contacts[c], l, s.phase_rate());
  }
  for (size_t p = 0; p < alike.size(); ++p) {
    put(alike[p], uint64_t{1} << l, s.slip_alike(pattern.alike[p].first, pattern.alike[p].second));
  }
  active |= uint64_t{1} << l;
}

/// Numbers of a system, but for its contacts and where the motion is.
template <class P>
HWY_ATTR void MotionLanes<P>::load_system(const ContactSystem& s, const MotionState& at, int l) {
  equations.load(s, l);
  for (int i = 0; i < n; ++i) {
    set_lane(scale[static_cast<size_t>(i)], l, 1.0 / s.state_scale()(i));
  }
  const Number rate = clock.load(s, at.phase, l);
  for (size_t i = 0; i < films.size(); ++i) films[i]->load(s.films()[i], l);
  for (const auto& disk : disks) disk->load(s.contacts()[disk->first], l, rate);
  tell_revolution(*this, s, rate, at.revolution, l);
}

/// State in a lane, rounded to double.
template <class P>
HWY_ATTR Vec MotionLanes<P>::state_of(int l) const {
  Vec state(layout().size());
  for (int i = 0; i < layout().size(); ++i) state(i) = lane(y[static_cast<size_t>(i)], l);
  return state;
}

template <class P>
HWY_ATTR void MotionLanes<P>::set_state(int l, const Vec& of_lane) {
  for (int i = 0; i < layout().size(); ++i) {
    P& number = y[static_cast<size_t>(i)];
    if constexpr (carries_slopes<P>) {
      number.x = typename P::Value(of_lane(i));  // slopes stay
    } else {
      set_lane(number, l, of_lane(i));
    }
  }
}

template <class P>
HWY_ATTR ContactStates MotionLanes<P>::contacts_of(int l) const {
  ContactStates states;
  for (const ContactLanes<P>& c : contacts) states.push_back(c.state(l));
  return states;
}

/// Values at h of series and of their derivatives, in all active lanes; Bodies as in
/// MotionSeries::find_of_bodies, or 0.
/// Slopes of h come last:  x' += v h',  v' += a h'.
template <class P>
template <int Bodies>
HWY_ATTR void MotionLanes<P>::evaluate(const P* series, const P& h, P* to) const {
  constexpr int at_once = Bodies > 0 ? 2 * Bodies : 2;  // coordinates, whose chains overlap
  const int count = Bodies > 0 ? 2 * Bodies : n;
  P* const rates = StateLayout(count).rates_at(to);
  const typename P::Mask where = mask_of<P>(active);
  const auto& t = as<PlainOf<P>>(h);
  for (int first = 0; first < count; first += at_once) {
    const auto place = [&](int i) { return Bodies > 0 ? i : std::min(first + i, count - 1); };
    P x[at_once], v[at_once];
    const P* now = series + (N + 2) * count;
    each<at_once>(0, [&](int i) HWY_ATTR {
      x[i] = now[place(i)];
      v[i] = P(0.0);
    });
    for (int k = N + 1; k >= 0; --k) {
      now -= count;
      each<at_once>(0, [&](int i) HWY_ATTR {
        v[i] = fma(t, v[i], x[i]);
        x[i] = fma(t, x[i], now[place(i)]);
      });
    }
    each<at_once>(0, [&](int i) HWY_ATTR {
      P &to_x = to[place(i)], &to_v = rates[place(i)];
      to_x = select(where, x[i], to_x);
      to_v = select(where, v[i], to_v);
    });
  }
  if constexpr (carries_slopes<P>) {
    if (is_flat(h)) return;
    for (int i = 0; i < count; ++i) {
      PlainOf<P> a(0.0);
      for (int k = N + 2; k >= 2; --k) {
        a = fma(a, t, PlainOf<P>(k * (k - 1.0)) * series[k * count + i].x);
      }
      to[i].s = fma(wide(rates[i].x), h.s, to[i].s);
      rates[i].s = fma(wide(a), h.s, rates[i].s);
    }
  }
}

/// Where the motion in a lane is.
template <class P>
HWY_ATTR MotionState motion_of(const MotionLanes<P>& m, long revolution, int l) {
  return {revolution, m.clock.phase(l), m.state_of(l), m.contacts_of(l)};
}

/// The step of lane 0, as polynomials in s = t / h.
template <class P>
HWY_ATTR Step step_of(MotionLanes<P>& m, const ContactSystem& system, long revolution, double h) {
  Step step;
  const int N = m.N;
  step.set(system.clock(), {m.clock.phase(0), revolution}, h);
  step.q.resize(m.n, N + 3);
  step.v.resize(m.n, N + 2);
  double power = 1.0;
  for (int k = 0; k <= N + 2; ++k, power *= h) {
    for (int i = 0; i < m.n; ++i) {
      step.q(i, k) = lane(m.term(k)[i], 0) * power;
      if (k <= N + 1) step.v(i, k) = (k + 1) * lane(m.term(k + 1)[i], 0) * power;
    }
  }
  step.contacts = m.contacts_of(0);
  return step;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
