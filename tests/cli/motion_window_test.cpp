// Stretches of a motion: what plot, export and animate take, draw and say.

#include "tests/cli/program.hpp"

namespace whirl::test {
namespace motion_window_test {

class Window : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
    const Outcome made = whirl({"simulate", "rub.toml", "--discard", "4", "--revolutions", "12",
                                "--samples", "16", "--out", "run.h5", "--quiet"});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  std::string problem(const std::vector<std::string>& words) const {
    const auto before = files();
    const Outcome outcome = whirl(words);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_EQ(files(), before);
    return outcome.err;
  }
  /// Lines of a file.
  long lines(const std::string& file) const {
    const std::string text = content(folder / file);
    return std::count(text.begin(), text.end(), '\n');
  }
};

TEST_F(Window, OfAPlotIsDrawnAndSaid) {
  for (const char* kind : {"time_history", "orbit", "contact_forces", "poincare"}) {
    const json r = result(
        {"plot", "run.h5", kind, "--from-revolution", "4", "--revolutions", "2", "--out", "x.svg"});
    EXPECT_EQ(r["notes"], json::array({"Revolutions 4 to 6 of 4 to 16, 0.2513 to 0.377 s."}))
        << kind;
    EXPECT_TRUE(has(content(folder / "x.svg"), "Revolutions 4 to 6 of 4 to 16")) << kind;
  }
  const Outcome told = whirl({"plot", "run.h5", "orbit", "--times", "300:400ms"});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_TRUE(has(told.out, "Revolutions 4.8125 to 6.3125 of 4 to 16")) << told.out;
}

TEST_F(Window, OfAnExportIsWrittenAndSaid) {
  const Outcome vtk =
      whirl({"export", "run.h5", "--out", "v", "--from-revolution", "4", "--revolutions", "3"});
  EXPECT_EQ(vtk.status, 0) << vtk.err;
  EXPECT_TRUE(has(vtk.out, "49 frames, revolutions 4 to 7 of 4 to 16")) << vtk.out;
  const Outcome end = whirl({"export", "run.h5", "--out", "v"});
  EXPECT_TRUE(has(end.out, "64 frames, revolutions 12")) << end.out;

  const Outcome csv = whirl({"export", "run.h5", "--format", "csv", "--out", "c",
                             "--from-revolution", "5", "--revolutions", "1"});
  EXPECT_EQ(csv.status, 0) << csv.err;
  EXPECT_EQ(lines("c_trajectory_time.csv"), 1 + 17);  // a head, and both ends of the revolution
  EXPECT_TRUE(has(csv.out, "revolutions 5 to 6 of 4 to 16")) << csv.out;
}

TEST_F(Window, ThatWasNotRecordedIsRefused) {
  const std::string there = "was recorded: revolutions 4 to 16, 0.2513 to 1.005 s";
  EXPECT_TRUE(has(problem({"plot", "run.h5", "orbit", "--from-revolution", "0"}), there));
  EXPECT_TRUE(has(problem({"plot", "run.h5", "orbit", "--times", "0:0.5"}), there));
  EXPECT_TRUE(
      has(problem({"export", "run.h5", "--from-revolution", "15", "--revolutions", "2"}), there));
  EXPECT_TRUE(has(
      problem({"plot", "run.h5", "spectrum", "--revolutions", "2"}),
      "orbit, time_history, orbits, poincare, phase_plane, tilts, contact_motion, contact_forces"));
  EXPECT_TRUE(has(problem({"plot", "run.h5", "orbit", "--times", "0.3:0.4", "--revolutions", "2"}),
                  "does not go with --revolutions"));
  EXPECT_TRUE(has(problem({"export", "rub.toml", "--times", "0.3:0.4"}), "holds none"));
}

}  // namespace motion_window_test
}  // namespace whirl::test
