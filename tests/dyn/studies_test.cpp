// Maps, sweeps and basins as values, without files: what a point finds alone, whatever the threads,
// and going on where they were stopped.

#include "tests/support/studies.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "libbase/error.hpp"

namespace whirl::studies_test {

using test::along_speed;
using test::around_the_start;
using test::brief;
using test::expect_same;
using test::expect_same_points;
using test::plane;
using test::rotor_stator;
using test::RotorStator;

/// A monitor that stops as soon as something is done.
template <class Result>
Monitor<Result> stopping(std::atomic<bool>& is_stopped) {
  return {.progress = [&](long done, long) { is_stopped = done > 0; },
          .is_stopped = [&] { return is_stopped.load(); }};
}

/// Stops a study, goes on from what it had, and compares with one that was never stopped.
template <class Result, class Options>
void expect_to_go_on(Result (*study)(const StudyModels&, const Options&, const Monitor<Result>&,
                                     Result),
                     const Options& options) {
  std::atomic<bool> is_stopped = false;
  const Result part = study(rotor_stator(), options, stopping<Result>(is_stopped), {});
  const std::size_t done = done_points(part.points);
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, part.points.size());
  long computed = 0;
  const Monitor<Result> watching{.progress = [&](long now, long total) {
    computed = now;
    EXPECT_EQ(total, static_cast<long>(part.points.size() - done));
  }};
  const Result rest = study(rotor_stator(), options, watching, part);
  EXPECT_EQ(computed, static_cast<long>(part.points.size() - done));
  expect_same_points(rest.points, study(rotor_stator(), options, {}, {}).points);
}

// In a map a motion becomes what it becomes alone, bit by bit.
TEST(Map, FindsAtEveryPointWhatItsMotionIsAlone) {
  const MapOptions options = plane(1);
  const MapResult result = map(rotor_stator(), options);
  EXPECT_EQ(result.system.contacts, std::vector<std::string>{"ring"});
  EXPECT_EQ(result.system.states, 8);
  for (const std::size_t point : {0u, 17u, 35u}) {
    const std::vector<double> values = options.grid.values_at(point);
    const RotorStator p{.Omega = values[0], .kC = values[1]};
    const Scene scene = p.scene();
    expect_same(*result.points[point],
                classified(classify(scene.contacts, test::start_of(p.model(), scene), brief)));
  }
}

TEST(Map, IsTheSameInThreads) {
  expect_same_points(map(rotor_stator(), plane(3)).points, map(rotor_stator(), plane(0)).points);
}

TEST(Map, GoesOnWhereItWasStopped) {
  expect_to_go_on(map, plane(1));
}

TEST(Sweep, GoesOnWhereItWasStopped) {
  expect_to_go_on(sweep, along_speed(SweepStart::carried));
  expect_to_go_on(sweep, along_speed(SweepStart::fresh));
}

TEST(Basins, GoesOnWhereItWasStopped) {
  expect_to_go_on(basins, around_the_start());
}

// Afresh every value is a point of a map; carried it begins where the one before has ended, so that
// the first value only is the same.
TEST(Sweep, BeginsEachValueAsAsked) {
  const SweepOptions options = along_speed(SweepStart::fresh);
  const SweepResult fresh = sweep(rotor_stator(), options);
  ASSERT_EQ(fresh.points.size(), 40u);
  const MapResult points =
      map(rotor_stator(), {.grid = {.axes = {options.values}}, .classify = brief});
  for (std::size_t i = 0; i < fresh.points.size(); ++i) {
    expect_same(fresh.points[i]->motion, *points.points[i]);
    EXPECT_EQ(fresh.points[i]->end.displacement.size(), 0);
  }
  const SweepResult carried = sweep(rotor_stator(), along_speed(SweepStart::carried));
  ASSERT_EQ(carried.points.size(), 80u);
  expect_same(carried.points[0]->motion, fresh.points[0]->motion);
  // down begins at the last value, where up has ended
  const FullState top = carried.points[39].value().end;
  StudyMotion again = begin_motion(rotor_stator(), {&options.values[39], 1}, &top);
  classify_together({&again, 1}, brief);
  expect_same(carried.points[79]->motion, classified(again));
}

// A wrong model in the middle ends a study; what was found before is handed over to be saved.
TEST(Map, KeepsWhatIsDoneBeforeAWrongModel) {
  StudyModels models = rotor_stator();
  models.member = [good = models.member](std::span<const double> values) {
    if (values[0] > 135.0) throw ModelError({}, "operation.speed", "too fast");
    return good(values);
  };
  std::size_t saved = 0;
  const Monitor<MapResult> monitor{
      .save = [&](const MapResult& result) { saved = done_points(result.points); }};
  EXPECT_THROW(map(models, plane(0), monitor), ModelError);
  EXPECT_GT(saved, 0u);   // the first pieces: as many points as step together
  EXPECT_LE(saved, 18u);  // of 130 to 135 rad/s
}

// Every point is handed on once, and all of them before the result is saved as a whole.
TEST(Map, HandsOnWhatIsNew) {
  std::vector<int> times(36, 0);
  int savings = 0;
  const Monitor<MapResult> monitor{
      .save =
          [&](const MapResult& result) {
            ++savings;
            EXPECT_EQ(done_points(result.points), result.points.size());
            EXPECT_EQ(times, std::vector<int>(36, 1));
          },
      .add =
          [&](const MapResult& result, std::span<const std::size_t> points) {
            for (const std::size_t point : points) {
              EXPECT_TRUE(result.points[point]);
              ++times[point];
            }
          }};
  map(rotor_stator(), plane(2), monitor);
  EXPECT_EQ(savings, 1);
}

// What cannot be computed fails alone, and says why.
TEST(Map, KeepsGoingWherePointsFail) {
  StudyModels models = rotor_stator();
  models.start = [good = models.start](const StudyMember& member, const FullState* from) {
    if (member.model.speed == 131.0) throw NumericalError("no start");
    return good(member, from);
  };
  const MapResult result = map(models, plane(1));
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const bool fails = i / 3 == 1;
    EXPECT_EQ(result.points[i]->has_failed(), fails) << i;
    EXPECT_EQ(result.points[i]->failure, fails ? "no start" : "") << i;
  }
}

// Above the speeds at which a rotor at rest begins to rub, two motions coexist; every start that
// has settled is in one basin.
TEST(Basins, CountsEveryStartOnce) {
  StudyModels models =
      study_models([](std::span<const double>) { return RotorStator{.Omega = 170.0}.model(); });
  BasinsOptions options = around_the_start();
  options.classify.discard = 200;
  options.classify.revolutions = options.classify.exponents = 50;
  const BasinsResult result = basins(models, options);
  EXPECT_GT(result.basins.size(), 1u);
  std::size_t counted = 0;
  for (std::size_t k = 0; k < result.basins.size(); ++k) {
    counted += result.basins[k].count;
    EXPECT_EQ(result.attractor[result.basins[k].first], static_cast<int>(k));
  }
  const auto open = std::count_if(result.attractor.begin(), result.attractor.end(),
                                  [](int number) { return number < 0; });
  EXPECT_EQ(counted + static_cast<std::size_t>(open), options.starts);
}

}  // namespace whirl::studies_test
