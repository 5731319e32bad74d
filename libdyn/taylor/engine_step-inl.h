// Steps of the engine: what a step is made of, in order, and the ends of revolutions.

#if defined(WHIRL_ENGINE_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_STEP_INL_H
#undef WHIRL_ENGINE_STEP_INL_H
#else
#define WHIRL_ENGINE_STEP_INL_H
#endif

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Ends the trajectories of lanes that cannot make a step.
template <class P>
HWY_ATTR void Engine<P>::fail_steps(uint64_t bad) {
  const uint64_t numbers = bits(motion_.clock.time, length_.finite),
                 bounded = bits(motion_.clock.time, length_.bounded);
  for (uint64_t rest = bad; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    if (const auto* film = records_[static_cast<size_t>(l)].trajectory->system->left_bearing(
            motion_.state_of(l).data())) {
      fail(l, Outcome::left_bearing, left_bearing_text(*film).c_str());
    } else if ((numbers >> l & 1) == 0) {
      fail(l, Outcome::not_finite, "the state is not finite");
    } else {
      fail(l, Outcome::step_too_small,
           (bounded >> l & 1) != 0 ? "the step underflowed" : boundless_text);
    }
  }
}

template <class P>
HWY_ATTR void Engine<P>::step(const Observer* observer) {
  constexpr Number too_small = 10.0 * P::rounding;  // of a revolution
  constexpr Number brief_step = 1e4 * P::rounding;  // of a revolution; its square is nothing
  if constexpr (carries_slopes<P>) slopes_->choose_order();
  series_.find();
  if constexpr (carries_slopes<P>) slopes_->begin_step();
  P h = length_.find(motion_);
  if constexpr (knows_tangents<P>) {
    if (has_tangents()) h = variation_->limit(h);
  }
  if constexpr (carries_slopes<P>) h = slopes_->limit(h);
  if (options_.fixed_step > 0.0) h = P(options_.fixed_step);
  for (const auto& film : motion_.films) h = film->shortened(h, motion_.N);
  const P left = motion_.clock.left();
  const Mask reaches = less_equal(left * P(Number(1.0) - 100.0 * P::rounding), h);
  const Mask moves = either(reaches, less(motion_.clock.period * P(too_small), h));
  const uint64_t good = bits(h, both(both(length_.finite, length_.bounded), moves));
  uint64_t ends = motion_.active & bits(h, reaches);
  h = select(reaches, left, h);
  const uint64_t bad = motion_.active & ~good;
  if (bad != 0) {
    fail_steps(bad);
    return;  // the others begin this step again
  }
  h = select(mask_of<P>(motion_.active), h, P(0.0));
  uint64_t fell = events_.find(h);
  ends &= ~fell;
  if (options_.measures) measure(motion_, h);
  const uint64_t instant =
      bits(h, less_equal(h, motion_.clock.period * P(too_small))) & motion_.active;
  for (uint64_t rest = instant; rest != 0; rest &= rest - 1) {
    ++records_[static_cast<size_t>(__builtin_ctzll(rest))].no_steps;
  }
  bool goes_on = true;
  if (observer && instant == 0)
    goes_on = (*observer)(
        step_of(motion_, *records_[0].trajectory->system, records_[0].revolution, lane(h, 0)));
  if constexpr (carries_slopes<P>) h = slopes_->end_of_step(h, fell, ends);
  if constexpr (knows_tangents<P>) {
    if (has_tangents()) variation_->move(h);
  }
  if (motion_.pattern.bodies == 2) {
    motion_.template evaluate<2>(motion_.terms.data(), h, motion_.y.data());
  } else {
    motion_.template evaluate<0>(motion_.terms.data(), h, motion_.y.data());
  }
  motion_.clock.move(h, ends);
  ++steps_;
  // where next to no time passed, a contact is still on its surface: others touch at the same
  // instant
  const uint64_t brief = bits(h, less_equal(h, motion_.clock.period * P(brief_step)));
  for (ContactLanes<P>& c : motion_.contacts) {
    for (uint64_t* surface :
         {&c.surface_distance, &c.surface_force, &c.surface_slip, &c.level_slip}) {
      *surface &= brief;
    }
  }
  if (fell != 0) apply_events(instant);
  end_revolutions(ends, observer != nullptr);
  if constexpr (carries_slopes<P>) {
    if (slopes_->is_done()) {
      slopes_->finish();
      finished_ |= 1;
    }
  } else if constexpr (knows_tangents<P>) {
    if (has_tangents() && options_.exponents) end_of_step_of_exponents(ends);
  }
  if (!goes_on) {
    records_[0].trajectory->outcome = Outcome::stopped_by_observer;
    finished_ |= 1;
  }
}

/// Ends a revolution in lanes: the next one begins, or the trajectory is done.
template <class P>
HWY_ATTR void Engine<P>::end_revolutions(uint64_t ends, bool is_observed) {
  for (uint64_t rest = ends; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    LaneRecord& record = records_[static_cast<size_t>(l)];
    ++record.revolution;
    ++watch_.revolutions;
    if (counts_revolutions(motion_)) {
      tell_revolution(motion_, *record.trajectory->system, lane(motion_.clock.rate, l),
                      record.revolution, l);
      if constexpr (carries_slopes<P>) slopes_->begin_revolution(record.revolution);
    }
    remove_slip(motion_, *record.trajectory->system, l);
    if (options_.sections) {
      std::vector<double>& sections = record.trajectory->sections;
      for (const P& y : motion_.y) sections.push_back(lane(y, l));
    }
    const bool is_alone = !is_observed && !has_tangents() && !carries_slopes<P>;
    if (P::is_double && is_alone && motion_.films.empty()) {
      watch_.revolutions += fly_on(motion_, record, options_.sections, l);
    }
    if (record.revolution >= record.last) finished_ |= uint64_t{1} << l;
  }
}

/// Makes columns orthonormal, at ends of revolutions and every so many steps of a lane, so that it
/// does not depend on the neighbors. Keeps what they have grown by at the ends of revolutions,
/// where a trajectory may be told to end.
template <class P>
HWY_ATTR void Engine<P>::end_of_step_of_exponents(uint64_t ends) {
  constexpr long interval = 32;  // steps
  uint64_t due = ends;
  for (uint64_t rest = motion_.active; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    if ((steps_ - records_[static_cast<size_t>(l)].first_step) % interval == 0)
      due |= uint64_t{1} << l;
  }
  variation_->orthonormalize(due);
  for (uint64_t rest = options_.growths ? ends : 0; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    Trajectory& trajectory = *records_[static_cast<size_t>(l)].trajectory;
    variation_->keep_growths(l, trajectory.growths);
    if (options_.is_enough && options_.is_enough(trajectory)) finished_ |= uint64_t{1} << l;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
