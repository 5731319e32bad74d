// The queue of a study: every piece is done once, whatever the threads.

#include "libbase/processes/work_queue.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <stdexcept>

#include "tests/support/sanitizers.hpp"

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

// A system that gives no more threads is no end: those that there are do the work.
TEST(WorkQueue, DoesWithTheThreadsThatItGets) {
  if (test::is_sanitized) {
    GTEST_SKIP() << "a sanitizer takes more addresses than the limit leaves";
  }
  const auto with_few = [] {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    constexpr std::size_t for_some_stacks = std::size_t{100} << 20u;
    const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + for_some_stacks;
    const rlimit limit{most, most};
    ::setrlimit(RLIMIT_AS, &limit);
    WorkQueue<int> queue(10'000);
    for (int i = 0; i < 5; ++i) queue.add([i] { return i; });
    int sum = 0;
    while (queue.has_open()) {
      if (const auto r = queue.take(1s)) sum += *r;
    }
    ::_exit(sum);
  };
  EXPECT_EXIT(with_few(), testing::ExitedWithCode(10), "");
}

}  // namespace whirl::work_queue_test
