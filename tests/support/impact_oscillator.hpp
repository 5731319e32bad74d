#pragma once
// A driven oscillator that strikes a rigid wall, with its orbits of one impact in closed form.

#include <cmath>
#include <numbers>

#include "libdyn/orbits/shooting.hpp"

namespace whirl::test {

/// x'' + x = A (1 - w^2) cos(w t - 4),  x <= d;  at x = d: x' -> -r x'.
struct ImpactOscillator {
  double A = 1.0, w = 1.6, r = 0.8, d = 1.0;

  double period() const { return 2.0 * std::numbers::pi / w; }

  /// From one period to the next: the solution between impacts is known, impacts are where x = d.
  Flow flow() const {
    return {Vec::Ones(2), period(), [p = *this](std::span<const Vec> starts, long n, WithTangent) {
              std::vector<FlowResult> all;
              for (const Vec& start : starts) all.push_back(p.pass(start, n));
              return all;
            }};
  }

  /// Speeds v before the impact of orbits with one impact a period, A^2 = (d + v k)^2 + (v g)^2
  /// with k = (1 + r) / 2 cot(T / 2), g = (1 - r) / (2 w) [ShawHolmes1983].
  double k() const { return 0.5 * (1.0 + r) / std::tan(0.5 * period()); }
  double g() const { return 0.5 * (1.0 - r) / w; }
  double amplitude(double v) const { return std::hypot(d + v * k(), v * g()); }
  /// Sum of the two multipliers of such an orbit; their product is r^2.
  double trace(double v) const {
    const double T = period(), over_v = (1.0 - w * w) * k() - w * w * d / v;
    return -2.0 * r * std::cos(T) + std::sin(T) * (1.0 + r) * over_v;
  }
  /// The speed at which the trace has a value.
  double speed(double at) const {
    const double T = period(), s = (1.0 + r) * std::sin(T);
    return -s * w * w * d / (at + 2.0 * r * std::cos(T) - s * (1.0 - w * w) * k());
  }

  /// A state of free motion moved on, or back.
  Vec moved(const Vec& y, double from, double to) const {
    const auto driven = [&](double t) {
      return Vec{{A * std::cos(w * t - 4.0), -A * w * std::sin(w * t - 4.0)}};
    };
    return driven(to) + turn(to - from) * (y - driven(from));
  }

 private:
  static Mat turn(double t) { return Mat{{std::cos(t), std::sin(t)}, {-std::sin(t), std::cos(t)}}; }

  FlowResult pass(const Vec& start, long n) const {
    FlowResult p{start, Mat::Identity(2, 2), {{.name = "wall"}}, {}};
    const double T = period(), h = T / 256.0;
    const double end = T * static_cast<double>(n);
    double t = 0.0;
    while (t < end) {
      double to = std::min(t + h, end);
      if (end - to < 1e-12) to = end;
      // the largest x on the way, where x' = 0 if that lies between
      double top = to;
      if (p.end(1) > 0.0 && moved(p.end, t, to)(1) < 0.0) {
        double low = t;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + top);
          (moved(p.end, t, middle)(1) > 0.0 ? low : top) = middle;
        }
      }
      const bool hits = moved(p.end, t, top)(0) > d && p.end(1) > 0.0;
      if (hits) {
        double low = t;
        for (int i = 0; i < 70; ++i) {
          const double middle = 0.5 * (low + top);
          (moved(p.end, t, middle)(0) < d ? low : top) = middle;
        }
        to = top;
      }
      p.end = moved(p.end, t, to);
      p.tangent = turn(to - t) * p.tangent;
      t = to;
      if (!hits) continue;
      const double v = p.end(1), f = A * (1.0 - w * w) * std::cos(w * t - 4.0) - d;
      Mat S{{-r, 0.0}, {(1.0 + r) * f / v, -r}};
      p.tangent = S * p.tangent;
      p.end = Vec{{d, -r * v}};
      p.contacts[0].impacts += 1.0;
      if (p.contacts[0].impacts > 100.0 * static_cast<double>(n)) {
        p.failure = "impacts without end";
        return p;
      }
    }
    return p;
  }
};

}  // namespace whirl::test
