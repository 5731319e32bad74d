// What a result file says is checked when it is opened: sizes that fit each other, codes that mean
// something. What readers relied on without looking ended the process by a signal.

#include "libio/results/result_schema.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "libio/figures/figures.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::result_schema_test {

using test::problem_of;

constexpr const char* model = "format = 1\n[[body]]\nname = \"rotor\"\nmass = 1\n";

/// Sizes and values of a Campbell diagram and a map, right unless a test says otherwise.
struct Content {
  Eigen::Index rows = 2, speeds = 3;
  std::vector<std::string> whirl{"forward", "backward"};
  std::vector<int> critical_branch{1};
  std::vector<int> motion{0, 1, 4, -1};
  double first_speed = 0.0;
  double samples = 64.0;
  int format = 1;
};

class ResultSchema : public test::InResultFolder {
 protected:
  std::string problem(const Content& c) const {
    {
      ResultWriter file(path, Replaces::anything);
      file.dataset("/model", std::vector<std::string>{model}, {});
      file.attribute("/", "format", c.format);
      Vec speed = Vec::LinSpaced(3, 0.0, 300.0);
      speed(0) = c.first_speed;
      file.dataset("/campbell/speed", speed, {"rad/s", "speed", {}});
      file.dataset("/campbell/branch", std::vector<int>{1, 2}, {});
      file.dataset("/campbell/frequency", Mat(Mat::Ones(c.rows, c.speeds)), {});
      file.dataset("/campbell/log_decrement", Mat(Mat::Ones(2, 3)), {});
      file.dataset("/campbell/whirl", c.whirl, {});
      file.dataset("/campbell/critical_speed", std::vector<double>{10.0}, {});
      file.dataset("/campbell/critical_branch", c.critical_branch, {});
      file.attribute("/trajectory", "samples_per_revolution", c.samples);
      for (const char* name : {"revolutions", "period", "steps", "evaluations", "events"}) {
        file.attribute("/trajectory", name, 1.0);
      }
      file.dataset("/map/motion", c.motion, {2, 2}, {});
      file.dataset("/map/axis_1", std::vector<double>{1.0, 2.0}, {"m", "a", {}});
      file.dataset("/map/axis_2", std::vector<double>{1.0, 2.0}, {"m", "b", {}});
      for (const char* name : {"period", "is_proven", "transient", "revolutions"}) {
        file.dataset(std::string("/map/") + name, std::vector<int>{1, 1, 1, 1}, {2, 2}, {});
      }
      for (const char* name : {"resolution", "section_dimension"}) {
        file.dataset(std::string("/map/") + name, std::vector<double>(4, 0.1), {2, 2}, {});
      }
      file.dataset("/map/exponent", std::vector<double>(8, 0.1), {2, 2, 2}, {});
      file.dataset("/map/regime", std::vector<int>(4, 1), {2, 2, 1}, {});
      for (const char* name :
           {"duty", "impacts_per_rev", "sticking", "max_normal", "max_tangential"}) {
        file.dataset(std::string("/map/") + name, std::vector<double>(4, 0.1), {2, 2, 1}, {});
      }
      file.commit();
    }
    return problem_of([&] { ResultView view(path); });
  }
  std::string found(const Content& c) const {
    const std::string text = problem(c), name = path.string() + ": ";
    return text.starts_with(name) ? text.substr(name.size()) : text;
  }
};

TEST_F(ResultSchema, LetsGoodResultsPass) {
  EXPECT_EQ(problem({}), "none");
}

TEST_F(ResultSchema, RefusesSizesThatDoNotFitAndNamesBothDatasets) {
  const std::string start = "/campbell/frequency is damaged or of another program: dimension ";
  EXPECT_EQ(found({.rows = 1}), start + "1 has 1 elements, /campbell/branch has 2 of them");
  EXPECT_EQ(found({.speeds = 4}), start + "2 has 4 elements, /campbell/speed has 3 of them");
  EXPECT_EQ(found({.whirl = {}}),
            "/campbell/whirl is damaged or of another program: dimension 1 has 0 elements, "
            "/campbell/branch has 2 of them");
}

TEST_F(ResultSchema, RefusesCodesWithoutMeaning) {
  const std::string branch = "/campbell/critical_branch is damaged or of another program: found ";
  for (const int code : {0, -1, 3, 2147483647}) {
    EXPECT_EQ(found({.critical_branch = {code}}),
              branch + std::to_string(code) + ", expected 1 to 2");
  }
  const std::string motion = "/map/motion is damaged or of another program: found ";
  EXPECT_EQ(found({.motion = {0, 0, 6, 0}}), motion + "6, expected -1 to 5");
  EXPECT_EQ(found({.motion = {0, 0, 0, -2}}), motion + "-2, expected -1 to 5");
}

TEST_F(ResultSchema, RefusesNumbersThatAreNone) {
  for (const double bad : {std::nan(""), 0.0, -64.0, double(INFINITY), 1e300}) {
    EXPECT_TRUE(found({.samples = bad})
                    .starts_with("/trajectory@samples_per_revolution is damaged or of another"))
        << bad;
  }
  EXPECT_EQ(
      found({.first_speed = std::nan("")}),
      "/campbell/speed is damaged or of another program: found nan, expected a finite number");
}

TEST_F(ResultSchema, RefusesALaterFormat) {
  EXPECT_NE(problem({.format = 2}).find("has format 2, this whirl reads formats up to 1"),
            std::string::npos);
}

TEST_F(ResultSchema, RefusesHalfASet) {
  {
    ResultWriter file(path, Replaces::anything);
    file.dataset("/model", std::vector<std::string>{model}, {});
    file.dataset("/modes/shape", CMat(CMat::Ones(4, 2)), {});
    file.commit();
  }
  EXPECT_EQ(
      problem_of([&] { open_result(path); }),
      path.string() + ": /modes/shape is damaged or of another program: /modes/number is missing");
}

// Every set begins with an entry that is not optional, no path stands in two of them.
TEST(ResultSchemaTable, NamesEachDatasetOnce) {
  std::vector<std::string_view> paths;
  for (const ResultSet& set : result_schema()) {
    ASSERT_FALSE(set.entries.empty());
    EXPECT_FALSE(set.entries.front().is_optional) << set.entries.front().path;
    for (const ResultEntry& entry : set.entries) {
      EXPECT_EQ(std::count(paths.begin(), paths.end(), entry.path), 0) << entry.path;
      paths.push_back(entry.path);
    }
  }
}

}  // namespace whirl::result_schema_test
