#pragma once
/// What long work tells, asks and keeps while it goes on.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>

namespace whirl::inline dyn {

/// How a caller follows long work; any member may be empty.
template <class Result>
struct Monitor {
  /// Called in the caller's thread with what this call has done, and what it has to do.
  std::function<void(long done, long total)> progress{};
  /// Asked often, in every thread that works; true: stop with what is there.
  std::function<bool()> is_stopped{};
  /// Called in the caller's thread with the result so far: now and then, at the end, and before an
  /// exception leaves.
  std::function<void(const Result&)> save{};
  /// Of a study of many points, in place of saving now and then: called in the caller's thread with the
  /// result so far and the points that are new since the last call; before the last saving, too.
  std::function<void(const Result&, std::span<const std::size_t> points)> add{};

  bool stops() const { return is_stopped && is_stopped(); }
  void show(long done, long total) const {
    if (progress) progress(done, total);
  }
};

/// When to save again: rarely enough that saving takes no more than a twentieth of the time.
class SaveTimer {
 public:
  bool is_due() const { return clock::now() >= next_; }

  /// Saves by calling f, and takes note of how long it took.
  template <class F>
  void save(const F& f) {
    const auto begin = clock::now();
    f();
    const auto end = clock::now();
    next_ = end + std::max<clock::duration>(least, 20 * (end - begin));
  }

 private:
  using clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds least{100};  ///< between two savings
  clock::time_point next_ = clock::now() + least;
};

}  // namespace whirl::inline dyn
