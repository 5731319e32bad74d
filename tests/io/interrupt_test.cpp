// Signals that ask to stop: a program with nothing to keep ends, another one stops with what it
// has.

#include "libio/text/interrupt.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

namespace whirl::interrupt_test {

constexpr int went_on = 7;

/// Ends with `went_on` if a signal is only taken note of.
[[noreturn]] void raise_and_go_on(int signal, bool is_looked_at) {
  install_interrupt_handler();
  if (is_looked_at) is_interrupted();
  ::raise(signal);
  ::_exit(is_interrupted() ? went_on : 0);
}

// Before anybody asks there is nothing to stop with: reading a large model or reducing it must not
// make the program deaf.
TEST(Interrupt, EndsAProgramThatHasNothingYet) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    EXPECT_EXIT(raise_and_go_on(signal, false), testing::KilledBySignal(signal), "");
  }
}

TEST(Interrupt, AsksAProgramThatLooksToStop) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    EXPECT_EXIT(raise_and_go_on(signal, true), testing::ExitedWithCode(went_on), "");
  }
}

}  // namespace whirl::interrupt_test
