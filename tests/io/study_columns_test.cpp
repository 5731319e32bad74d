// Studies in files: what is computed survives, bit by bit, and what is not is known for it.

#include "libio/results/study_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libdyn/studies/basins.hpp"
#include "libdyn/studies/map.hpp"
#include "libdyn/studies/sweep.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::study_columns_test {

const std::vector<ParameterAxis> axes{
    {.path = "operation.speed", .unit = "rad/s", .values = {1, 2}},
    {.path = "gravity", .unit = "m/s^2", .values = {3, 4, 5}}};

ClassifiedMotion motion() {
  return {.kind = MotionKind::chaotic,
          .transient = 500,
          .revolutions = 1000,
          .resolution = 1.0 / 3.0,
          .section_dimension = 1.9,
          .exponents = {0.1, -0.0},
          .contacts = {{.regime = Regime::intermittent, .duty = 0.25, .max_normal = 7.0}}};
}

MapResult half_a_map() {
  MapResult map{.system = {.contacts = {"ring"}, .states = 2}};
  map.points.resize(6);
  map.points.set(4, motion());
  map.points.set(2, {.failure = "it left its bearing"});
  return map;
}

class StudyColumns : public test::InResultFolder {
 protected:
  template <class Result>
  ResultReader saved(const Result& result, const std::vector<ParameterAxis>& parameters) const {
    ResultWriter file(folder / "study.h5", Replaces::anything);
    write_study(file, parameters, result);
    file.commit();
    return ResultReader(folder / "study.h5");
  }
};

