#include "libdyn/motions/support_loads.hpp"

#include <gtest/gtest.h>

#include "libdyn/linear/unbalance_study.hpp"
#include "libdyn/motions/run_model.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::support_loads_test {

/// Half of the way between largest and smallest.
double amplitude(const Vec& signal) {
  return 0.5 * (signal.maxCoeff() - signal.minCoeff());
}

whirl::Run run_of(const Model& model, long discard, long revolutions, int samples = 64) {
  return run_model(model, {.simulation = {.revolutions = revolutions,
                                          .discard = discard,
                                          .samples = samples,
                                          .integration = {.tolerance = 1e-11}}});
}

/// Amplitudes of x of all parts by the unbalance response of the whole rotor.
std::vector<double> linear_amplitudes(const Model& model) {
  const Assembler assembler(model.structure);
  std::vector<double> all;
  for (const BearingResponse& b :
       unbalance_study(model, assembler, {.speeds = {model.speed}, .has_given_speeds = true})
           .bearings) {
    all.push_back(std::abs(b.x(0)));
  }
  return all;
}

/// The two-disk rotor without a contact.
Model free_rotor() {
  Model model = test::TwoDiskRub{.speed = 3000.0 * rpm, .c = 2e4}.model();
  model.reduction = {};  // with the static shapes of dampers
  model.contacts.clear();
  return model;
}

TEST(SupportLoads, OfASettledMotionAreThoseOfTheUnbalanceResponse) {
  const Model model = free_rotor();
  const std::vector<double> linear = linear_amplitudes(model);
  const whirl::Run run = run_of(model, 600, 2, 512);
  ASSERT_EQ(run.supports.size(), 2U);
  for (const Eigen::Index i : {0, 1}) {
    const Vec x = run.simulation.recording.on_supports.row(2 * i).transpose();
    EXPECT_NEAR(amplitude(x), linear[static_cast<std::size_t>(i)],
                1e-3 * linear[static_cast<std::size_t>(i)]);  // the tolerance of the reduction
  }
}

// The reduction leaves modes out; their inertia alone is missing in the force on a rigid bearing.
TEST(SupportLoads, OnRigidBearingsFollowFromFewModes) {
  Model model = free_rotor();
  model.structure.bearings = {test::rigid(test::node(1)), test::rigid(test::node(13))};
  model.structure.damping.mass = 40.0;
  model.reduction = {.method = ReductionMethod::modal, .modes = 12};
  const std::vector<double> linear = linear_amplitudes(model);
  const whirl::Run run = run_of(model, 600, 2, 512);
  for (const Eigen::Index i : {0, 1}) {
    const Vec x = run.simulation.recording.on_supports.row(2 * i).transpose();
    EXPECT_NEAR(amplitude(x), linear[static_cast<std::size_t>(i)],
                1e-3 * linear[static_cast<std::size_t>(i)]);
  }
}

// In the mean nothing accelerates: supports and contact bear the weight.
TEST(SupportLoads, AndTheContactBearTheWeightInTheMean) {
  Model model = test::P3.model();
  const whirl::Run run = run_of(model, 3000, 8);
  const Recording& r = run.simulation.recording;
  const double weight = (test::P3.mr + test::P3.ms) * test::P3.gravity;
  const double sum = r.on_supports.row(1).mean() + r.on_supports.row(3).mean();
  EXPECT_NEAR(sum, -weight, 1e-6 * weight);  // the contact is between both: it cancels
  EXPECT_GT(r.normal.maxCoeff(), 0.0);
}

// A rigid bearing beside a rub has the force of a bearing that hardly gives.
TEST(SupportLoads, OnARigidBearingSeeTheContact) {
  Model model = test::TwoDiskRub{.speed = 4430.0 * rpm, .modes = 0}.model();
  model.contacts[0].clearance = 2e-4;
  model.structure.bearings[1] = test::bearing(test::node(13), test::isotropic(1e10, 1e4));
  const whirl::Run stiff = run_of(model, 0, 1);
  model.structure.bearings[1] = test::rigid(test::node(13));
  const whirl::Run rigid = run_of(model, 0, 1);
  ASSERT_GT(rigid.simulation.recording.normal.maxCoeff(), 100.0);
  const Mat a = rigid.simulation.recording.on_supports, b = stiff.simulation.recording.on_supports;
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 0.01 * b.cwiseAbs().maxCoeff());
}

