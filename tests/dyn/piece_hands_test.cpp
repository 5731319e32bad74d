// Who computes the pieces of a study: threads of this process, and another one that is played here,
// letter by letter.

#include "libdyn/studies/piece_hands.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "tests/support/post.hpp"

namespace whirl::piece_hands_test {

using Work = PointWork<int, int>;
using Hands = PieceHands<int, int>;

const std::function<bool()> never = [] { return false; };
const std::function<bool()> at_once = [] { return true; };

/// Rows are ten times the numbers of their points, and what the piece is given.
Work ten_times(int threads) {
  return {.threads = threads, .compute = [](const Work::Piece& piece, int& given) {
            std::vector<int> rows;
            for (const std::size_t point : piece) {
              rows.push_back(10 * static_cast<int>(point) + given);
            }
            return rows;
          }};
}

/// The next piece that is done, however long it takes.
FinishedPiece<int> next(Hands& hands) {
  while (true) {
    if (auto finished = hands.wait()) return std::move(*finished);
  }
}

TEST(PieceHands, GiveBackTheRowsOfEveryPiece) {
  for (const int threads : {0, 1, 3}) {
    const Work work = ten_times(threads);
    Hands hands(work, nullptr, never);
    EXPECT_FALSE(hands.has_open());
    EXPECT_EQ(hands.threads(), threads);
    for (std::size_t i = 0; i < 5; ++i) hands.add({i, i + 100}, 7);
    std::set<std::size_t> done;
    while (hands.has_open()) {
      const FinishedPiece<int> finished = next(hands);
      ASSERT_EQ(finished.piece.size(), 2u);
      const int first = static_cast<int>(finished.piece[0]);
      EXPECT_EQ(finished.rows, (std::vector<int>{10 * first + 7, 10 * first + 1007}));
      EXPECT_TRUE(finished.is_whole);
      EXPECT_GE(finished.seconds, 0.0);
      done.insert(finished.piece[0]);
    }
    EXPECT_EQ(done.size(), 5u) << threads;
    EXPECT_FALSE(hands.take());
  }
}

// A piece for every thread and one more that waits.
TEST(PieceHands, AreFullWithTwoPiecesForAThread) {
  const Work work = ten_times(2);
  Hands hands(work, nullptr, never);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FALSE(hands.is_full()) << i;
    hands.add({i}, 0);
  }
  EXPECT_TRUE(hands.is_full());
  next(hands);
  EXPECT_FALSE(hands.is_full());
}

TEST(PieceHands, SayThatAStoppedPieceIsNotWhole) {
  Work work = ten_times(0);
  {
    Hands hands(work, nullptr, at_once);
    hands.add({1}, 0);
    EXPECT_FALSE(next(hands).is_whole);
  }
  work.keeps_parts = true;
  Hands hands(work, nullptr, at_once);
  hands.add({1}, 0);
  EXPECT_TRUE(next(hands).is_whole);
}

TEST(PieceHands, ThrowWhatAPieceHasThrown) {
  for (const int threads : {0, 1}) {
    Work work = ten_times(threads);
    work.compute = [](const Work::Piece&, int&) -> std::vector<int> {
      throw NumericalError("no rows");
    };
    Hands hands(work, nullptr, never);
    hands.add({1}, 0);
    EXPECT_THROW(next(hands), NumericalError) << threads;
  }
}

// ---- another process ----------------------------------------------------------------------------

/// The letter with a piece that another process was sent.
std::optional<Letter> piece_letter(const Ranks& other) {
  while (auto letter = other.receive()) {
    if (letter->kind == LetterKind::piece) return letter;
  }
  return std::nullopt;
}

