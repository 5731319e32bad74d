// The models that come with the program: each is read, and does what its header says.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "libdyn/simulate.hpp"
#include "libio/model_file.hpp"

namespace whirl {
namespace {

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
}

TEST(BundledModels, AreReadAndIntegrated) {
  int models = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".toml") continue;
    SCOPED_TRACE(file.path());
    const Model model = read_model(file.path());
    EXPECT_TRUE(model.has_speed);
    const Scene scene = make_scene(model);
    MotionState state = start_state(model, scene, nullptr);
    EXPECT_EQ(integrate(Dop853{}, scene.contacts, state, 20, {}).outcome, Outcome::reached_end);
    ++models;
  }
  EXPECT_GE(models, 2);
}

}  // namespace
}  // namespace whirl
