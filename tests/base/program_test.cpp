// Other programs: how they end and what they say.

#include "libbase/system/program.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace whirl::program_test {

class OtherProgram : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(output); }
  const std::filesystem::path output = std::filesystem::path(testing::TempDir()) /
                                       ("whirl_program_test_" + std::to_string(::getpid()));
};

TEST_F(OtherProgram, GivesItsExitStatusOrItsSignal) {
  EXPECT_EQ(run_program({"true"}), 0);
  EXPECT_EQ(run_program({"sh", "-c", "exit 3"}), 3);
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}), 128 + 9);
  EXPECT_EQ(run_program({"whirl_no_such_program"}), std::nullopt);
}

// Words arrive as they are: no shell takes them apart.
TEST_F(OtherProgram, IsGivenItsWordsWithoutAShell) {
  ASSERT_EQ(run_program({"echo", "a  b", "$HOME;"}, output), 0);
  EXPECT_EQ(last_words(output), "a  b $HOME;");
}

TEST_F(OtherProgram, SaysAnErrorRatherThanTheLinesBehindIt) {
  std::ofstream(output) << "  File \"x.py\"\nValueError: no such day\n\nbye\n";
  EXPECT_EQ(last_words(output), "ValueError: no such day");
  std::ofstream(output) << "one\ntwo\n\n";
  EXPECT_EQ(last_words(output), "two");
  std::ofstream(output) << "";
  EXPECT_EQ(last_words(output), "it does not say why");
}

TEST(ProgramNamed, IsTheOneThatRuns) {
  const auto shell = program_named("sh");
  ASSERT_TRUE(shell);
  EXPECT_EQ(run_program({*shell, "-c", "exit 3"}), 3);
  EXPECT_FALSE(program_named("no-program-of-this-name"));
}

}  // namespace whirl::program_test
