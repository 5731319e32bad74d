#include "libio/texts/status_text.hpp"

#include <fmt/format.h>

#include "libio/text/progress_line.hpp"

namespace whirl::inline io {

namespace {

/// "120 of 600 points, 3 of them failed"
std::string counts_text(const StudyStatus& s) {
  std::string text = s.points ? fmt::format("{} of {} points", s.done, *s.points)
                              : fmt::format("{} points", s.done);
  if (s.failed.value_or(0) > 0) text += fmt::format(", {} of them failed", *s.failed);
  return text;
}

std::string state_text(const StudyStatus& s) {
  if (s.is_complete) return "complete";
  if (!s.is_running) return s.work ? "on " + s.work->host : "not complete";
  if (*s.is_running) return fmt::format("running as process {}", s.work->process);
  return "stopped: the same line goes on from there";
}

}  // namespace

std::string text_of(const StudyStatus& s) {
  std::string text =
      fmt::format("  {}: {}, {}\n    {}", s.file, s.verb, counts_text(s), state_text(s));
  if (!s.is_complete && s.rate && s.points) {
    text += "; " + rate_text(s.done, *s.points, s.work->seconds);
  }
  return text + fmt::format("; saved {}\n", s.saved);
}

}  // namespace whirl::inline io
