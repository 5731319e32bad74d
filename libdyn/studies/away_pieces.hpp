#pragma once
/// Pieces of a study that other processes compute.

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libbase/processes/ranks.hpp"
#include "libbase/structs/travel.hpp"
#include "libdyn/studies/point_work.hpp"

namespace whirl::inline dyn {

/// Time between two letters that say nothing but that a process is alive.
constexpr std::chrono::seconds alive_every{5};

/// What the processes that this one leads have been given, and what has come back.
template <class Row, class Given>
class AwayPieces {
 public:
  using Piece = typename PointWork<Row, Given>::Piece;

  /// @param ranks  that this process leads; null: none
  explicit AwayPieces(const Ranks* ranks) : ranks_(ranks) {
    if (ranks_) others_.resize(static_cast<std::size_t>(ranks_->count) - 1);
    read_letters();
  }

  /// Threads of all of them.
  /// @param unknown  those of a process that has not begun
  int threads(int unknown) const {
    int all = 0;
    for (const Other& other : others_) all += other.threads > 0 ? other.threads : unknown;
    return all;
  }
  bool has_room() const {
    for (const Other& other : others_) {
      if (other.has_room()) return true;
    }
    return false;
  }
  /// Whether pieces are under way.
  bool has_away() const { return !away_.empty(); }
  bool has_arrived() const { return !arrived_.empty(); }

  /// The rank with the fewest open pieces for each of its threads, if these are fewer than `least`;
  /// else 0.
  int freest(double least) const {
    int rank = 0;
    for (std::size_t i = 0; i < others_.size(); ++i) {
      const Other& other = others_[i];
      if (!other.has_room() || other.load() >= least) continue;
      rank = static_cast<int>(i) + 1;
      least = other.load();
    }
    return rank;
  }
  void give(int rank, const Piece& piece, const Given& given) {
    away_[++last_] = piece;
    ++others_[static_cast<std::size_t>(rank) - 1].open;
    ranks_->send({rank, LetterKind::piece, packed(last_, piece, given)});
    patience_.begin_anew();  // a long letter leaves while others are looked for
  }

  /// A piece that has come back, if there is one.
  /// @throws ModelError, ...  what a piece has thrown
  /// @throws LostRank
  std::optional<FinishedPiece<Row>> take() {
    read_letters();
    if (arrived_.empty()) return {};
    FinishedPiece<Row> first = std::move(arrived_.front());
    arrived_.pop_front();
    return first;
  }
  /// How long to wait before letters are looked for again.
  std::chrono::microseconds pause() {
    return ranks_ ? patience_.next() : std::chrono::milliseconds(100);
  }

  /// Tells them to stop with their pieces.
  void stop() {
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (others_[i].open == 0 || std::exchange(others_[i].is_told, true)) continue;
      ranks_->send({static_cast<int>(i) + 1, LetterKind::stop});
    }
  }

 private:
  using clock = std::chrono::steady_clock;

  /// Another process.
  struct Other {
    int threads = 0;       ///< 0: the process has not begun
    std::size_t open = 0;  ///< pieces that the process was given and has not answered
    bool is_told = false;  ///< to stop
    Silence silence{};

    bool has_room() const { return open < 2 * static_cast<std::size_t>(threads); }
    double load() const { return static_cast<double>(open) / static_cast<double>(threads); }
  };

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

  const Ranks* ranks_;
  std::vector<Other> others_;            ///< from rank 1
  std::map<std::uint64_t, Piece> away_;  ///< by number
  std::uint64_t last_ = 0;               ///< number of the last piece given away
  std::deque<FinishedPiece<Row>> arrived_;
  Patience patience_;
  clock::time_point next_alive_ = clock::now() + alive_every;
};

}  // namespace whirl::inline dyn
