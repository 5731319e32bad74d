#pragma once
/// Hands out the pieces of a study one after the other, and takes in what comes of them.

#include <chrono>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "libdyn/studies/monitor.hpp"
#include "libdyn/studies/piece_hands.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// A piece that waits to be computed.
template <class Given>
struct OpenPiece {
  std::vector<std::size_t> piece;
  Given given;
};

/// Where pieces come from, and what becomes of them; all is called in the calling thread.
template <class Row, class Given>
struct PieceFlow {
  /// The next piece for so many threads. Nothing: there is no piece before another one is kept, or
  /// no piece at all.
  std::function<std::optional<OpenPiece<Given>>(int threads)> next{};
  /// Takes in a piece that is whole; pieces come in any order.
  std::function<void(FinishedPiece<Row>)> keep{};
  /// Saves what was taken in and is not saved yet: at the end, before an exception leaves, and
  /// before the wait for processes that were told to stop.
  std::function<void()> save{};
};

/// Computes pieces until there are no more. After a stop, pieces that are begun are waited for.
///
/// Where the monitor has ranks, that is processes that all come here with the same work, the leader
/// shares out pieces and alone returns; the other processes serve the leader to its end.
///
/// @throws WorkIsDone  in ranks that do not lead
/// @throws LostRank    where a process does not answer any more; what is done is saved
template <class Row, class Given, class Result>
void run_pieces(const PointWork<Row, Given>& work, const PieceFlow<Row, Given>& flow,
                const Monitor<Result>& monitor) {
  const std::function<bool()> stops = [&monitor] { return monitor.stops(); };
  if (monitor.ranks && !monitor.ranks->leads()) serve(work, *monitor.ranks, stops);
  const auto keep = [&flow](std::optional<FinishedPiece<Row>> finished) {
    if (finished && finished->is_whole) flow.keep(std::move(*finished));
  };
  try {
    PieceHands<Row, Given> hands(work, monitor.ranks, stops);
    while (!monitor.stops()) {
      if (auto open = flow.next(hands.threads())) {
        if (monitor.stops()) break;  // what the piece is given may have been stopped half-way
        hands.add(open->piece, std::move(open->given));
        while (auto finished = hands.take()) keep(std::move(finished));
        while (hands.is_full() && !monitor.stops()) keep(hands.wait());
      } else if (hands.has_open()) {
        keep(hands.wait());
      } else {
        break;
      }
    }
    if (hands.has_away()) flow.save();  // who stops all ranks may not wait for long
    hands.stop();
    const auto enough = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (hands.has_open()) {
      if (hands.has_away() && std::chrono::steady_clock::now() > enough) break;
      keep(hands.wait());
    }
  } catch (...) {  // a wrong model somewhere in the middle: what is done is kept
    flow.save();
    throw;
  }
  flow.save();
}

}  // namespace whirl::inline dyn
