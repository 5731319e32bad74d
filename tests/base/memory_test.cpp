// Memory that a process can have: what the machine, its cgroups and its limit of addresses leave.

#include "libbase/system/memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <map>

#include "libbase/error.hpp"
#include "tests/support/sanitizers.hpp"

namespace whirl::memory_test {

namespace fs = std::filesystem;

/// A folder with files as /proc and /sys have them.
class Memory : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(root); }

  MemoryLimits limits(const std::map<std::string, std::string>& files) const {
    fs::remove_all(root);
    for (const auto& [name, text] : files) {
      fs::create_directories((root / name).parent_path());
      std::ofstream(root / name) << text;
    }
    return memory_limits(root);
  }

  const fs::path root = fs::path(testing::TempDir()) /
                        ("whirl_memory_" + std::to_string(::getpid()) + "_" +
                         testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Memory, OfTheMachineIsWhatIsAvailableAndTheSwap) {
  const std::string facts =
      "MemTotal:  100000 kB\nMemFree: 10 kB\nMemAvailable:  2000 kB\nSwapFree: 500 kB\n";
  EXPECT_EQ(limits({{"proc/meminfo", facts}}).machine, 2500.0 * 1024.0);
  EXPECT_EQ(limits({}).machine, std::nullopt);
}

// Files that were only read can be given back.
TEST_F(Memory, OfACgroupIsItsLimitLessWhatIsInUse) {
  EXPECT_EQ(limits({{"proc/self/cgroup", "0::/job/step\n"},
                    {"sys/fs/cgroup/job/memory.max", "9000\n"},
                    {"sys/fs/cgroup/job/memory.current", "5000\n"},
                    {"sys/fs/cgroup/job/memory.stat", "anon 100\ninactive_file 700\n"},
                    {"sys/fs/cgroup/job/step/memory.max", "max\n"},
                    {"sys/fs/cgroup/job/step/memory.current", "100\n"}})
                .cgroup,
            4700.0);
  EXPECT_EQ(limits({{"proc/self/cgroup", "2:memory:/job\n"},
                    {"sys/fs/cgroup/memory/job/memory.limit_in_bytes", "9000\n"},
                    {"sys/fs/cgroup/memory/job/memory.usage_in_bytes", "5000\n"}})
                .cgroup,
            4000.0);
  EXPECT_EQ(limits({{"proc/self/cgroup", "0::/\n"}}).cgroup, std::nullopt);
}

TEST_F(Memory, LeastOfAllCounts) {
  EXPECT_EQ(least_of({.machine = 3.0, .cgroup = 2.0, .addresses = 5.0}), 2.0);
  EXPECT_TRUE(std::isinf(least_of({})));
}

// `ulimit -v` counts, and the refusal names the option and both numbers.
TEST_F(Memory, MoreThanTheLimitOfAddressesIsRefusedInWords) {
  if (test::is_sanitized) {
    GTEST_SKIP() << "a sanitizer takes more addresses than the limit leaves";
  }
  const auto refused = [] {
    rlimit most{};
    ::getrlimit(RLIMIT_AS, &most);
    const double used = 2e9;
    most.rlim_cur = static_cast<rlim_t>(used);
    ::setrlimit(RLIMIT_AS, &most);
    try {
      require_memory("revolutions", 5e12, "512 revolutions", "record fewer");
    } catch (const OptionError& error) {
      const std::string text = error.what();
      const bool is_right = text.find("512 revolutions take 5000 GB, and this process can have ") !=
                                std::string::npos &&
                            text.ends_with("; record fewer") && error.option() == "revolutions" &&
                            least_of(memory_limits()) < used;
      ::_exit(is_right ? 7 : 1);
    }
    ::_exit(2);
  };
  EXPECT_EXIT(refused(), testing::ExitedWithCode(7), "");
  EXPECT_NO_THROW(require_memory("revolutions", 1e6, "one", "record fewer"));
}

}  // namespace whirl::memory_test
