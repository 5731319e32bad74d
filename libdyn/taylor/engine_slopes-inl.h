// Slopes of the engine: a motion over numbers that carry derivatives, sampled at given times.

#if defined(WHIRL_ENGINE_SLOPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_SLOPES_INL_H
#undef WHIRL_ENGINE_SLOPES_INL_H
#else
#define WHIRL_ENGINE_SLOPES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What the engine keeps of slopes.
template <class P>
struct SlopeWork<P, true> {
  explicit SlopeWork(SlopeRun& of) : run(&of) {}

  SlopeRun* run;
  double fastest2 = 0.0;     ///< square of the fastest rate of the linear part [1/s^2]
  double reach = 0.0;        ///< rate times step at which a slope is as exact as the tolerance
  std::vector<double> gain;  ///< per contact, largest eigenvalue of U B [1/kg]
  std::vector<typename Tangents<P>::FilmSlopes> film_slopes;
  typename P::Slopes stretch;  ///< -rate' / rate of the phase: of times at fixed phase
  std::vector<P> sample;
  std::vector<double> passed;  ///< per contact, Graze::margin if its event happens

  // of deviations, whose steps end at the instants of events
  typename P::Slopes moved{0.0};  ///< of the time beyond those at fixed phase
  P length;                       ///< of the step
  std::vector<P> before;  ///< acceleration before a jump of it, until that is known after it
  std::vector<P> along;   ///< per deviation, by how much earlier it meets the event
};

/// Gives the numbers of a loaded system the slopes that its neighbors tell, and states their own.
template <class P>
HWY_ATTR void Engine<P>::load_slopes(const Trajectory& t) {
  auto& slopes = *slopes_;
  const ContactSystem& s = *t.system;
  for (size_t c = 0; c < slopes.run->columns.size(); ++c) {
    const SlopeColumn& column = slopes.run->columns[c];
    const int number = static_cast<int>(c);
    if (!column.parameter) {
      set_lane(y_[static_cast<size_t>(column.start)].s, number, 1.0);
      continue;
    }
    for (size_t j = 0; j < column.parameter->neighbors.size(); ++j) {
      const ContactSystem& neighbor = column.parameter->neighbors[j];
      const int l = lane_of_neighbor(number, static_cast<int>(j));
      load_system(neighbor, t.state, l);
      for (size_t i = 0; i < contacts_.size(); ++i) {
        contacts_[i].load_numbers(neighbor.contacts()[i], l, neighbor.phase_rate());
      }
    }
  }
  const auto& e = equations_;
  is_flat_ = !has_tangents() && is_flat(rate_);
  for (const auto* v : {&e.K, &e.D, &e.A, &e.f0, &e.fc, &e.fs}) is_flat_ = is_flat_ && are_flat(*v);
  for (const OtherLoadLanes<P>& o : e.other_loads) {
    is_flat_ = is_flat_ && is_flat(o.rate) && are_flat(o.fc) && are_flat(o.fs);
  }
  for (ContactLanes<P>& c : contacts_) {
    c.rows_are_flat = are_flat(c.ux) && are_flat(c.uy) && are_flat(c.bx) && are_flat(c.by);
  }
  const double fastest = fastest_mode(s);
  slopes.fastest2 = fastest * fastest;
  slopes.gain.clear();
  for (const ReducedContact& c : s.contacts()) slopes.gain.push_back(contact_gain(c));
  slopes.film_slopes.resize(films_.size());
  // as Tangents::reach
  int sign = 1;
  slopes.reach = std::exp((std::log(options_.tolerance) + ::lgamma_r(N + 4.0, &sign)) / (N + 3.0));
  slopes.stretch = -(rate_.s * wide(typename P::Value(1.0) / rate_.x));
  if (has_tangents()) load_deviations();
}

/// Tells the loads of other frequencies what a revolution begins with beside the system.
template <class P>
HWY_ATTR void Engine<P>::begin_revolution_of_neighbors(long revolution) {
  const auto& columns = slopes_->run->columns;
  for (size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].parameter) continue;
    const auto& neighbors = columns[c].parameter->neighbors;
    for (size_t j = 0; j < neighbors.size(); ++j) {
      equations_.begin_revolution(neighbors[j], neighbors[j].phase_rate(), revolution,
                                  lane_of_neighbor(static_cast<int>(c), static_cast<int>(j)));
    }
  }
}

