#include "libio/text/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

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

ProgressLine::ProgressLine(std::string what, long total, bool shows)
    : what_(std::move(what)),
      total_(total),
      shows_(shows && isatty(STDERR_FILENO) != 0),
      begin_(seconds()) {}

ProgressLine::~ProgressLine() {
  if (has_drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(long done) {
  if (!shows_) return;
  const double now = seconds();
  if (now - last_ < 0.1 || now - begin_ < 0.5) return;
  last_ = now;
  has_drawn_ = true;
  constexpr int width = 30;
  const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 0.0;
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < share * width ? "━" : "╌";
  const double elapsed = now - begin_;
  const double left = done > 0 ? elapsed * (1.0 / share - 1.0) : 0.0;
  fmt::print(stderr, "\r{} {} {:3.0f} %  {} of {}, {:.0f}/s, {} left\033[K", what_, bar,
             100.0 * share, done, total_, static_cast<double>(done) / elapsed, clock_text(left));
  std::fflush(stderr);
}

}  // namespace whirl::inline io
