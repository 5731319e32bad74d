#include "libio/text/interrupt.hpp"

#include <signal.h>

#include <atomic>

namespace whirl::inline io {

namespace {

std::atomic<bool> interrupted = false;

/// @param more  flags of sigaction beside SA_RESTART, by which files are written on
void ask_to_stop_at(int signal, int more) {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
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
  return interrupted;
}

}  // namespace whirl::inline io
