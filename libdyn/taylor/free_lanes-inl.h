// Motions that never touch again, in closed form.

#if defined(WHIRL_FREE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_FREE_LANES_INL_H
#undef WHIRL_FREE_LANES_INL_H
#else
#define WHIRL_FREE_LANES_INL_H
#endif

#include "libdyn/taylor/lane_record.hpp"
#include "libdyn/taylor/motion_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Ends a trajectory in closed form where no contact can ever happen again; looked into after 1, 2,
/// 4, ... revolutions without contact.
/// @return  revolutions that it went on by
template <class P>
HWY_ATTR long fly_on(MotionLanes<P>& m, LaneRecord& record, bool wants_sections, int l) {
  const uint64_t bit = uint64_t{1} << l;
  uint64_t near = 0;
  for (const ContactLanes<P>& c : m.contacts) near |= c.touching | c.receding;
  if ((near & bit) != 0 || record.events != record.events_before) {
    record.events_before = record.events;
    record.free_since = record.revolution;
    record.certificate_due = record.revolution + 1;
    return 0;
  }
  if (record.revolution < record.certificate_due || record.revolution >= record.last) return 0;
  record.certificate_due = 2 * record.revolution - record.free_since;
  Trajectory& t = *record.trajectory;
  if (!record.free_flight) record.free_flight = std::make_unique<FreeFlight>(*t.system);
  MotionState state = motion_of(m, record.revolution, l);
  if (!record.free_flight->is_certain(state)) return 0;
  const long before = record.revolution;
  while (record.revolution < record.last) {
    const long to = wants_sections ? record.revolution + 1 : record.last;
    record.free_flight->finish(state, to);
    record.revolution = to;
    if (wants_sections) t.sections.insert(t.sections.end(), state.y.begin(), state.y.end());
  }
  m.set_state(l, state.y);
  return record.revolution - before;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
