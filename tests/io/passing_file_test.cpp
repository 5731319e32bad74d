// What is there for a while only: never somebody else's, and gone at every end but that of SIGKILL.

#include "libio/text/passing_file.hpp"

#include <signal.h>
#include <sys/wait.h>

#include "libio/results/output_lock.hpp"
#include "libio/results/temporary_folder.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace passing_file_test {

namespace fs = std::filesystem;

using PassingFileTest = InResultFolder;

// A link of the temporary file's name, put there by somebody who knows it, leads to no file of
// others.
TEST_F(PassingFileTest, TakesNoFileOfItsName) {
  const fs::path victim = folder / "victim", taken = path.string() + ".tmp.";
  std::ofstream(victim) << "precious";
  fs::create_symlink("victim", taken.string() + std::to_string(::getpid()));
  replace_file(path, "new");
  EXPECT_EQ(content(path), "new");
  EXPECT_EQ(content(victim), "precious");
  EXPECT_EQ(files(), 3u);
}

// Every signal that ends the process ends its unfinished files and folders, too.
TEST_F(PassingFileTest, IsRemovedBySignals) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGXCPU, SIGALRM, SIGPIPE}) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::signal(signal, SIG_DFL);
      ::setenv("TMPDIR", folder.c_str(), 1);
      const FileReplacement file(path);
      std::ofstream(file.temporary()) << "half";
      const TemporaryFolder within("test", path);
      std::ofstream(within.path() / "part") << "half";
      const OutputLock lock(path);
      ::raise(signal);
      ::_exit(9);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(files(), 0u) << signal;
  }
}

// A program that has a status for being stopped ends with it.
TEST_F(PassingFileTest, EndsWithTheStatusOfTheProgram) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGTERM, SIG_DFL);
    remove_passing_files_at_signals(130);
    const FileReplacement file(path);
    ::raise(SIGTERM);
    ::_exit(9);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  EXPECT_EQ(files(), 0u);
}

// What a child has as a copy of its parent's list is the parent's.
TEST_F(PassingFileTest, IsNotRemovedByAChild) {
  const FileReplacement file(path);
  std::fflush(nullptr);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::raise(SIGTERM);
    ::_exit(9);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(file.temporary()));
}

// One call at a time has an output; what a killed one has left keeps nobody out.
TEST_F(PassingFileTest, AnOutputIsOfOneCall) {
  const fs::path lock = path.string() + ".lock";
  {
    const OutputLock first(path);
    EXPECT_TRUE(fs::exists(lock));
    const std::string problem = problem_of([&] { OutputLock second(path); });
    EXPECT_NE(problem.find("another run is writing it"), std::string::npos) << problem;
    fs::create_symlink("result.h5", folder / "link.h5");
    EXPECT_NE(problem_of([&] { OutputLock second(folder / "link.h5"); }), "none");
    fs::remove(folder / "link.h5");
  }
  EXPECT_EQ(files(), 0u);
  std::ofstream(lock).close();  // left behind
  EXPECT_EQ(problem_of([&] { OutputLock again(path); }), "none");
  EXPECT_EQ(files(), 0u);
}

// A file or link of the lock's name that is no lock stays as it is.
TEST_F(PassingFileTest, ALockTakesNoFileOfItsName) {
  const fs::path lock = path.string() + ".lock";
  std::ofstream(lock) << "mine";
  EXPECT_NE(problem_of([&] { OutputLock refused(path); }), "none");
  EXPECT_EQ(content(lock), "mine");
  fs::remove(lock);
  std::ofstream(folder / "victim").close();
  fs::create_symlink("victim", lock);
  EXPECT_NE(problem_of([&] { OutputLock refused(path); }), "none");
  EXPECT_EQ(files(), 2u);
}

}  // namespace passing_file_test
}  // namespace whirl::test
