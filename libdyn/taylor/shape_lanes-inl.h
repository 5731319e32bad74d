// Shapes of the races under a rolling element in all lanes.

#if defined(WHIRL_SHAPE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WHIRL_SHAPE_LANES_INL_H
#undef WHIRL_SHAPE_LANES_INL_H
#else
#define WHIRL_SHAPE_LANES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <vector>

#include "libdyn/system/contact_system.hpp"
#include "libdyn/taylor/clock_lanes-inl.h"
#include "libdyn/taylor/series-inl.h"

HWY_BEFORE_NAMESPACE();
namespace whirl::inline dyn {
namespace HWY_NAMESPACE {

/// What stands out of the races under an element (geometry::RaceShape), over time. With c = cos a,
/// a the angle of the shape under the element, E = exp(s (c - 1)) is the solution of E' = s c' E.
template <class P>
struct ShapeLanes {
  struct One {
    bool is_spall;
    P height{0.0}, ratio{0.0}, rate{0.0}, start{0.0}, begin{0.0}, sharpness{0.0};
    P cosine[P::most_terms], sine[P::most_terms], left[P::most_terms];
  };
  std::vector<One> all;
  P longest{boundless};  ///< step in which the series of all heights are good [s]

  explicit ShapeLanes(const geometry::RollingElements& of) {
    for (const geometry::RaceShape& shape : of.shapes)
      all.emplace_back().is_spall = shape.is_spall();
  }

  HWY_ATTR void load(const ReducedContact& from, typename P::Number rate_of_phase, int l) {
    for (size_t i = 0; i < all.size(); ++i) {
      const geometry::RaceShape& shape = rolling_elements(from.geometry)->shapes[i];
      set_lane(all[i].height, l, shape.height);
      set_lane(all[i].ratio, l, shape.ratio);
      set_lane(all[i].rate, l, rate_of_phase);
      set_lane(all[i].start, l, shape.start);
      set_lane(all[i].sharpness, l, shape.sharpness);
    }
    if (l == 0 || !carries_slopes<P>) set_lane(longest, l, longest_step(from));
  }
  HWY_ATTR void begin_revolution(const ReducedContact& from, long revolution, int l) {
    for (size_t i = 0; i < all.size(); ++i) {
      set_start_angle(all[i].begin, l, rolling_elements(from.geometry)->shapes[i].ratio,
                      revolution);
    }
  }
  HWY_ATTR void start(const P& time) {
    for (One& one : all) {
      sin_cos(fma(one.ratio, one.rate * time, one.begin) + one.start, one.sine[0], one.cosine[0]);
    }
  }

  /// All heights together at the instant of start().
  HWY_ATTR P height_now() const {
    P sum(0.0);
    for (const One& one : all) {
      const P& c = one.cosine[0];
      sum = fma(one.height, one.is_spall ? exp(one.sharpness * (c - P(1.0))) : c, sum);
    }
    return sum;
  }
  /// Coefficient k of all heights together; call for k = 0, 1, 2, ...
  HWY_ATTR P height(int k) {
    P sum(0.0);
    for (One& one : all) sum = sum + one.height * term(one, k);
    return sum;
  }

 private:
  /// Waves and a bell of this many radians of their angle, and of its width, are good to 1e-10 with
  /// as many terms as a series has.
  static double longest_step(const ReducedContact& from) {
    constexpr double good = 0.8;
    double sharpest = 0.0;
    for (const geometry::RaceShape& shape : rolling_elements(from.geometry)->shapes) {
      const double steep = shape.is_spall() ? std::sqrt(std::max(1.0, shape.sharpness)) : 1.0;
      sharpest = std::max(sharpest, std::abs(shape.speed) * steep);
    }
    return sharpest > 0.0 ? good / sharpest : boundless;
  }
  HWY_ATTR P term(One& one, int k) {
    if (k > 0) {
      const P turn = one.ratio * one.rate * P(inverse_of<P>(k));
      one.sine[k] = turn * one.cosine[k - 1];
      one.cosine[k] = -(turn * one.sine[k - 1]);
    }
    if (!one.is_spall) return one.cosine[k];
    if (k == 0) return one.left[0] = exp(one.sharpness * (one.cosine[0] - P(1.0)));
    P sum(0.0);
    for (int i = 1; i <= k; ++i) sum = fma(P(double(i)) * one.cosine[i], one.left[k - i], sum);
    return one.left[k] = one.sharpness * sum * P(inverse_of<P>(k));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace whirl::inline dyn
HWY_AFTER_NAMESPACE();

#endif  // guard
