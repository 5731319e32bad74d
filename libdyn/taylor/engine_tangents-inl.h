// Tangents of the engine: columns of the linearized flow, carried by series of their own.

#if defined(WHIRL_ENGINE_TANGENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_ENGINE_TANGENTS_INL_H
#undef WHIRL_ENGINE_TANGENTS_INL_H
#else
#define WHIRL_ENGINE_TANGENTS_INL_H
#endif

#include <algorithm>
#include <functional>
#include <utility>

#include "libdyn/taylor/engine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

template <class P>
HWY_ATTR void Engine<P>::prepare_tangents() {
  const auto size = static_cast<size_t>(layout().size());
  auto& t = *tangents_;
  t.columns.assign(size * size, P(0.0));
  t.log_sums.assign(size, P(0.0));
  t.weights.assign(size, P(1.0));
  t.weighted.assign(size, P(0.0));
  t.forces.assign(8 * contacts_.size(), P(0.0));  // the second half: friction that acts elsewhere
  t.slopes.resize(contacts_.size());
  t.film_slopes.resize(films_.size());
  for (auto& track : t.tracks) {
    track.contacts.resize(contacts_.size());
    track.films.resize(films_.size());
    track.terms.assign(terms_.size(), P(0.0));
  }
  t.gain.assign(contacts_.size(), P(0.0));
  // the term that is left out, (w h)^(N+3) / (N+3)!, is as large as the tolerance;
  // std::lgamma writes the global signgam, and several threads come here at once
  int sign = 1;
  t.reach = std::exp((std::log(options_.tolerance) + ::lgamma_r(N + 4.0, &sign)) / (N + 3.0));
}

template <class P>
HWY_ATTR void Engine<P>::load_tangents(int l, const ContactSystem& s) {
  auto& t = *tangents_;
  const int size = layout().size();
  Vec scale(size);
  scale << s.state_scale();
  for (int c = 0; c < size; ++c) {
    const auto uc = static_cast<size_t>(c);
    set_lane(t.log_sums[uc], l, 0.0);
    set_lane(t.weights[uc], l, 1.0 / (scale(c) * scale(c)));
    for (int i = 0; i < size; ++i) {
      const double unit = options_.exponents ? scale(i) : 1.0;
      set_lane(t.columns[uc * static_cast<size_t>(size) + static_cast<size_t>(i)], l,
               i == c ? unit : 0.0);
    }
  }
  const double rate = fastest_mode(s);
  set_lane(t.fastest2, l, rate * rate);
  set_lane(t.trace, l, -s.D().trace());
  set_lane(t.divergence, l, 0.0);
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ReducedContact& c = s.contacts()[i];
    set_lane(t.gain[i], l, contact_gain(c));
  }
}

/// Limits the step where tangents move faster than the motion itself.
template <class P>
HWY_ATTR P Engine<P>::limit_for_tangents(const P& h) {
  auto& t = *tangents_;
  P square = t.fastest2, longest = h;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.touching & active_) == 0) continue;
    t.slopes[i].find(c, N);
    const SeriesMatrix<P>&J = t.slopes[i].J, &H = t.slopes[i].H;
    P stiffness = J.size(0) + J.size(1) * h;
    if (t.slopes[i].J_t) stiffness = stiffness + t.slopes[i].J_t->size(0);
    const P damping = t.slopes[i].has_H ? t.gain[i] * H.size(0) : P(0.0);
    const P both_rates = fma(damping, damping, t.gain[i] * stiffness);
    square = square + select(c.in_touch, both_rates, P(0.0));
    if (!c.rows.is_analytic) {  // at a surface the slopes change faster than the force
      const P last = max(t.gain[i] * J.size(N), P(1e-280)) / (rate_ * P(N + 1.0));
      const P steep = rough_exp2((P(log2_tolerance_) - rough_log2(last)) * P(1.0 / (N + 1)));
      longest = min(longest, select(c.in_touch, steep, h));
    }
  }
  find_film_slopes(h, square, longest);
  return min(longest, P(t.reach) / sqrt(max(square, P(1e-200))));
}

