#include "libio/text/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <system_error>

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

ProgressLine::ProgressLine(std::string what, bool shows, double period)
    : what_(shown_text(what)),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      period_(is_terminal_ ? 1.0 : period),
      begin_(seconds()) {
  if (!shows) return;
  try {
    ticker_ = std::jthread([this](const std::stop_token& stop) { tick(stop); });
  } catch (const std::system_error&) {  // the system gives no more threads
  }
}

ProgressLine::~ProgressLine() {
  ticker_.request_stop();
  if (ticker_.joinable()) ticker_.join();
  if (has_drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::update(long done, long total) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  total_ = total;
}

void ProgressLine::tick(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const std::chrono::duration<double> period(period_);
  while (!ends_.wait_for(lock, stop, period, [&] { return stop.stop_requested(); })) {
    if (is_terminal_) {
      redraw();
    } else {
      fmt::print(stderr, "{}: {}\n", what_, state());
    }
    std::fflush(stderr);
  }
}

std::string ProgressLine::state() const {
  const double elapsed = seconds() - begin_;
  return total_ > 0 ? progress_text(done_, total_, elapsed) : clock_text(elapsed);
}

void ProgressLine::redraw() {
  has_drawn_ = true;
  constexpr int width = 30;
  const double share = total_ > 0 ? static_cast<double>(done_) / static_cast<double>(total_) : 0.0;
  std::string bar;
  for (int i = 0; i < width && total_ > 0; ++i) bar += i < share * width ? "━" : "╌";
  if (total_ > 0) bar += fmt::format(" {:3.0f} %  ", 100.0 * share);
  fmt::print(stderr, "\r{} {}{}\033[K", what_, bar, state());
}

}  // namespace whirl::inline io
