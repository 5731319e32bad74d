#pragma once
/// Points at which a computation that nobody would get a part of can be left.

#include <functional>

namespace whirl::inline base {

/// From its making to its end, in this thread: what is asked at every such point; it leaves the
/// computation by throwing, or returns.
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

/// Such a point, before a step of milliseconds or more: where matrices are assembled or factored.
/// @throws what the Interruptible of this thread does
void interruption_point();

}  // namespace whirl::inline base
