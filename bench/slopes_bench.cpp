// What derivatives by parameters cost: motions alone, and with those by eight parameters.

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <vector>

#include "libdyn/system/model.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libdyn/taylor/motion_slopes.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {
namespace {

/// A parameter: what it is compared with, and how a model changes by it.
struct Parameter {
  double value, size;  ///< size 0: of the value
  std::function<void(Model&, double)> set;
};

/// Of the contact alone: stiffness, friction, clearance, place of the ring.
std::vector<Parameter> of_contact(const Model& m) {
  const auto& c = m.contacts[0];
  return {{std::get<Radial<>>(c.law).k, 0.0,
           [](Model& to, double k) { std::get<Radial<>>(to.contacts[0].law).k = k; }},
          {c.friction.mu, 0.0, [](Model& to, double mu) { to.contacts[0].friction.mu = mu; }},
          {c.clearance, 0.0, [](Model& to, double gap) { to.contacts[0].clearance = gap; }},
          {0.0, c.clearance, [](Model& to, double x) { to.contacts[0].offset(0) = x; }},
          {0.0, c.clearance, [](Model& to, double y) { to.contacts[0].offset(1) = y; }}};
}

/// Those, the speed and the unbalance.
std::vector<Parameter> of_rotor(const Model& m) {
  std::vector<Parameter> all = of_contact(m);
  const Unbalance& u = m.structure.unbalances[0];
  all.push_back({m.speed, 0.0, [](Model& to, double Omega) { to.speed = Omega; }});
  all.push_back(
      {u.moment, 0.0, [](Model& to, double U) { to.structure.unbalances[0].moment = U; }});
  all.push_back(
      {u.phase, 1.0, [](Model& to, double phase) { to.structure.unbalances[0].phase = phase; }});
  return all;
}

std::vector<SystemSlope> eight(const Model& model, const Scene& scene,
                               const std::vector<Parameter>& parameters) {
  std::vector<SystemSlope> slopes;
  for (std::size_t i = 0; i < 8; ++i) {
    const Parameter& p = parameters[i % parameters.size()];
    slopes.push_back(slope_of("", scene, p.value, p.size, [&](double value) {
      Model changed = model;
      p.set(changed, value);
      return changed;
    }));
  }
  return slopes;
}

enum Motion { impacts, damped, permanent };

Model model_of(Motion motion) {
  switch (motion) {
    case impacts:
      return test::P1.model();
    case damped: {
      test::RotorStator rotor = test::P1;
      rotor.cC = 1e3;
      return rotor.model();
    }
    case permanent:
      return test::P3.model();
  }
  return {};
}

/// 40 revolutions of a settled motion: alone, with slopes by the contact, or by contact and rotor.
void EightSlopes(benchmark::State& state) {
  constexpr long revolutions = 40;
  const Model model = model_of(static_cast<Motion>(state.range(0)));
  const Scene scene = make_scene(model);
  MotionState start = test::start_of(model, scene);
  test::run(scene, start, 100, {.tolerance = 1e-12});
  const bool has_slopes = state.range(2) != 0;
  std::vector<SystemSlope> slopes;
  if (has_slopes)
    slopes = eight(model, scene, state.range(2) == 1 ? of_contact(model) : of_rotor(model));
  const std::vector<double> times{revolutions * scene.contacts.period()};
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(1)));
  long steps = 0, events = 0;
  for (auto _ : state) {
    if (!has_slopes) {
      Trajectory t{.system = &scene.contacts, .state = start, .revolutions = revolutions};
      integrate_single(t, {.tolerance = tolerance});
      benchmark::DoNotOptimize(t.state.y.data());
      steps = t.cost.steps;
      events = t.cost.events;
    } else {
      const MotionSlopes found = motion_slopes(scene.contacts, start, times, slopes,
                                               {.tolerance = tolerance, .by_start = false});
      benchmark::DoNotOptimize(found.end.y.data());
      steps = found.cost.steps;
      events = found.cost.events;
    }
  }
  state.counters["steps"] = static_cast<double>(steps);
  state.counters["events"] = static_cast<double>(events);
}
BENCHMARK(EightSlopes)
    ->ArgNames({"motion", "digits", "slopes"})
    ->ArgsProduct({{impacts, damped, permanent}, {10, 12}, {0, 1, 2}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace whirl
