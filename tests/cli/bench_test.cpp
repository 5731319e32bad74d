// bench: errors and times of integrators, as table, JSON, result file and picture.

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "libdyn/studies/work_precision_study.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/hdf5.hpp"
#include "tests/cli/program.hpp"

namespace whirl::test {
namespace bench_test {

class Bench : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
  }
};

const std::vector<std::string> call{"bench",        "rub.toml",   "--methods", "dop853,arkode,rk4",
                                    "--tolerances", "1e-6,1e-10", "--discard", "20"};

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Every method at every tolerance; permanent contact is smooth, so that all errors follow the
// tolerance and RK4 takes 100 and 1000 steps a revolution.
TEST_F(Bench, MeasuresEveryMethodAtEveryTolerance) {
  const json r = result(call);
  EXPECT_EQ(r["revolutions"], 20);
  EXPECT_EQ(r["discard"], 20);
  EXPECT_EQ(r["reference"]["made_by"], "taylor in quadruple precision at 1e-26");
  EXPECT_LT(r["reference"]["error"], 3e-16);  // of its end as a double
  EXPECT_LT(r["reference"]["growth"], 1.0);   // heavily damped
  ASSERT_EQ(r["runs"].size(), 6u);
  const char* methods[] = {"dop853", "arkode", "rk4"};
  for (std::size_t i = 0; i < 6; i += 2) {
    const json &coarse = r["runs"][i], &fine = r["runs"][i + 1];
    EXPECT_EQ(coarse["method"], methods[i / 2]);
    EXPECT_EQ(fine["method"], methods[i / 2]);
    EXPECT_EQ(coarse["tolerance"], 1e-6);
    EXPECT_EQ(fine["tolerance"], 1e-10);
    EXPECT_LT(fine["error"].get<double>(), 1e-3 * coarse["error"].get<double>());
    EXPECT_LT(fine["error"], 1e-8);
    EXPECT_GT(fine["steps"], coarse["steps"]);
    EXPECT_GT(fine["evaluations"], fine["steps"]);
    EXPECT_GT(coarse["ns_per_revolution"], 100.0);
    EXPECT_LT(fine["ns_per_revolution"], 1e8);
  }
  EXPECT_EQ(r["runs"][4]["steps"], 20 * 100);
  EXPECT_EQ(r["runs"][5]["steps"], 20 * 1000);

  const std::string text = whirl(call).out;
  for (const char* part :
       {"method", "tolerance", "error", "ns/revolution", "1e-10", "arkode", "after 20 revolutions",
        "taylor in quadruple precision at 1e-26", "the smallest clearance"}) {
    EXPECT_TRUE(has(text, part)) << part;
  }
  EXPECT_FALSE(has(text, "chaotic"));
}

TEST_F(Bench, DrawsAPicture) {
  EXPECT_EQ(whirl(with(call, {"--svg", "bench.svg", "--quiet"})).status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"bench.svg", "rub.toml"}));
  const std::string svg = content(folder / "bench.svg");
  for (const char* part : {">dop853</text>", ">arkode</text>", ">rk4</text>",
                           ">time per revolution [ns]</text>", "error after 20 revolutions"}) {
    EXPECT_TRUE(has(svg, part)) << part;
  }
  const Outcome parsed =
      wait(start(python, {"-c",
                          "import xml.dom.minidom as m; print(m.parse('bench.svg').documentElement"
                          ".tagName)"}));
  EXPECT_EQ(parsed.out, "svg\n") << parsed.err;
}

TEST_F(Bench, WritesTheSameNumbersToTheResultFile) {
  const json r = result(with(call, {"--out", "bench.h5"}));
  const ResultReader file(folder / "bench.h5");
  EXPECT_EQ(file.strings("/bench/method"), (std::vector<std::string>{"dop853", "arkode", "rk4"}));
  EXPECT_EQ(file.vector("/bench/tolerance"), Vec2(1e-6, 1e-10));
  const Mat error = file.matrix("/bench/error"), time = file.matrix("/bench/time");
  const Mat steps = file.matrix("/bench/steps");
  ASSERT_EQ(error.rows(), 3);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const json& run = r["runs"][static_cast<std::size_t>(i)];
    EXPECT_EQ(error(i / 2, i % 2), run["error"]);
    EXPECT_DOUBLE_EQ(1e9 * time(i / 2, i % 2), run["ns_per_revolution"].get<double>());
    EXPECT_DOUBLE_EQ(20.0 * steps(i / 2, i % 2), run["steps"].get<double>());
  }
  EXPECT_EQ(file.string_attribute("/bench", "reference"), "taylor in quadruple precision at 1e-26");
  // what it is of is read back with it
  const auto read = read_result<WorkPrecisionStudy>(file);
  EXPECT_EQ(read.options.methods, file.strings("/bench/method"));
  EXPECT_EQ(read.options.tolerances, (std::vector<double>{1e-6, 1e-10}));
  EXPECT_EQ(read.reference.error, file.number_attribute("/bench", "reference_error"));
  EXPECT_EQ(read.reference.made_by, file.string_attribute("/bench", "reference"));
}

