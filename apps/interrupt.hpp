#pragma once
/// What long work looks at and shows while it goes on.

#include <string>

namespace whirl::inline cli {

/// From now on the first Ctrl-C asks to stop, and the second one ends the program as usual.
void install_interrupt_handler();
/// Whether it did; long work looks at it and stops with what it has.
bool is_interrupted();

/// A line on standard error that is rewritten while something long goes on; only on a terminal.
class Progress {
 public:
  Progress(std::string what, long total, bool shows);
  ~Progress();
  /// Redraws at most ten times a second.
  void update(long done);

 private:
  std::string what_;
  long total_;
  bool shows_;
  double begin_, last_ = 0.0;
  bool has_drawn_ = false;
};

}  // namespace whirl::inline cli