TEST_F(StudyColumns, KnowWhatIsDone) {
  const ResultReader file = saved(half_a_map(), axes);
  EXPECT_EQ(file.number_attribute("/map", "complete"), 0.0);
  EXPECT_EQ(file.shape("/map/exponent"), (std::vector<Eigen::Index>{2, 3, 2}));
  EXPECT_EQ(file.axes("/map/regime"),
            (std::vector<std::string>{"/map/axis_1", "/map/axis_2", "/map/contact"}));
  EXPECT_EQ(file.integers("/map/motion"), (std::vector<int>{-1, -1, -1, -1, 3, -1}));
  EXPECT_EQ(file.integers("/map/done"), (std::vector<int>{0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(file.integers("/map/is_proven"), (std::vector<int>{-1, -1, -1, -1, 0, -1}));
  EXPECT_TRUE(std::isnan(file.numbers("/map/duty")[2]));
  EXPECT_EQ(file.string_attribute("/map/regime", words_attribute), "none,intermittent,permanent");

  const auto again = read_study<MapResult>(file, 6);
  EXPECT_EQ(done_points(again.points), 2u);
  EXPECT_TRUE(again.points[2]->has_failed());
  EXPECT_TRUE(again.points[2]->exponents.empty());
  const ClassifiedMotion chaos = again.points[4].value();
  EXPECT_EQ(chaos.kind, MotionKind::chaotic);
  EXPECT_EQ(chaos.revolutions, 1000);
  EXPECT_EQ(chaos.resolution, 1.0 / 3.0);
  ASSERT_EQ(chaos.exponents.size(), 2u);
  EXPECT_TRUE(std::signbit(chaos.exponents[1]));
  ASSERT_EQ(chaos.contacts.size(), 1u);
  EXPECT_EQ(chaos.contacts[0].regime, Regime::intermittent);
  EXPECT_EQ(chaos.contacts[0].max_normal, 7.0);
}

TEST_F(StudyColumns, AreWholeWhenAllIsDone) {
  MapResult map = half_a_map();
  for (std::size_t i = 0; i < map.points.size(); ++i) map.points.set(i, motion());
  const ResultReader file = saved(map, axes);
  EXPECT_EQ(file.number_attribute("/map", "complete"), 1.0);
  EXPECT_FALSE(file.has("/map/done"));
  EXPECT_EQ(done_points(read_study<MapResult>(file, 6).points), 6u);
}

// Rows in blocks of any size, from memory or from the disk, make the same file.
TEST_F(StudyColumns, AreTheSameInBlocks) {
  const MapResult map = half_a_map();
  MapResult on_disk = half_a_map();
  on_disk.points = PointRows<ClassifiedMotion>(RowStore(6, {.block = 1, .in_memory = 0}));
  on_disk.points.overflow_into(folder);
  for (const std::size_t i : {4ul, 2ul}) on_disk.points.set(i, map.points[i].value());
  const ResultReader whole = saved(map, axes);
  for (const std::size_t numbers : {1ul, 70ul, 90ul}) {  // of one, some points
    const std::filesystem::path place = folder / "blocks.h5";
    {
      ResultWriter file(place, Replaces::anything);
      write_study(file, axes, on_disk, numbers);
      file.commit();
    }
    const ResultReader blocks(place);
    EXPECT_EQ(blocks.list("/map"), whole.list("/map"));
    for (const std::string& name : whole.list("/map")) {
      const std::string dataset = "/map/" + name;
      EXPECT_EQ(blocks.kind(dataset), whole.kind(dataset)) << name;
      EXPECT_EQ(blocks.shape(dataset), whole.shape(dataset)) << name;
      EXPECT_EQ(blocks.axes(dataset), whole.axes(dataset)) << name;
      if (whole.kind(dataset) == ObjectKind::text) continue;
      EXPECT_EQ(packed(blocks.numbers(dataset)), packed(whole.numbers(dataset))) << name;
    }
    PointRows<ClassifiedMotion> again(6);
    const auto take = [&](std::size_t i, const ClassifiedMotion& m) { again.set(i, m); };
    each_stored_row<MapResult>(blocks, 6, take, {.most_numbers = numbers});
    const auto known = read_study<MapResult>(whole, 6);
    for (std::size_t i = 0; i < 6; ++i) {
      ASSERT_EQ(again.has(i), known.points.has(i)) << i;
      if (!again.has(i)) continue;
      EXPECT_EQ(again.bytes(i), known.points.bytes(i)) << i;
    }
  }
}

// Every second value along an axis: what is along the points goes with them.
TEST_F(StudyColumns, AreReadCoarser) {
  const CoarseGrid grid{{2, 3}, {1, 2}};
  EXPECT_EQ(grid.points(), 4u);
  std::vector<std::size_t> had;
  for (std::size_t i = 0; i < 6; ++i) {
    if (!grid.has(i)) continue;
    EXPECT_EQ(grid.number_of(i), had.size());
    had.push_back(i);
  }
  EXPECT_EQ(had, (std::vector<std::size_t>{0, 2, 3, 5}));

  BasinsResult basins{.system = {.states = 1, .dofs = 1}, .sections = 1};
  basins.points.resize(6);
  for (int i = 0; i < 6; ++i) {
    basins.points.set(static_cast<std::size_t>(i),
                      {.motion = {.kind = MotionKind::periodic, .period = i, .exponents = {0.0}},
                       .start = {Vec::Ones(1), Vec::Zero(1)},
                       .sections = {1.0}});
    basins.attractor.push_back(10 * i);
  }
  const auto coarse = stored_study<BasinsResult>(saved(basins, axes), grid);
  ASSERT_EQ(coarse.points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(coarse.points[i]->motion.period, static_cast<int>(had[i]));
    EXPECT_EQ(coarse.attractor[i], 10 * static_cast<int>(had[i]));
  }
}

TEST_F(StudyColumns, RefuseAnotherNumberOfPoints) {
  EXPECT_THROW(read_study<MapResult>(saved(half_a_map(), axes), 5), FileError);
}

// What studies have got since a file was begun stays unknown; what they had may not be missing.
TEST_F(StudyColumns, GoOnWithAFileFromBeforeAColumn) {
  const auto without = [&](const std::string& key) {
    ResultWriter file(folder / "before.h5", Replaces::anything);
    study_columns::StudyWriter to(file, "/map", {{"exponents", 2}, {"contacts", 1}});
    to.write_parameters(axes, "");
    for (const auto& c : study_columns::point_columns<ClassifiedMotion>()) {
      if (c.facts.name == key) continue;
      to.write_points(c.facts, std::vector<double>(6 * to.width(c.facts), 1.0));
    }
    to.write_done(6, [](std::size_t) { return true; });
    file.commit();
    return ResultReader(folder / "before.h5");
  };
  const auto known = read_study<MapResult>(without("settles_after"), 6);
  EXPECT_EQ(known.points[5]->period, 1);
  EXPECT_EQ(known.points[5]->settles_after, 0);
  EXPECT_THROW(read_study<MapResult>(without("period"), 6), FileError);
}

// Files say what their codes mean: another order of the words is another code, and a word that is
// unknown is not taken for a known one.
TEST_F(StudyColumns, CodesAreThoseOfTheirWords) {
  const auto kinds = [&](const std::string& words) {
    ResultWriter file(folder / "words.h5", Replaces::anything);
    file.dataset("/map/motion", std::vector<int>{0, 1, 2, -1}, {"", "kind", {""}});
    if (!words.empty()) file.attribute("/map/motion", words_attribute, words);
    file.commit();
    std::vector<std::optional<MotionKind>> found;
    for (const auto& p : stored_study<MapResult>(ResultReader(folder / "words.h5")).points) {
      found.push_back(p ? p->kind : std::nullopt);
    }
    return found;
  };
  using enum MotionKind;
  using Kinds = std::vector<std::optional<MotionKind>>;
  EXPECT_EQ(kinds("chaotic,of another kind,not settled"),
            (Kinds{chaotic, std::nullopt, not_settled, std::nullopt}));
  EXPECT_EQ(kinds(""), (Kinds{equilibrium, periodic, quasi_periodic, std::nullopt}));
}

// What is read to be shown knows its points and what they are of; what a file is without is as in a
// new row.
TEST_F(StudyColumns, AreReadToBeShown) {
  const MapResult map = stored_study<MapResult>(saved(half_a_map(), axes));
  ASSERT_EQ(map.points.size(), 6u);
  EXPECT_FALSE(map.points[0]);
  EXPECT_EQ(map.points[4]->period, 0);
  EXPECT_EQ(map.points[4]->largest_exponent(), 0.1);
  EXPECT_EQ(map.system.contacts, std::vector<std::string>{"ring"});
  const auto parameters = stored_parameters(ResultReader(folder / "study.h5"), MapResult::group);
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[1].path, axes[1].path);
  EXPECT_EQ(parameters[1].values, axes[1].values);
  EXPECT_EQ(point_dataset<MapResult>("exponent"), "/map/exponent");
  EXPECT_EQ(point_dataset<MapResult>("exponents"), "");
}

TEST_F(StudyColumns, KeepPortraits) {
  SweepResult sweep{.system = {.contacts = {"ring"}, .states = 2, .dofs = 3},
                    .stations = {"1 left", "2"},
                    .sections = 4,
                    .spectrum_revolutions = 1};
  sweep.points.resize(4);
  SweepPoint point;
  point.motion = motion();
  point.end = {Vec::LinSpaced(3, 0.0, 1.0), Vec::Zero(3)};
  point.portrait = {.poincare_x = Mat::Random(2, 4),
                    .poincare_y = Mat::Random(2, 4),
                    .max_radius = Vec::Random(2),
                    .spectrum = Mat::Random(2, 17),
                    .contact_angle = Mat::Random(1, 36)};
  sweep.points.set(3, point);
  const ResultReader file = saved(sweep, {axes[0]});
  EXPECT_EQ(file.strings("/sweep/direction"), (std::vector<std::string>{"up", "down"}));
  EXPECT_EQ(file.shape("/sweep/spectrum"), (std::vector<Eigen::Index>{2, 2, 2, 17}));
  const auto again = read_study<SweepResult>(file, 4);
  ASSERT_EQ(done_points(again.points), 1u);
  EXPECT_EQ(again.points[3]->portrait.poincare_x, point.portrait.poincare_x);
  EXPECT_EQ(again.points[3]->portrait.spectrum, point.portrait.spectrum);
  EXPECT_EQ(again.points[3]->portrait.contact_angle, point.portrait.contact_angle);
  EXPECT_EQ(again.points[3]->end.displacement, point.end.displacement);

  sweep.spectrum_revolutions = 0;
  const ResultReader brief = saved(sweep, {axes[0]});
  for (const char* name : {"spectrum", "order", "sector", "contact_angle", "max_radius"}) {
    EXPECT_FALSE(brief.has(std::string("/sweep/") + name)) << name;
  }
}

// Random starts are numbered; attractors are there once all starts are.
TEST_F(StudyColumns, NumberRandomStarts) {
  BasinsResult basins{.system = {.states = 2, .dofs = 3}, .is_random = true, .sections = 1};
  basins.points.resize(2);
  EXPECT_FALSE(saved(basins, {}).has("/basins/attractor"));
  for (std::size_t i = 0; i < basins.points.size(); ++i) {
    basins.points.set(i, {.motion = {.kind = MotionKind::periodic, .exponents = {0.0, -1.0}},
                          .start = {Vec::Ones(3), Vec::Zero(3)},
                          .sections = {1.0, 2.0}});
  }
  basins.attractor = {0, 0};
  const ResultReader file = saved(basins, {});
  EXPECT_EQ(file.integers("/basins/start"), (std::vector<int>{1, 2}));
  EXPECT_EQ(file.axes("/basins/attractor"), std::vector<std::string>{"/basins/start"});
  EXPECT_EQ(read_study<BasinsResult>(file, 2).points[1]->sections, (std::vector<double>{1.0, 2.0}));
}

}  // namespace whirl::study_columns_test
