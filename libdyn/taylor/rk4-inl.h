// RK4 in lanes: one motion per lane, all in lock step.

#if defined(WHIRL_RK4_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_RK4_INL_H
#undef WHIRL_RK4_INL_H
#else
#define WHIRL_RK4_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "libdyn/system/equal_steps.hpp"
#include "libdyn/system/failure_text.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/blade_disks-inl.h"
#include "libdyn/taylor/contact_loading-inl.h"
#include "libdyn/taylor/equation_lanes-inl.h"
#include "libdyn/taylor/film_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Where the rotor is beside the surface of a contact; d and r are those of ContactLanes.
template <class P>
struct PlaceOfContact {
  P dx, dy;                  // d; at first the displacement
  P depth, inverse_r{1.0};   // inverse_r: 1 / r
  P tip_x{0.0}, tip_y{0.0};  // of a blade, from the disk's center
  typename P::Mask beyond;   // lanes in which it is beyond the surface

  /// From the displacement to the place; whether a lane is beyond the surface.
  HWY_INLINE HWY_ATTR bool find(const ContactLanes<P>& c) {
    return c.rows.is_plane     ? find_on_plane(c)
           : c.wall            ? find_on_wall(c)
           : c.rows.is_rolling ? find_on_element(c)
                               : find_on_circle(c);
  }

 private:
  HWY_INLINE HWY_ATTR bool find_on_circle(const ContactLanes<P>& c) {
    dx = dx - c.offset_x;
    dy = dy - c.offset_y;
    if (c.disk) {
      const P &cosine = c.disk->cosine[0], &sine = c.disk->sine[0];
      tip_x = c.disk->radius * fnma(sine, c.blade_sine, cosine * c.blade_cosine);
      tip_y = c.disk->radius * fma(cosine, c.blade_sine, sine * c.blade_cosine);
      dx = dx + tip_x;
      dy = dy + tip_y;
    }
    const P s = fma(dx, dx, dy * dy);
    beyond = less(c.clearance2, s);
    if (!any(s, beyond)) return false;
    const P r = sqrt(select(beyond, s, c.clearance2));
    inverse_r = P(1.0) / r;
    depth = r - c.clearance;
    return true;
  }

  /// d is the direction n of the element, which turns; r is one. The depth n . u - play changes as
  /// n turns as if the place moved with a tip at -u.
  HWY_INLINE HWY_ATTR bool find_on_element(const ContactLanes<P>& c) {
    tip_x = c.offset_x - dx;
    tip_y = c.offset_y - dy;
    const P &cosine = c.disk->cosine[0], &sine = c.disk->sine[0];
    dx = fnma(sine, c.blade_sine, cosine * c.blade_cosine);
    dy = fma(cosine, c.blade_sine, sine * c.blade_cosine);
    depth = -fma(dx, tip_x, dy * tip_y) - c.plane_at;
    if (c.shapes) depth = depth + c.shapes->height_now();
    const P nothing(0.0);
    beyond = less(nothing, depth);
    if (!any(depth, beyond)) return false;
    depth = select(beyond, depth, c.least_depth);
    return true;
  }

  /// d is the normal, r is one.
  HWY_INLINE HWY_ATTR bool find_on_plane(const ContactLanes<P>& c) {
    const P above = fma(c.dx[0], dx, c.dy[0] * dy) - c.plane_at, nothing(0.0);
    dx = c.dx[0];
    dy = c.dy[0];
    beyond = less(nothing, above);
    depth = select(beyond, above, nothing);
    return any(above, beyond);
  }

  /// d is the normal, r is one.
  HWY_NOINLINE HWY_ATTR bool find_on_wall(const ContactLanes<P>& c) {
    const WallLanes<P>& wall = *c.wall;
    const P x = dx - c.offset_x, y = dy - c.offset_y;
    const P square = wall.square_of(x, y);
    beyond = less(P(1.0), square);
    if (!any(square, beyond)) return false;
    const WallGap<P> gap =
        wall.at(select(beyond, x, wall.harmless_x), select(beyond, y, wall.harmless_y));
    dx = gap.nx;
    dy = gap.ny;
    depth = max(gap.depth, P(0.0));
    return true;
  }
};

