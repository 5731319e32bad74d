// The batch engine on random points of the rotor-stator planes, and all exponents of a motion.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "libdyn/taylor/batch.hpp"
#include "tests/support/trajectories.hpp"

namespace whirl {
namespace {

using test::RotorStator;
using test::Trajectories;

/// Random points of the planes of speed, contact stiffness and friction, from the static sag.
Trajectories random_points(int count, long revolutions) {
  Trajectories points;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < count; ++i) {
    const RotorStator p{.Omega = 130.0 + 35.0 * unit(random),
                        .kC = 2e6 + 148e6 * unit(random),
                        .mu = 0.0375 * std::floor(9.0 * unit(random))};
    points.add(p, revolutions);
  }
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

/// As in a map: 200 revolutions of transient, or 50 beyond them with exponents.
void RandomMapPoints(benchmark::State& state) {
  static const Trajectories fresh = random_points(512, 200);
  static const Trajectories settled = [] {
    Trajectories points = random_points(512, 200);
    integrate_batch(points.all, {});
    return points;
  }();
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const bool exponents = state.range(1) != 0;
  time_batch(state, exponents ? settled : fresh, exponents ? 50 : 200,
             {.tolerance = tolerance, .threads = 1, .exponents = exponents});
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
