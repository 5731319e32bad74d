// models/overhung_face_rub.toml: kinds of motion that "Rotor-stator rubbing contact in an overhung
// rotordynamic system" tells, and numbers of an independent program for this set of parameters,
// which is calibrated: the paper prints none.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "libdyn/motions/start.hpp"
#include "libdyn/studies/classify.hpp"
#include "libdyn/system/scene.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::overhung_face_rub_test {

Model bundled() {
  return read_model(std::filesystem::path(WHIRL_SOURCE_DIR) / "models/overhung_face_rub.toml");
}

Classification classified(const Model& model, const ClassifyOptions& options = {}) {
  const Scene scene = make_scene(model);
  return classify(scene.contacts, start_state(model, scene, nullptr), options);
}

// The file says the numbers of set T: stiffness of a massless cantilever, damping in proportion.
TEST(OverhungFaceRub, HasTheMatricesOfItsEquations) {
  constexpr double rounding = 1e-12;
  const Model model = bundled();
  const Scene scene = make_scene(model);
  const double m = 0.573, It = 3.85e-4, Ip = 7.06e-4, L = 0.11723, EI = 20.37971, n = 230.0;
  const double k11 = 12.0 * EI / (L * L * L), k12 = 6.0 * EI / (L * L), k22 = 4.0 * EI / L;
  Mat K(4, 4), G = Mat::Zero(4, 4);
  K << k11, 0, 0, -k12, 0, k11, k12, 0, 0, k12, k22, 0, -k12, 0, 0, k22;
  G(2, 3) = Ip;
  G(3, 2) = -Ip;
  const Vec M = (Vec(4) << m, m, It, It).finished();
  const Mat map = scene.displacement_map().bottomRows(4), inverse = map.transpose();
  ASSERT_LT((map * inverse - Mat::Identity(4, 4)).norm(), rounding);  // its rows are coordinates
  const Mat found_K = M.asDiagonal() * (map * scene.contacts.K() * inverse);
  const Mat found_D = M.asDiagonal() * (map * scene.contacts.D() * inverse);
  EXPECT_LT((found_K - K).norm(), rounding * K.norm());
  EXPECT_LT((found_D - 2.421527e-4 * K - n * G).norm(), rounding * found_D.norm());
  const Vec start = map * start_state(model, scene, nullptr).y.head(4);
  EXPECT_NEAR(start(1), -m * 9.81 * L * L * L / (3.0 * EI), rounding);
}

// Period 3, lateral duty 0.32, face duty 0.57: to the digits of the independent program.
TEST(OverhungFaceRub, HasPeriodThreeAt230RadPerSecond) {
  const Classification c = classified(bundled());
  EXPECT_EQ(c.kind, MotionKind::periodic);
  EXPECT_TRUE(c.is_proven);
  EXPECT_EQ(c.period, 3);
  EXPECT_NEAR(c.contacts.at(0).duty, 0.32, 0.005);
  EXPECT_NEAR(c.contacts.at(1).duty, 0.57, 0.005);
}

// Also from the static sag of the disk with tilts of zero.
TEST(OverhungFaceRub, HasPeriodThreeFromAStartWithoutTilts) {
  const Scene scene = make_scene(bundled());
  MotionState state;
  state.y = Vec::Zero(8);
  const Mat map = scene.displacement_map().bottomRows(4);
  state.y.head(4) =
      map.transpose() * Vec::Unit(4, 1) * (-0.573 * 9.81 * std::pow(0.11723, 3) / 3.0 / 20.37971);
  EXPECT_EQ(classify(scene.contacts, state, {}).period, 3);
}

TEST(OverhungFaceRub, IsQuasiPeriodicAt300AndChaoticAt330RadPerSecond) {
  Model model = bundled();
  model.speed = 300.0;
  EXPECT_EQ(classified(model).kind, MotionKind::quasi_periodic);
  model.speed = 330.0;
  EXPECT_EQ(classified(model, {.discard = 2000, .revolutions = 2000}).kind, MotionKind::chaotic);
}

TEST(OverhungFaceRub, LosesItsPeriodInASmallerRing) {
  Model model = bundled();
  const auto kind = [&](double clearance) {
    model.contacts.at(0).clearance = clearance;
    return classified(model).kind;
  };
  EXPECT_EQ(kind(6.8e-4), MotionKind::periodic);
  EXPECT_EQ(kind(6e-4), MotionKind::chaotic);
  EXPECT_EQ(kind(5.5e-4), MotionKind::quasi_periodic);
}

// Friction of one direction feeds the whirl: chaos, then no bound.
TEST(OverhungFaceRub, IsDrivenOffByFriction) {
  Model model = bundled();
  const auto with = [&](double mu) {
    for (Contact& c : model.contacts) c.friction.mu = mu;
    return classified(model);
  };
  EXPECT_EQ(with(0.1).kind, MotionKind::chaotic);
  const Classification driven = with(0.4);
  EXPECT_EQ(driven.outcome, Outcome::step_too_small);
  EXPECT_NE(driven.failure.text().find("grows without bound"), std::string::npos) << driven.failure;
}

}  // namespace whirl::overhung_face_rub_test
