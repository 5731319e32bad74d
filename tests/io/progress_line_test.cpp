// What is shown of long work where there is no terminal, as in the log of a job.

#include "libio/text/progress_line.hpp"

#include <gtest/gtest.h>

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
    ProgressLine line("mapping", 20, shows, period);
    for (int i = 1; i <= 20; ++i) {
      std::this_thread::sleep_for(5ms);
      line.update(i);
    }
  }
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressLine, IsALineNowAndThenWithoutATerminal) {
  const std::string text = printed(true, 0.03);
  EXPECT_TRUE(std::regex_match(
      text, std::regex("(mapping: \\d+ of 20, [0-9.]+/s, \\d+:\\d\\d left\n){1,3}")))
      << text;
  EXPECT_EQ(printed(true, 3600.0), "");
  EXPECT_EQ(printed(false, 0.0), "");
}

}  // namespace whirl::progress_line_test
