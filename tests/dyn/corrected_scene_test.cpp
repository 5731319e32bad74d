// Shapes that follow a parameter of the rotor.

#include "libdyn/system/corrected_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "libbase/numerics/dense.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::corrected_scene_test {

using test::rpm;
using test::TwoDiskRub;

constexpr double stiffness = 4e6;  // of the bearings [N/m]

Model model_at(double k) {
  return TwoDiskRub{.speed = 3000.0 * rpm, .k = k, .modes = 6}.model();
}

/// What the middle moves when a force of the speed's frequency pushes at a disk, in shapes Phi.
Complex answer(double k, const Mat& Phi) {
  const System system = Assembler(model_at(k).structure).at(3000.0 * rpm);
  const double w = system.Omega;
  const Mat D = Mat(system.C) + w * Mat(system.G());
  const CMat full = Mat(system.K).cast<Complex>() - w * w * Mat(system.M).cast<Complex>() +
                    Complex(0.0, w) * D.cast<Complex>();
  const CMat small = Phi.transpose().cast<Complex>() * full * Phi.cast<Complex>();
  const auto row = [&](int node) -> CVec {
    return (Phi.transpose() * system.dofs.row({Point::Kind::node, node - 1}, X)).cast<Complex>();
  };
  const CVec answer = DenseLu<CMat>(small).solve(row(4));
  return row(7).transpose() * answer;
}

Complex slope(const Mat& Phi) {
  constexpr double step = 1e-4 * stiffness;
  return (answer(stiffness + step, Phi) - answer(stiffness - step, Phi)) / (2.0 * step);
}

TEST(CorrectedScene, FollowsTheStiffnessOfBearings) {
  const Model model = model_at(stiffness);
  const Scene scene = make_scene(model, ReductionEstimate::no);
  const Scene corrected = corrected_scene(scene, model, std::array{model_at(1.01 * stiffness)});
  const Eigen::Index n = scene.system.size();
  const Complex exact = slope(Mat::Identity(n, n));
  const double held = std::abs(slope(scene.reduced.Phi) / exact - 1.0);
  const double left = std::abs(slope(corrected.reduced.Phi) / exact - 1.0);
  EXPECT_EQ(corrected.reduced.size(), scene.reduced.size() + 4);  // two bearings, two directions
  EXPECT_GT(held, 1e-3);
  EXPECT_LT(left, 0.02 * held);
  const Mat M = corrected.reduced.M;
  EXPECT_LT((M - Mat::Identity(M.rows(), M.cols())).norm(), 1e-10);
}

TEST(CorrectedScene, IsTheSameWhereNoShapeChanges) {
  const Model model = model_at(stiffness);
  Model other = model;
  other.contacts[0].friction.mu = 0.3;
  const Scene scene = make_scene(model, ReductionEstimate::no);
  EXPECT_EQ(corrected_scene(scene, model, std::array{other}).reduced.Phi, scene.reduced.Phi);
  Model whole = model;
  whole.reduction = {.method = ReductionMethod::none};
  const Scene unreduced = make_scene(whole, ReductionEstimate::no);
  EXPECT_EQ(corrected_scene(unreduced, whole, std::array{model_at(1.1 * stiffness)}).reduced.Phi,
            unreduced.reduced.Phi);
}

}  // namespace whirl::corrected_scene_test
