#pragma once
/// Processes that do one piece of work together, and the letters between them, whatever carries the
/// letters.

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace whirl::inline base {

/// What a letter is about.
enum class LetterKind : int {
  share = 1,  ///< from the leader: what all must know
  ready,      ///< to the leader: so many threads wait for pieces
  piece,      ///< to a rank: a piece to be computed
  rows,       ///< to the leader: the rows of a piece
  error,      ///< to the leader: an error of a piece or a rank
  alive,      ///< either way: the sender is alive, nothing else
  stop,       ///< either way: all stop, with the pieces that are begun
  end         ///< all work has ended; the ranks answer alike
};

/// A letter to a rank, or from one.
struct Letter {
  int rank = 0;
  LetterKind kind = LetterKind::alive;
  std::string bytes{};
};

/// A process among those that work together. Rank 0 leads: it hands out pieces, and holds the
/// result and its file; the others compute.
///
/// Letters from one rank to another arrive in the order in which they were sent. One thread of a
/// process sends and receives.
struct Ranks {
  int rank = 0;   ///< of this process
  int count = 1;  ///< of all
  /// Sends a letter; returns at once.
  std::function<void(Letter)> send{};
  /// The next letter, if one is there; never waits.
  std::function<std::optional<Letter>()> receive{};
  /// Set in a process that is told to stop by another one.
  std::shared_ptr<std::atomic<bool>> told_to_stop = std::make_shared<std::atomic<bool>>(false);
  /// A rank that says nothing for so long is lost.
  std::chrono::milliseconds patience = std::chrono::seconds(60);

  bool leads() const { return rank == 0; }
  bool is_told_to_stop() const { return *told_to_stop; }
  /// The same text in all processes: the leader makes it and sends it, the others wait for it.
  /// @throws WorkIsDone  in the others, if the leader ends instead
  std::string share(const std::function<std::string()>& make) const;
};

/// Thrown in ranks that serve once the leader has ended. It is no std::exception, as nothing is
/// wrong.
struct WorkIsDone {};

/// A rank does not answer any more.
class LostRank : public std::runtime_error {
 public:
  LostRank(int rank, std::chrono::milliseconds silence);
};

/// How long to wait between two looks for letters: not at all while letters come, then ever longer,
/// up to some milliseconds, so that a process that waits needs no processor. A look takes some
/// 30 us.
class Patience {
 public:
  /// A letter was there.
  void begin_anew() { looks_ = 0; }
  /// Time to wait until the next look; lets other threads run if that is zero.
  std::chrono::microseconds next();

 private:
  int looks_ = 0;  ///< without a letter
};

/// For how long a rank has said nothing, counting at most a second between two looks for letters.
class Silence {
 public:
  void hear() { lasts_ = {}; }
  /// Notes another look; returns how long the silence lasts.
  std::chrono::milliseconds look();

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point last_ = clock::now();
  clock::duration lasts_{};
};

/// An error as bytes: a ModelError with its problems, a NumericalError, too little memory, or
/// another one by its text.
std::string packed_error(const std::exception_ptr& error);
/// Throws a packed error again, in another process.
/// @param rank  where the error was met
[[noreturn]] void throw_packed(std::string_view error, int rank);

}  // namespace whirl::inline base
