#include "libio/text/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "libio/text/terminal.hpp"

namespace whirl::inline io {

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string clock_text(double s) {
  const long t = static_cast<long>(s + 0.5);
  return t < 3600 ? fmt::format("{}:{:02}", t / 60, t % 60)
                  : fmt::format("{}:{:02}:{:02}", t / 3600, t / 60 % 60, t % 60);
}

}  // namespace

std::string rate_text(long done, long total, double elapsed) {
  const double rate = elapsed > 0.0 ? static_cast<double>(done) / elapsed : 0.0;
  const std::string text =
      rate < 9.95 ? fmt::format("{:.2g}/s", rate) : fmt::format("{:.0f}/s", rate);
  if (!(rate > 0.0)) return text;
  return text + fmt::format(", {} left", clock_text(static_cast<double>(total - done) / rate));
}

std::string progress_text(long done, long total, double elapsed) {
  return fmt::format("{} of {}, {}", done, total, rate_text(done, total, elapsed));
}

ProgressLine::ProgressLine(std::string what, long total, bool shows, double period)
    : what_(shown_text(what)),
      total_(total),
      shows_(shows),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      period_(period),
      begin_(seconds()),
      last_(begin_) {}

ProgressLine::~ProgressLine() {
  if (has_drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(long done) {
  if (!shows_) return;
  const double now = seconds(), elapsed = now - begin_;
  if (is_terminal_ ? now - last_ < 0.1 || elapsed < 0.5 : now - last_ < period_) return;
  last_ = now;
  if (is_terminal_) {
    redraw(done, elapsed);
  } else {
    fmt::print(stderr, "{}: {}\n", what_, progress_text(done, total_, elapsed));
  }
  std::fflush(stderr);
}

void ProgressLine::redraw(long done, double elapsed) {
  has_drawn_ = true;
  constexpr int width = 30;
  const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 0.0;
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < share * width ? "━" : "╌";
  fmt::print(stderr, "\r{} {} {:3.0f} %  {}\033[K", what_, bar, 100.0 * share,
             progress_text(done, total_, elapsed));
}

}  // namespace whirl::inline io
