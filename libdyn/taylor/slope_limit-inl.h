// How long a step may be for slopes.

#if defined(WHIRL_SLOPE_LIMIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SLOPE_LIMIT_INL_H
#undef WHIRL_SLOPE_LIMIT_INL_H
#else
#define WHIRL_SLOPE_LIMIT_INL_H
#endif

#include <algorithm>
#include <cmath>

#include "libdyn/flow/linear_flow.hpp"
#include "libdyn/taylor/motion_lanes-inl.h"
#include "libdyn/taylor/tangents-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// Shortens steps where slopes move faster than the motion, and chooses how many terms they have.
template <class P>
class SlopeLimit {
 public:
  SlopeLimit(MotionLanes<P>& of, double tolerance)
      : m_(of),
        first_order_(of.N),
        log2_tolerance_(std::log2(tolerance)),
        first_reach_(reach_of_slopes(tolerance, of.N)),
        most_reach_(reach_of_slopes(tolerance, of.most)) {}

  /// @param fastest  rate of the linear part, see fastest_mode [rad/s]
  void load(const ContactSystem& s, double fastest) {
    fastest2_ = fastest * fastest;
    gain_.clear();
    for (const ReducedContact& c : s.contacts()) gain_.push_back(contact_gain(c));
    film_slopes_.resize(s.films().size());
  }
  HWY_ATTR P find(const P& h);
  /// Decides the order of the next step, by values alone.
  void choose_order() { m_.N = is_slow_ ? m_.most : first_order_; }

 private:
  MotionLanes<P>& m_;
  int first_order_;
  bool is_slow_ = false;  // whether slopes make steps much shorter than the motion needs
  double log2_tolerance_;
  double first_reach_, most_reach_;  // largest rate times step, from reach_of_slopes
  double fastest2_ = 0.0;            // square of the fastest rate of the linear part [1/s^2]
  std::vector<double> gain_;         // per contact, largest eigenvalue of U B [1/kg]
  std::vector<typename Tangents<P>::FilmSlopes> film_slopes_;
};

/// Limits the step where slopes move faster than the motion itself, whichever are asked for.
template <class P>
HWY_ATTR P SlopeLimit<P>::find(const P& h) {
  constexpr double much_shorter = 0.5, shorter = 0.8;  // apart, so that the order stays
  const int N = m_.N;
  const double step = lane(h, 0);
  double square = fastest2_, longest = step;
  const auto shorten = [&](double last) {
    const double steep = (log2_tolerance_ - std::log2(std::max(last, 1e-280))) / (N + 1);
    longest = std::min(longest, std::exp2(std::min(steep, 900.0)));
  };
  for (size_t i = 0; i < m_.contacts.size(); ++i) {
    const ContactLanes<P>& c = m_.contacts[i];
    if ((c.touching & m_.active) == 0) continue;
    const double gain = gain_[i], mu = 1.0 + lane(c.mu, 0), q = std::abs(lane(c.q[0], 0));
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
    if (!c.rows.is_analytic) shorten(gain * by_depth[2] / (lane(m_.clock.rate, 0) * (N + 1.0)));
  }
  for (size_t i = 0; i < m_.films.size(); ++i) {
    auto& [J, H] = film_slopes_[i];
    m_.films[i]->find_slopes(J, H, N);
    const double gain = lane(m_.films[i]->gain, 0);
    const double damping = gain * (lane(H.size(0), 0) + lane(H.size(1), 0) * step);
    square += damping * damping + gain * (lane(J.size(0), 0) + lane(J.size(1), 0) * step);
    shorten(gain * lane(J.size(N), 0) / (lane(m_.clock.rate, 0) * (N + 1.0)));
  }
  const double reach = N == first_order_ ? first_reach_ : most_reach_;
  const double by_slopes = reach / std::sqrt(std::max(square, 1e-200));
  is_slow_ = by_slopes < (is_slow_ ? shorter : much_shorter) * longest;
  return P(std::min(longest, by_slopes));
}

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
