#pragma once
/// Who computes the pieces of a study: threads of this process, and other processes with theirs.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "libbase/processes/ranks.hpp"
#include "libbase/processes/work_queue.hpp"
#include "libbase/structs/travel.hpp"
#include "libdyn/studies/away_pieces.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// The threads of this process and of the processes that it leads, if any. Each thread is given the
/// piece that it computes and one more piece that waits, so that no thread is idle while letters
/// are on their way.
template <class Row, class Given>
class PieceHands {
 public:
  using Work = PointWork<Row, Given>;
  using Piece = typename Work::Piece;

  /// @param ranks  that this process leads; null: none
  /// @param stops  whether to stop with what is begun; asked in every thread
  PieceHands(const Work& work, const Ranks* ranks, const std::function<bool()>& stops)
      : work_(work), stops_(stops), threads_(work.computing_threads()), away_(ranks) {}
  /// Does not wait for what other processes have not done.
  ~PieceHands() { stop(); }
  PieceHands(const PieceHands&) = delete;
  PieceHands& operator=(const PieceHands&) = delete;

  /// Threads of all processes; a process that has not begun counts with as many as this one has.
  int threads() const { return threads_ + away_.threads(work_.threads); }

  /// Whether every thread has a piece, and another piece waits for it.
  bool is_full() const { return !away_.has_room() && own_.is_full(); }
  bool has_open() const { return own_.has_open() || has_away() || away_.has_arrived(); }
  bool has_away() const { return away_.has_away(); }

  /// Gives a piece to the process with the fewest open pieces for each of its threads; to this one,
  /// if all are alike. This one, if it has no thread beside the calling one, takes pieces only
  /// where all others are full.
  void add(const Piece& piece, Given given) {
    const double own_load = threads_ > 0
                                ? static_cast<double>(own_open_) / static_cast<double>(threads_)
                                : std::numeric_limits<double>::infinity();
    if (const int rank = away_.freest(own_load); rank > 0) return away_.give(rank, piece, given);
    ++own_open_;
    own_.add([this, piece, shared = std::make_shared<Given>(std::move(given))] {
      return finish_piece(work_, piece, *shared, stops_);
    });
  }

  /// A piece that is done, if there is one.
  /// @throws ModelError, ...  what a piece has thrown, in whatever process
  /// @throws LostRank
  std::optional<FinishedPiece<Row>> take() {
    auto arrived = away_.take();
    return arrived ? std::move(arrived) : take_own({});
  }
  /// A piece that is done; waits a little for one to come.
  std::optional<FinishedPiece<Row>> wait() {
    auto finished = take();
    return finished ? std::move(finished) : take_own(away_.pause());
  }

  /// Tells other processes to stop with their pieces.
  void stop() { away_.stop(); }

 private:
  std::optional<FinishedPiece<Row>> take_own(std::chrono::microseconds patience) {
    auto finished = own_.take(patience);
    if (finished) --own_open_;
    return finished;
  }

  const Work& work_;
  const std::function<bool()>& stops_;
  int threads_;  ///< of this process
  std::size_t own_open_ = 0;
  AwayPieces<Row, Given> away_;
  WorkQueue<FinishedPiece<Row>> own_{threads_};  // the last member: its threads use the others
};

/// The answer to a letter with a piece.
template <class Row, class Given>
Letter answer_piece(const PointWork<Row, Given>& work, const std::string& bytes,
                    const std::function<bool()>& stops) {
  try {
    std::uint64_t number = 0;
    typename PointWork<Row, Given>::Piece piece;
    Given given{};
    unpack(bytes, number, piece, given);
    FinishedPiece<Row> finished{.is_whole = false};
    if (!stops()) finished = finish_piece(work, piece, given, stops);
    if (!finished.is_whole) finished.rows.clear();
    return {0, LetterKind::rows,
            packed(number, finished.is_whole, finished.seconds, finished.rows)};
  } catch (...) {
    return {0, LetterKind::error, packed_error(std::current_exception())};
  }
}

/// Computes pieces that the leader sends, in the threads of this process, until the leader ends.
/// @throws WorkIsDone  when the leader has ended
/// @throws LostRank    if nothing is heard of the leader
template <class Row, class Given>
[[noreturn]] void serve(const PointWork<Row, Given>& work, const Ranks& ranks,
                        const std::function<bool()>& stops) {
  using clock = std::chrono::steady_clock;
  const int threads = std::max(1, work.threads);
  WorkQueue<Letter> queue(threads);
  ranks.send({0, LetterKind::ready, packed(threads)});
  Patience patience;
  std::optional<Silence> silence;  // from the leader's first letter on, before which it may be busy
  bool has_stopped = false;
  const auto send = [&](Letter letter) {
    ranks.send(std::move(letter));
    patience.begin_anew();  // as in AwayPieces::give
  };
  for (auto next_alive = clock::now() + alive_every;;) {
    const std::optional<Letter> letter = ranks.receive();
    if (letter) {
      patience.begin_anew();
      silence.emplace();
      if (letter->kind == LetterKind::stop || letter->kind == LetterKind::end) {
        *ranks.told_to_stop = true;
      }
      if (letter->kind == LetterKind::end) throw WorkIsDone{};
      if (letter->kind == LetterKind::piece) {
        queue.add(
            [&work, &stops, bytes = letter->bytes] { return answer_piece(work, bytes, stops); });
      }
    }
    while (auto answer = queue.take({})) send(std::move(*answer));
    if (stops() && !std::exchange(has_stopped, true)) ranks.send({0, LetterKind::stop});
    if (clock::now() >= next_alive) {
      ranks.send({0, LetterKind::alive});
      next_alive = clock::now() + alive_every;
    }
    // the leader may be busy for long where it prepares pieces
    constexpr int longer = 30;
    if (silence) {
      if (const auto lasts = silence->look(); lasts > longer * ranks.patience) {
        throw LostRank(0, lasts);
      }
    }
    if (letter) continue;
    if (auto answer = queue.take(patience.next())) send(std::move(*answer));
  }
}

}  // namespace whirl::inline dyn
