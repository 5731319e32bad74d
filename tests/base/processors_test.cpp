// Threads that a process may use: what its affinity mask, its cgroups and its environment leave.

#include "libbase/system/processors.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

namespace whirl::processors_test {

namespace fs = std::filesystem;

/// A folder with files as /proc and /sys have them.
class Processors : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(root); }

  std::optional<double> quota(const std::map<std::string, std::string>& files) const {
    fs::remove_all(root);
    for (const auto& [name, text] : files) {
      fs::create_directories((root / name).parent_path());
      std::ofstream(root / name) << text;
    }
    return processor_limits(root).quota;
  }

  const fs::path root = fs::path(testing::TempDir()) /
                        ("whirl_processors_" + std::to_string(::getpid()) + "_" +
                         testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Sets a variable of the environment until the end of its life; null: it is not set.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }

 private:
  void set(const char* value) const { value ? ::setenv(name_, value, 1) : ::unsetenv(name_); }
  const char* name_;
  std::optional<std::string> old_;
};

// The group itself may do anything, the one that it is in 2.5 processors' worth of time, that one's
// folder 4.
TEST_F(Processors, CpuMaxOfAGroupAndOfAllThatItIsIn) {
  const std::map<std::string, std::string> files{
      {"proc/self/cgroup", "0::/user.slice/job_7/step_0\n"},
      {"sys/fs/cgroup/user.slice/cpu.max", "400000 100000\n"},
      {"sys/fs/cgroup/user.slice/job_7/cpu.max", "125000 50000\n"},
      {"sys/fs/cgroup/user.slice/job_7/step_0/cpu.max", "max 100000\n"}};
  EXPECT_EQ(quota(files), 2.5);
}

TEST_F(Processors, NoQuotaWithoutALimit) {
  EXPECT_EQ(quota({}), std::nullopt);
  EXPECT_EQ(quota({{"proc/self/cgroup", "0::/\n"}}), std::nullopt);
  EXPECT_EQ(quota({{"proc/self/cgroup", "0::/a\n"}, {"sys/fs/cgroup/a/cpu.max", "max 100000\n"}}),
            std::nullopt);
  EXPECT_EQ(quota({{"proc/self/cgroup", "0::/a\n"}, {"sys/fs/cgroup/a/cpu.max", "many\n"}}),
            std::nullopt);
  EXPECT_EQ(quota({{"proc/self/cgroup", "rubbish\n:\n\n"}}), std::nullopt);
}

// A container sees its own group as the root of all, by whatever path it is called outside.
TEST_F(Processors, QuotaOfAContainer) {
  for (const char* path : {"/", "/docker/0123", "/../../other"}) {
    EXPECT_EQ(quota({{"proc/self/cgroup", std::string("0::") + path + "\n"},
                     {"sys/fs/cgroup/cpu.max", "150000 100000\n"}}),
              1.5)
        << path;
  }
}

TEST_F(Processors, QuotaOfTheFirstVersion) {
  const std::map<std::string, std::string> lines{
      {"proc/self/cgroup",
       "12:cpuset:/\n4:cpu,cpuacct:/slurm/job_9\n2:memory:/slurm/job_9\n0::/\n"}};
  const auto with = [&](const std::string& mount, const std::string& group_quota) {
    auto files = lines;
    files["sys/fs/cgroup/" + mount + "/slurm/job_9/cpu.cfs_quota_us"] = group_quota;
    files["sys/fs/cgroup/" + mount + "/slurm/job_9/cpu.cfs_period_us"] = "100000\n";
    files["sys/fs/cgroup/" + mount + "/slurm/cpu.cfs_quota_us"] = "600000\n";
    files["sys/fs/cgroup/" + mount + "/slurm/cpu.cfs_period_us"] = "100000\n";
    return quota(files);
  };
  EXPECT_EQ(with("cpu,cpuacct", "300000\n"), 3.0);
  EXPECT_EQ(with("cpu", "300000\n"), 3.0);
  EXPECT_EQ(with("cpu", "-1\n"), 6.0);
  // cpuset and cpuacct are other controllers
  EXPECT_EQ(quota({{"proc/self/cgroup", "4:cpuset,cpuacct:/a\n"},
                   {"sys/fs/cgroup/cpu/a/cpu.cfs_quota_us", "100000\n"},
                   {"sys/fs/cgroup/cpu/a/cpu.cfs_period_us", "100000\n"}}),
            std::nullopt);
}

TEST_F(Processors, OfTheEnvironment) {
  const auto found = [&](const char* openmp, const char* slurm) {
    const Variable first("OMP_NUM_THREADS", openmp), second("SLURM_CPUS_PER_TASK", slurm);
    const ProcessorLimits limits = processor_limits(root);
    return std::pair(limits.openmp, limits.slurm);
  };
  using Found = std::pair<std::optional<int>, std::optional<int>>;
  EXPECT_EQ(found(nullptr, nullptr), Found());
  EXPECT_EQ(found("3", "8"), Found(3, 8));
  EXPECT_EQ(found("4,2", nullptr), Found(4, std::nullopt));  // nested levels of OpenMP
  for (const char* rubbish : {"", "many", "0", "-2", "3x", "99999999999"}) {
    EXPECT_EQ(found(rubbish, rubbish), Found()) << rubbish;
  }
}

TEST(UsableProcessors, AreTheSmallestOfAllLimits) {
  EXPECT_EQ(usable_processors({.affinity = 64}), 64);
  EXPECT_EQ(usable_processors({.affinity = 64, .quota = 2.5}), 3);
  EXPECT_EQ(usable_processors({.affinity = 64, .quota = 0.2}), 1);
  EXPECT_EQ(usable_processors({.affinity = 2, .quota = 1e300}), 2);
  EXPECT_EQ(usable_processors({.affinity = 64, .slurm = 8}), 8);
  EXPECT_EQ(usable_processors({.affinity = 64, .openmp = 4, .slurm = 8}), 4);
  EXPECT_EQ(usable_processors({.affinity = 64, .openmp = 12, .slurm = 8}), 12);  // OpenMP's counts
  EXPECT_EQ(usable_processors({.affinity = 2, .openmp = 12}), 2);
  EXPECT_EQ(usable_processors({.affinity = 0}), 1);
}

// As under taskset: a child that is bound to one processor counts one.
TEST(UsableProcessors, AreThoseOfTheAffinityMask) {
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(processor_limits("/nowhere").affinity, CPU_COUNT(&all));
  const pid_t child = ::fork();
  if (child == 0) {
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int i = 0; CPU_COUNT(&one) == 0; ++i) {
      if (CPU_ISSET(i, &all)) CPU_SET(i, &one);
    }
    const bool is_bound = ::sched_setaffinity(0, sizeof one, &one) == 0;
    ::_exit(is_bound ? processor_limits("/nowhere").affinity : 99);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace whirl::processors_test
