// The models that come with the program: each is read, and does what its header says.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "libdyn/motions/simulate.hpp"
#include "libdyn/motions/start.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/modes.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::bundled_models_test {

const std::filesystem::path folder = std::filesystem::path(WHIRL_SOURCE_DIR) / "models";

std::vector<Regime> regimes(const std::string& name) {
  const Model model = read_model(folder / name);
  const Scene scene = make_scene(model);
  const Simulation simulation =
      simulate(scene, start_state(model, scene, nullptr), {.revolutions = 50, .discard = 1000});
  EXPECT_EQ(simulation.integration.outcome, Outcome::reached_end);
  std::vector<Regime> found;
  for (const ContactMeasure& c : simulation.recording.contacts) found.push_back(c.regime());
  return found;
}

TEST(BundledModels, TouchAsTheirHeadersSay) {
  EXPECT_EQ(regimes("two_disk_mac.toml"), std::vector{Regime::intermittent});
  EXPECT_EQ(regimes("two_disk_double_rub.toml"),
            (std::vector{Regime::permanent, Regime::permanent}));
  EXPECT_EQ(regimes("jeffcott_stator.toml"), std::vector{Regime::intermittent});
  EXPECT_EQ(regimes("two_disk_oil_film.toml"),
            (std::vector{Regime::intermittent, Regime::intermittent}));
}

// (48 E I / (m l^3))^(1/2), by Rayleigh's quotient with the shaft bent as by the disk's weight.
TEST(BundledModels, JeffcottRotorHasTheCriticalSpeedOfTheTextbook) {
  const Assembler assembler(read_model(folder / "jeffcott.toml").structure);
  const double EI = 210e9 * std::numbers::pi * std::pow(0.01, 4) / 64.0, l = 0.5;
  const double shaft = 7800.0 * std::numbers::pi * 0.25e-4 * l;
  const double speed = std::sqrt(48.0 * EI / ((2.0 + 17.0 / 35.0 * shaft) * l * l * l));
  EXPECT_NEAR(critical_speeds(assembler, {.count = 2}).at(1).speed, speed, 2e-3 * speed);
}

// A thin disk's second forward mode runs away from the speed, a drum's does not.
TEST(BundledModels, OverhungDiskLosesASecondForwardCriticalSpeed) {
  Structure structure = read_model(folder / "overhung_disk.toml").structure;
  const auto forward_below = [&](double speed) {
    int count = 0;
    for (const Critical& c : critical_speeds(Assembler(structure), {})) {
      if (c.whirl == Whirl::forward && c.speed < speed) ++count;
    }
    return count;
  };
  EXPECT_EQ(forward_below(3000.0), 1);
  structure.disks.at(0).Ip = 0.02;
  EXPECT_EQ(forward_below(3000.0), 2);
}

// k_xy against c omega: unstable into the guard ring as it stands, stable with less.
TEST(BundledModels, CrossCouplingDrivesForwardWhirl) {
  Model model = read_model(folder / "cross_coupled_bearing.toml");
  const auto first = [&] {
    return complex_modes(Assembler(model.structure).at(model.speed), 2).oscillatory.at(0);
  };
  EXPECT_EQ(first().whirl, Whirl::forward);
  EXPECT_NEAR(first().damping_ratio(), (200.0 - 150e3 / 628.3) / (2.0 * 10.0 * 628.3), 1e-5);
  EXPECT_EQ(regimes("cross_coupled_bearing.toml"), std::vector{Regime::permanent});
}

// A pendulum as long as the clearance. Its amplitude, a quarter of a radian, makes it 0.4 % slower,
// friction a little more.
TEST(BundledModels, DroppedRotorRocksAtTheBottom) {
  const Model model = read_model(folder / "dropped_rotor.toml");
  const Scene scene = make_scene(model);
  const Simulation s =
      simulate(scene, start_state(model, scene, nullptr), {.revolutions = 512, .discard = 500});
  ASSERT_EQ(s.integration.outcome, Outcome::reached_end);
  EXPECT_EQ(s.recording.contacts.at(0).regime(), Regime::permanent);
  const Vec x = s.recording.eta.row(0).array() - s.recording.eta.row(0).mean();
  int crossings = 0;
  for (Eigen::Index i = 1; i < x.size(); ++i) crossings += x(i - 1) * x(i) < 0.0 ? 1 : 0;
  const double duration = s.recording.spacing() * static_cast<double>(x.size());
  const double found = std::numbers::pi * crossings / duration;
  const double pendulum = std::sqrt(9.81 / 0.25e-3);
  EXPECT_LT(found, pendulum);
  EXPECT_GT(found, 0.97 * pendulum);
}

// Independent integrators agree on every one of them, over its first revolutions.
TEST(BundledModels, MoveAlikeByEveryMethod) {
  int models = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".toml") continue;
    SCOPED_TRACE(file.path());
    const Model model = read_model(file.path());
    EXPECT_TRUE(model.has_speed);
    const Scene scene = make_scene(model);
    const auto end = [&](const AnyMethod& method, double tolerance) {
      MotionState state = start_state(model, scene, nullptr);
      const Integration result =
          integrate(method, scene.contacts, state, 5, {.tolerance = tolerance});
      EXPECT_EQ(result.outcome, Outcome::reached_end) << result.failure;
      return Vec(state.y.cwiseQuotient(scene.contacts.state_scale()));
    };
    const Vec reference = end(Dop853{}, 1e-14);
    EXPECT_LT((end(Taylor{}, 1e-12) - reference).cwiseAbs().maxCoeff(), 1e-9);
    if (Collocation::abilities.can(scene.contacts)) {
      EXPECT_LT((end(Collocation{}, 1e-10) - reference).cwiseAbs().maxCoeff(), 1e-7);
    }
    EXPECT_LT((end(CvodeAdams{}, 1e-11) - reference).cwiseAbs().maxCoeff(), 1e-5);
    ++models;
  }
  EXPECT_GE(models, 10);
}

}  // namespace whirl::bundled_models_test
