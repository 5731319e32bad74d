// The published two-disk rotor, 8 modes, one contact, bouncing at 4430 rpm, for 100 s of machine
// time. Its error after a tenth of a second against a run at 1e-14 is reported with the time
// (bouncing is stable: the error does not grow). And the rotor and stator with a mode at 1e5 rad/s.

#include <benchmark/benchmark.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/start.hpp"
#include "libio/model/model_file.hpp"

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

/// The rotor and stator with five impacts a revolution, and a mode at 1e5 rad/s on the rotor.
constexpr const char* fast_mode = R"(
[[body]]
name = "fast"
mass = "1 kg"
[[bearing]]
body      = "fast"
stiffness = "1e10 N/m"
damping   = "100 N.s/m"
[[link]]
from      = "rotor"
to        = "fast"
stiffness = "1 kN/m"
)";

void ImpactsBesideAFastMode(benchmark::State& state) {
  std::ifstream file(WHIRL_MODELS "/jeffcott_stator.toml");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Model model = parse_model(text + fast_mode, "fast");
  const Scene scene = make_scene(model);
  const AnyMethod method = suitable_method(scene.contacts);
  MotionState settled = start_state(model, scene, nullptr);
  integrate(method, scene.contacts, settled, 500, {.tolerance = 1e-12});
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  constexpr long revolutions = 100;
  MotionState end = settled, exact = settled;
  for (auto _ : state) {
    end = settled;
    benchmark::DoNotOptimize(
        integrate(method, scene.contacts, end, revolutions, {.tolerance = tolerance}));
  }
  integrate(Dop853{}, scene.contacts, exact, revolutions, {.tolerance = 1e-14});
  state.counters["error"] = distance(scene.contacts, end.y, exact.y);
  state.counters["s_per_rev"] = benchmark::Counter(
      static_cast<double>(revolutions),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(name_of_method(method)));
}
BENCHMARK(ImpactsBesideAFastMode)->DenseRange(6, 10, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