/// The classical Runge-Kutta method as methods/rk4.hpp has it: equal steps, contacts and the sign
/// of friction as the state of each stage says.
template <class P>
class Rk4Lanes {
 public:
  using Mask = typename P::Mask;

  explicit Rk4Lanes(const Pattern& pattern)
      : pattern_(pattern), n_(pattern.n), equations_(pattern) {
    for (std::vector<P>* v : {&y_, &stage_, &k_, &sum_, &start_}) {
      v->assign(static_cast<size_t>(layout().size()), P(0.0));
    }
    contacts_.reserve(pattern.contacts.size());
    for (const Pattern::ContactRows& rows : pattern.contacts) {
      contacts_.emplace_back(rows, 0, false);
    }
    for (const Pattern::FilmRows& rows : pattern.films) {
      films_.push_back(std::make_unique<FilmLanes<P>>(rows, 0, false));
    }
    disks_ = disks_of(pattern, contacts_);
    swings_.resize(pattern.other_loads);
  }

  /// Integrates at most as many trajectories as there are lanes.
  HWY_ATTR void run(std::span<Trajectory> all, const IntegrationOptions& options) {
    const int lanes = P::lanes();
    const auto used = static_cast<int>(all.size());
    for (int l = 0; l < lanes; ++l) load(l, all[static_cast<size_t>(std::min(l, used - 1))]);
    uint64_t active = 0;
    for (int l = 0; l < used; ++l) {
      if (all[static_cast<size_t>(l)].revolutions > 0) active |= uint64_t{1} << l;
    }
    for (long revolution = 1; active != 0; ++revolution) {
      const long steps = steps_of_revolution(all, active, options);
      start_ = y_;
      thinnest_ = P(1.0);
      turn(mask_of<P>(active), steps);
      const uint64_t inside = bits(thinnest_, less(P(0.0), thinnest_));
      const uint64_t finite = finite_lanes() & inside;
      for (uint64_t rest = active; rest != 0; rest &= rest - 1) {
        const int l = __builtin_ctzll(rest);
        const uint64_t bit = uint64_t{1} << l;
        Trajectory& t = all[static_cast<size_t>(l)];
        t.cost.steps += steps;
        t.cost.evaluations += 4 * steps;
        const bool is_good = (finite & bit) != 0;
        if (is_good) {
          ++t.state.revolution;
          t.state.phase = 0.0;
          set_lane(time_, l, 0.0);
          begin_revolution(*t.system, t.state.revolution, l);
        }
        if (is_good && revolution < t.revolutions) continue;
        const std::vector<P>& y = is_good ? y_ : start_;
        for (int i = 0; i < layout().size(); ++i) t.state.y(i) = lane(y[static_cast<size_t>(i)], l);
        t.state.contacts = t.system->classify(t.state.instant(), t.state.y.data());
        if (!is_good) {
          const bool left = (inside & bit) == 0;
          t.outcome = left ? Outcome::left_bearing : Outcome::not_finite;
          t.failure = failure_text(*t.system, t.state,
                                   left ? "a step of the next revolution of RK4 leaves a bearing"
                                        : "a revolution of RK4 gave no finite numbers");
        }
        active &= ~bit;
      }
    }
  }

 private:
  StateLayout layout() const { return n_; }
  HWY_ATTR void load(int l, const Trajectory& t) {
    const ContactSystem& s = *t.system;
    equations_.load(s, l);
    for (size_t c = 0; c < contacts_.size(); ++c) {
      contacts_[c].load(s.contacts()[c], {}, l, s.phase_rate());
    }
    for (size_t i = 0; i < films_.size(); ++i) films_[i]->load(s.films()[i], l);
    for (const auto& disk : disks_) disk->load(s.contacts()[disk->first], l, s.phase_rate());
    for (int i = 0; i < layout().size(); ++i) set_lane(y_[static_cast<size_t>(i)], l, t.state.y(i));
    set_lane(rate_, l, s.phase_rate());
    set_lane(period_, l, s.period());
    set_lane(time_, l, t.state.phase / s.phase_rate());
    begin_revolution(s, t.state.revolution, l);
  }

