#include "libio/text/interrupt.hpp"

#include <signal.h>

#include <atomic>

#include "libio/text/passing_file.hpp"

namespace whirl::inline io {

namespace {

std::atomic<bool> interrupted = false, by_hand = false;
std::atomic<bool> is_looked_at = false;  ///< by somebody, so that there may be something to keep

void ask_to_stop(int signal) {
  const bool is_second = signal == SIGINT && by_hand.exchange(true);
  interrupted = true;
  if (is_second || !is_looked_at) end_by_signal(signal);
}

void ask_to_stop_at(int signal) {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;  // files are written on
  sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void install_interrupt_handler() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) ask_to_stop_at(signal);
}

bool is_interrupted() {
  if (!is_looked_at.load(std::memory_order_relaxed)) is_looked_at = true;
  return interrupted;
}

}  // namespace whirl::inline io