// The leader has no thread of its own, so every piece goes to the other process; its answer is the
// piece with its rows.
TEST(PieceHands, SendPiecesToOtherProcesses) {
  test::Post post(2);
  const Ranks leader = post.ranks(0), other = post.ranks(1);
  other.send({0, LetterKind::ready, packed(1)});
  const Work work = ten_times(0), elsewhere = ten_times(1);
  Hands hands(work, &leader, never);
  EXPECT_EQ(hands.threads(), 1);
  hands.add({3, 4}, 5);
  EXPECT_TRUE(hands.has_away());
  EXPECT_TRUE(hands.has_open());
  EXPECT_FALSE(hands.take());  // not answered
  const auto letter = piece_letter(other);
  ASSERT_TRUE(letter);
  const Letter answer = answer_piece(elsewhere, letter->bytes, never);
  EXPECT_EQ(answer.kind, LetterKind::rows);
  other.send(answer);
  const auto finished = hands.take();
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->piece, (Work::Piece{3, 4}));
  EXPECT_EQ(finished->rows, (std::vector<int>{35, 45}));
  EXPECT_TRUE(finished->is_whole);
  EXPECT_FALSE(hands.has_away());
  EXPECT_FALSE(hands.has_open());
}

// What is given up is not waited for: it is told to stop, once.
TEST(PieceHands, TellOtherProcessesToStop) {
  test::Post post(2);
  const Ranks leader = post.ranks(0), other = post.ranks(1);
  other.send({0, LetterKind::ready, packed(1)});
  const Work work = ten_times(0);
  {
    Hands hands(work, &leader, never);
    hands.add({3}, 0);
    hands.stop();
  }
  int stops = 0;
  while (const auto letter = other.receive()) stops += letter->kind == LetterKind::stop;
  EXPECT_EQ(stops, 1);
}

TEST(PieceHands, ThrowWhatAnotherProcessHasMet) {
  test::Post post(2);
  const Ranks leader = post.ranks(0), other = post.ranks(1);
  other.send({0, LetterKind::ready, packed(1)});
  const Work work = ten_times(0);
  Work broken = ten_times(1);
  broken.compute = [](const Work::Piece&, int&) -> std::vector<int> {
    throw NumericalError("no rows");
  };
  Hands hands(work, &leader, never);
  hands.add({3}, 0);
  const auto letter = piece_letter(other);
  ASSERT_TRUE(letter);
  const Letter answer = answer_piece(broken, letter->bytes, never);
  EXPECT_EQ(answer.kind, LetterKind::error);
  other.send(answer);
  EXPECT_THROW(hands.take(), NumericalError);
}

// A process that is stopped answers every piece, without rows, and computes none that has not
// begun.
TEST(AnswerPiece, HasNoRowsWhereItIsStopped) {
  std::atomic<int> computed = 0;
  Work work = ten_times(1);
  work.compute = [&](const Work::Piece&, int&) {
    ++computed;
    return std::vector<int>{1};
  };
  const std::string bytes = packed(std::uint64_t{9}, Work::Piece{1}, 0);
  const Letter answer = answer_piece(work, bytes, at_once);
  EXPECT_EQ(answer.kind, LetterKind::rows);
  std::uint64_t number = 0;
  bool is_whole = true;
  double seconds = -1.0;
  std::vector<int> rows{5};
  unpack(answer.bytes, number, is_whole, seconds, rows);
  EXPECT_EQ(number, 9u);
  EXPECT_FALSE(is_whole);
  EXPECT_TRUE(rows.empty());
  EXPECT_EQ(computed.load(), 0);
}

// A silent process is lost.
TEST(PieceHands, LoseAProcessThatSaysNothing) {
  test::Post post(2);
  Ranks leader = post.ranks(0);
  leader.patience = std::chrono::milliseconds(20);
  post.ranks(1).send({0, LetterKind::ready, packed(1)});
  const Work work = ten_times(0);
  Hands hands(work, &leader, never);
  hands.add({3}, 0);
  const auto wait_for_it = [&] {
    for (int i = 0; i < 1000; ++i) hands.wait();
  };
  EXPECT_THROW(wait_for_it(), LostRank);
}

}  // namespace whirl::piece_hands_test
