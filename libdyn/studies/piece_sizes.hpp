#pragma once
/// How many points of a study go together: all processors busy, lanes full, results soon.

#include <algorithm>
#include <cstddef>

namespace whirl::inline dyn {

/// Sizes of the pieces that points are cut into, from what points cost so far.
///
/// The first piece of each thread is small, so that there is something to keep soon, whatever a
/// point costs. Later pieces take some seconds, or have as many points as fill the lanes of a batch
/// well. No piece takes more than half a thread's share of what is left, down to some lanes: one
/// point may cost thirty times as much as another, and all threads are to end at about the same
/// time. The last points, or a few points from the start, are shared out evenly. Smaller pieces
/// would cost more than they save: at the end of each piece lanes stand empty, and a step of a few
/// lanes takes as long as one of all.
class PieceSizes {
 public:
  /// @param most     points of a piece at most
  /// @param threads  that do the pieces; 0: the calling one
  /// @param lanes    points that step together
  PieceSizes(std::size_t most, int threads, int lanes = 8)
      : most_(most),
        threads_(static_cast<std::size_t>(std::max(1, threads))),
        first_(static_cast<std::size_t>(lanes)) {}

  /// Points of the next piece.
  /// @param left  points that are not given out
  std::size_t next(std::size_t left) {
    const std::size_t share = (left + threads_ - 1) / threads_;
    const bool is_first = given_++ < threads_ && share > least;
    const std::size_t wanted = is_first ? first_ : cost_ > 0.0 ? lasting_points() : second;
    return std::min({fair(share), wanted, most_, left});
  }

  /// From now on so many threads do the pieces.
  void work_with(int threads) { threads_ = static_cast<std::size_t>(std::max(1, threads)); }

  /// Takes note of what a piece cost.
  /// @param seconds  of one thread
  void learn(std::size_t points, double seconds) {
    if (points == 0 || !(seconds > 0.0)) return;
    const double each = seconds / static_cast<double>(points);
    cost_ = cost_ > 0.0 ? 0.5 * (cost_ + each) : each;
  }

 private:
  static constexpr std::size_t second = 32;  ///< points, while the cost of a point is not known
  static constexpr std::size_t full = 64;    ///< points that leave few lanes empty at the end
  static constexpr std::size_t least = 32;   ///< points that fill lanes twice or more
  static constexpr double lasting = 4.0;     ///< [s], well below the ten until a first result

  /// Points of a piece at most, where so many are left for each thread.
  std::size_t fair(std::size_t share) {
    const std::size_t half = (share + 1) / 2;
    if (share > full || last_ > 0) return last_ > 0 ? last_ : std::max(full, half);
    if (share > least && threads_ > 1) return std::max(least, half);
    return last_ = share;
  }

  std::size_t lasting_points() const {
    const double points = std::min(lasting / cost_, static_cast<double>(most_));
    return std::max(full, static_cast<std::size_t>(points));
  }

  std::size_t most_, threads_, first_;
  std::size_t given_ = 0;  ///< pieces
  std::size_t last_ = 0;   ///< points of each of the last pieces; 0: more is left
  double cost_ = 0.0;      ///< of a point [s]; 0: not known yet
};

}  // namespace whirl::inline dyn
