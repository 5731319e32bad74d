// Series of the motion: coefficients of all coordinates, order by order.

#if defined(WHIRL_MOTION_SERIES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_MOTION_SERIES_INL_H
#undef WHIRL_MOTION_SERIES_INL_H
#else
#define WHIRL_MOTION_SERIES_INL_H
#endif

#include <vector>

#include "libdyn/taylor/sticking-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Makes the series of the motion in a step: forces of an order, then the acceleration, then the
/// coordinates two orders on.
template <class P>
class MotionSeries {
 public:
  MotionSeries(MotionLanes<P>& of, Sticking<P>& sticking) : m_(of), sticking_(sticking) {}

  HWY_ATTR void find();

 private:
  __attribute__((flatten)) HWY_ATTR void find_of_any();
  // motion_bodies-inl.h
  template <int Bodies, bool Isotropic, class V, class Law>
  __attribute__((flatten)) HWY_ATTR void find_of_bodies(Law& law);

  MotionLanes<P>& m_;
  Sticking<P>& sticking_;
  std::vector<AnyLawWork<P>> laws_;
};

/// Coefficients x_{k+2} from those up to k + 1:  x'' = f - K x - D x' - sum B F.
template <class P>
HWY_ATTR void MotionSeries<P>::find() {
  laws_.clear();
  sticking_.find_leaders();
  for (ContactLanes<P>& c : m_.contacts) {
    c.begin(m_.active, m_.N + 2);
    if (c.disk && !c.is_evaluated) {  // most of many blades: nothing is built for their force
      laws_.emplace_back(std::in_place_type<LawWork<P, Radial<P>>>, Radial<P>{});
      continue;
    }
    with_alternative(c.law, [&](const auto& law) HWY_ATTR {
      using Law = std::remove_cvref_t<decltype(law)>;
      laws_.emplace_back(std::in_place_type<LawWork<P, Law>>, law);
    });
  }
  if (!m_.is_rotor_in_stator()) return find_of_any();
  with_alternative(laws_[0], [&](auto& law) HWY_ATTR {
    if constexpr (std::remove_cvref_t<decltype(law)>::is_of_bodies) {
      if constexpr (carries_slopes<P>) {
        m_.equations.linear_is_flat&& m_.contacts[0].rows_are_flat
            ? find_of_bodies<2, false, PlainOf<P>>(law)
            : find_of_bodies<2, false, P>(law);
      } else {
        m_.pattern.is_isotropic ? find_of_bodies<2, true, P>(law)
                                : find_of_bodies<2, false, P>(law);
      }
    }
  });
}

/// The same for any system.
template <class P>
HWY_ATTR void MotionSeries<P>::find_of_any() {
  std::copy(m_.y.begin(), m_.y.end(), m_.term(0));
  const int N = m_.N;
  m_.equations.linear_is_flat ? m_.equations.template find_load<PlainOf<P>>(m_.clock, N + 1)
                              : m_.equations.template find_load<P>(m_.clock, N + 1);
  const bool any_sticks = m_.any_sticks();
  for (ContactLanes<P>& c : m_.contacts) {
    if (c.shapes) c.shapes->start(m_.clock.time);
  }
  for (const auto& disk : m_.disks) {
    disk->start(m_.clock.time);
    extend(*disk, m_.contacts, m_.term(0), 0);
  }
  for (int k = 0; k <= N; ++k) {
    P* acceleration = m_.term(k + 2);  // not yet integrated
    for (const auto& disk : m_.disks) extend(*disk, m_.contacts, m_.term(k + 1), k + 1);
    for (size_t i = 0; i < m_.contacts.size(); ++i) {  // before all else: this takes longest
      ContactLanes<P>& c = m_.contacts[i];
      if (c.disk && !c.is_evaluated) continue;  // in EventFinder, if at all
      if (k == 0) c.first_geometry(m_.term(0));
      if (c.is_ahead) {
        c.geometry(m_.term(k + 1), k + 1, true);
      } else if (k > 0) {
        c.geometry(m_.term(k), k, c.is_evaluated);
      }
      if (c.rub && c.is_ahead) c.rub->velocity(m_.term(k + 1), k);
      if (c.is_evaluated) c.force(laws_[i], k);
    }
    const auto accelerate = [&]<class V, class W>() HWY_ATTR {
      m_.equations.template accelerate<V, W>(k, m_.term(k), m_.term(k + 1), acceleration);
    };
    using Plain = PlainOf<P>;
    if (m_.equations.linear_is_flat)
      accelerate.template operator()<Plain, Plain>();
    else if (m_.equations.damping_is_flat)
      accelerate.template operator()<P, Plain>();
    else
      accelerate.template operator()<P, P>();
    for (const ContactLanes<P>& c : m_.contacts) {
      if (!c.is_evaluated) continue;
      c.push(acceleration, c.fx, c.fy);
      if (c.rub) c.rub->push(acceleration, c.rub->fx, c.rub->fy);
    }
    for (const auto& film : m_.films) film->add(m_.term(k), m_.term(k + 1), k, acceleration);
    if (any_sticks) sticking_.add(k);
    const PlainOf<P> scale(twice_integrated<P>(k));
    for (int i = 0; i < m_.n; ++i) acceleration[i] = scale * acceleration[i];
  }
  // to be as good as the state, the square of the distance needs two more
  for (const auto& disk : m_.disks) extend(*disk, m_.contacts, m_.term(N + 2), N + 2);
  for (ContactLanes<P>& c : m_.contacts) {
    if (c.disk && !c.is_evaluated) continue;
    if (!c.is_ahead) c.geometry(m_.term(N + 1), N + 1, false);
    c.geometry(m_.term(N + 2), N + 2, false);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
