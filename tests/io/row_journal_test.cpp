// Rows beside a large study's file: what was appended is there, whatever happened to the process.

#include "libio/results/row_journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>

#include "libio/results/replace_file.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::row_journal_test {

namespace fs = std::filesystem;
using test::content, test::problem_of;
using Row = RowJournal::Row;
using Rows = std::vector<std::pair<std::uint64_t, std::string>>;

class Journal : public test::InResultFolder {
 public:
  fs::path place = journal_of(path);
};

/// A row whose bytes tell its number.
Row row(std::uint64_t number) {
  return {number, std::string(number % 50, static_cast<char>('a' + number % 26))};
}

std::vector<Row> rows(std::uint64_t from, std::uint64_t to) {
  std::vector<Row> all;
  for (std::uint64_t i = from; i < to; ++i) all.push_back(row(i));
  return all;
}

Rows in(const RowJournal& journal) {
  Rows all;
  journal.read(
      [&](std::uint64_t number, std::string_view bytes) { all.emplace_back(number, bytes); });
  return all;
}

Rows expected(std::uint64_t count) {
  Rows all;
  for (const Row& each : rows(0, count)) all.emplace_back(each.number, each.bytes);
  return all;
}

void overwrite(const fs::path& place, const std::string& text) {
  std::ofstream(place, std::ios::binary | std::ios::trunc) << text;
}

TEST_F(Journal, GivesBackWhatWasAppended) {
  {
    RowJournal journal(place, "a study");
    EXPECT_TRUE(in(journal).empty());
    journal.append(rows(0, 100));
    journal.append(rows(100, 1000));
    EXPECT_EQ(in(journal), expected(1000));
  }
  RowJournal again(place, "a study");
  EXPECT_EQ(in(again), expected(1000));
  again.append(rows(1000, 1001));
  EXPECT_EQ(in(again), expected(1001));
  EXPECT_EQ(rows_in_journal(place).size(), 1001u);
  again.clear();
  EXPECT_TRUE(rows_in_journal(place).empty());
  again.remove();
  EXPECT_FALSE(fs::exists(place));
}

// Rows of another study are hours of work: they go only where this is asked for.
TEST_F(Journal, OfAnotherStudyIsKept) {
  RowJournal(place, "a study").append(rows(0, 10));
  const std::string before = content(place);
  EXPECT_EQ(problem_of([&] { RowJournal(place, "another study"); }),
            "cannot write " + place.string() +
                ": it has 10 rows of another study, or of another model or version; take another "
                "name, or --restart to drop them");
  EXPECT_EQ(content(place), before);
  drop_rows(place);
  EXPECT_TRUE(in(RowJournal(place, "another study")).empty());
  EXPECT_TRUE(in(RowJournal(place, "a study")).empty());  // one without rows is taken
}

TEST_F(Journal, CutAnywhereHasTheRowsBefore) {
  RowJournal(place, "a study").append(rows(0, 12));
  const std::string whole = content(place);
  std::size_t last = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    overwrite(place, whole.substr(0, size));
    RowJournal journal(place, "a study");
    const std::size_t left = in(journal).size();
    EXPECT_EQ(in(journal), expected(left)) << size;
    EXPECT_GE(left, last) << size;
    last = left;
    if (size % 16 != 0) continue;
    journal.append(rows(left, 12));  // and goes on
    EXPECT_EQ(in(journal), expected(12)) << size;
  }
  EXPECT_EQ(last, 12u);
}

TEST_F(Journal, DoesNotTellWhatADamagedByteChanged) {
  constexpr std::size_t head_bytes = 24;
  RowJournal(place, "a study").append(rows(0, 12));
  const std::string whole = content(place);
  for (std::size_t at = 8; at < whole.size(); at += 3) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    overwrite(place, damaged);
    if (at < head_bytes) {  // whose rows these are is not known: they stay
      EXPECT_NE(problem_of([&] { RowJournal(place, "a study"); }), "none") << at;
      EXPECT_EQ(content(place), damaged) << at;
      continue;
    }
    const RowJournal journal(place, "a study");
    const std::size_t left = in(journal).size();
    EXPECT_LT(left, 12u) << at;
    EXPECT_EQ(in(journal), expected(left)) << at;
  }
}

TEST_F(Journal, LeavesOtherFilesAlone) {
  overwrite(place, "notes about rows");
  EXPECT_EQ(
      problem_of([&] { RowJournal(place, "a study"); }),
      "cannot write " + place.string() + ": this file is no journal of whirl and would be lost");
  EXPECT_EQ(content(place), "notes about rows");
  EXPECT_TRUE(rows_in_journal(place).empty());
}

TEST_F(Journal, IsOpenInOneProcessOnly) {
  const RowJournal journal(place, "a study");
  EXPECT_EQ(problem_of([&] { RowJournal(place, "a study"); }),
            "cannot write " + place.string() + ": another run is writing it");
}

TEST_F(Journal, OnAFullDiskIsAsItWas) {
  RowJournal(place, "a study").append(rows(0, 50));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{10'000, 10'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    RowJournal journal(place, "a study");
    const std::string problem = problem_of([&] { journal.append(rows(50, 1000)); });
    const bool is_right = problem == "cannot write " + place.string() + ": File too large";
    std::exit(is_right && in(journal) == expected(50) ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(in(RowJournal(place, "a study")), expected(50));
}

TEST_F(Journal, OfAKilledProcessHasAllThatWasAppended) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> delay(0, 20'000);  // [us], a few appends long
  std::uint64_t before = 0;
  for (int i = 0; i < 20; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      RowJournal journal(place, "a study");
      for (std::uint64_t from = before;; from += 40) journal.append(rows(from, from + 40));
    }
    ::usleep(static_cast<useconds_t>(delay(random)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const RowJournal journal(place, "a study");
    const std::size_t left = in(journal).size();
    EXPECT_GE(left, before);
    EXPECT_EQ(in(journal), expected(left));
    before = left;
  }
  EXPECT_GT(before, 100u);
}

}  // namespace whirl::row_journal_test
