// The batch engine on random points of the rotor-stator planes, and all exponents of a motion.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "libdyn/batch/batch.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl {
namespace {

using test::RotorStator;
using test::Trajectories;

/// Points of all nine planes: speed, contact stiffness, friction. Beyond a transient.
Trajectories random_points(int count) {
  Trajectories points;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < count; ++i) {
    RotorStator p{.Omega = 130.0 + 35.0 * unit(random), .kC = 2e6 + 198e6 * unit(random)};
    constexpr double mu[] = {0.0, 0.095, 0.1, 0.105, 0.11, 0.12, 0.15, 0.2, 0.3};
    p.mu = mu[i % 9];
    points.add(p, 100);
  }
  integrate_batch(points.all, {});
  return points;
}

/// Time of a revolution of one trajectory on one core.
void time_batch(benchmark::State& state, const Trajectories& points, long revolutions,
                const BatchOptions& options) {
  for (auto _ : state) {
    std::vector<Trajectory> batch = points.all;
    for (Trajectory& t : batch) t.revolutions = revolutions;
    integrate_batch(batch, options);
    benchmark::DoNotOptimize(batch.data());
  }
  state.counters["s_per_rev"] = benchmark::Counter(
      static_cast<double>(revolutions) * static_cast<double>(points.all.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(instruction_set());
}

void RandomMapPoints(benchmark::State& state) {
  static const Trajectories points = random_points(252);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  time_batch(state, points, 20,
             {.tolerance = tolerance, .threads = 1, .exponents = state.range(1) != 0});
}
BENCHMARK(RandomMapPoints)
    ->ArgNames({"digits", "exponents"})
    ->ArgsProduct({{7, 11}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

void EightExponents(benchmark::State& state) {
  Trajectories points;
  for (int i = 0; i < 16; ++i) points.add(test::P1, 400);
  integrate_batch(points.all, {});
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  time_batch(state, points, 50, {.tolerance = tolerance, .threads = 1, .exponents = true});
}
BENCHMARK(EightExponents)->ArgName("digits")->Arg(7)->Arg(11)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
