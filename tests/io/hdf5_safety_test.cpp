// Result files stay whole: full disks and killed writers.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "libio/results/hdf5.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::hdf5_safety_test {

namespace fs = std::filesystem;
using test::content, test::problem_of, test::write_example;

class ResultFileSafety : public test::InResultFolder {};

// A file size limit stands for a full disk: the error is thrown, the old file stays, and the
// process ends in order (HDF5's own clean-up would crash).
TEST_F(ResultFileSafety, FullDiskIsAnError) {
  write_example(path);
  const std::string old = content(path);
  std::fflush(nullptr);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string problem = problem_of([&] {
      ResultWriter out(path);
      out.dataset("/x", Mat(Mat::Random(1000, 100)), {"m", "x", {}});
      out.commit();
    });
    const bool is_right = problem == path.string() + ": cannot write dataset /x: File too large";
    std::exit(is_right ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(content(path) == old);
  EXPECT_EQ(files(), 1u);
}

/// A file whose parts all tell the same number.
void write_generation(const fs::path& path, int generation) {
  ResultWriter out(path, Replaces::anything);
  out.attribute("/", "generation", generation);
  out.dataset("/large", Mat(Mat::Random(1000, 100).array() + generation), {"m", "large", {}});
  out.dataset("/constant", Mat(Mat::Constant(300, 100, generation)), {"m", "constant", {}});
  out.attribute("/", "end", generation);
  out.commit();
}

/// The number, if the file is whole.
int read_generation(const fs::path& path) {
  const ResultReader in(path);
  const double generation = in.number_attribute("/", "generation");
  EXPECT_EQ(in.number_attribute("/", "end"), generation);
  EXPECT_EQ(in.matrix("/constant"), Mat(Mat::Constant(300, 100, generation)));
  const Mat noise = in.matrix("/large").array() - generation;
  EXPECT_EQ(noise.rows(), 1000);
  EXPECT_LE(noise.cwiseAbs().maxCoeff(), 1.0 + 1e-9);
  return static_cast<int>(generation);
}

TEST_F(ResultFileSafety, IsWholeWhereverItsWriterIsKilled) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> delay(0, 40'000);  // [us], a few writes long
  write_generation(path, 0);
  int generation = 0, killed_at_work = 0;
  for (int i = 0; i < 20; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int next = generation + 1;; ++next) write_generation(path, next);
    }
    // while files replace one another, whoever reads finds a whole one
    int before = generation;
    while (before == generation) before = read_generation(path);
    ::usleep(static_cast<useconds_t>(delay(random)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);

    const int after = read_generation(path);
    EXPECT_GE(after, before);
    generation = after;
    const std::string left_behind = path.string() + ".tmp." + std::to_string(child);
    if (fs::remove(left_behind)) ++killed_at_work;
    EXPECT_EQ(files(), 1u);
  }
  EXPECT_GT(killed_at_work, 0);
}

}  // namespace whirl::hdf5_safety_test
