#pragma once
/// What is shown while something long goes on.

#include <string>

namespace whirl::inline io {

/// "2.5/s, 3:12 left".
/// @param elapsed  [s]
std::string rate_text(long done, long total, double elapsed);
/// "120 of 600, 2.5/s, 3:12 left".
std::string progress_text(long done, long total, double elapsed);

/// A line on standard error: on a terminal one that is rewritten, elsewhere, as in the log of a job,
/// one after the other.
class ProgressLine {
 public:
  /// @param period  between two lines where there is no terminal, and before the first one [s]
  ProgressLine(std::string what, long total, bool shows, double period = 60.0);
  ~ProgressLine();
  /// Redraws at most ten times a second.
  void update(long done);

 private:
  void redraw(long done, double elapsed);

  std::string what_;
  long total_;
  bool shows_, is_terminal_;
  double period_, begin_, last_;
  bool has_drawn_ = false;
};

}  // namespace whirl::inline io
