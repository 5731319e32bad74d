// Error and time of Boost.odeint on a case of bench/others.py, as a user of odeint would write it.
//
//   whirl_odeint FILE
//
// The file has numbers: how many coordinates n, then by rows stiffness and damping (n by n), load,
// cosine, sine (n), gap (2 by n), by_force (n by 2), mu, rim, start and end (2 n). What they mean
// is said in bench/other_programs/cases.py.

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numbers>
#include <vector>

namespace {

namespace odeint = boost::numeric::odeint;

using Numbers = std::vector<double>;
constexpr int revolutions = 20, most_runs = 15;
constexpr double most_time = 0.5;

struct Case {
  std::size_t n = 0;
  Numbers stiffness, damping, load, cosine, sine, gap, by_force;
  double mu = 0.0, rim = 0.0;
  Numbers start, end;
};

bool read(std::istream& in, Numbers& into, std::size_t count) {
  into.resize(count);
  for (double& x : into) in >> x;
  return static_cast<bool>(in);
}

bool read(std::istream& in, Case& c) {
  if (!(in >> c.n) || c.n > 1000) return false;
  const std::size_t n = c.n;
  return read(in, c.stiffness, n * n) && read(in, c.damping, n * n) && read(in, c.load, n) &&
         read(in, c.cosine, n) && read(in, c.sine, n) && read(in, c.gap, 2 * n) &&
         read(in, c.by_force, 2 * n) && (in >> c.mu >> c.rim) && read(in, c.start, 2 * n) &&
         read(in, c.end, 2 * n);
}

double dot(const double* a, const double* b, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

void right_hand_side(const Case& c, const Numbers& y, Numbers& dy, double t) {
  const std::size_t n = c.n;
  const double *p = y.data(), *v = p + n;
  const double cosine = std::cos(t), sine = std::sin(t);
  for (std::size_t i = 0; i < n; ++i) {
    dy[i] = v[i];
    dy[n + i] = c.load[i] + c.cosine[i] * cosine + c.sine[i] * sine -
                dot(&c.stiffness[i * n], p, n) - dot(&c.damping[i * n], v, n);
  }
  const double *gx = c.gap.data(), *gy = gx + n;
  const double dx = dot(gx, p, n), dy_gap = dot(gy, p, n), r = std::hypot(dx, dy_gap);
  if (r <= 1.0) return;
  const double nx = dx / r, ny = dy_gap / r;
  const double slip = c.rim - ny * dot(gx, v, n) + nx * dot(gy, v, n);
  const double mu = slip >= 0.0 ? c.mu : -c.mu;
  const double fx = (r - 1.0) * (nx - mu * ny), fy = (r - 1.0) * (ny + mu * nx);
  for (std::size_t i = 0; i < n; ++i) {
    dy[n + i] -= c.by_force[2 * i] * fx + c.by_force[2 * i + 1] * fy;
  }
}

Numbers solve(const Case& c, double tolerance) {
  Numbers y = c.start;
  const auto stepper =
      odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<Numbers>());
  odeint::integrate_adaptive(
      stepper, [&](const Numbers& from, Numbers& to, double t) { right_hand_side(c, from, to, t); },
      y, 0.0, 2.0 * std::numbers::pi * revolutions, 1e-3);
  return y;
}

double error(const Case& c, const Numbers& y) {
  double most = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) most = std::max(most, std::abs(y[i] - c.end[i]));
  return most;
}

double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void measure(const Case& c, double tolerance) {
  std::vector<double> times;
  Numbers y;
  double spent = 0.0;
  while (times.empty() || (times.size() < most_runs && spent < most_time)) {
    const double begin = processor_time();
    y = solve(c, tolerance);
    times.push_back(processor_time() - begin);
    spent += times.back();
  }
  std::nth_element(times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());
  std::printf("case | odeint | %g | %.2e | %.5g us\n", tolerance, error(c, y),
              1e6 * times[times.size() / 2] / revolutions);
}

}  // namespace

int main(int count, char** words) {
  Case c;
  std::ifstream file(count == 2 ? words[1] : "");
  if (!file || !read(file, c)) {
    std::fprintf(stderr, "usage: whirl_odeint FILE, with the numbers of a case\n");
    return 1;
  }
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) measure(c, tolerance);
}