/// Limits the step where slopes move faster than the motion itself, whichever are asked for.
template <class P>
HWY_ATTR P Engine<P>::limit_for_slopes(const P& h) {
  auto& slopes = *slopes_;
  const double step = lane(h, 0);
  double square = slopes.fastest2, longest = step;
  const auto shorten = [&](double last) {
    const double steep = (log2_tolerance_ - std::log2(std::max(last, 1e-280))) / (N + 1);
    longest = std::min(longest, std::exp2(std::min(steep, 900.0)));
  };
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.touching & active_) == 0) continue;
    const double gain = slopes.gain[i], mu = 1.0 + lane(c.mu, 0), q = std::abs(lane(c.q[0], 0));
    double by_depth[3], by_rate = 0.0;  // coefficients 0, 1 and N
    with_force(c.law, c.rows.has_rate, [&](const auto& force) HWY_ATTR {
      auto depth_slope = derivative<0>(force);
      auto rate_slope = derivative<1>(force);
      for (int k = 0; k <= N; ++k) {
        const double now = std::abs(lane(depth_slope.at(k, c.depth(k), c.rate(k)), 0));
        if (k < 2) by_depth[k] = now;
        by_depth[2] = now;
        if (k == 0 && c.rows.has_rate) {
          by_rate = std::abs(lane(rate_slope.at(0, c.depth(0), c.rate(0)), 0));
        }
        if (k == 1 && c.rows.is_analytic) break;
      }
    });
    const double smoothed =
        c.smooth != 0 ? lane(c.mu, 0) * q * lane(c.r[0], 0) * lane(c.inverse_width, 0) : 0.0;
    const double damping = gain * (by_rate * mu + smoothed);
    square += gain * mu * (by_depth[0] + by_depth[1] * step + q) + damping * damping;
    if (!c.rows.is_analytic) shorten(gain * by_depth[2] / (lane(rate_, 0) * (N + 1.0)));
  }
  for (size_t i = 0; i < films_.size(); ++i) {
    auto& [J, H] = slopes.film_slopes[i];
    films_[i]->find_slopes(J, H, N);
    const double gain = lane(films_[i]->gain, 0);
    const double damping = gain * (lane(H.size(0), 0) + lane(H.size(1), 0) * step);
    square += damping * damping + gain * (lane(J.size(0), 0) + lane(J.size(1), 0) * step);
    shorten(gain * lane(J.size(N), 0) / (lane(rate_, 0) * (N + 1.0)));
  }
  return P(std::min(longest, slopes.reach / std::sqrt(std::max(square, 1e-200))));
}

/// A step to a fixed phase: what changes the speed changes how long it takes,
/// h' = -h rate' / rate. Slopes are then those at fixed phase; the time of a state has slopes, too.
template <class P>
HWY_ATTR P Engine<P>::to_fixed_phase(const P& h) const {
  return {h.x, wide(h.x) * slopes_->stretch - slopes_->moved};
}

/// Time since the start [s].
template <class P>
HWY_ATTR double Engine<P>::elapsed() const {
  const LaneRecord& record = records_[0];
  return static_cast<double>(record.revolution - record.first_revolution) * lane(period_, 0) +
         (lane(time_, 0) - record.first_phase / trajectory_[0]->system->phase_rate());
}

