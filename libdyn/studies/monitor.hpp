#pragma once
/// What long work tells and asks its caller, and saves, while it goes on.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>

#include "libbase/processes/ranks.hpp"

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
  /// Of a study of many points, in place of saving now and then: called in the caller's thread with
  /// the result so far and the points that are new since the last call; also called before the last
  /// saving.
  std::function<void(const Result&, std::span<const std::size_t> points)> add{};

  /// Processes that share the work, this one among them; null: this process is alone. All processes
  /// must be called with the same work; studies of many points share it, see run_points.
  const Ranks* ranks = nullptr;

  bool stops() const { return (is_stopped && is_stopped()) || (ranks && ranks->is_told_to_stop()); }
  /// What stops() says, for work that must not know the monitor; empty: the work never stops.
  std::function<bool()> stop_asked() const {
    if (!ranks) return is_stopped;
    return [is_stopped = is_stopped, told = ranks->told_to_stop] {
      return *told || (is_stopped && is_stopped());
    };
  }
  /// The monitor of work whose result is another one, and is saved otherwise or not at all.
  template <class Other>
  Monitor<Other> of() const {
    return {.progress = progress, .is_stopped = is_stopped, .ranks = ranks};
  }
  void show(long done, long total) const {
    if (progress) progress(done, total);
  }
};

/// When to save again: rarely enough that saving takes no more than a twentieth of the time.
class SaveTimer {
 public:
  bool is_due() const { return clock::now() >= next_; }

  /// Saves by calling f, and takes note of how long f took.
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
