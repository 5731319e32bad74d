// Tables of studies: what is computed survives a file, bit by bit.

#include "libio/results/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/io/result_folder.hpp"

namespace whirl::checkpoint_test {

class Checkpoint : public test::InResultFolder {
 protected:
  static PointTable table() {
    return {"/study",
            {{"kind", "", "kind", true}, {"value", "m", "values", false, {2}}},
            {2, 3},
            {"/study/a", "/study/b"}};
  }
  void save(const PointTable& t, const std::string& name) const {
    ResultWriter file(folder / name, Replaces::anything);
    file.dataset("/study/a", Vec(Vec::LinSpaced(2, 0.0, 1.0)), {"", "a", {""}});
    file.dataset("/study/b", Vec(Vec::LinSpaced(3, 0.0, 1.0)), {"", "b", {""}});
    t.write(file);
    file.commit();
  }
};

TEST_F(Checkpoint, KnowsWhatIsDone) {
  PointTable t = table();
  ASSERT_EQ(t.points(), 6u);
  EXPECT_EQ(t.done(), 0u);
  t.put(4, {{7.0}, {1.0 / 3.0, -0.0}});
  EXPECT_TRUE(t.is_done(4));
  save(t, "half.h5");
  const ResultReader half(folder / "half.h5");
  EXPECT_EQ(half.number_attribute("/study", "complete"), 0.0);
  EXPECT_EQ(half.shape("/study/value"), (std::vector<Eigen::Index>{2, 3, 2}));

  PointTable again = table();
  again.read(half);
  EXPECT_EQ(again.done(), 1u);
  EXPECT_EQ(again.number("kind", 4), 7.0);
  EXPECT_EQ(again.at("value", 4)[0], 1.0 / 3.0);
  EXPECT_TRUE(std::signbit(again.at("value", 4)[1]));
  EXPECT_EQ(again.number("kind", 3), -1.0);
  EXPECT_TRUE(std::isnan(again.at("value", 3)[0]));
}

// What a table has got since a file was begun stays unknown; what it had may not be missing.
TEST_F(Checkpoint, GoesOnWithAFileFromBeforeAColumn) {
  const auto with = [](bool may_lack) {
    PointColumn later{"later", "", "a later column", true};
    later.may_lack = may_lack;
    return PointTable("/study",
                      {{"kind", "", "kind", true}, {"value", "m", "values", false, {2}}, later},
                      {2, 3}, {"/study/a", "/study/b"});
  };
  PointTable t = table();
  t.put(4, {{7.0}, {1.0, 2.0}});
  save(t, "before.h5");
  PointTable longer = with(true), strict = with(false);
  longer.read(ResultReader(folder / "before.h5"));
  EXPECT_EQ(longer.number("kind", 4), 7.0);
  EXPECT_EQ(longer.number("later", 4), -1.0);
  EXPECT_THROW(strict.read(ResultReader(folder / "before.h5")), FileError);
}

// Short rows leave the rest unknown; a whole table needs no flags.
TEST_F(Checkpoint, IsWholeWhenAllIsDone) {
  PointTable t = table();
  for (std::size_t i = 0; i < t.points(); ++i) t.put(i, {{-1.0}});
  save(t, "whole.h5");
  const ResultReader whole(folder / "whole.h5");
  EXPECT_EQ(whole.number_attribute("/study", "complete"), 1.0);
  EXPECT_FALSE(whole.has("/study/done"));
  PointTable again = table();
  again.read(whole);
  EXPECT_EQ(again.done(), 6u);
  EXPECT_TRUE(std::isnan(again.at("value", 5)[1]));
}

TEST_F(Checkpoint, RefusesAnotherShape) {
  save(table(), "six.h5");
  PointTable other("/study", {{"kind", "", "kind", true}}, {4}, {"/study/a"});
  EXPECT_THROW(other.read(ResultReader(folder / "six.h5")), FileError);
}

}  // namespace whirl::checkpoint_test