/// Takes the samples within a step of length h.
template <class P>
HWY_ATTR void Engine<P>::take_samples(const P& h) {
  auto& slopes = *slopes_;
  SlopeRun& run = *slopes.run;
  const LaneRecord& record = records_[0];
  const ContactSystem& s = *trajectory_[0]->system;
  const double period = lane(period_, 0), length = lane(h, 0);
  const double before = elapsed();
  while (!run.is_done()) {
    double into = run.times[run.states.size()] - before;
    if (!(into <= length + 1e-14 * period)) return;
    into = std::clamp(into, 0.0, length);
    P place = to_fixed_phase(P(into));
    if (run.held == HeldSample::time) {  // the time before this step, which stretched, is made up
      place.s = -(wide(typename P::Value(before)) * slopes.stretch) - slopes.moved;
    }
    slopes.length = place;
    slopes.sample = y_;
    evaluate<0>(terms_.data(), place, slopes.sample.data());
    Vec y(layout().size());
    Mat by(layout().size(), static_cast<Eigen::Index>(run.columns.size()));
    for (int i = 0; i < layout().size(); ++i) {
      const P& number = slopes.sample[static_cast<size_t>(i)];
      y(i) = lane(number, 0);
      for (int c = 0; c < by.cols(); ++c) by(i, c) = lane(number.s, c);
    }
    const double time = lane(time_, 0) + into;
    const bool turns_over = time >= period * (1.0 - 1e-14);
    run.end = {record.revolution + (turns_over ? 1 : 0), turns_over ? 0.0 : time * s.phase_rate(),
               y, contacts_of(0)};
    run.states.push_back(std::move(y));
    run.slopes.push_back(std::move(by));
  }
}

/// Lets slopes jump with the acceleration at an event of contact i, by how the function of the
/// event changes at its phase: the depth, or the slip.
template <class P>
HWY_ATTR void Engine<P>::jump_slopes(size_t i, EventKind kind, const Saltation& s) {
  const ContactLanes<P>& c = contacts_[i];
  P x = c.dx[0], y = c.dy[0], r(1.0), u, v;
  if (!c.rows.is_plane) {
    c.displacement(y_.data(), x, y);
    x = x - c.offset_x;
    y = y - c.offset_y;
    r = sqrt(fma(x, x, y * y));
  }
  P function;
  if (kind == EventKind::touch) {
    if (c.rows.is_plane) {
      c.displacement(y_.data(), u, v);
      function = fma(x, u, y * v) - c.plane_at;
    } else {
      function = c.wall ? c.wall->at(x, y).depth : r - c.clearance;
    }
  } else {
    if (c.rub) {
      c.rub->lateral(layout().rates_at(y_.data()), u, v);
    } else {
      c.displacement(layout().rates_at(y_.data()), u, v);
    }
    function = c.rim + fnma(y, u, x * v) / r;
  }
  for (int j = layout().place_of_rate(0); j < layout().size(); ++j) {
    P& number = y_[static_cast<size_t>(j)];
    number.s = fma(typename P::Slopes(s.jump(j)), function.s, number.s);
  }
}

/// Begins with the deviations that are asked for.
template <class P>
HWY_ATTR void Engine<P>::load_deviations() {
  const Mat& start = slopes_->run->deviations;
  tangents_->columns.assign(start.data(), start.data() + start.size());
  slopes_->along.clear();
}

/// Looks at a step of length h, and says how slopes move its end: to fixed phase, but with
/// deviations
///
/// - to the instant of an event. Their rate jumps there, and so would they beside that instant;
/// - to the same depth close to the surface of a law that has no Taylor series there, unless a
/// revolution
///   ends: second derivatives of its force grow without bound, but not beside motions that are
///   equally deep;
/// - to the last sample, before any event.
template <class P>
HWY_ATTR P Engine<P>::end_of_step(const P& h, uint64_t& fell, uint64_t ends) {
  auto& slopes = *slopes_;
  const P fixed = to_fixed_phase(h);
  find_grazes(fixed);
  take_samples(fixed);
  if (!has_tangents()) return fixed;
  if (slopes.run->is_done()) {
    fell = 0;
    return slopes.length;
  }
  slopes.length = fell != 0 ? h : ends != 0 || is_analytic_ ? fixed : to_same_depth(fixed);
  slopes.moved = slopes.length.s - fixed.s;
  return slopes.length;
}

/// Gives a time at which the distance of a contact is an event the slopes that hold it there.
template <class P>
HWY_ATTR void Engine<P>::move_with_distance(ContactLanes<P>& c, P& h) const {
  P value, rate;
  c.beyond_at(P(h.x), N + 2, value, rate);
  h.s = -(value.s * wide(typename P::Value(1.0) / rate.x));
}