  HWY_ATTR void begin_revolution(const ContactSystem& s, long revolution, int l) {
    equations_.begin_revolution(s, s.phase_rate(), revolution, l);
    begin_turning(disks_, contacts_, s, revolution, l);
  }

  /// Steps of what is left of a revolution: as many as the lane needs that needs most.
  long steps_of_revolution(std::span<const Trajectory> all, uint64_t active,
                           const IntegrationOptions& options) const {
    double most = 1.0;
    for (uint64_t rest = active; rest != 0; rest &= rest - 1) {
      const auto l = static_cast<size_t>(__builtin_ctzll(rest));
      const ContactSystem& s = *all[l].system;
      const double left = s.period() - all[l].state.phase / s.phase_rate();
      most = std::max(most, equal_steps(s.period(), left, options));
    }
    return static_cast<long>(most);
  }

  /// Moves active lanes to the end of their revolution.
  HWY_ATTR void turn(const Mask& active, long steps) {
    const auto size = static_cast<size_t>(layout().size());
    const P h = select(active, (period_ - time_) / P(static_cast<double>(steps)), P(0.0));
    const P half = P(0.5) * h, sixth = h * P(1.0 / 6.0);
    P sine, cosine;
    const auto go_to = [&](const P& time) HWY_ATTR {
      sin_cos(rate_ * time, sine, cosine);
      for (const auto& disk : disks_) disk->start(time);
      for (ContactLanes<P>& c : contacts_) {
        if (c.shapes) c.shapes->start(time);
      }
      for (size_t o = 0; o < swings_.size(); ++o) {
        const OtherLoadLanes<P>& from = equations_.other_loads[o];
        sin_cos(fma(from.rate, time, from.start), swings_[o].sine, swings_[o].cosine);
      }
    };
    go_to(time_);
    for (long step = 0; step < steps; ++step) {
      const P begin = fma(P(static_cast<double>(step)), h, time_);
      derivative(y_.data(), sine, cosine);
      for (size_t i = 0; i < size; ++i) {
        sum_[i] = k_[i];
        stage_[i] = fma(half, k_[i], y_[i]);
      }
      go_to(begin + half);
      derivative(stage_.data(), sine, cosine);
      for (size_t i = 0; i < size; ++i) {
        sum_[i] = fma(P(2.0), k_[i], sum_[i]);
        stage_[i] = fma(half, k_[i], y_[i]);
      }
      derivative(stage_.data(), sine, cosine);
      for (size_t i = 0; i < size; ++i) {
        sum_[i] = fma(P(2.0), k_[i], sum_[i]);
        stage_[i] = fma(h, k_[i], y_[i]);
      }
      go_to(begin + h);
      derivative(stage_.data(), sine, cosine);
      for (size_t i = 0; i < size; ++i) y_[i] = fma(sixth, sum_[i] + k_[i], y_[i]);
    }
  }

  /// k = (eta', eta'') of a state.
  HWY_ATTR void derivative(const P* y, const P& sine, const P& cosine) {
    const EquationLanes<P>& e = equations_;
    P* a = layout().rates_at(k_.data());
    const P* rate = layout().rates_at(y);
    for (int i = 0; i < n_; ++i) {
      const auto ui = static_cast<size_t>(i);
      k_[ui] = rate[i];
      const P load = fma(e.fc[ui], cosine, fma(e.fs[ui], sine, e.f0[ui]));
      a[i] = fnma(e.K[ui], y[i], fnma(e.D[ui], rate[i], load));
    }
    for (size_t o = 0; o < swings_.size(); ++o) {
      const OtherLoadLanes<P>& of = e.other_loads[o];
      for (const int i : pattern_.forced) {
        const auto ui = static_cast<size_t>(i);
        a[i] = a[i] + fma(of.fc[ui], swings_[o].cosine, of.fs[ui] * swings_[o].sine);
      }
    }
    for (const Pattern::CoupledRows& rows : pattern_.coupled) {
      const P* factor = e.A.data() + rows.begin;
      for (const int j : rows.of_x) {
        for (const int i : rows.rows) a[i] = fnma(*factor++, y[j], a[i]);
      }
      for (const int j : rows.of_rate) {
        for (const int i : rows.rows) a[i] = fnma(*factor++, rate[j], a[i]);
      }
    }
    for (const ContactLanes<P>& c : contacts_) push(c, y, a);
    for (const auto& film : films_) film->add_force(y, rate, a, thinnest_);
  }