// A damper of 1e6 N.s/m on 2 kg decays with 5e5 1/s, too fast for steps of 0.2 ms of RK4; the
// implicit method does not mind.
TEST_F(Bench, SaysWhichMethodsFail) {
  const std::vector<std::string> stiff{"bench",         "rub.toml",
                                       "--set",         "bearing.shaft.damping=1e6",
                                       "--methods",     "rk4,cvode-bdf",
                                       "--tolerances",  "1e-8",
                                       "--discard",     "0",
                                       "--revolutions", "1"};
  const json r = result(with(stiff, {"--svg", "bench.svg", "--out", "bench.h5"}));
  ASSERT_EQ(r["runs"].size(), 2u);
  EXPECT_TRUE(r["runs"][0]["error"].is_null());
  EXPECT_TRUE(r["runs"][0]["ns_per_revolution"].is_null());
  EXPECT_TRUE(has(r["runs"][0]["failure"], "grows without bound"));
  EXPECT_LT(r["runs"][1]["error"], 1e-5);
  EXPECT_FALSE(r["runs"][1].contains("failure"));
  EXPECT_TRUE(has(whirl(stiff).out, "rk4 at 1e-8 failed"));
  EXPECT_TRUE(std::isnan(ResultReader(folder / "bench.h5").matrix("/bench/error")(0, 0)));
  EXPECT_FALSE(has(content(folder / "bench.svg"), "rk4"));
}

// An unstable motion: negative damping makes deviations grow by exp(|c| T / (2 m)) = 8e4 in ten
// revolutions.
TEST_F(Bench, SaysThatDeviationsGrow) {
  write("unstable.toml", jeffcott);
  const std::vector<std::string> words{"bench",         "unstable.toml",
                                       "--speed",       "100rad/s",
                                       "--set",         "bearing.shaft.damping={xx=-72,yy=-72}",
                                       "--discard",     "0",
                                       "--revolutions", "10",
                                       "--methods",     "dop853",
                                       "--tolerances",  "1e-6"};
  const double expected = std::exp(72.0 / 4.0 * 2.0 * pi / 10.0);
  const double growth = result(words)["reference"]["growth"];
  EXPECT_GT(growth, 0.5 * expected);
  EXPECT_LT(growth, 3.0 * expected);
  const std::string text = whirl(words).out;
  EXPECT_TRUE(has(text, "a small deviation grows ") && has(text, "e times every 0.")) << text;
  EXPECT_TRUE(has(text, "the size of the motion")) << text;
}

TEST_F(Bench, GoesOnWhereAResultEnded) {
  EXPECT_EQ(whirl({"simulate", "rub.toml", "--out", "run.h5", "--quiet"}).status, 0);
  const json settled = result(with(call, {"--from", "run.h5", "--discard", "0"}));
  EXPECT_LT(settled["runs"][1]["error"], 1e-8);
}

// Ctrl-C in a transient that would take days: nothing is measured, and that is said.
TEST_F(Bench, StopsOnCtrlC) {
  const pid_t child = start(WHIRL_PROGRAM, {"bench", "rub.toml", "--discard", "10000000"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_EQ(outcome.status, 130);
  EXPECT_TRUE(has(outcome.out, "stopped before the first run")) << outcome.out;
}

TEST_F(Bench, RefusesWhatItCannotMeasure) {
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Outcome outcome = whirl(with({"bench", "rub.toml"}, more));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_TRUE(has(refusal({"--methods", "dop853,rk5"}), "--methods rk5: unknown method"));
  EXPECT_TRUE(has(refusal({"--methods", ""}), "unknown method"));
  EXPECT_TRUE(has(refusal({"--tolerances", "1e-6,2"}), "--tolerances 2"));
  EXPECT_TRUE(has(refusal({"--tolerances", "1e-6,,1e-8"}), "--tolerances"));
  EXPECT_TRUE(has(refusal({"--revolutions", "0"}), "--revolutions 0"));
  EXPECT_TRUE(has(refusal({"--svg", "nowhere/bench.svg"}), "nowhere"));
  write("rotor.toml", jeffcott);
  const Outcome outcome = whirl({"bench", "rotor.toml"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome.err, "operation.speed")) << outcome.err;
}

}  // namespace bench_test
}  // namespace whirl::test