/// The step to the depth of the contact that is closest to its surface, if one comes from there or
/// goes there.
template <class P>
HWY_ATTR P Engine<P>::to_same_depth(const P& h) {
  P to = h;
  double soonest = std::numeric_limits<double>::infinity();
  for (ContactLanes<P>& c : contacts_) {
    if ((c.touching & 1) == 0 || c.rows.is_analytic) continue;
    P value, rate;
    c.beyond_at(P(h.x), N + 2, value, rate);
    double bend = 0.0;
    for (int k = N + 2; k >= 2; --k) bend = bend * lane(h, 0) + k * (k - 1.0) * lane(c.s[k], 0);
    const double depth = std::abs(lane(value, 0)), speed = std::abs(lane(rate, 0));
    if (!(speed * speed > std::abs(bend) * depth) || !(depth < soonest * speed)) continue;
    soonest = depth / speed;
    to.s = -(value.s * wide(typename P::Value(1.0) / rate.x));
  }
  return to;
}

/// How the function of an event changes along a direction of the state: the distance of a touch
/// times what it is, and that times the slip.
///
/// @param moved, rates  the direction's displacements and velocities
template <class P>
HWY_ATTR P Engine<P>::along_event(const ContactLanes<P>& c, EventKind kind, const P* moved,
                                  const P* rates) const {
  P x = c.dx[0], y = c.dy[0], u, v;
  if (!c.rows.is_plane) {
    c.displacement(y_.data(), x, y);
    x = x - c.offset_x;
    y = y - c.offset_y;
  }
  if (c.wall) {
    const WallGap<P> gap = c.wall->at(x, y);
    x = gap.nx;
    y = gap.ny;
  }
  c.displacement(moved, u, v);
  const P outward = fma(x, u, y * v);
  if (kind == EventKind::touch) return outward;
  const auto lateral = [&](const P* velocity, P& to_x, P& to_y) HWY_ATTR {
    c.rub ? c.rub->lateral(velocity, to_x, to_y) : c.displacement(velocity, to_x, to_y);
  };
  P a, b;
  lateral(rates, a, b);
  const P turned = fnma(y, a, x * b);
  if (c.rows.is_plane) return turned;
  lateral(layout().rates_at(y_.data()), a, b);
  return turned + fma(u, b, fnma(v, a, c.rim * outward / sqrt(fma(x, x, y * y))));
}

/// Notes what a jump of the acceleration at an event of contact i does to deviations, as far as it
/// is known before the next step:  dy+ = dy- + (f+ - f-) (dg / dy dy-) / (dg / dt).
template <class P>
HWY_ATTR void Engine<P>::note_jump(size_t i, EventKind kind) {
  auto& slopes = *slopes_;
  const ContactLanes<P>& c = contacts_[i];
  slopes.before.assign(static_cast<size_t>(n_), P(0.0));
  for (int k = N + 2; k >= 2; --k) {
    const P* x = term(k);
    for (size_t j = 0; j < slopes.before.size(); ++j) {
      slopes.before[j] = fma(slopes.before[j], slopes.length, P(k * (k - 1.0)) * x[j]);
    }
  }
  const P rate = along_event(c, kind, layout().rates_at(y_.data()), slopes.before.data());
  const auto& columns = tangents_->columns;
  slopes.along.clear();
  for (const P* dy = columns.data(); dy != columns.data() + columns.size(); dy += layout().size()) {
    slopes.along.push_back(along_event(c, kind, dy, layout().rates_at(dy)) / rate);
  }
}

/// Lets deviations jump, the acceleration after the event being known.
template <class P>
HWY_ATTR void Engine<P>::jump_deviations() {
  auto& slopes = *slopes_;
  if (slopes.along.empty()) return;  // always where there are no tangents
  P* deviation = tangents_->columns.data();
  for (size_t d = 0; d < slopes.along.size(); ++d) {
    P* rates = layout().rates_at(deviation);
    deviation = layout().end(deviation);
    for (size_t j = 0; j < slopes.before.size(); ++j) {
      const P jump = P(2.0) * term(2)[j] - slopes.before[j];
      rates[j] = fma(jump, slopes.along[d], rates[j]);
    }
  }
  slopes.along.clear();
}

