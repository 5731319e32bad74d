#pragma once
/// What is shown while something long goes on.

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace whirl::inline io {

/// "2.5/s, 3:12 left".
/// @param elapsed  [s]
std::string rate_text(long done, long total, double elapsed);
/// "120 of 600, 2.5/s, 3:12 left".
std::string progress_text(long done, long total, double elapsed);

/// Progress on standard error: on a terminal a line that is rewritten every second, from the first
/// second on; elsewhere, as in the log of a job, line after line.
///
/// A thread of its own draws the line, however long a step of the work takes.
class ProgressLine {
 public:
  /// @param what    what goes on
  /// @param period  between two lines where there is no terminal, and before the first one [s]
  ProgressLine(std::string what, bool shows, double period = 60.0);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  /// @param total  0: not known, the time alone is told
  void update(long done, long total);

 private:
  void tick(const std::stop_token& stop);
  void redraw();
  std::string state() const;

  std::string what_;
  bool is_terminal_;
  double period_, begin_;
  std::mutex mutex_;
  std::condition_variable_any ends_;
  long done_ = 0, total_ = 0;
  bool has_drawn_ = false;
  std::jthread ticker_;  // last: it uses the others
};

}  // namespace whirl::inline io