/// Coefficient k of the acceleration of both columns.
template <class P>
template <int Bodies>
HWY_ATTR inline void Engine<P>::accelerate_columns(int k, const P* forces, P* to_a, P* to_b) {
  auto& [first, second] = tangents_->tracks;
  const int n = Bodies > 0 ? 2 * Bodies : n_;
  const P *a = tangents_->term(first, k), *b = tangents_->term(second, k);
  const P *rate_a = a + n, *rate_b = b + n, *kd = equations_.K.data(), *dd = equations_.D.data();
  const P whole(k + 1.0);
  each<2 * Bodies>(n, [&](int i) HWY_ATTR {
    const P stiffness = kd[i], damping = whole * dd[i];
    to_a[i] = -fma(stiffness, a[i], damping * rate_a[i]);
    to_b[i] = -fma(stiffness, b[i], damping * rate_b[i]);
  });
  const size_t contacts = Bodies > 0 ? 1 : contacts_.size();
  for (size_t c = 0; c < contacts; ++c, forces += 4) {
    const ContactLanes<P>& contact = contacts_[c];
    if ((contact.touching & active_) == 0) continue;
    contact.template push<Bodies>(to_a, forces[0], forces[1]);
    contact.template push<Bodies>(to_b, forces[2], forces[3]);
    if (Bodies == 0 && contact.rub) {
      const P* friction = forces + 4 * contacts;
      contact.rub->push(to_a, friction[0], friction[1]);
      contact.rub->push(to_b, friction[2], friction[3]);
    }
  }
  if (Bodies > 0) return;
  for (const Pattern::OffDiagonal& row : pattern_.off_diagonal) {
    P of_a(0.0), of_b(0.0), of_rate_a(0.0), of_rate_b(0.0);
    const P* entry = equations_.A.data() + row.begin;
    for (const int j : row.of_x) {
      of_a = fma(*entry, a[j], of_a);
      of_b = fma(*entry++, b[j], of_b);
    }
    for (const int j : row.of_rate) {
      of_rate_a = fma(*entry, rate_a[j], of_rate_a);
      of_rate_b = fma(*entry++, rate_b[j], of_rate_b);
    }
    to_a[row.i] = to_a[row.i] - fma(whole, of_rate_a, of_a);
    to_b[row.i] = to_b[row.i] - fma(whole, of_rate_b, of_b);
  }
}

/// Moves all columns over the step h of the motion.
template <class P>
HWY_ATTR void Engine<P>::move_tangents(const P& h) {
  auto& t = *tangents_;
  bool any_sticks = false;
  for (const ContactLanes<P>& c : contacts_) any_sticks = any_sticks || (c.sticking & active_) != 0;
  if constexpr (!carries_slopes<P>) add_divergence(h);
  const size_t size = 2 * static_cast<size_t>(n_), count = t.columns.size() / size;
  for (size_t c = 0; c < count; c += 2) {
    P* y = t.columns.data() + c * size;
    if (is_rotor_in_stator()) {
      move_columns<2>(y, any_sticks, h);
    } else {
      move_columns<0>(y, any_sticks, h);
    }
  }
}

/// Adds what the flow diverges by in the step h.
template <class P>
HWY_ATTR void Engine<P>::add_divergence(const P& h) {
  auto& t = *tangents_;
  const Mask active = mask_of<P>(active_);
  t.divergence = t.divergence + select(active, t.trace * h, P(0.0));
  for (size_t i = 0; i < contacts_.size(); ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.touching & active_) != 0 && t.slopes[i].has_H) {
      t.divergence =
          t.divergence + select(both(active, c.in_touch), contact_divergence(i, h), P(0.0));
    }
  }
  if (!films_.empty()) {
    t.divergence = t.divergence + select(active, film_divergence(h), P(0.0));
  }
}

/// Integral of -trace(H U B) over the step.
template <class P>
HWY_ATTR P Engine<P>::contact_divergence(size_t i, const P& h) {
  const ContactLanes<P>& c = contacts_[i];
  const SeriesMatrix<P>& H = tangents_->slopes[i].H;
  P xx(0.0), xy(0.0), yx(0.0), yy(0.0);  // of U B, or V B_t
  const auto effect = [&](const P& fx, const P& fy, P& to_x, P& to_y) HWY_ATTR {
    work_.assign(static_cast<size_t>(n_), P(0.0));
    if (c.rub) {
      c.rub->push(work_.data(), fx, fy);
      c.rub->lateral(work_.data(), to_x, to_y);
    } else {
      c.push(work_.data(), fx, fy);
      c.displacement(work_.data(), to_x, to_y);
    }
  };
  effect(P(-1.0), P(0.0), xx, yx);
  effect(P(0.0), P(-1.0), xy, yy);
  P integral(0.0);
  for (int k = N; k >= 0; --k) {
    const P trace = fma(H.xx[k], xx, fma(H.xy[k], yx, fma(H.yx[k], xy, H.yy[k] * yy)));
    integral = fma(integral, h, trace * inverse_of<P>(k + 1));
  }
  return -(integral * h);
}

