#pragma once
/// Points of a study, computed piece by piece in threads, and in processes that share the study.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/piece_runner.hpp"
#include "libdyn/studies/piece_sizes.hpp"
#include "libdyn/studies/point_rows.hpp"
#include "libdyn/studies/point_work.hpp"
#include "libdyn/taylor/lanes.hpp"

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

  /// Saves all that is done so far, if that is not saved.
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

/// Computes the points of a result that are not done, as run_pieces. Points of pieces that are
/// stopped stay undone.
/// @param result  its `points` are PointRows<Row>
template <class Row, class Given, class Result>
void run_points(const PointWork<Row, Given>& work, Result& result, const Monitor<Result>& monitor) {
  PointRows<Row>& points = result.points;
  const auto open = static_cast<long>(open_points(points, work.stripe));
  long done = 0;
  Savings<Result> savings(result, monitor);
  const auto conclude = [&] {
    if (work.conclude && done == open) work.conclude();
  };
  conclude();
  PieceSizes sizes(work.most_together, work.computing_threads(), lanes_together());
  PiecesLeft<Row> pieces(work.pieces, points, work.stripe);
  const auto next = [&](int threads) -> std::optional<OpenPiece<Given>> {
    sizes.work_with(threads);
    std::vector<std::size_t> piece = pieces.next(sizes);
    if (piece.empty()) return std::nullopt;
    Given given = work.given(piece);
    return OpenPiece<Given>{std::move(piece), std::move(given)};
  };
  const auto keep = [&](FinishedPiece<Row> finished) {
    for (std::size_t i = 0; i < finished.piece.size(); ++i) {
      const std::size_t point = finished.piece[i];
      done += points.has(point) ? 0 : 1;
      points.set(point, finished.rows[i]);
    }
    sizes.learn(finished.piece.size(), finished.seconds);
    conclude();
    savings.note(finished.piece);
    monitor.show(done, open);
  };
  run_pieces<Row, Given>(work, {next, keep, [&savings] { savings.save(); }}, monitor);
}

}  // namespace whirl::inline dyn
