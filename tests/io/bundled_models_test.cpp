// The models that come with the program: each is read, and does what its header says.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/simulate.hpp"
#include "libio/model_file.hpp"

namespace whirl::bundled_models_test {

const std::filesystem::path folder = std::filesystem::path(WHIRL_SOURCE_DIR) / "models";

std::vector<Regime> regimes(const std::string& name) {
  const Model model = read_model(folder / name);
  const Scene scene = make_scene(model);
  const Simulation simulation =
      simulate(scene, start_state(model, scene, nullptr), {.revolutions = 50, .discard = 300});
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
      EXPECT_EQ(result.outcome, Outcome::reached_end) << result.diagnosis;
      return Vec(state.y.cwiseQuotient(scene.contacts.state_scale()));
    };
    const Vec reference = end(Dop853{}, 1e-14);
    EXPECT_LT((end(Taylor{}, 1e-12) - reference).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((end(Collocation{}, 1e-10) - reference).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((end(CvodeAdams{}, 1e-11) - reference).cwiseAbs().maxCoeff(), 1e-5);
    ++models;
  }
  EXPECT_GE(models, 3);
}

}  // namespace whirl::bundled_models_test
