#pragma once
/// Pieces of work for threads; what becomes of the results is not decided here.

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace whirl::inline base {

/// Threads that do pieces of work in the order in which they come.
///
/// Results are taken by the thread that gives the work, in any order; an exception of a piece comes
/// out of take(). Without threads, add() does the work itself.
template <class Result>
class WorkQueue {
 public:
  /// @param threads  wanted; if the system gives fewer threads (`ulimit -u`), those do the work
  explicit WorkQueue(int threads) {
    try {
      for (int i = 0; i < threads; ++i) {
        threads_.emplace_back([this](std::stop_token stop) { work(stop); });
      }
    } catch (const std::system_error&) {
    }
  }
  /// Drops pieces that have not begun, and waits for those that have.
  ~WorkQueue() {
    for (std::jthread& t : threads_) t.request_stop();
    threads_.clear();
  }
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  void add(std::function<Result()> piece) {
    ++open_;
    if (threads_.empty()) {
      finish(run(piece));
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(std::move(piece));
    }
    has_work_.notify_one();
  }

  /// Whether every thread has a piece and another one waits for it.
  bool is_full() const { return open_ >= 2 * threads_.size() && open_ > 0; }
  /// Whether there are pieces whose results have not been taken.
  bool has_open() const { return open_ > 0; }

  /// A result, if one is there or comes within `patience`.
  std::optional<Result> take(std::chrono::microseconds patience) {
    std::unique_lock lock(mutex_);
    if (!has_result_.wait_for(lock, patience, [&] { return !finished_.empty(); })) {
      return std::nullopt;
    }
    Finished first = std::move(finished_.front());
    finished_.pop_front();
    --open_;
    if (first.error) std::rethrow_exception(first.error);
    return std::move(first.result);
  }

 private:
  struct Finished {
    std::optional<Result> result;
    std::exception_ptr error;
  };

  static Finished run(const std::function<Result()>& piece) {
    try {
      return {piece(), nullptr};
    } catch (...) {
      return {std::nullopt, std::current_exception()};
    }
  }

  void finish(Finished done) {
    {
      const std::lock_guard lock(mutex_);
      finished_.push_back(std::move(done));
    }
    has_result_.notify_one();
  }

  void work(const std::stop_token& stop) {
    while (true) {
      std::function<Result()> piece;
      {
        std::unique_lock lock(mutex_);
        if (!has_work_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
        if (stop.stop_requested()) return;
        piece = std::move(waiting_.front());
        waiting_.pop_front();
      }
      finish(run(piece));
    }
  }

  std::mutex mutex_;
  std::condition_variable_any has_work_, has_result_;
  std::deque<std::function<Result()>> waiting_;
  std::deque<Finished> finished_;
  std::size_t open_ = 0;  ///< pieces added whose results have not been taken
  std::vector<std::jthread> threads_;
};

}  // namespace whirl::inline base
