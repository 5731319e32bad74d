#pragma once
/// Processes that do one piece of work together, and the letters between them, whatever carries
/// these.

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
  piece,      ///< to be computed
  rows,       ///< of a piece
  error,      ///< that a piece, or a rank, met
  alive,      ///< and nothing else
  stop,       ///< with what is begun
  end         ///< of all work
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
/// Letters between two ranks arrive in their order. One thread of a process sends and receives.
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

/// How long to wait between two looks for letters: not at all while they come, then ever longer, up
/// to some milliseconds, so that who waits needs no processor: a look takes some 30 us.
class Patience {
 public:
  /// A letter was there.
  void begin_anew() { looks_ = 0; }
  /// Until the next look; others may run meanwhile.
  std::chrono::microseconds next();

 private:
  int looks_ = 0;  ///< without a letter
};

/// For how long a rank has said nothing, by the time in which its letters were looked for.
class Silence {
 public:
  void hear() { lasts_ = {}; }
  /// Looks again; how long it lasts.
  std::chrono::milliseconds look();

 private:
  using clock = std::chrono::steady_clock;
  clock::time_point last_ = clock::now();
  clock::duration lasts_{};
};

/// An error as bytes: a ModelError with its problems, a NumericalError, too little memory, or
/// another one by its text.
std::string packed_error(const std::exception_ptr& error);
/// Throws it again in another process.
/// @param rank  where it was met
[[noreturn]] void throw_packed(std::string_view error, int rank);

}  // namespace whirl::inline base
