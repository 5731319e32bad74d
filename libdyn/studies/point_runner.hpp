#pragma once
/// Points of a study, computed in threads piece by piece.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
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

/// What a piece of a study is given beside the numbers of its points, where that is nothing.
struct NothingGiven {};

/// How a study becomes pieces of work.
template <class Row, class Given = NothingGiven>
struct PointWork {
  using Piece = std::vector<std::size_t>;
  /// Points that are computed together, one piece after the other; none: any points may be, in
  /// their order, and pieces are cut as time and threads ask for.
  std::vector<Piece> pieces{};
  std::size_t most_together = 0;  ///< points of such a piece at most
  /// That do the work; 0: the calling one. Where pieces are prepared, one of them does that.
  int threads = 1;
  /// Makes what a piece is given, in order and in the calling thread; none for pieces that are done.
  /// May be empty.
  std::function<Given(const Piece&)> prepare{};
  /// The rows of a piece, in any thread: the same for the same points and what they are given, bit by
  /// bit.
  std::function<std::vector<Row>(const Piece&, Given&)> compute{};

  /// Threads beside the one that prepares.
  int computing_threads() const { return prepare ? threads - 1 : threads; }
  Given given(const Piece& piece) const { return prepare ? prepare(piece) : Given{}; }
};

/// The pieces of a study that are not done, one after the other.
template <class Row>
class PiecesLeft {
 public:
  /// @param pieces  as of PointWork
  PiecesLeft(const std::vector<std::vector<std::size_t>>& pieces, const PointRows<Row>& points)
      : pieces_(pieces), points_(points), left_(points.size() - done_points(points)) {}

  /// Points that are computed together; none: all have been given out.
  std::vector<std::size_t> next(PieceSizes& sizes) {
    if (pieces_.empty()) return next_points(sizes.next(left_));
    while (at_ < pieces_.size()) {
      const auto& piece = pieces_[at_++];
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

  const std::vector<std::vector<std::size_t>>& pieces_;
  const PointRows<Row>& points_;
  std::size_t at_ = 0;  ///< the next piece, or point
  std::size_t left_;    ///< points that are neither done nor given out
};

/// A piece that was computed.
template <class Row>
struct FinishedPiece {
  std::vector<std::size_t> piece;
  std::vector<Row> rows;
  bool is_whole = true;  ///< false: it was stopped, and its rows are worth nothing
  double seconds = 0.0;  ///< of one thread
};

/// Computes a piece in the calling thread.
/// @param stops  whether it was stopped meanwhile
template <class Row, class Given>
FinishedPiece<Row> finish_piece(const PointWork<Row, Given>& work,
                                const std::vector<std::size_t>& piece, Given& given,
                                const std::function<bool()>& stops) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Row> rows = work.compute(piece, given);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return {piece, std::move(rows), !stops(), taken.count()};
}

/// Hands on what is done of a study: what is new now and then, all of it at the end.
template <class Result>
class Savings {
 public:
  Savings(const Result& result, const Monitor<Result>& monitor)
      : result_(result), monitor_(monitor) {}

  /// Takes note of points that are done now.
  void note(const std::vector<std::size_t>& points) {
    if (monitor_.add) news_.insert(news_.end(), points.begin(), points.end());
    is_saved_ = false;
    if (timer_.is_due()) timer_.save([&] { monitor_.add ? add() : save(); });
  }

  /// All that is done so far, once.
  void save() {
    if (is_saved_) return;
    if (monitor_.add) add();
    if (monitor_.save) monitor_.save(result_);
    is_saved_ = true;
  }

 private:
  void add() {
    monitor_.add(result_, news_);
    news_.clear();
  }

  const Result& result_;
  const Monitor<Result>& monitor_;
  SaveTimer timer_;
  std::vector<std::size_t> news_;  ///< points done since the last time that some were added
  bool is_saved_ = false;
};

/// Computes the points of a result that are not done. Pieces that are stopped leave theirs so.
/// @param result  its `points` are PointRows<Row>
template <class Row, class Given, class Result>
void run_points(const PointWork<Row, Given>& work, Result& result, const Monitor<Result>& monitor) {
  PointRows<Row>& points = result.points;
  const std::size_t before = done_points(points);
  std::size_t done = before;
  const std::function<bool()> stops = [&monitor] { return monitor.stops(); };
  Savings<Result> savings(result, monitor);
  PieceSizes sizes(work.most_together, work.computing_threads());
  try {
    WorkQueue<FinishedPiece<Row>> queue(work.computing_threads());
    const auto take = [&] {
      auto finished = queue.take(std::chrono::milliseconds(100));
      if (!finished || !finished->is_whole) return;
      for (std::size_t i = 0; i < finished->piece.size(); ++i) {
        std::optional<Row>& point = points[finished->piece[i]];
        done += point ? 0 : 1;
        point = std::move(finished->rows[i]);
      }
      sizes.learn(finished->piece.size(), finished->seconds);
      savings.note(finished->piece);
      monitor.show(static_cast<long>(done - before), static_cast<long>(points.size() - before));
    };
    PiecesLeft<Row> pieces(work.pieces, points);
    while (!monitor.stops()) {
      const std::vector<std::size_t> piece = pieces.next(sizes);
      if (piece.empty()) break;
      const auto given = std::make_shared<Given>(work.given(piece));
      queue.add([&work, &stops, piece, given] { return finish_piece(work, piece, *given, stops); });
      while (queue.is_full()) take();
    }
    while (queue.has_open()) take();
  } catch (...) {  // a wrong model somewhere in the middle: what is done is kept
    savings.save();
    throw;
  }
  savings.save();
}

}  // namespace whirl::inline dyn
