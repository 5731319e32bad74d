// The published two-disk rotor on two oil films with rubs at both disks, 460 rad/s, one impact of
// each disk a revolution: time of a revolution, and the error after five against quadruple
// precision.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "libdyn/taylor/batch.hpp"
#include "tests/support/oil_films.hpp"

namespace whirl {
namespace {

constexpr long revolutions = 20, compared = 5;

struct Steady {
  Scene scene = test::TwoDisksOnFilms{}.scene();
  MotionState start;
  Vec exact;  ///< after the revolutions that are compared

  Steady() {
    start = test::start_of(test::TwoDisksOnFilms{}.model(), scene);
    test::run(scene, start, 200, {.tolerance = 1e-12});
    Trajectory t = trajectory(compared);
    integrate_quad(t, {.tolerance = 1e-22, .order = 24});
    exact = t.state.y;
  }
  Trajectory trajectory(long count) const {
    return {.system = &scene.contacts, .state = start, .revolutions = count};
  }
};

const Steady& steady() {
  static const Steady motion;
  return motion;
}

void report(benchmark::State& state, const Vec& end, int motions) {
  state.counters["error"] = distance(steady().scene.contacts, end, steady().exact);
  state.counters["s_per_rev"] = benchmark::Counter(
      static_cast<double>(revolutions * motions),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void OilFilmRotor(benchmark::State& state, const AnyMethod& method) {
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const ContactSystem& system = steady().scene.contacts;
  for (auto _ : state) {
    MotionState moved = steady().start;
    benchmark::DoNotOptimize(
        integrate(method, system, moved, revolutions, {.tolerance = tolerance}));
  }
  MotionState end = steady().start;
  integrate(method, system, end, compared, {.tolerance = tolerance});
  report(state, end.y, 1);
}
#define WHIRL_OIL_FILM(name, method)            \
  BENCHMARK_CAPTURE(OilFilmRotor, name, method) \
      ->ArgName("digits")                       \
      ->DenseRange(6, 12, 2)                    \
      ->Unit(benchmark::kMillisecond)
WHIRL_OIL_FILM(taylor, Taylor{});
WHIRL_OIL_FILM(dop853, Dop853{});
WHIRL_OIL_FILM(cvode_adams, CvodeAdams{});
WHIRL_OIL_FILM(cvode_bdf, CvodeBdf{});
#undef WHIRL_OIL_FILM

/// In the lanes of one core, as in a map.
void OilFilmRotorInLanes(benchmark::State& state) {
  constexpr int motions = 16;
  const BatchOptions options{.tolerance = std::pow(10.0, -static_cast<double>(state.range(0))),
                             .threads = 1};
  for (auto _ : state) {
    std::vector<Trajectory> all(motions, steady().trajectory(revolutions));
    integrate_batch(all, options);
    benchmark::DoNotOptimize(all.data());
  }
  std::vector<Trajectory> all(motions, steady().trajectory(compared));
  integrate_batch(all, options);
  report(state, all[0].state.y, motions);
  state.SetLabel(instruction_set());
}
BENCHMARK(OilFilmRotorInLanes)
    ->ArgName("digits")
    ->DenseRange(6, 12, 2)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
