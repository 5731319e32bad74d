// The queue of a study: every piece is done once, whatever the threads.

#include "libbase/work_queue.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace whirl::work_queue_test {

using namespace std::chrono_literals;

TEST(WorkQueue, DoesEveryPieceOnce) {
  for (const int threads : {0, 1, 4}) {
    WorkQueue<int> queue(threads);
    std::multiset<int> results;
    for (int i = 0; i < 50; ++i) {
      queue.add([i] { return i; });
      while (queue.is_full()) {
        if (const auto r = queue.take(1s)) results.insert(*r);
      }
    }
    while (queue.has_open()) {
      if (const auto r = queue.take(1s)) results.insert(*r);
    }
    EXPECT_EQ(results.size(), 50u);
    EXPECT_EQ(std::set<int>(results.begin(), results.end()).size(), 50u);
  }
}

TEST(WorkQueue, HandsOnWhatWentWrong) {
  for (const int threads : {0, 2}) {
    WorkQueue<int> queue(threads);
    queue.add([]() -> int { throw std::runtime_error("no"); });
    EXPECT_THROW(
        {
          while (queue.has_open()) queue.take(1s);
        },
        std::runtime_error);
    EXPECT_FALSE(queue.has_open());
  }
}

// What has not begun is given up with the queue: its end does not wait for it.
TEST(WorkQueue, DropsWhatHasNotBegun) {
  std::atomic<int> begun = 0;
  {
    WorkQueue<int> queue(1);
    for (int i = 0; i < 100; ++i) {
      queue.add([&] {
        ++begun;
        std::this_thread::sleep_for(5ms);
        return 0;
      });
    }
  }
  EXPECT_LT(begun, 100);
}

}  // namespace whirl::work_queue_test
