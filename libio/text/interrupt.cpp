#include "libio/text/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace whirl::inline io {

namespace {

std::atomic<bool> interrupted = false;

}  // namespace

void install_interrupt_handler() {
  std::signal(SIGINT, [](int) {
    interrupted = true;
    std::signal(SIGINT, SIG_DFL);
  });
}

bool is_interrupted() {
  return interrupted;
}

}  // namespace whirl::inline io