  /// Adds the force of a contact where it touches and pushes.
  HWY_ATTR void push(const ContactLanes<P>& c, const P* y, P* a) const {
    PlaceOfContact<P> at;
    c.displacement(y, at.dx, at.dy);
    if (c.rows.is_limit) {
      P wx, wy;
      c.rub->lateral(layout().rates_at(y), wx, wy);
      at.dx = at.dx + wx;
      at.dy = at.dy + wy;
    }
    if (!at.find(c)) return;
    P vx, vy;
    c.displacement(layout().rates_at(y), vx, vy);
    if (c.disk) {
      const P spin = c.disk->turns * c.disk->rate;
      vx = fnma(spin, at.tip_y, vx);
      vy = fma(spin, at.tip_x, vy);
    }
    const P rate = fma(at.dx, vx, at.dy * vy) * at.inverse_r, nothing(0.0);
    const P N = with_alternative(
        c.law, [&](const auto& law) HWY_ATTR { return law.normal(at.depth, rate); });
    const P q = select(both(at.beyond, less(nothing, N)), N * at.inverse_r, nothing);
    push_by(c, q, at, vx, vy, y, a);
  }

  /// Adds -(q d + tau rot d), with the velocity (vx, vy) of the place.
  HWY_ATTR inline void push_by(const ContactLanes<P>& c, const P& q, const PlaceOfContact<P>& at,
                               P vx, P vy, const P* y, P* a) const {
    const P &dx = at.dx, &dy = at.dy;
    if (!c.rows.has_friction) {
      c.push(a, q * dx, q * dy);
      return;
    }
    if (c.rub) c.rub->lateral(layout().rates_at(y), vx, vy);
    const P slip = fma(fma(dx, vy, -(dy * vx)), at.inverse_r, c.rim);
    P share = select(both(mask_of<P>(c.exact), less(slip, P(0.0))), P(-1.0), P(1.0));
    if (c.smooth != 0) share = select(mask_of<P>(c.smooth), tanh(slip * c.inverse_width), share);
    const P tau = c.mu * share * q;
    if (c.rub) {
      c.push(a, q * dx, q * dy);
      c.rub->push(a, -(tau * dy), tau * dx);
      return;
    }
    c.push(a, fnma(tau, dy, q * dx), fma(tau, dx, q * dy));
  }

  /// Lanes whose state is one of numbers.
  HWY_ATTR uint64_t finite_lanes() const {
    P sum(0.0);
    for (const P& y : y_) sum = sum + abs(y);
    return bits(sum, less(sum, P(1e300)));
  }

  /// Of a load of another frequency, now.
  struct Swing {
    P sine{0.0}, cosine{1.0};
  };

  const Pattern& pattern_;
  int n_;
  EquationLanes<P> equations_;
  std::vector<Swing> swings_;
  std::vector<ContactLanes<P>> contacts_;
  std::vector<std::unique_ptr<FilmLanes<P>>> films_;
  P thinnest_{1.0};  // gap of a film in this revolution, 1 - x^2 - y^2
  std::vector<std::unique_ptr<BladeLanes<P>>> disks_;
  P rate_{1.0}, period_{1.0};
  std::vector<P> y_, start_;  // now, and at the start of the revolution
  P time_{0.0};               // of the start
  std::vector<P> stage_, k_, sum_;
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
