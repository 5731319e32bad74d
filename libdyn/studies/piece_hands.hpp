#pragma once
/// Who computes the pieces of a study: threads of this process, and other processes with theirs.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "libbase/processes/ranks.hpp"
#include "libbase/processes/work_queue.hpp"
#include "libbase/structs/travel.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// Time between two letters that say nothing but that a process is alive.
constexpr std::chrono::seconds alive_every{5};

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
      : work_(work), ranks_(ranks), stops_(stops), threads_(work.computing_threads()) {
    if (ranks_) others_.resize(static_cast<std::size_t>(ranks_->count) - 1);
    read_letters();
  }
  /// Does not wait for what other processes have not done.
  ~PieceHands() { stop(); }
  PieceHands(const PieceHands&) = delete;
  PieceHands& operator=(const PieceHands&) = delete;

  /// Threads of all processes; a process that has not begun counts with as many as this one has.
  int threads() const {
    int all = threads_;
    for (const Other& other : others_) all += other.threads > 0 ? other.threads : work_.threads;
    return all;
  }

  /// Whether every thread has a piece, and another piece waits for it.
  bool is_full() const {
    for (const Other& other : others_) {
      if (other.has_room()) return false;
    }
    return own_.is_full();
  }
  bool has_open() const { return own_.has_open() || has_away() || !arrived_.empty(); }
  bool has_away() const { return !away_.empty(); }

  /// Gives a piece to the process with the fewest open pieces for each of its threads; to this one,
  /// if all are alike.
  void add(const Piece& piece, Given given) {
    if (const int rank = freest(); rank > 0) {
      Other& other = others_[static_cast<std::size_t>(rank) - 1];
      away_[++last_] = piece;
      ++other.open;
      ranks_->send({rank, LetterKind::piece, packed(last_, piece, given)});
      patience_.begin_anew();  // a long letter leaves while others are looked for
      return;
    }
    ++own_open_;
    own_.add([this, piece, shared = std::make_shared<Given>(std::move(given))] {
      return finish_piece(work_, piece, *shared, stops_);
    });
  }

  /// A piece that is done, if there is one.
  /// @throws ModelError, ...  what a piece has thrown, in whatever process
  /// @throws LostRank
  std::optional<FinishedPiece<Row>> take() {
    read_letters();
    if (!arrived_.empty()) {
      FinishedPiece<Row> first = std::move(arrived_.front());
      arrived_.pop_front();
      return first;
    }
    return take_own({});
  }
  /// A piece that is done; waits a little for one to come.
  std::optional<FinishedPiece<Row>> wait() {
    auto finished = take();
    if (finished) return finished;
    return take_own(ranks_ ? patience_.next() : std::chrono::milliseconds(100));
  }

  /// Tells other processes to stop with their pieces.
  void stop() {
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (others_[i].open == 0 || std::exchange(others_[i].is_told, true)) continue;
      ranks_->send({static_cast<int>(i) + 1, LetterKind::stop});
    }
  }

 private:
  using clock = std::chrono::steady_clock;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Another process.
  struct Other {
    int threads = 0;       ///< 0: the process has not begun
    std::size_t open = 0;  ///< pieces that the process was given and has not answered
    bool is_told = false;  ///< to stop
    Silence silence{};

    bool has_room() const { return open < 2 * static_cast<std::size_t>(threads); }
  };

  std::optional<FinishedPiece<Row>> take_own(std::chrono::microseconds patience) {
    auto finished = own_.take(patience);
    if (finished) --own_open_;
    return finished;
  }

  /// The rank with the fewest open pieces for each of its threads; this process, if it has no
  /// thread beside the calling one, only if all others are full.
  int freest() const {
    const auto load = [](std::size_t open, int threads) {
      return static_cast<double>(open) / static_cast<double>(threads);
    };
    int rank = 0;
    double least = threads_ > 0 ? load(own_open_, threads_) : infinite;
    for (std::size_t i = 0; i < others_.size(); ++i) {
      const Other& other = others_[i];
      if (!other.has_room() || load(other.open, other.threads) >= least) continue;
      rank = static_cast<int>(i) + 1;
      least = load(other.open, other.threads);
    }
    return rank;
  }

  void read_letters() {
    if (!ranks_) return;
    while (const std::optional<Letter> letter = ranks_->receive()) {
      patience_.begin_anew();
      read(*letter);
      if (!arrived_.empty()) break;
    }
    const bool says_so = clock::now() >= next_alive_;
    if (says_so) next_alive_ = clock::now() + alive_every;
    for (std::size_t i = 0; i < others_.size(); ++i) {
      Other& other = others_[i];
      const int rank = static_cast<int>(i) + 1;
      if (other.threads == 0) continue;
      if (const auto lasts = other.silence.look(); lasts > ranks_->patience) {
        throw LostRank(rank, lasts);
      }
      if (says_so) ranks_->send({rank, LetterKind::alive});
    }
  }

  void read(const Letter& letter) {
    Other& other = others_[static_cast<std::size_t>(letter.rank) - 1];
    other.silence.hear();
    switch (letter.kind) {
      case LetterKind::ready:
        other.silence = {};
        unpack(letter.bytes, other.threads);
        return;
      case LetterKind::rows:
        return read_rows(letter.bytes, other);
      case LetterKind::error:
        return throw_packed(letter.bytes, letter.rank);
      case LetterKind::stop:  // somebody has stopped that process alone: all of them stop
        *ranks_->told_to_stop = true;
        return;
      default:
        return;
    }
  }

  void read_rows(const std::string& bytes, Other& other) {
    std::uint64_t number = 0;
    FinishedPiece<Row> finished;
    unpack(bytes, number, finished.is_whole, finished.seconds, finished.rows);
    const auto away = away_.find(number);
    finished.piece = std::move(away->second);
    away_.erase(away);
    --other.open;
    arrived_.push_back(std::move(finished));
  }

  const Work& work_;
  const Ranks* ranks_;
  const std::function<bool()>& stops_;
  int threads_;  ///< of this process
  std::size_t own_open_ = 0;
  std::vector<Other> others_;            ///< from rank 1
  std::map<std::uint64_t, Piece> away_;  ///< in other processes, by number
  std::uint64_t last_ = 0;               ///< number of the last piece given away
  std::deque<FinishedPiece<Row>> arrived_;
  Patience patience_;
  clock::time_point next_alive_ = clock::now() + alive_every;
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
    patience.begin_anew();  // as in PieceHands::add
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
