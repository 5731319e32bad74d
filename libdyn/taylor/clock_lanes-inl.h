// Angle and time of the rotors in all lanes.

#if defined(WHIRL_CLOCK_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_CLOCK_LANES_INL_H
#undef WHIRL_CLOCK_LANES_INL_H
#else
#define WHIRL_CLOCK_LANES_INL_H
#endif

#include "libdyn/system/contact_system.hpp"
#include "libdyn/taylor/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// start_angle() (libbase/structs/instant.hpp) into a lane.
template <class P>
HWY_ATTR void set_start_angle(P& to, int l, typename P::Number ratio, long revolution) {
  using Number = typename P::Number;
  if constexpr (P::is_double) {
    const bool is_neighbor = carries_slopes<P> && l > 0;  // whose angle must not wrap
    const double turned = 2.0 * P::pi * static_cast<double>(revolution);
    set_lane(to, l, is_neighbor ? ratio * turned : start_angle(ratio, revolution));
  } else {
    const Number turns = ratio * Number(static_cast<double>(revolution));
    const Number whole = Number(static_cast<double>(static_cast<int64_t>(turns)));
    set_lane(to, l, Number(2.0) * P::pi * (turns - whole));
  }
}

/// Clock (libdyn/system/clock.hpp) in lanes: the angle is the time times a rate. Other
/// parts that know that the speed is constant are named in README.md.
template <class P>
struct ClockLanes {
  using Number = typename P::Number;

  P rate{1.0};    ///< of the angle [rad/s]
  P period{1.0};  ///< of a revolution [s]
  P time{0.0};    ///< since the start of the revolution [s]

  /// A revolution is 2 pi to the last digit of P; without spin it is one second.
  /// @param phase  where the motion is [rad]
  /// @return       the rate
  HWY_ATTR Number load(const ContactSystem& s, double phase, int l) {
    const Number whole = Number(2.0) * P::pi;
    const Number of_angle = s.Omega() != 0.0 ? Number(s.phase_rate()) : whole;
    set_lane(rate, l, of_angle);
    set_lane(period, l, whole / of_angle);
    set_lane(time, l, Number(phase) / of_angle);
    return of_angle;
  }
  /// Angle since the start of the revolution [rad].
  /// @tparam V  P, or its value alone
  template <class V = P>
  HWY_ATTR V angle() const {
    return as<V>(rate) * as<V>(time);
  }
  HWY_ATTR double phase(int l) const { return static_cast<double>(lane(angle(), l)); }
  /// Time to the end of the revolution [s].
  HWY_ATTR P left() const { return max(period - time, P(0.0)); }
  /// Goes on by a step; in lanes that end a revolution with it the next one begins.
  HWY_ATTR void move(const P& h, uint64_t ends) {
    time = time + h;
    time = select(mask_of<P>(ends), P(0.0), time);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
