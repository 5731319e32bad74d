// Rows that are too many for the memory: on the disk they are as they were.

#include "libbase/processes/row_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace whirl::row_store_test {

namespace fs = std::filesystem;

constexpr RowStore::Limits few{.block = 256, .in_memory = 1024};  // bytes

/// Rows of no byte to more than one read of the disk takes.
std::string row(std::size_t i) {
  return std::string(37 * i % 3000, static_cast<char>('a' + i % 26));
}

class Rows : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  static std::string read(const RowStore& store, std::size_t i) {
    std::string buffer;
    return std::string(store.get(i, buffer));
  }

  const fs::path folder =
      fs::path(testing::TempDir()) / ("whirl_row_store_test_" + std::to_string(::getpid()));
};

TEST_F(Rows, AreTheSameInMemoryAndOnTheDisk) {
  for (const bool has_disk : {false, true}) {
    RowStore store(200, few);
    if (has_disk) store.overflow_into(folder);
    for (std::size_t i = 1; i < 200; ++i) store.set(199 - i, row(i));
    EXPECT_EQ(store.on_disk() > 100'000, has_disk);
    EXPECT_TRUE(fs::is_empty(folder));  // nothing is left of it, whatever ends the process
    for (std::size_t i = 1; i < 200; ++i) EXPECT_EQ(read(store, 199 - i), row(i)) << i;
    EXPECT_FALSE(store.has(199));
    store.set(5, "again");
    EXPECT_EQ(read(store, 5), "again");
  }
}

// Copies go on by themselves, whoever writes first.
TEST_F(Rows, OfACopyAreItsOwn) {
  RowStore one(400, few);
  one.overflow_into(folder);
  for (std::size_t i = 0; i < 100; ++i) one.set(i, row(i));
  RowStore other = one;
  for (std::size_t i = 100; i < 400; ++i) {
    one.set(i, row(i));
    other.set(i, row(i + 1));
  }
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_EQ(read(one, i), row(i));
    EXPECT_EQ(read(other, i), row(i < 100 ? i : i + 1));
  }
}

TEST_F(Rows, StayInMemoryWhereTheDiskCannotBeWritten) {
  RowStore store(100, few);
  store.overflow_into(folder / "nowhere");
  for (std::size_t i = 0; i < 100; ++i) store.set(i, row(i));
  EXPECT_EQ(store.on_disk(), 0u);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(read(store, i), row(i));
}

}  // namespace whirl::row_store_test
