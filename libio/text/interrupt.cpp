#include "libio/text/interrupt.hpp"

#include <signal.h>

#include <atomic>

namespace whirl::inline io {

namespace {

std::atomic<bool> interrupted = false;
std::atomic<bool> is_looked_at = false;  ///< by somebody, so that there may be something to keep

/// @param more  flags of sigaction beside SA_RESTART, by which files are written on
void ask_to_stop_at(int signal, int more) {
  struct sigaction action {};
  action.sa_handler = [](int number) {
    interrupted = true;
    if (is_looked_at) return;
    ::signal(number, SIG_DFL);
    ::raise(number);
  };
  action.sa_flags = SA_RESTART | more;
  sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void install_interrupt_handler() {
  ask_to_stop_at(SIGINT, static_cast<int>(SA_RESETHAND));  // only the first time
  ask_to_stop_at(SIGTERM, 0);
  ask_to_stop_at(SIGUSR1, 0);
}

bool is_interrupted() {
  if (!is_looked_at.load(std::memory_order_relaxed)) is_looked_at = true;
  return interrupted;
}

}  // namespace whirl::inline io
