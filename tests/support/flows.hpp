#pragma once
// Flow maps of plain equations, to test shooting and continuation on.

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "libdyn/orbits/shooting.hpp"

namespace whirl::test {

/// y' = f(t, y) with its derivative by y.
struct Equation {
  std::function<void(double t, const Vec& y, Vec& f, Mat& J)> rates;
};

/// Moves a state and its tangent on over a time, by extrapolated midpoint rules of order 12.
/// @source [HairerNorsettWanner1993], II.9
inline void move_on(const Equation& equation, double t, double duration, int steps, Vec& y,
                    Mat& Y) {
  const Eigen::Index n = y.size();
  Vec f(n);
  Mat J(n, n);
  const auto rate = [&](double at, const Mat& Z) -> Mat {  // Z = (y, Y)
    equation.rates(at, Z.col(0), f, J);
    Mat dZ(n, n + 1);
    dZ << f, J * Z.rightCols(n);
    return dZ;
  };
  Mat Z(n, n + 1);
  Z << y, Y;
  const double H = duration / steps;
  for (int s = 0; s < steps; ++s) {
    const double at = t + H * s;
    std::vector<Mat> row;
    for (int j = 0; j < 6; ++j) {
      const int parts = 2 * (j + 1);
      const double h = H / parts;
      Mat before = Z, now = Z + h * rate(at, Z);
      for (int k = 1; k < parts; ++k) {
        Mat next = before + 2.0 * h * rate(at + h * k, now);
        before = std::move(now);
        now = std::move(next);
      }
      Mat T = 0.5 * (now + before + h * rate(at + H, now));  // Gragg's last step
      for (int k = 1; k <= j; ++k) {
        const double ratio = double(j + 1) / double(j + 1 - k);
        Mat better = T + (T - row[std::size_t(k - 1)]) / (ratio * ratio - 1.0);
        row[std::size_t(k - 1)] = std::move(T);
        T = std::move(better);
      }
      row.push_back(std::move(T));
    }
    Z = row.back();
  }
  y = Z.col(0);
  Y = Z.rightCols(n);
}

/// The flow over periods of an equation that is driven with this period.
inline Flow flow_of(const Equation& equation, int size, double period, int steps = 40) {
  return {Vec::Ones(size), period, [=](std::span<const Vec> starts, long revolutions, WithTangent) {
            std::vector<FlowResult> all;
            for (const Vec& start : starts) {
              FlowResult p{start, Mat::Identity(size, size), {}, {}};
              for (long r = 0; r < revolutions; ++r) {
                move_on(equation, 0.0, period, steps, p.end, p.tangent);
              }
              all.push_back(std::move(p));
            }
            return all;
          }};
}

/// x'' + 2 zeta x' + a x + b x^3 = F cos(w t) as an equation of (x, x').
struct Duffing {
  double zeta = 0.05, a = 1.0, b = 1.0, F = 0.3, w = 1.0;

  Equation equation() const {
    return {[p = *this](double t, const Vec& y, Vec& f, Mat& J) {
      f << y(1),
          p.F * std::cos(p.w * t) - 2.0 * p.zeta * y(1) - p.a * y(0) - p.b * y(0) * y(0) * y(0);
      J << 0.0, 1.0, -p.a - 3.0 * p.b * y(0) * y(0), -2.0 * p.zeta;
    }};
  }
  Flow flow() const { return flow_of(equation(), 2, 2.0 * std::numbers::pi / w); }
};

/// A map y -> f(y) as a flow.
inline Flow map_flow(int size, std::function<void(const Vec& y, Vec& f, Mat& J)> f) {
  return {Vec::Ones(size), 1.0, [=](std::span<const Vec> starts, long n, WithTangent) {
            std::vector<FlowResult> all;
            for (const Vec& start : starts) {
              FlowResult p{start, Mat::Identity(size, size), {}, {}};
              Vec next(size);
              Mat J(size, size);
              for (long i = 0; i < n; ++i) {
                f(p.end, next, J);
                p.end = next;
                p.tangent = J * p.tangent;
              }
              all.push_back(std::move(p));
            }
            return all;
          }};
}

/// Folds of one harmonic of Duffing's equation, a^2 ((1 + 3/4 b a^2 - w^2)^2 + (2 zeta w)^2) = F^2:
/// the largest and smallest frequency above resonance, as amplitudes go down.
inline std::pair<double, double> harmonic_folds(double zeta, double b, double F) {
  const auto frequency = [&](double a) {
    const double k = 1.0 + 0.75 * b * a * a - 2.0 * zeta * zeta, k0 = 1.0 + 0.75 * b * a * a;
    const double root = k * k - k0 * k0 + F * F / (a * a);
    return root < 0.0 ? -1.0 : std::sqrt(k + std::sqrt(root));
  };
  double upper = 0.0, lower = 1e300;
  double a = F / (2.0 * zeta);  // above the largest amplitude
  while (frequency(a) < 0.0) a *= 0.99999;
  for (double last = 0.0; frequency(a) >= last; a *= 0.99999) upper = last = frequency(a);
  for (lower = upper; frequency(a) <= lower; a *= 0.99999) lower = frequency(a);
  return {upper, lower};
}

/// z' = z (1 + a - |z|^2) exp(i (circle_angle + circle_twist |z|^2)) for the first two coordinates
/// of a map, z = x + i y: the circle |z| = sqrt(a) is turned by circle_angle + circle_twist a, and
/// its exponent is log(1 - 2 a).
constexpr double circle_angle = 2.4, circle_twist = 0.7;
inline void turn_circle(double a, const Vec& y, Vec& f, Mat& J) {
  const double x = y(0), w = y(1), r2 = x * x + w * w, s = 1.0 + a - r2;
  const double t = circle_angle + circle_twist * r2, c = std::cos(t), d = std::sin(t);
  const double p = c * x - d * w, q = d * x + c * w;
  f.head(2) << s * p, s * q;
  J.topLeftCorner(2, 2) << s * c - 2.0 * x * p - s * q * 2.0 * circle_twist * x,
      -s * d - 2.0 * w * p - s * q * 2.0 * circle_twist * w,
      s * d - 2.0 * x * q + s * p * 2.0 * circle_twist * x,
      s * c - 2.0 * w * q + s * p * 2.0 * circle_twist * w;
}

}  // namespace whirl::test
