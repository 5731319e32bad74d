// 200 points of a branch with their multipliers, by event-exact tangents and by finite differences.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "libdyn/branches/branch_equations.hpp"
#include "libdyn/branches/range_slopes.hpp"
#include "libdyn/methods/rk4.hpp"
#include "libdyn/motions/start.hpp"
#include "libdyn/taylor/batch.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/scenes.hpp"

namespace whirl {
namespace {

constexpr int points = 200;

/// P1 over the contact stiffness, from 150 MN/m on.
struct P1Branch {
  static test::RotorStator at(double stiffness) {
    test::RotorStator p = test::P1;
    p.kC = stiffness;
    return p;
  }
  std::shared_ptr<const Scene> first = std::make_shared<const Scene>(at(150e6).scene());
  Vec start = [this] {
    Trajectory t{.system = &first->contacts,
                 .state = test::start_of(at(150e6).model(), *first),
                 .revolutions = 300};
    integrate_single(t, {});
    return t.state.y;
  }();
  ContinuationOptions options{
      .low = 150e6, .high = 170e6, .first = 150e6, .largest_step = 0.1e6, .most_points = points};

  void walk(
      benchmark::State& state, const FlowAt& flow_at,
      const std::function<EndSlopeAt()>& slope_at = [] { return EndSlopeAt(); }) const {
    std::size_t found = 0;
    for (auto _ : state) {
      Continuation walk = orbit_continuation(flow_at, start, options, slope_at());
      while (walk.advance()) {
      }
      found = walk.branch().points.size();
      benchmark::DoNotOptimize(walk.branch().points.back().multipliers.data());
    }
    state.counters["points"] = static_cast<double>(found);
  }
};

void BranchByTangents(benchmark::State& state) {
  const P1Branch branch;
  branch.walk(state, [&](double stiffness) {
    return flow_of(std::make_shared<const Scene>(P1Branch::at(stiffness).scene()), *branch.first);
  });
}
BENCHMARK(BranchByTangents)->Unit(benchmark::kMillisecond);

/// The same with exact derivatives by the stiffness, too, which begin anew with every branch.
void BranchBySlopes(benchmark::State& state) {
  const P1Branch branch;
  const auto scene_at = [](double stiffness) {
    return std::make_shared<const Scene>(P1Branch::at(stiffness).scene());
  };
  branch.walk(
      state, [&](double stiffness) { return flow_of(scene_at(stiffness), *branch.first); },
      [&]() -> EndSlopeAt {
        const auto slopes = std::make_shared<const RangeSlopes>(
            scene_at, branch.first, branch.options.low, branch.options.high);
        return [slopes](double stiffness, const Vec& start, double revolutions) {
          return slopes->end_slope(stiffness, test::state_of(start), revolutions);
        };
      });
}
BENCHMARK(BranchBySlopes)->Unit(benchmark::kMillisecond);

/// Shooting as it is done without tangents: RK4, 1000 steps a revolution, a column of the tangent
/// from each of 8 starts moved aside.
Flow differences(const std::shared_ptr<const Scene>& scene) {
  Flow flow = flow_of(scene, *scene);
  flow.go = [scene, scale = flow.scale](std::span<const Vec> starts, long revolutions,
                                        WithTangent wanted) {
    const auto end = [&](const Vec& y) {
      MotionState state = test::state_of(y);
      const double step = scene->contacts.period() / 1000.0;
      integrate(AnyMethod(Rk4{}), scene->contacts, state, revolutions, {.fixed_step = step}, {});
      return state.y;
    };
    std::vector<FlowResult> all;
    for (const Vec& y : starts) {
      FlowResult p{end(y), Mat::Identity(y.size(), y.size()), {}, {}};
      for (Eigen::Index k = 0; wanted == WithTangent::yes && k < y.size(); ++k) {
        Vec aside = y;
        const double h = 1e-6 * scale(k);
        aside(k) += h;
        p.tangent.col(k) = (end(aside) - p.end) / h;
      }
      all.push_back(std::move(p));
    }
    return all;
  };
  return flow;
}

void BranchByDifferences(benchmark::State& state) {
  const P1Branch branch;
  branch.walk(state, [](double stiffness) {
    return differences(std::make_shared<const Scene>(P1Branch::at(stiffness).scene()));
  });
}
BENCHMARK(BranchByDifferences)->Unit(benchmark::kMillisecond);

/// The two-disk rotor that bounces at 4430 rpm, closed as seen from the rotor, over the speed.
struct TwoDiskBranch {
  static constexpr double rpm = std::numbers::pi / 30.0;
  Model model = read_model(WHIRL_MODELS "/two_disk_mac.toml");
  std::shared_ptr<const Scene> first = at(4430.0 * rpm);
  Vec start = [this] {
    Trajectory t{.system = &first->contacts,
                 .state = start_state(model, *first, nullptr),
                 .revolutions = 500};
    integrate_single(t, {});
    return t.state.y;
  }();
  double period = recurrence(*first, start, 64).value() / first->contacts.period();
  ContinuationOptions options{.low = 3000.0 * rpm,
                              .high = 7000.0 * rpm,
                              .first = 4430.0 * rpm,
                              .largest_step = 2.0 * rpm,
                              .most_points = points};

