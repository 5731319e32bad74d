// Studies that several processes share, here threads: the same to the last bit whatever ranks and
// threads, errors and stops of others, and one that is lost.

#include <atomic>

#include "libbase/error.hpp"
#include "libbase/structs/travel.hpp"
#include "libdyn/studies/point_runner.hpp"
#include "tests/support/branch_trees.hpp"
#include "tests/support/post.hpp"
#include "tests/support/studies.hpp"

namespace whirl::dyn_ranks_test {

using test::expect_same_points;
using test::in_ranks;

/// What a study finds in ranks and alone must be the same, and not the leader alone may have worked
/// on it.
template <class Result, class Options>
void expect_same_in_ranks(Result (*study)(const StudyModels&, const Options&,
                                          const Monitor<Result>&, Result),
                          Options options) {
  options.threads = 1;
  const Result alone = study(test::rotor_stator(), options, {}, {});
  for (const auto& [count, threads] : {std::pair{2, 1}, {3, 2}, {4, 1}}) {
    options.threads = threads;
    std::vector<std::atomic<int>> models_of(static_cast<std::size_t>(count));
    const Result result = in_ranks(count, [&](const Ranks& ranks) {
      StudyModels models = test::rotor_stator();
      models.member = [&, good = models.member](std::span<const double> values) {
        ++models_of[static_cast<std::size_t>(ranks.rank)];
        return good(values);
      };
      return study(models, options, {.ranks = &ranks}, {});
    });
    expect_same_points(result.points, alone.points);
    int models_elsewhere = 0;  // beside the first of each, which says what there is
    for (std::size_t rank = 1; rank < models_of.size(); ++rank)
      models_elsewhere += models_of[rank] - 1;
    EXPECT_GT(models_elsewhere, 0) << count;
  }
}

TEST(StudyRanks, MapIsTheSame) {
  expect_same_in_ranks(map, test::plane(1));
}

TEST(StudyRanks, FreshSweepIsTheSame) {
  SweepOptions options = test::along_speed(SweepStart::fresh);
  for (int i = 0; i < 40; ++i) options.values.push_back(141.0 + 0.25 * i);  // enough for all
  expect_same_in_ranks(sweep, options);
}

TEST(StudyRanks, CarriedSweepIsTheSame) {
  expect_same_in_ranks(sweep, test::along_speed(SweepStart::carried));
}

TEST(StudyRanks, BasinsAreTheSame) {
  BasinsOptions options = test::around_the_start();
  options.starts = 60;
  expect_same_in_ranks(basins, options);
}

// Branches and the curves of their bifurcations, in stretches that go from process to process.
TEST(StudyRanks, BranchesAreTheSame) {
  const test::DoublingRotor rotor;
  BranchStudyOptions options{.tree = rotor.options(), .curves = rotor.curve_options()};
  const BranchStudy begun{.tree = rotor.begun()};
  const BranchStudy alone = test::followed(rotor.all_scenes(), begun, options);
  EXPECT_GT(alone.curves.curves.size(), 1u);
  options.stretch = std::chrono::milliseconds(5);
  for (const auto& [count, threads] : {std::pair{2, 1}, {3, 2}, {4, 1}}) {
    options.threads = threads;
    std::atomic<int> scenes_elsewhere = 0;
    const BranchStudy study = in_ranks(count, [&](const Ranks& ranks) {
      BranchScenes scenes = rotor.all_scenes();
      scenes.along.at = [&, at = scenes.along.at](double value) {
        scenes_elsewhere += !ranks.leads();
        return at(value);
      };
      return test::followed(scenes, ranks.leads() ? begun : BranchStudy{}, options,
                            {.ranks = &ranks});
    });
    test::expect_same_tree(study.tree, alone.tree);
    test::expect_same_curves(study.curves, alone.curves);
    EXPECT_GT(scenes_elsewhere, 0) << count;
  }
}

// Where a motion fails in another process its reason comes back with it.
TEST(StudyRanks, PointsFailAloneAndSayWhy) {
  const MapResult result = in_ranks(2, [](const Ranks& ranks) {
    StudyModels models = test::rotor_stator();
    models.start = [&, good = models.start](const StudyMember& member, const FullState* from) {
      if (!ranks.leads()) throw NumericalError("no start");
      return good(member, from);
    };
    return map(models, test::plane(1), {.ranks = &ranks});
  });
  long failed = 0;
  for (const auto& point : result.points) {
    failed += point->has_failed();
    EXPECT_EQ(point->failure, point->has_failed() ? "no start" : "");
  }
  EXPECT_GE(failed, 8);
  EXPECT_LE(failed, 28);
}

// A wrong model that another process meets ends the study with its problems; what is done is saved.
TEST(StudyRanks, AWrongModelElsewhereEndsTheStudy) {
  std::size_t saved = 0;
  const auto study = [&](const Ranks& ranks) {
    StudyModels models = test::rotor_stator();
    models.start = [&, good = models.start](const StudyMember& member, const FullState* from) {
      if (!ranks.leads()) throw ModelError({"a.toml", 3, 7}, "operation.speed", "too fast");
      return good(member, from);
    };
    return map(
        models, test::plane(1),
        {.save = [&](const MapResult& result) { saved = result.points.size(); }, .ranks = &ranks});
  };
  try {
    in_ranks(2, study);
    FAIL();
  } catch (const ModelError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_EQ(error.problems()[0].where, (Where{"a.toml", 3, 7}));
    EXPECT_EQ(error.problems()[0].key, "operation.speed");
  }
  EXPECT_EQ(saved, 36u);
}

// A process that is asked to stop alone, as by a signal, stops all; what is done is kept, and the
// study goes on from there to the same end.
TEST(StudyRanks, WhoIsStoppedStopsAll) {
  MapOptions options = test::plane(1);
  for (int i = 0; i < 100; ++i) options.grid.axes[0].push_back(142.0 + 0.1 * i);
  std::atomic<bool> is_stopped = false;
  std::size_t saved = 0;
  const MapResult part = in_ranks(2, [&](const Ranks& ranks) {
    Monitor<MapResult> monitor{.ranks = &ranks};
    if (ranks.leads()) {
      monitor.progress = [&](long done, long) { is_stopped = done > 0; };
      monitor.save = [&](const MapResult& result) { saved = done_points(result.points); };
    } else {
      monitor.is_stopped = [&] { return is_stopped.load(); };
    }
    return map(test::rotor_stator(), options, monitor);
  });
  const std::size_t done = done_points(part.points);
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, part.points.size());
  EXPECT_EQ(saved, done);
  const MapResult rest = in_ranks(2, [&](const Ranks& ranks) {
    return map(test::rotor_stator(), options, {.ranks = &ranks},
               ranks.leads() ? part : MapResult{});
  });
  expect_same_points(rest.points, map(test::rotor_stator(), options).points);
}

