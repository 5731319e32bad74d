#pragma once
/// Points at which a computation can be left whose parts are of no use to anybody.

#include <functional>

namespace whirl::inline base {

/// While an Interruptible lives, its function is called at every such point of this thread; the
/// function leaves the computation by throwing, or returns.
class Interruptible {
 public:
  explicit Interruptible(std::function<void()> ask);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  std::function<void()> ask_;
  const std::function<void()>* before_;
};

/// A point at which a computation can be left, before a step of milliseconds or more: where
/// matrices are assembled or factored, and where a flow begins.
/// @throws what the Interruptible of this thread does
void interruption_point();

/// Calls f, and leaves f at an interruption_point once `stops` says so.
/// @return  whether f has returned; what f had changed by then stays changed
template <class F>
bool finishes_unless(const std::function<bool()>& stops, F&& f) {
  struct Left {};
  const Interruptible leaves([&] {
    if (stops()) throw Left{};
  });
  try {
    f();
    return true;
  } catch (const Left&) {
    return false;
  }
}

}  // namespace whirl::inline base
