// A result states its members once: what is written comes back, and file, JSON and schema agree.

#include "libio/results/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/io/result_folder.hpp"

namespace whirl::columns_test {

enum class Color { red, blue };
constexpr auto choices(Color) {
  return std::array{Choice<Color>{"red", Color::red}, Choice<Color>{"blue", Color::blue}};
}

struct Row {
  double speed = 0.0;
  Color color = Color::red;
  int partner = 0;
  Complex value;
  std::vector<double> over;
  std::string note;

  double twice() const { return 2.0 * speed; }

  static constexpr auto columns() {
    return ColumnList{column("speed", &Row::speed, "rad/s", "a speed").within(valid::nonnegative),
                      column("color", &Row::color, "", "a choice"),
                      column("partner", &Row::partner, "", "number of a row").from_one(),
                      column("value", &Row::value, "m", "a complex number"),
                      column("over", &Row::over, "N", "over places").along("places"),
                      column("twice", &Row::twice, "rad/s", "a function of others"),
                      column("note", &Row::note, "", "only here").only(Written::in_json).maybe()};
  }
};

struct Result {
  double share = 0.0;
  std::string title;
  Vec places;
  std::vector<Row> rows_of_it;
  Mat square;
  std::vector<double> extra;

  static constexpr std::string_view group = "/thing";
  static constexpr auto columns() {
    return ColumnList{
        column("place", &Result::places, "m", "places").axis("places+"),
        column("share", &Result::share, "", "a number"),
        column("title", &Result::title, "", "a text"),
        rows(&Result::rows_of_it, "items").numbered("item", "items"),
        column("square", &Result::square, "N.m", "a matrix").along("items places"),
        column("extra", &Result::extra, "m/s", "may be missing").along("extras").maybe()};
  }
};

Result example() {
  Result r{.share = 0.25, .title = "a thing", .places = Vec::LinSpaced(3, 0.0, 2.0)};
  r.rows_of_it = {{1.5, Color::blue, 1, {1.0, -2.0}, {1.0, 2.0, 3.0}, "why"},
                  {2.5, Color::red, 0, {0.0, 4.0}, {4.0, 5.0, nan}, ""}};
  r.square = (Mat(2, 3) << 1, 2, 3, 4, 5, 6).finished();
  return r;
}

class Columns : public test::InResultFolder {
 protected:
  void write(const Result& r) const {
    ResultWriter file(path, Replaces::anything);
    write_result(file, r);
    file.commit();
  }
};

TEST_F(Columns, BringBackWhatWasWritten) {
  const Result before = example();
  write(before);
  const ResultReader file(path);
  const auto after = read_result<Result>(file);
  EXPECT_EQ(after.share, before.share);
  EXPECT_EQ(after.title, before.title);
  EXPECT_EQ(after.places, before.places);
  EXPECT_EQ(after.square, before.square);
  EXPECT_TRUE(after.extra.empty());
  ASSERT_EQ(after.rows_of_it.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Row &a = after.rows_of_it[i], &b = before.rows_of_it[i];
    EXPECT_EQ(a.speed, b.speed);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.partner, b.partner);
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(a.over[0], b.over[0]);
    EXPECT_EQ(std::isnan(a.over[2]), std::isnan(b.over[2]));
    EXPECT_EQ(a.note, "");  // is in no file
  }
}

TEST_F(Columns, WriteDatasetsWithTheirAxes) {
  write(example());
  const ResultReader file(path);
  EXPECT_EQ(file.axes("/thing/speed"), std::vector<std::string>{"/thing/item"});
  EXPECT_EQ(file.axes("/thing/over"), (std::vector<std::string>{"/thing/item", "/thing/place"}));
  EXPECT_EQ(file.axes("/thing/square"), (std::vector<std::string>{"/thing/item", "/thing/place"}));
  EXPECT_EQ(file.integers("/thing/item"), (std::vector<int>{1, 2}));
  EXPECT_EQ(file.integers("/thing/partner"), (std::vector<int>{2, 1}));
  EXPECT_EQ(file.strings("/thing/color"), (std::vector<std::string>{"blue", "red"}));
  EXPECT_EQ(file.vector("/thing/twice")(1), 5.0);
  EXPECT_FALSE(file.has("/thing/extra"));
  EXPECT_FALSE(file.has("/thing/note"));
}

// Of an empty list the datasets are there with the sizes of their other dimensions.
// A row that knows nothing of a column leaves the others at their places.
TEST_F(Columns, RowsThatKnowNothingKeepTheirPlace) {
  Result r = example();
  r.rows_of_it[0].over.clear();
  write(r);
  const auto after = read_result<Result>(ResultReader(path));
  ASSERT_EQ(after.rows_of_it.size(), 2u);
  for (const double unknown : after.rows_of_it[0].over) EXPECT_TRUE(std::isnan(unknown));
  EXPECT_EQ(after.rows_of_it[1].over[0], 4.0);
  EXPECT_EQ(after.rows_of_it[1].over[1], 5.0);
}

TEST_F(Columns, WriteEmptyRows) {
  Result r = example();
  r.rows_of_it.clear();
  r.square.resize(0, 3);
  write(r);
  const ResultReader file(path);
  EXPECT_EQ(file.shape("/thing/over"), (std::vector<Eigen::Index>{0, 3}));
  EXPECT_TRUE(read_result<Result>(file).rows_of_it.empty());
}

