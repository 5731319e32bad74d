// Runs that are read back from their result, as if they had been integrated here.

#include <gtest/gtest.h>

#include "libdyn/motions/run_model.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/call.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/motion_results.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::stored_run_test {

constexpr std::string_view text = R"(
format = 1
[operation]
speed = "200 rad/s"
[material.steel]
density = 7800
youngs_modulus = 2e11
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1.0
outer_diameter = 0.03
elements = 4
[[bearing]]
at = 0.0
stiffness = 1e7
[[bearing]]
at = 1.0
stiffness = 1e7
damping = 1e3
[[disk]]
at = 0.5
mass = 10.0
unbalance = { offset = 1e-3 }
[[contact]]
name = "ring"
at = 0.5
clearance = 1e-3
stiffness = 1e6
friction = 0.1
)";
constexpr double rounding = 1e-12;  // of displacements that are computed in other coordinates

Model rotor(const std::vector<std::string>& sets = {}) {
  return parse_model(std::string(text), "rotor.toml", sets, {});
}

class StoredRuns : public test::InResultFolder {
 protected:
  const Model model = rotor();
  const dyn::Run run =
      run_model(model, {.simulation = {.revolutions = 6, .discard = 3, .samples = 16}});

  std::unique_ptr<ResultWriter> begin() const {
    auto file = std::make_unique<ResultWriter>(path, Replaces::anything);
    write_origin(*file, {{.verb = "simulate", .file = "rotor.toml"}, {"whirl"}, "1"}, model);
    return file;
  }
  void write() const {
    const auto file = begin();
    write_run(*file, run, model);
    file->commit();
  }
};

TEST_F(StoredRuns, AreTheSameToTheLastBit) {
  write();
  const StoredRun stored = stored_run(path.string(), model, "", "");
  const Recording &read = stored.run.simulation.recording, &r = run.simulation.recording;
  EXPECT_EQ(read.eta, r.eta);
  EXPECT_EQ(read.normal, r.normal);
  EXPECT_EQ(read.friction, r.friction);
  EXPECT_EQ(read.first_revolution, r.first_revolution);
  EXPECT_GT(r.contacts[0].impacts, 0.0);
  EXPECT_EQ(read.contacts[0].impacts, r.contacts[0].impacts);
  EXPECT_EQ(read.contacts[0].duty, r.contacts[0].duty);
  EXPECT_EQ(stored.run.method, run.method);
  EXPECT_EQ(stored.run.stations.size(), run.stations.size());
  EXPECT_EQ(stored.run.simulation.integration.cost.steps, run.simulation.integration.cost.steps);
}

// another machine may find other vectors of a pair of equal frequencies
TEST_F(StoredRuns, MayHaveOtherCoordinatesOfTheSameRotor) {
  MotionRecord turned = recorded_motion(run);
  const Mat Q = Mat::Identity(turned.basis.cols(), turned.basis.cols()).rowwise().reverse();
  turned.basis = turned.basis * Q;
  turned.coordinates = Q.transpose() * turned.coordinates;
  const auto file = begin();
  write_result(*file, motion_end(run.scene, run.simulation.end));
  write_result(*file, run_facts(run.simulation));
  write_result(*file, contact_shares(run.simulation.recording.contacts, 6));
  write_result(*file, turned);
  file->commit();
  const Mat eta = stored_run(path.string(), model, "", "").run.simulation.recording.eta;
  const Mat& expected = run.simulation.recording.eta;
  EXPECT_LT((eta - expected).norm(), rounding * expected.norm());
}

TEST_F(StoredRuns, OfAnotherRotorAreNotTaken) {
  const auto problem = [&](const Model& of) -> std::string {
    try {
      stored_run(path.string(), of, "", "");
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  write();
  EXPECT_EQ(problem(rotor({"operation.speed=200 rad/s"})), "none");
  for (const char* set : {"shaft.1.elements=6", "disk.1.mass=20"}) {
    EXPECT_NE(problem(rotor({set})).find("its motion is of another rotor than this model"),
              std::string::npos)
        << set;
  }
  begin()->commit();
  EXPECT_NE(problem(model).find("holds no motion"), std::string::npos);
}

}  // namespace whirl::stored_run_test
