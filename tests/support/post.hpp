#pragma once
/// Ranks that are threads of one program, with letters that go from box to box.

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "libbase/processes/ranks.hpp"

namespace whirl::test {

class Post {
 public:
  explicit Post(int count) : boxes_(static_cast<std::size_t>(count)) {}

  Ranks ranks(int rank) {
    Ranks ranks{.rank = rank, .count = static_cast<int>(boxes_.size())};
    ranks.send = [this, rank](Letter letter) {
      Box& to = box(std::exchange(letter.rank, rank));
      const std::lock_guard lock(to.mutex);
      to.letters.push_back(std::move(letter));
    };
    ranks.receive = [this, rank]() -> std::optional<Letter> {
      Box& own = box(rank);
      const std::lock_guard lock(own.mutex);
      if (own.letters.empty()) return std::nullopt;
      Letter letter = std::move(own.letters.front());
      own.letters.pop_front();
      return letter;
    };
    return ranks;
  }

  /// Waits until so many letters are in the box of the leader.
  void wait_for(std::size_t letters) {
    while (true) {
      {
        const std::lock_guard lock(box(0).mutex);
        if (box(0).letters.size() >= letters) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 private:
  struct Box {
    std::mutex mutex;
    std::deque<Letter> letters;
  };
  Box& box(int rank) { return boxes_[static_cast<std::size_t>(rank)]; }

  std::vector<Box> boxes_;
};

/// Does what several ranks share, each in a thread of its own; what the leader makes of it.
/// @param work  called with the ranks as each of them sees them; of the leader once all others
///              serve
template <class Work>
auto in_ranks(int count, const Work& work) {
  Post post(count);
  std::vector<std::jthread> others;
  for (int rank = 1; rank < count; ++rank) {
    others.emplace_back([&post, &work, rank] {
      try {
        work(post.ranks(rank));
        ADD_FAILURE() << "rank " << rank << " does not serve";
      } catch (const WorkIsDone&) {
      }
    });
  }
  post.wait_for(static_cast<std::size_t>(count) - 1);
  const Ranks leader = post.ranks(0);
  const auto end = [&] {
    for (int rank = 1; rank < count; ++rank) leader.send({rank, LetterKind::end});
  };
  try {
    auto result = work(leader);
    end();
    return result;
  } catch (...) {
    end();
    throw;
  }
}

}  // namespace whirl::test
