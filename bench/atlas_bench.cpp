// Points of the rotor-stator planes as published studies compute them (classical Runge-Kutta, 1000
// steps a revolution, exponents from eight neighbors) beside `whirl map`, in one run on one core:
// time of a point, and how often the two tell different motions.
//
//   whirl_atlas [points]

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <random>

#include "libdyn/studies/classify.hpp"
#include "libio/text/table.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {
namespace {

constexpr long transient = 1000, averaged = 200;
constexpr double frictions[] = {0.0, 0.095, 0.1, 0.105, 0.11, 0.12, 0.15, 0.2, 0.3};

struct Verdict {
  Regime regime = Regime::none;
  MotionKind kind = MotionKind::periodic;
  int period = 0;
  double seconds = 0.0;
};

/// Processor time of this thread [s]: other work on the machine does not count.
double now() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Smallest period with which sections repeat to a thousandth of a clearance.
int period_of(const ContactSystem& system, const std::vector<Vec>& sections) {
  const std::size_t count = sections.size();
  for (std::size_t p = 1; p <= std::min<std::size_t>(32, count / 2); ++p) {
    double worst = 0.0;
    for (std::size_t i = count - p; i < count; ++i) {
      worst = std::max(worst, distance(system, sections[i], sections[i - p]));
    }
    if (worst < 1e-3) return static_cast<int>(p);
  }
  return 0;
}

/// The equations as a study of this rotor alone would write them: (x_r, y_r, x_s, y_s, rates).
struct Rotor {
  test::RotorStator p;
  bool touches = false, parts = false;  ///< what was seen since they were reset

  void rates(double t, const double* y, double* to) {
    const double dx = y[0] - y[2], dy = y[1] - y[3], r = std::hypot(dx, dy);
    double fx = 0.0, fy = 0.0;
    if (r >= p.gap) {
      touches = true;
      const double turn = (dx * (y[5] - y[7]) - dy * (y[4] - y[6])) / r;
      const double s = p.Omega * p.R + turn >= 0.0 ? p.mu : -p.mu;
      const double q = p.kC * (r - p.gap) / r;
      fx = q * (-dx + s * dy);
      fy = q * (-dy - s * dx);
    } else {
      parts = true;
    }
    for (int i = 0; i < 4; ++i) to[i] = y[4 + i];
    const double pull = p.e * p.Omega * p.Omega;
    to[4] = (fx - p.cr * y[4] - p.kr * y[0]) / p.mr + pull * std::cos(p.Omega * t);
    to[5] = (fy - p.cr * y[5] - p.kr * y[1]) / p.mr + pull * std::sin(p.Omega * t) - p.gravity;
    to[6] = (-fx - p.cs * y[6] - p.ks * y[2]) / p.ms;
    to[7] = (-fy - p.cs * y[7] - p.ks * y[3]) / p.ms - p.gravity;
  }

  /// Moves a state on by whole revolutions of 1000 steps each.
  void go(double* y, long revolutions) {
    const double h = 2.0 * std::numbers::pi / (1000.0 * p.Omega);
    double a[8], b[8], c[8], d[8], z[8];
    for (long k = 0; k < 1000 * revolutions; ++k) {
      const double t = h * static_cast<double>(k % 1000);
      rates(t, y, a);
      for (int i = 0; i < 8; ++i) z[i] = y[i] + 0.5 * h * a[i];
      rates(t + 0.5 * h, z, b);
      for (int i = 0; i < 8; ++i) z[i] = y[i] + 0.5 * h * b[i];
      rates(t + 0.5 * h, z, c);
      for (int i = 0; i < 8; ++i) z[i] = y[i] + h * c[i];
      rates(t + h, z, d);
      for (int i = 0; i < 8; ++i) y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    }
  }
};

Verdict by_rk4(const test::RotorStator& p, const ContactSystem& system, Vec y) {
  const double begin = now();
  Rotor rotor{p};
  rotor.go(y.data(), transient);
  constexpr int size = 8;
  constexpr double apart = 1e-7;  // of the neighbors, in clearances
  Mat directions = Mat::Identity(size, size);
  Vec sums = Vec::Zero(size);
  std::vector<Vec> sections;
  bool touches = false, parts = false;
  for (long k = 0; k < averaged; ++k) {
    const Vec from = y;
    rotor.touches = rotor.parts = false;
    rotor.go(y.data(), 1);
    touches = touches || rotor.touches;
    parts = parts || rotor.parts;
    sections.push_back(y);
    for (int i = 0; i < size; ++i) {
      Vec neighbor = from + apart * system.state_scale().cwiseProduct(directions.col(i));
      rotor.go(neighbor.data(), 1);
      directions.col(i) = (neighbor - y).cwiseQuotient(system.state_scale()) / apart;
    }
    for (int i = 0; i < size; ++i) {  // Gram and Schmidt
      for (int j = 0; j < i; ++j) {
        directions.col(i) -= directions.col(j).dot(directions.col(i)) * directions.col(j);
      }
      const double length = directions.col(i).norm();
      sums(i) += std::log(length);
      directions.col(i) /= length;
    }
  }
  Verdict v{.regime = !touches ? Regime::none
                      : parts  ? Regime::intermittent
                               : Regime::permanent,
            .period = period_of(system, sections)};
  const double resolution = (1.0 + std::log(static_cast<double>(averaged))) / averaged;
  const auto positive = (sums.array() / averaged > resolution).count();
  if (positive > 0) {
    v.kind = positive > 1 ? MotionKind::hyperchaotic : MotionKind::chaotic;
    v.period = 0;
  } else if (v.period == 0) {
    v.kind = sums.maxCoeff() / averaged > -resolution ? MotionKind::quasi_periodic
                                                      : MotionKind::periodic;
  }
  v.seconds = now() - begin;
  return v;
}

constexpr double known = 0.25;  ///< how well exponents of chaos are asked for [1/revolution]

/// Verdicts of whirl from starts moved by a share of a clearance.
std::vector<Verdict> by_whirl(const std::vector<Scene>& scenes,
                              const std::vector<MotionState>& starts, double moved,
                              ClassifyOptions how = {}) {
  const double begin = now();
  std::vector<ClassifyCandidate> subjects;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    subjects.push_back({.system = &scenes[i].contacts});
    subjects.back().found.end = starts[i];
    subjects.back().found.end.y(0) += moved * scenes[i].contacts.length_scale();
  }
  how.discard = transient, how.revolutions = averaged;
  settle(subjects, how);
  average(subjects, how);
  const double each = (now() - begin) / static_cast<double>(scenes.size());
  std::vector<Verdict> verdicts;
  for (const ClassifyCandidate& s : subjects) {
    const Classification& c = s.found;
    verdicts.push_back({c.contacts[0].regime(), c.kind, c.period, each});
  }
  return verdicts;
}