/// Tells where deviations have got to, with their slopes.
template <class P>
HWY_ATTR void Engine<P>::keep_deviations() {
  SlopeRun& run = *slopes_->run;
  for (Eigen::Index d = 0; d < run.deviations.cols(); ++d) {
    Mat& by = run.deviation_slopes.emplace_back(layout().size(), std::ssize(run.columns));
    for (int i = 0; i < layout().size(); ++i) {
      const P& number = tangents_->columns[static_cast<size_t>(layout().size() * d + i)];
      run.deviations(i, d) = lane(number, 0);
      for (int c = 0; c < by.cols(); ++c) by(i, c) = lane(number.s, c);
    }
  }
}

/// Notes an event of contact i, and whether the motion grazes there.
template <class P>
HWY_ATTR void Engine<P>::tell_event(size_t i, EventKind kind, bool jumps) {
  SlopeRun& run = *slopes_->run;
  const double time = elapsed();
  run.events.push_back({time, static_cast<int>(i), kind, jumps});
  const double margin = slopes_->passed[i];
  if (jumps && margin <= run.near) {
    run.grazes.push_back({time, static_cast<int>(i), kind, true, margin});
  }
}

/// Extreme of a function of an event within a step: how far it stays from zero, or goes beyond.
///
/// @param g      coefficients; sign times them is positive before the event
/// @param first  number 0 of them, which may stand elsewhere
/// @param scale  of the margin
template <class P>
HWY_ATTR void Engine<P>::find_graze(const P* g, const P& first, int degree, double sign,
                                    double scale, double h, size_t i, EventKind kind) {
  auto& slopes = *slopes_;
  SlopeRun& run = *slopes.run;
  const auto at = [&](double t, int derivatives) {
    double sum = 0.0;
    for (int k = degree; k >= derivatives; --k) {
      double factor = sign;
      for (int d = 0; d < derivatives; ++d) factor *= k - d;
      sum = sum * t + factor * lane(k == 0 ? first : g[k], 0);
    }
    return sum;
  };
  // were the event not to happen, the function would bend back so far below zero
  const double rate = at(h, 1), bend = at(h, 2);
  slopes.passed[i] =
      bend > 0.0 ? rate * rate / (2.0 * bend) / scale : std::numeric_limits<double>::infinity();
  if (!(at(0.0, 1) < 0.0 && rate > 0.0)) return;  // one that begins flat has just ended sticking
  double low = 0.0, high = h;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (at(middle, 1) <= 0.0 ? low : high) = middle;
  }
  const double margin = at(low, 0) / scale;
  if (margin > run.near) return;
  run.grazes.push_back({elapsed() + low, static_cast<int>(i), kind, false, std::max(margin, 0.0)});
}

/// Looks for grazes in a step of length h: of surfaces where a damped law would begin to push, and
/// of stops of slip.
template <class P>
HWY_ATTR void Engine<P>::find_grazes(const P& h) {
  slopes_->passed.assign(contacts_.size(), std::numeric_limits<double>::infinity());
  const double length = lane(h, 0);
  if (!(length > 0.0)) return;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ContactLanes<P>& c = contacts_[i];
    const bool is_apart = ((c.touching | c.receding) & 1) == 0;
    if (is_apart && (c.continuous & 1) == 0 && !c.disk) {
      const double scale = lane(c.distance_scale, 0) * (c.rows.is_plane ? 1.0 : 2.0);
      find_graze(c.s, c.beyond(), N + 2, -1.0, scale, length, i, EventKind::touch);
    }
    if ((c.touching & c.exact & ~c.sticking & 1) != 0 && c.slip_is_known) {
      find_graze(c.slip, c.slip[0], N, lane(c.sign, 0), lane(c.slip_scale, 0), length, i,
                 EventKind::slip_stop);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
