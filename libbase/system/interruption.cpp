#include "libbase/system/interruption.hpp"

#include <utility>

namespace whirl::inline base {

namespace {

thread_local const std::function<void()>* asked = nullptr;

}  // namespace

Interruptible::Interruptible(std::function<void()> ask)
    : ask_(std::move(ask)), before_(std::exchange(asked, &ask_)) {}

Interruptible::~Interruptible() {
  asked = before_;
}

void interruption_point() {
  if (asked) (*asked)();
}

}  // namespace whirl::inline base