// mu N v of a rub that lasts, at the speed of the rim: the slip is nearly Omega R.
TEST(ContactMeter, TellsHeatAndMomentOfFriction) {
  const whirl::Run run = run_of(test::P3.model(), 3000, 16);
  const ContactMeasure& measure = run.simulation.recording.contacts.at(0);
  ASSERT_EQ(measure.regime(), Regime::permanent);
  const FrictionLoad& ring = run.simulation.recording.rubbing.at(0);
  const double time = 16.0 * run.scene.contacts.period();
  EXPECT_NEAR(ring.energy, ring.mean_power * time, 1e-12 * ring.energy);
  // the largest of nine points of each step, and of parabolas through them
  EXPECT_NEAR(ring.max_torque, test::P3.R * measure.max_tangential, 1e-3 * ring.max_torque);
  // T of all samples times R: the mean moment
  const double mean = run.simulation.recording.friction.row(0).mean();
  EXPECT_NEAR(ring.mean_torque, test::P3.R * mean, 1e-4 * std::abs(ring.mean_torque));
  EXPECT_GT(ring.mean_power, 0.0);
  EXPECT_LT(ring.mean_power, ring.max_power);
}

/// The rotor with a second unbalance that is there from the start, begins late, or is missing.
Model with_blade(Beginning begins, double moment = 5e-3) {
  Model model = test::TwoDiskRub{.speed = 4430.0 * rpm}.model();
  model.structure.unbalances.push_back(
      {.at = test::node(9), .moment = moment, .phase = 1.0, .begins = begins});
  return model;
}

/// Columns of a motion in the displacements of all points.
Mat motion(const whirl::Run& run) {
  return run.scene.displacement_map() * run.simulation.recording.eta;
}

// Within a revolution: the motion before is that without the blade, the motion after goes on from
// its end with all of the unbalance.
TEST(LateLoads, BeginAtTheirInstant) {
  const whirl::Run late = run_of(with_blade({.revolutions = 3.25}), 40, 8);
  const whirl::Run never = run_of(with_blade({}, 0.0), 40, 8);
  ASSERT_EQ(late.simulation.recording.begins.size(), 1U);
  const double period = late.scene.contacts.period();
  EXPECT_NEAR(late.simulation.recording.begins[0], 43.25 * period, 1e-12 * period);
  const Eigen::Index before = 3 * 64 + 16;
  const Mat a = motion(late), b = motion(never);
  const double size = b.cwiseAbs().maxCoeff();
  EXPECT_LT((a.leftCols(before + 1) - b.leftCols(before + 1)).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_GT((a.rightCols(64) - b.rightCols(64)).cwiseAbs().maxCoeff(), 1e-2 * size);
}

TEST(LateLoads, GoOnFromTheEndOfTheMotionBefore) {
  const whirl::Run late = run_of(with_blade({.revolutions = 3.0}), 40, 8);
  const whirl::Run before = run_of(with_blade({}, 0.0), 40, 3);
  EarlierEnd end{full_state(before.scene, before.simulation.end)};
  Model after = with_blade({});
  after.start.from = StartFrom::file;
  const whirl::Run by_hand = run_model(
      after, {.simulation = {.revolutions = 5, .discard = 0, .integration = {.tolerance = 1e-11}}},
      end);
  const Mat a = motion(late).rightCols(5 * 64), b = motion(by_hand);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-6 * b.cwiseAbs().maxCoeff());
}

TEST(LateLoads, OfATimeAreThoseOfTheSameRevolutions) {
  const double period = 60.0 / 4430.0;
  const whirl::Run by_time = run_of(with_blade({.time = 2.5 * period}), 10, 6);
  const whirl::Run by_turns = run_of(with_blade({.revolutions = 2.5}), 10, 6);
  EXPECT_LT((motion(by_time) - motion(by_turns)).cwiseAbs().maxCoeff(),
            1e-8 * motion(by_turns).cwiseAbs().maxCoeff());
}

TEST(LateLoads, TellForcesBeforeAndAfter) {
  const RunSummary summary = run_summary(run_of(with_blade({.revolutions = 4.0}), 40, 40));
  ASSERT_EQ(summary.begins.size(), 1U);
  for (const SupportLoad& s : summary.supports) {
    ASSERT_TRUE(s.before && s.after);
    EXPECT_LE(*s.before, s.largest);
    EXPECT_LE(*s.after, s.largest);
    EXPECT_LT(*s.before, *s.after);
  }
}

// A load that begins after the recording has no part in it.
TEST(LateLoads, MayBeginTooLate) {
  const whirl::Run late = run_of(with_blade({.revolutions = 8.0}), 10, 8);
  const whirl::Run never = run_of(with_blade({}, 0.0), 10, 8);
  EXPECT_TRUE(late.simulation.recording.begins.empty());
  EXPECT_LT((motion(late) - motion(never)).cwiseAbs().maxCoeff(),
            1e-8 * motion(never).cwiseAbs().maxCoeff());
}

}  // namespace whirl::support_loads_test