/// Moves two columns, one after the other in memory; Bodies as in series_of.
template <class P>
template <int Bodies>
HWY_ATTR void Engine<P>::move_columns(P* columns, bool any_sticks, const P& h) {
  auto& t = *tangents_;
  auto& [first, second] = t.tracks;
  const int n = Bodies > 0 ? 2 * Bodies : n_;
  const size_t contacts = Bodies > 0 ? 1 : contacts_.size();
  const StateLayout layout(n);
  P* const next = layout.end(columns);
  std::copy(columns, next, first.terms.data());
  std::copy(next, layout.end(next), second.terms.data());
  P local_forces[4], local_a[Bodies > 0 ? 2 * Bodies : 1], local_b[Bodies > 0 ? 2 * Bodies : 1];
  P* forces = Bodies > 0 ? local_forces : t.forces.data();
  for (int k = 0; k <= N; ++k) {
    const P *now = t.term(first, k), *other = t.term(second, k);
    std::fill(forces, forces + (Bodies > 0 ? 4 : 8 * contacts), P(0.0));
    for (size_t i = 0; i < contacts; ++i) {
      const ContactLanes<P>& c = contacts_[i];
      if ((c.touching & active_) == 0) continue;
      const ContactSlopes<P>& slopes = t.slopes[i];
      auto &u = first.contacts[i], &w = second.contacts[i];
      c.template displacement<Bodies>(now, u.dx[k], u.dy[k]);
      c.template displacement<Bodies>(other, w.dx[k], w.dy[k]);
      P* of_contact = forces + 4 * i;
      add_slope_forces(slopes.J, u.dx, u.dy, w.dx, w.dy, k, of_contact);
      if (Bodies == 0 && slopes.has_H) {
        const P whole(k + 1.0);
        for (auto [column, rate] : {std::pair(&u, now + n), std::pair(&w, other + n)}) {
          P vx, vy;
          c.rub ? c.rub->lateral(rate, vx, vy) : c.displacement(rate, vx, vy);
          column->vx[k] = whole * vx;
          column->vy[k] = whole * vy;
        }
        P* of_rate = c.rub ? of_contact + 4 * contacts : of_contact;
        add_slope_forces(slopes.H, u.vx, u.vy, w.vx, w.vy, k, of_rate);
      }
      if (Bodies == 0 && slopes.J_t) {
        add_slope_forces(*slopes.J_t, u.dx, u.dy, w.dx, w.dy, k, of_contact + 4 * contacts);
      }
    }
    P *next_a = t.term(first, k + 2), *next_b = t.term(second, k + 2);
    P *to_a = Bodies > 0 ? local_a : next_a, *to_b = Bodies > 0 ? local_b : next_b;
    accelerate_columns<Bodies>(k, forces, to_a, to_b);
    if constexpr (Bodies == 0) add_film_slopes(k, to_a, to_b);
    if (Bodies == 0 && any_sticks) {
      for (auto& track : t.tracks) stick_column(track, k);
    }
    const P scale(twice_integrated<P>(k));
    each<2 * Bodies>(n, [&](int i) HWY_ATTR {
      next_a[i] = to_a[i] * scale;
      next_b[i] = to_b[i] * scale;
    });
  }
  evaluate<Bodies>(first.terms.data(), h, columns);
  evaluate<Bodies>(second.terms.data(), h, next);
}

/// Change of the friction of sticking contacts, so that a column stays without slip:
///
///   d(d) x d'' + d x d(d'') + Omega R d(r)' = 0
template <class P>
HWY_ATTR void Engine<P>::stick_column(typename Tangents<P>::Track& track, int k) {
  const size_t m = contacts_.size();
  P* acceleration = tangents_->term(track, k + 2);  // not yet integrated
  P ax, ay;
  work_.assign(m, P(0.0));
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    auto& u = track.contacts[i];
    const Mask sticks = mask_of<P>(c.sticking);
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
    c.displacement(tangents_->term(track, k + 1), u.dx[k + 1], u.dy[k + 1]);
    if (k == 0) u.r[0] = fma(c.dx[0], u.dx[0], c.dy[0] * u.dy[0]) / c.r[0];
    P along(0.0);
    for (int j = 0; j <= k + 1; ++j) {
      along = fma(c.dx[j], u.dx[k + 1 - j], fma(c.dy[j], u.dy[k + 1 - j], along));
    }
    for (int j = 1; j <= k + 1; ++j) along = fnma(c.r[j], u.r[k + 1 - j], along);
    u.r[k + 1] = select(sticks, along / c.r[0], P(0.0));
  }
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
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
    const ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    const P tau = work_[i];
    track.contacts[i].tau[k] = tau;
    c.push(acceleration, -(tau * c.dy[0]), tau * c.dx[0]);
  }
  for (size_t i = 0; i < m; ++i) {
    const ContactLanes<P>& c = contacts_[i];
    if ((c.sticking & active_) == 0) continue;
    c.displacement(acceleration, track.contacts[i].ax[k], track.contacts[i].ay[k]);
  }
}

