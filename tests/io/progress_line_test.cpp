// What is shown of long work, on a terminal and in the log of a job.

#include "libio/text/progress_line.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <regex>
#include <thread>

namespace whirl::progress_line_test {

using namespace std::chrono_literals;

TEST(ProgressText, TellsRateAndTimeLeft) {
  EXPECT_EQ(progress_text(2100, 100'000, 10.0), "2100 of 100000, 210/s, 7:46 left");
  EXPECT_EQ(progress_text(5, 20, 20.0), "5 of 20, 0.25/s, 1:00 left");
  EXPECT_EQ(progress_text(1, 3601, 1.0), "1 of 3601, 1/s, 1:00:00 left");
  EXPECT_EQ(progress_text(0, 20, 20.0), "0 of 20, 0/s");  // nobody knows
  EXPECT_EQ(progress_text(20, 20, 0.0), "20 of 20, 0/s");
}

/// What a line prints that is told 1, 2, ... of 20 all 5 ms.
std::string printed(bool shows, double period) {
  testing::internal::CaptureStderr();  // a file, no terminal
  {
    ProgressLine line("mapping", shows, period);
    line.update(0, 20);
    for (int i = 1; i <= 20; ++i) {
      std::this_thread::sleep_for(5ms);
      line.update(i, 20);
    }
  }
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressLine, IsALineNowAndThenWithoutATerminal) {
  const std::string text = printed(true, 0.03);
  EXPECT_TRUE(
      std::regex_match(text, std::regex("(mapping: \\d+ of 20, [0-9.]+/s, \\d+:\\d\\d left\n)+")))
      << text;
  EXPECT_EQ(printed(true, 3600.0), "");
  EXPECT_EQ(printed(false, 0.0), "");
}

// On a terminal it does not wait for a step to end: here nothing is ever told of any.
TEST(ProgressLine, IsThereOnATerminalHoweverLongAStepTakes) {
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    const ProgressLine line("fitting", true, 3600.0);
    std::this_thread::sleep_for(1h);
    ::_exit(0);
  }
  std::string shown;
  for (char letter; shown.find("fitting 0:0") == std::string::npos;) {
    if (::read(terminal, &letter, 1) != 1) break;
    shown += letter;
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(terminal);
  EXPECT_TRUE(shown.find("fitting 0:0") != std::string::npos) << shown;
}

}  // namespace whirl::progress_line_test
