// Studies whose file takes long to write: rows that are new are beside it, and nothing is lost.

#include "libio/results/kept_study.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "libdyn/system/model.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::kept_study_test {

namespace fs = std::filesystem;
using test::problem_of;

/// Points that are numbers; NaN where none is known.
struct Numbers {
  std::vector<double> points = std::vector<double>(100, std::nan(""));
  bool operator==(const Numbers& other) const { return packed(points) == packed(other.points); }
};

/// The process is gone; what runs after that is not its own.
struct Killed {};

class KeptStudies : public test::InResultFolder {
 protected:
  fs::path journal = journal_of(path);
  StudyKeeping keeping{.place = {.file = path.string(),
                                 .call = {.verb = "map", .file = "rotor.toml"},
                                 .model = "a model",
                                 .version = "1"},
                       .begin = [this] {
                         auto file = std::make_unique<ResultWriter>(path, Replaces::own_results);
                         Model model;
                         model.source = "a model";
                         write_origin(*file, {keeping.place.call, {"whirl", "map"}, "1"}, model);
                         return file;
                       }};
  int writings = 0;

  /// A study that does what is asked for with what was there.
  KeptStudy<Numbers> study(const std::function<void(Numbers&, const Monitor<Numbers>&)>& run) {
    return {.write =
                [this](ResultWriter& to, const Numbers& so_far) {
                  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // which is long
                  to.dataset("/numbers", Vec(Vec::Map(so_far.points.data(), 100)), {"", "n", {""}});
                  ++writings;
                },
            .take = [](Numbers& begun,
                       const ResultReader& from) { begun.points = from.numbers("/numbers"); },
            .run =
                [run](Numbers begun, const Monitor<Numbers>& monitor) {
                  run(begun, monitor);
                  return begun;
                },
            .pack = [](const Numbers& so_far,
                       std::size_t point) { return packed(so_far.points[point]); },
            .unpack = [](Numbers& begun, std::size_t point,
                         std::string_view bytes) { unpack(bytes, begun.points[point]); }};
  }

  /// Computes points one by one until the process is killed, or all are there.
  static void grow(Numbers& so_far, const Monitor<Numbers>& monitor, std::size_t from,
                   std::size_t killed_at) {
    for (std::size_t i = from; i < 100; ++i) {
      if (i == killed_at) throw Killed{};
      so_far.points[i] = static_cast<double>(i);
      monitor.add(so_far, std::vector{i});
    }
    monitor.save(so_far);
  }
};

TEST_F(KeptStudies, KeepWhatIsNewBesideTheirFile) {
  EXPECT_THROW(run_kept(keeping, study([](Numbers& so_far, const auto& monitor) {
                          grow(so_far, monitor, 0, 70);
                        })),
               Killed);
  EXPECT_LE(writings, 2);
  EXPECT_EQ(rows_in_journal(journal).size(), 69u);  // the first one showed how long writing takes

  Numbers found;
  const Numbers whole = run_kept(keeping, study([&](Numbers& so_far, const auto& monitor) {
                                   found = so_far;
                                   grow(so_far, monitor, 70, 100);
                                 }));
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(std::isnan(found.points[i]), i >= 70) << i;
    EXPECT_EQ(whole.points[i], static_cast<double>(i));
  }
  EXPECT_FALSE(fs::exists(journal));
  EXPECT_EQ(ResultReader(path).numbers("/numbers"), whole.points);
}

// A file that took long to read is not written anew before anything else.
TEST_F(KeptStudies, GoOnBesideTheirFile) {
  EXPECT_THROW(run_kept(keeping, study([](Numbers& so_far, const auto& monitor) {
                          grow(so_far, monitor, 0, 30);
                        })),
               Killed);
  writings = 0;
  auto goes_on = study([](Numbers& so_far, const auto& m) { grow(so_far, m, 30, 33); });
  goes_on.take = [](Numbers& begun, const ResultReader& from) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    begun.points = from.numbers("/numbers");
  };
  EXPECT_THROW(run_kept(keeping, goes_on), Killed);
  EXPECT_EQ(writings, 0);
  EXPECT_EQ(rows_in_journal(journal).size(), 32u);
}

// What is new is beside the file: nobody who wants the study to stop waits for all of it.
TEST_F(KeptStudies, GiveUpAWritingThatTakesLongOnceTheyAreToStop) {
  bool is_stopped = false;
  keeping.place.patience = std::chrono::milliseconds(70);
  keeping.is_stopped = [&] { return is_stopped; };
  auto stops = study([&](Numbers& so_far, const auto& monitor) {
    for (std::size_t i = 0; i < 30; ++i) {
      so_far.points[i] = static_cast<double>(i);
      monitor.add(so_far, std::vector{i});
    }
    is_stopped = true;
    monitor.save(so_far);
  });
  const auto write = stops.write;
  stops.write = [&](ResultWriter& to, const Numbers& so_far) {
    for (int block = 0; is_stopped && block < 1000; ++block) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      to.go_on();
    }
    write(to, so_far);
  };
  run_kept(keeping, stops);
  EXPECT_LE(writings, 1);
  EXPECT_EQ(rows_in_journal(journal).size(), 29u);

  is_stopped = false;
  run_kept(keeping, study([](Numbers& so_far, const auto&) {
             for (std::size_t i = 0; i < 30; ++i) {
               EXPECT_EQ(so_far.points[i], static_cast<double>(i));
             }
           }));
}

TEST_F(KeptStudies, ThatBeginAnewForgetIt) {
  const auto killed = study([](Numbers& so_far, const auto& m) { grow(so_far, m, 0, 30); });
  EXPECT_THROW(run_kept(keeping, killed), Killed);
  Numbers found;
  const auto look = study([&](Numbers& so_far, const auto&) { found = so_far; });
  keeping.place.restarts = true;
  run_kept(keeping, look);
  EXPECT_TRUE(found == Numbers{});

  keeping.place.restarts = false;
  EXPECT_THROW(run_kept(keeping, killed), Killed);
  fs::remove(path);  // whoever takes the file away means all of it
  run_kept(keeping, look);
  EXPECT_TRUE(found == Numbers{});
}

TEST_F(KeptStudies, OfAnotherCallDoNotTakeIt) {
  EXPECT_THROW(run_kept(keeping, study([](Numbers& so_far, const auto& monitor) {
                          grow(so_far, monitor, 0, 30);
                        })),
               Killed);
  keeping.place.call.options = {"--discard=7"};
  EXPECT_NE(problem_of([&] {
              run_kept(keeping, study([](Numbers&, const auto&) {}));
            }).find("holds another study"),
            std::string::npos);
  EXPECT_EQ(rows_in_journal(journal).size(), 29u);
}

// A study in parts whose rows are not all in the file of one of them is not joined without these.
TEST_F(KeptStudies, DoNotJoinPartsWithoutTheirRows) {
  EXPECT_THROW(run_kept(keeping, study([](Numbers& so_far, const auto& monitor) {
                          grow(so_far, monitor, 0, 30);
                        })),
               Killed);
  StudyKeeping joins = keeping;
  joins.place.file = (folder / "all.h5").string();
  joins.place.joins = {path.string()};
  joins.begin = [&] { return std::make_unique<ResultWriter>(joins.place.file); };
  EXPECT_NE(problem_of([&] {
              run_kept(joins, study([](Numbers&, const auto&) {}));
            }).find("has rows beside it that are not in it yet: `whirl merge"),
            std::string::npos);
}

}  // namespace whirl::kept_study_test