TEST(ColumnsInJson, HaveUnitsInTheirKeysAndSpeedsInRpm) {
  Result r = example();
  r.rows_of_it[0].speed = 2.0 * rpm;
  const std::string json = record_of(r).json();
  EXPECT_NE(json.find("\"speed_rpm\": 2"), std::string::npos) << json;
  EXPECT_NE(json.find("\"square_n_m\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"number\": 1"), std::string::npos) << json;
  EXPECT_NE(json.find("\"partner\": 2"), std::string::npos) << json;
  EXPECT_EQ(json.find("\"note\": \"\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"note\": \"why\""), std::string::npos) << json;
}

TEST(ColumnsInSchema, StateKindsSizesAndWhatMayBeMissing) {
  const std::vector<ResultSet> sets = schema_of<Result>();
  ASSERT_EQ(sets.size(), 2u);
  const auto entry = [&](const std::string& path) {
    for (const ResultSet& set : sets) {
      for (const ResultEntry& e : set.entries) {
        if (e.path == path) return e;
      }
    }
    ADD_FAILURE() << path;
    return ResultEntry{};
  };
  EXPECT_EQ(sets[0].entries[0].path, "/thing/place");
  EXPECT_EQ(entry("/thing/over").sizes, "items places");
  EXPECT_EQ(entry("/thing/over").unit, "N");
  EXPECT_EQ(entry("/thing/value").kind, ObjectKind::complex);
  EXPECT_EQ(entry("/thing/color").kind, ObjectKind::text);
  EXPECT_EQ(entry("/thing@share").kind, ObjectKind::real);
  EXPECT_EQ(entry("/thing/item").values.counts, "items");
  EXPECT_EQ(sets[1].entries[0].path, "/thing/extra");
  EXPECT_EQ(sets[1].needs, std::vector<std::string>{"/thing/place"});
}

struct Place {
  double value = 0.0;
  std::string reason;
  int partner = 0;
  std::vector<double> over;

  static constexpr auto columns() {
    return ColumnList{column("value", &Place::value, unit_of_parameter, "the parameter's").axis(),
                      column("reason", &Place::reason, "", "a text"),
                      column("partner", &Place::partner, "", "a number"),
                      column("over", &Place::over, "N", "over names").along("names").maybe()};
  }
};

struct Walk {
  ParameterName parameter;
  std::optional<int> count;
  std::vector<std::string> names;
  std::vector<Place> places;

  static constexpr std::string_view group = "/walk";
  static auto& parameter_of(auto& result, std::string_view) { return result.parameter; }
  static constexpr auto columns() {
    return ColumnList{column("count", &Walk::count, "", "may be nothing").maybe(),
                      column("name", &Walk::names, "", "names").axis("names+").maybe(),
                      rows(&Walk::places, "places")};
  }
};

TEST_F(Columns, NameParametersThatOnlyACallKnows) {
  ResultWriter out(path, Replaces::anything);
  write_result(out, Walk{{"operation.speed", "rad/s"}, {}, {}, {{2.0, "", 0, {}}}});
  out.commit();
  const ResultReader file(path);
  EXPECT_EQ(file.string_attribute("/walk/value", "units"), "rad/s");
  EXPECT_EQ(file.string_attribute("/walk/value", "long_name"), "operation.speed");
  EXPECT_FALSE(file.has_attribute("/walk", "count"));
  EXPECT_FALSE(file.has("/walk/over"));
  const auto after = read_result<Walk>(file);
  EXPECT_EQ(after.parameter.path, "operation.speed");
  EXPECT_EQ(after.parameter.unit, "rad/s");
  EXPECT_FALSE(after.count);
}

TEST_F(Columns, BringBackAnOptionalNumber) {
  ResultWriter out(path, Replaces::anything);
  write_result(out, Walk{{}, 3, {"a"}, {{2.0, "", 0, {5.0}}}});
  out.commit();
  const auto after = read_result<Walk>(ResultReader(path));
  EXPECT_EQ(after.count, 3);
  EXPECT_EQ(after.places.at(0).over, std::vector<double>{5.0});
}

TEST(ColumnsInJson, LeaveOutANumberThatIsNothing) {
  EXPECT_EQ(record_of(Walk{}).json().find("count"), std::string::npos);
  EXPECT_NE(record_of(Walk{{}, 3, {}, {}}).json().find("\"count\": 3"), std::string::npos);
  const std::string json = record_of(Walk{{}, {}, {}, {{2.0, "", 0, {}}}}).json();
  EXPECT_NE(json.find("\"value\": 2"), std::string::npos) << json;  // without a unit in its key
}

// What rows may lack asks for the names that it goes along.
TEST(ColumnsInSchema, LetRowsLackWhatGoesAlongAMissingAxis) {
  const std::vector<ResultSet> sets = schema_of<Walk>();
  ASSERT_EQ(sets.size(), 3u);
  EXPECT_EQ(sets[2].entries.at(0).path, "/walk/over");
  EXPECT_EQ(sets[2].entries.at(0).sizes, "places names");
  EXPECT_NE(std::ranges::find(sets[2].needs, "/walk/name"), sets[2].needs.end());
}

}  // namespace whirl::columns_test
