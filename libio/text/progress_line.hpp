#pragma once
/// What a terminal shows while something long goes on.

#include <string>

namespace whirl::inline io {

/// A line on standard error that is rewritten; only on a terminal.
class ProgressLine {
 public:
  ProgressLine(std::string what, long total, bool shows);
  ~ProgressLine();
  /// Redraws at most ten times a second.
  void update(long done);

 private:
  std::string what_;
  long total_;
  bool shows_;
  double begin_, last_ = 0.0;
  bool has_drawn_ = false;
};

}  // namespace whirl::inline io