/// Lanes whose columns are to be made orthonormal: at ends of revolutions and every so many of
/// their own steps, so that it does not depend on the neighbors.
template <class P>
HWY_ATTR uint64_t Engine<P>::due_lanes(uint64_t ends) const {
  constexpr long interval = 32;  // steps
  uint64_t due = ends;
  for (uint64_t rest = active_; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    if ((steps_ - records_[static_cast<size_t>(l)].first_step) % interval == 0)
      due |= uint64_t{1} << l;
  }
  return due;
}

/// Makes the columns orthonormal by modified Gram-Schmidt and adds up their growth, in lanes that
/// are due.
template <class P>
HWY_ATTR void Engine<P>::orthonormalize(uint64_t due) {
  if (due == 0) return;
  auto& t = *tangents_;
  const Mask where = mask_of<P>(due);
  const auto size = static_cast<size_t>(layout().size());
  for (size_t c = 0; c < size; ++c) {
    P* a = t.columns.data() + c * size;
    P square(0.0);
    for (size_t i = 0; i < size; ++i) square = fma(t.weights[i] * a[i], a[i], square);
    square = max(square, P(1e-300));  // a column that sticking has made zero
    const P inverse = P(1.0) / sqrt(square);
    t.log_sums[c] = t.log_sums[c] + select(where, P(0.5) * log(square), P(0.0));
    for (size_t i = 0; i < size; ++i) {
      a[i] = select(where, a[i] * inverse, a[i]);
      t.weighted[i] = t.weights[i] * a[i];
    }
    for (size_t other = c + 1; other < size; ++other) {
      P* b = t.columns.data() + other * size;
      P dot(0.0);
      for (size_t i = 0; i < size; ++i) dot = fma(t.weighted[i], b[i], dot);
      dot = select(where, dot, P(0.0));
      for (size_t i = 0; i < size; ++i) b[i] = fnma(dot, a[i], b[i]);
    }
  }
}

/// Adds the growth of the columns to the trajectories whose revolutions end.
template <class P>
HWY_ATTR void Engine<P>::keep_growths(uint64_t ends) {
  for (uint64_t rest = ends; rest != 0; rest &= rest - 1) {
    const int l = __builtin_ctzll(rest);
    std::vector<double>& growths = trajectory_[static_cast<size_t>(l)]->growths;
    for (const P& sum : tangents_->log_sums) growths.push_back(static_cast<double>(lane(sum, l)));
  }
}

/// Lets the columns of a lane jump with the acceleration at an event.
template <class P>
HWY_ATTR void Engine<P>::jump_tangents(int l, const Saltation& s) {
  auto& t = *tangents_;
  const int size = layout().size();
  for (int c = 0; c < size; ++c) {
    P* column = t.columns.data() + static_cast<size_t>(c) * static_cast<size_t>(size);
    double along = 0.0;
    for (int i = 0; i < size; ++i) along += s.gradient(i) * lane(column[i], l);
    for (int i = layout().place_of_rate(0); i < size; ++i)
      set_lane(column[i], l, lane(column[i], l) + s.jump(i) * along);
  }
  set_lane(t.divergence, l, lane(t.divergence, l) + s.log_determinant());
}

template <class P>
HWY_ATTR void Engine<P>::unload_tangents(int l, double time, Trajectory& to) {
  auto& t = *tangents_;
  const int size = layout().size();
  if (options_.tangent) {
    to.tangent.resize(size, size);
    for (int c = 0; c < size; ++c) {
      for (int i = 0; i < size; ++i)
        to.tangent(i, c) = lane(t.columns[static_cast<size_t>(c * size + i)], l);
    }
  } else if (time > 0.0) {  // else it failed at once, and there is nothing to tell
    orthonormalize(uint64_t{1} << l);
    to.exponents.resize(size);
    for (int c = 0; c < size; ++c)
      to.exponents(c) = lane(t.log_sums[static_cast<size_t>(c)], l) / time;
    std::sort(to.exponents.begin(), to.exponents.end(), std::greater<>());
  }
  if (time > 0.0) to.divergence = static_cast<double>(lane(t.divergence, l)) / time;
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