struct Counted {
  PointRows<int> points;
};

// A piece in whose preparation the leader is stopped is not kept, as it was given something half
// done; also where it would be computed in a process that was not told yet.
TEST(StudyRanks, WhatWasStoppedWhilePreparedIsNotKept) {
  constexpr std::size_t pieces = 10, stopped = 3;
  const Counted result = in_ranks(2, [&](const Ranks& ranks) {
    Counted counted{.points = PointRows<int>(pieces)};
    bool is_stopped = false;
    PointWork<int, int> work{.pieces = {}, .most_together = 1};
    for (std::size_t i = 0; i < pieces; ++i) work.pieces.push_back({i});
    work.prepare = [&](const auto& piece) {
      is_stopped = piece[0] == stopped;
      return is_stopped ? -1 : 1;
    };
    work.compute = [](const auto&, int given) { return std::vector<int>{given}; };
    Monitor<Counted> monitor{.is_stopped = [&] { return is_stopped; }, .ranks = &ranks};
    run_points(work, counted, monitor);
    return counted;
  });
  for (std::size_t i = 0; i < pieces; ++i) {
    EXPECT_TRUE(i < stopped || !result.points[i]) << i;
    EXPECT_EQ(result.points[i].value_or(1), 1) << i;
  }
}

// A process that began and then says nothing: the leader does its own pieces, waits, saves and says
// which rank is lost.
TEST(StudyRanks, ALostRankEndsTheStudyWithAMessage) {
  test::Post post(2);
  post.ranks(1).send({0, LetterKind::ready, packed(1)});
  Ranks leader = post.ranks(0);
  leader.patience = std::chrono::milliseconds(300);
  std::size_t saved = 0;
  const Monitor<MapResult> monitor{
      .save = [&](const MapResult& result) { saved = done_points(result.points); },
      .ranks = &leader};
  try {
    map(test::rotor_stator(), test::plane(1), monitor);
    FAIL();
  } catch (const LostRank& lost) {
    EXPECT_NE(std::string(lost.what()).find("rank 1"), std::string::npos) << lost.what();
  }
  EXPECT_GT(saved, 0u);
  EXPECT_LT(saved, 36u);
}

// Thousands of pieces that cost nothing go to another process and back, each to its own place.
TEST(StudyRanks, ManySmallPiecesComeBack) {
  constexpr std::size_t pieces = 2000;
  const Counted result = in_ranks(2, [&](const Ranks& ranks) {
    Counted counted{.points = PointRows<int>(pieces)};
    PointWork<int> work{.pieces = {}, .most_together = 1};
    for (std::size_t i = 0; i < pieces; ++i) work.pieces.push_back({i});
    work.compute = [](const auto& piece, NothingGiven&) {
      return std::vector<int>{static_cast<int>(2 * piece[0])};
    };
    run_points(work, counted, Monitor<Counted>{.ranks = &ranks});
    return counted;
  });
  for (std::size_t i = 0; i < pieces; ++i) EXPECT_EQ(result.points[i], static_cast<int>(2 * i));
}

}  // namespace whirl::dyn_ranks_test
