#pragma once
/// How a study becomes pieces of work, and the result of a piece.

#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "libbase/structs/travel.hpp"
#include "libdyn/studies/stripe.hpp"

namespace whirl::inline dyn {

/// What a piece of a study is given beside the numbers of its points, where that is nothing.
struct NothingGiven {};
template <class Bytes>
void travel(Bytes&, Is<NothingGiven> auto&) {}

/// How a study becomes pieces of work.
template <class Row, class Given = NothingGiven>
struct PointWork {
  using Piece = std::vector<std::size_t>;
  /// Points that are computed together, one piece after the other; empty: any points may go
  /// together, in their order, and pieces are cut as time and threads ask.
  std::vector<Piece> pieces{};
  std::size_t most_together = 0;  ///< points of a piece that is cut, at most
  Stripe stripe{};                ///< the points that are computed, where pieces are cut
  /// Threads that do the work; 0: the calling one. Where pieces are prepared, one thread does that.
  int threads = 1;
  /// Makes what a piece is given, in order and in the calling thread; not called for pieces that
  /// are done. May be empty.
  std::function<Given(const Piece&)> prepare{};
  /// The rows of a piece, in any thread of any process: the same rows for the same points and what
  /// the piece is given, bit by bit.
  std::function<std::vector<Row>(const Piece&, Given&)> compute{};
  /// Makes what is made of all points, once all are there and before that is saved; may be empty.
  std::function<void()> conclude{};
  /// Whether rows of a piece that is stopped are worth keeping, too.
  bool keeps_parts = false;

  /// Threads beside the one that prepares.
  int computing_threads() const { return prepare ? threads - 1 : threads; }
  Given given(const Piece& piece) const { return prepare ? prepare(piece) : Given{}; }
};

/// A piece that was computed.
template <class Row>
struct FinishedPiece {
  std::vector<std::size_t> piece;
  std::vector<Row> rows;
  bool is_whole = true;  ///< false: the piece was stopped, and its rows are worth nothing
  double seconds = 0.0;  ///< of one thread
};

/// Computes a piece in the calling thread.
/// @param stops  whether the piece was stopped meanwhile
template <class Row, class Given>
FinishedPiece<Row> finish_piece(const PointWork<Row, Given>& work,
                                const std::vector<std::size_t>& piece, Given& given,
                                const std::function<bool()>& stops) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Row> rows = work.compute(piece, given);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return {piece, std::move(rows), work.keeps_parts || !stops(), taken.count()};
}

}  // namespace whirl::inline dyn
