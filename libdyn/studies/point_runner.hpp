#pragma once
/// Points of a study, computed in threads piece by piece.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "libbase/piece_sizes.hpp"
#include "libbase/work_queue.hpp"
#include "libdyn/studies/monitor.hpp"

namespace whirl::inline dyn {

/// Rows of a study, one per point; empty where a point is not computed.
template <class Row>
using PointRows = std::vector<std::optional<Row>>;

template <class Row>
std::size_t done_points(const PointRows<Row>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.has_value(); }));
}

/// How a study becomes pieces of work.
template <class Row>
struct PointWork {
  using Piece = std::vector<std::size_t>;
  /// Points that are computed together, one piece after the other; none: any points may be, in
  /// their order, and pieces are cut as time and threads ask for.
  std::vector<Piece> pieces{};
  std::size_t most_together = 0;  ///< points of such a piece at most
  int threads = 1;                ///< that do the work; 0: the calling one
  /// Makes the work of a piece, in order and in the calling thread; none for pieces that are done.
  std::function<std::function<std::vector<Row>()>(const Piece&)> prepare{};
};

/// The pieces of a study that are not done, one after the other.
template <class Row>
class PiecesLeft {
 public:
  PiecesLeft(const PointWork<Row>& work, const PointRows<Row>& points)
      : work_(work), points_(points), left_(points.size() - done_points(points)) {}

  /// Points that are computed together; none: all have been given out.
  std::vector<std::size_t> next(PieceSizes& sizes) {
    if (work_.pieces.empty()) return next_points(sizes.next(left_));
    while (at_ < work_.pieces.size()) {
      const auto& piece = work_.pieces[at_++];
      if (!std::all_of(piece.begin(), piece.end(),
                       [&](auto p) { return points_[p].has_value(); })) {
        return piece;
      }
    }
    return {};
  }

 private:
  std::vector<std::size_t> next_points(std::size_t count) {
    std::vector<std::size_t> piece;
    for (; at_ < points_.size() && piece.size() < count; ++at_) {
      if (!points_[at_]) piece.push_back(at_);
    }
    left_ -= piece.size();
    return piece;
  }

  const PointWork<Row>& work_;
  const PointRows<Row>& points_;
  std::size_t at_ = 0;  ///< the next piece, or point
  std::size_t left_;    ///< points that are neither done nor given out
};

/// Computes the points of a result that are not done. Pieces that are stopped leave theirs so.
/// @param result  its `points` are PointRows<Row>
template <class Row, class Result>
void run_points(const PointWork<Row>& work, Result& result, const Monitor<Result>& monitor) {
  struct Finished {
    std::vector<std::size_t> piece;
    std::vector<Row> rows;
    bool is_whole;
    double seconds;
  };
  using clock = std::chrono::steady_clock;
  PointRows<Row>& points = result.points;
  const std::size_t before = done_points(points);
  std::size_t done = before;
  SaveTimer timer;
  const auto save = [&] {
    if (monitor.save) monitor.save(result);
  };
  PieceSizes sizes(work.most_together, work.threads);
  try {
    WorkQueue<Finished> queue(work.threads);
    const auto take = [&] {
      auto finished = queue.take(std::chrono::milliseconds(100));
      if (!finished || !finished->is_whole) return;
      for (std::size_t i = 0; i < finished->piece.size(); ++i) {
        std::optional<Row>& point = points[finished->piece[i]];
        done += point ? 0 : 1;
        point = std::move(finished->rows[i]);
      }
      sizes.learn(finished->piece.size(), finished->seconds);
      if (timer.is_due()) timer.save(save);
      monitor.show(static_cast<long>(done - before), static_cast<long>(points.size() - before));
    };
    PiecesLeft<Row> pieces(work, points);
    while (!monitor.stops()) {
      const std::vector<std::size_t> piece = pieces.next(sizes);
      if (piece.empty()) break;
      queue.add([&monitor, piece, compute = work.prepare(piece)] {
        const auto begin = clock::now();
        std::vector<Row> rows = compute();
        const std::chrono::duration<double> taken = clock::now() - begin;
        return Finished{piece, std::move(rows), !monitor.stops(), taken.count()};
      });
      while (queue.is_full()) take();
    }
    while (queue.has_open()) take();
  } catch (...) {  // a wrong model somewhere in the middle: what is done is kept
    save();
    throw;
  }
  save();
}

}  // namespace whirl::inline dyn