  std::shared_ptr<const Scene> at(double speed) const {
    Model moved = model;
    moved.speed = speed;
    return std::make_shared<const Scene>(make_scene(moved, ReductionEstimate::no));
  }
  void walk(benchmark::State& state, const AutonomousFlowAt& flow_at) const {
    std::size_t found = 0;
    for (auto _ : state) {
      Continuation walk = autonomous_continuation(flow_at, start, period, options);
      while (walk.advance()) {
      }
      found = walk.branch().points.size();
      benchmark::DoNotOptimize(walk.branch().points.back().multipliers.data());
    }
    state.counters["points"] = static_cast<double>(found);
  }
};

void TwoDiskBranchByTangents(benchmark::State& state) {
  const TwoDiskBranch branch;
  branch.walk(state, [&](double speed) { return rotating_flow(branch.at(speed), *branch.first); });
}
BENCHMARK(TwoDiskBranchByTangents)->Unit(benchmark::kMillisecond);

/// The same flow by RK4 with 1000 steps a revolution, its tangent by differences.
AutonomousFlow differences(const AutonomousFlow& exact, const std::shared_ptr<const Scene>& scene) {
  AutonomousFlow flow = exact;
  flow.go = [scene, scale = flow.scale](const Vec& z, double time, WithTangent wanted) {
    const double turn = 2.0 * std::numbers::pi, phases = scene->contacts.Omega() * time;
    const auto revolutions = static_cast<long>(std::ceil(phases / turn));
    const double phase = static_cast<double>(revolutions) * turn - phases;
    const Mat R = rotation(*scene, phase);
    const auto end = [&](const Vec& from) {
      MotionState state = test::state_of(R * from);
      state.phase = phase;
      const double step = scene->contacts.period() / 1000.0;
      integrate(AnyMethod(Rk4{}), scene->contacts, state, revolutions, {.fixed_step = step}, {});
      return state.y;
    };
    AutonomousFlow::Result at{.end = end(z)};
    if (wanted == WithTangent::no) return at;
    at.tangent = Mat::Identity(z.size(), z.size());
    for (Eigen::Index k = 0; k < z.size(); ++k) {
      Vec aside = z;
      const double h = 1e-6 * scale(k);
      aside(k) += h;
      at.tangent.col(k) = (end(aside) - at.end) / h;
    }
    return at;
  };
  return flow;
}

void TwoDiskBranchByDifferences(benchmark::State& state) {
  const TwoDiskBranch branch;
  branch.walk(state, [&](double speed) {
    const auto scene = branch.at(speed);
    return differences(rotating_flow(scene, *branch.first), scene);
  });
}
BENCHMARK(TwoDiskBranchByDifferences)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whirl
