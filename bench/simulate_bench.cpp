// The published two-disk rotor, 8 modes, one contact, bouncing at 4430 rpm, for 100 s of machine
// time. Its error after a tenth of a second against a run at 1e-14 is reported with the time
// (bouncing is stable: the error does not grow).

#include <benchmark/benchmark.h>

#include <cmath>

#include "libdyn/simulate.hpp"
#include "libio/model_file.hpp"

namespace whirl {
namespace {

void TwoDiskRotor100Seconds(benchmark::State& state) {
  const Model model = read_model(WHIRL_MODELS "/two_disk_mac.toml");
  const Scene scene = make_scene(model);
  const MotionState start = start_state(model, scene, nullptr);
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const long revolutions = std::lround(100.0 / scene.contacts.period());
  for (auto _ : state) {
    SimulationOptions options{.revolutions = 100, .discard = revolutions - 100};
    options.integration.tolerance = tolerance;
    options.method = Taylor{};
    benchmark::DoNotOptimize(simulate(scene, start, options));
  }
  MotionState settled = start;
  integrate(Dop853{}, scene.contacts, settled, 2000, {.tolerance = 1e-12});
  MotionState coarse = settled, fine = settled;
  const long tenth = std::lround(0.1 / scene.contacts.period());
  integrate(Taylor{}, scene.contacts, coarse, tenth, {.tolerance = tolerance});
  integrate(Dop853{}, scene.contacts, fine, tenth, {.tolerance = 1e-14});
  state.counters["error"] = distance(scene.contacts, coarse.y, fine.y);
  state.counters["s_per_rev"] = benchmark::Counter(
      static_cast<double>(revolutions),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(TwoDiskRotor100Seconds)->Arg(7)->Arg(8)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