/// How often two lists of verdicts differ, and in what.
struct Differences {
  int regime = 0, order = 0, period = 0, disorder = 0;

  Differences(const std::vector<Verdict>& a, const std::vector<Verdict>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const bool regular = a[i].kind == MotionKind::periodic;
      const bool also = b[i].kind == MotionKind::periodic;
      regime += a[i].regime != b[i].regime;
      order += regular != also;
      period += regular && also && a[i].period != b[i].period;
      disorder += !regular && !also && a[i].kind != b[i].kind;
    }
  }
};

void run(int points) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit;
  std::vector<test::RotorStator> rotors;
  std::vector<Scene> scenes;
  std::vector<MotionState> starts;
  for (int i = 0; i < points; ++i) {
    rotors.push_back({.Omega = 130.0 + 0.2 * std::floor(176.0 * unit(random)),
                      .kC = 2e6 + 1e6 * std::floor(199.0 * unit(random)),
                      .mu = frictions[static_cast<std::size_t>(9.0 * unit(random))]});
    scenes.push_back(rotors.back().scene());
    starts.push_back(test::start_of(rotors.back().model(), scenes.back()));
  }
  const std::vector<Verdict> ours = by_whirl(scenes, starts, 0.0);
  const std::vector<Verdict> moved = by_whirl(scenes, starts, 1e-9);
  const std::vector<Verdict> two = by_whirl(scenes, starts, 0.0, {.most_exponents = 2});
  const std::vector<Verdict> rough =
      by_whirl(scenes, starts, 0.0, {.most_exponents = 2, .resolution = known});
  std::vector<Verdict> theirs;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    theirs.push_back(by_rk4(rotors[i], scenes[i].contacts, starts[i].y));
  }
  double seconds = 0.0;
  for (const Verdict& v : theirs) seconds += v.seconds / points;

  constexpr double whole = 9.0 * 35024.0;
  Table times({"method", "time of a point", "nine planes on two cores"});
  const auto time_row = [&](const char* what, const Verdict& any) {
    times.row({what, fmt::format("{:.2f} ms", 1e3 * any.seconds),
               fmt::format("{:.1f} min", any.seconds * whole / 120.0)});
  };
  time_row("whirl map, tolerance 1e-10", ours[0]);
  time_row("with two exponents", two[0]);
  time_row("with two, known to 0.25", rough[0]);
  times.row({"Runge-Kutta, 1000 steps", fmt::format("{:.1f} ms", 1e3 * seconds),
             fmt::format("{:.0f} min", seconds * whole / 120.0)});
  fmt::print("{} random points\n\n{}\n", points, times.text());
  const Differences rk4(ours, theirs), chance(ours, moved), pair(ours, two), early(ours, rough);
  const auto share = [&](int count) { return fmt::format("{:.1f} %", 100.0 * count / points); };
  Table errors({"points where the verdict is another one", "Runge-Kutta",
                "whirl, start moved by 1e-9 clearances", "two exponents", "known to 0.25"});
  const auto row = [&](const char* what, int Differences::*part) {
    errors.row(
        {what, share(rk4.*part), share(chance.*part), share(pair.*part), share(early.*part)});
  };
  row("regime of contact", &Differences::regime);
  row("order or disorder", &Differences::order);
  row("period", &Differences::period);
  row("kind of disorder", &Differences::disorder);
  fmt::print("{}", errors.text());
}

}  // namespace
}  // namespace whirl

int main(int argc, char** argv) {
  whirl::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 200);
}
