#pragma once
/// Points of a study, computed piece by piece in threads, and in processes that share it.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "libbase/piece_sizes.hpp"
#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/piece_hands.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// The pieces of a study that are not done, one after the other.
template <class Row>
class PiecesLeft {
 public:
  /// @param pieces  as of PointWork
  PiecesLeft(const std::vector<std::vector<std::size_t>>& pieces, const PointRows<Row>& points,
             const Stripe& stripe)
      : pieces_(pieces), points_(points), stripe_(stripe), left_(open_points(points, stripe)) {}

  /// Points that are computed together; none: all have been given out.
  std::vector<std::size_t> next(PieceSizes& sizes) {
    if (pieces_.empty()) return next_points(sizes.next(left_));
    while (at_ < pieces_.size()) {
      const auto& piece = pieces_[at_++];
      if (!std::all_of(piece.begin(), piece.end(), [&](auto p) { return points_.has(p); })) {
        return piece;
      }
    }
    return {};
  }

 private:
  std::vector<std::size_t> next_points(std::size_t count) {
    std::vector<std::size_t> piece;
    for (; at_ < points_.size() && piece.size() < count; ++at_) {
      if (!points_.has(at_) && stripe_.has(at_)) piece.push_back(at_);
    }
    left_ -= piece.size();
    return piece;
  }

  const std::vector<std::vector<std::size_t>>& pieces_;
  const PointRows<Row>& points_;
  Stripe stripe_;
  std::size_t at_ = 0;  ///< the next piece, or point
  std::size_t left_;    ///< points that are neither done nor given out
};

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
///
/// Where the monitor has ranks, that is processes that all come here with the same work, the leader
/// shares out pieces and alone returns; the others serve it to its end.
///
/// @param result  its `points` are PointRows<Row>
/// @throws WorkIsDone  in ranks that do not lead
/// @throws LostRank    where one does not answer any more; what is done is saved
template <class Row, class Given, class Result>
void run_points(const PointWork<Row, Given>& work, Result& result, const Monitor<Result>& monitor) {
  const std::function<bool()> stops = [&monitor] { return monitor.stops(); };
  if (monitor.ranks && !monitor.ranks->leads()) serve(work, *monitor.ranks, stops);
  PointRows<Row>& points = result.points;
  const auto open = static_cast<long>(open_points(points, work.stripe));
  long done = 0;
  Savings<Result> savings(result, monitor);
  PieceSizes sizes(work.most_together, work.computing_threads());
  const auto keep = [&](std::optional<FinishedPiece<Row>> finished) {
    if (!finished || !finished->is_whole) return;
    for (std::size_t i = 0; i < finished->piece.size(); ++i) {
      const std::size_t point = finished->piece[i];
      done += points.has(point) ? 0 : 1;
      points.set(point, finished->rows[i]);
    }
    sizes.learn(finished->piece.size(), finished->seconds);
    savings.note(finished->piece);
    monitor.show(done, open);
  };
  try {
    PieceHands<Row, Given> hands(work, monitor.ranks, stops);
    PiecesLeft<Row> pieces(work.pieces, points, work.stripe);
    while (!monitor.stops()) {
      sizes.work_with(hands.threads());
      const std::vector<std::size_t> piece = pieces.next(sizes);
      if (piece.empty()) break;
      hands.add(piece, work.given(piece));
      while (auto finished = hands.take()) keep(std::move(finished));
      while (hands.is_full() && !monitor.stops()) keep(hands.wait());
    }
    while (hands.has_open() && !monitor.stops()) keep(hands.wait());
    if (hands.has_away()) savings.save();  // who stops all ranks may not wait for long
    hands.stop();
    const auto enough = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (hands.has_open()) {
      if (hands.has_away() && std::chrono::steady_clock::now() > enough) break;
      keep(hands.wait());
    }
  } catch (...) {  // a wrong model somewhere in the middle: what is done is kept
    savings.save();
    throw;
  }
  savings.save();
}

}  // namespace whirl::inline dyn
