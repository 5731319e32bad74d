// Large studies are drawn coarser, and say so.

#include "libio/figures/drawn_grid.hpp"

#include <gtest/gtest.h>

#include "libdyn/studies/map.hpp"
#include "libdyn/system/model.hpp"
#include "libio/results/call.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::drawn_grid_test {

using figures::drawn_grid, figures::DrawnPoints;
using Steps = std::vector<std::size_t>;

constexpr DrawnPoints few{.of_plane = 100, .of_planes = 400, .values_of_sweep = 10};

TEST(DrawnGrid, IsAllOfASmallStudy) {
  EXPECT_TRUE(drawn_grid({10, 10}, false, few).is_all());
  EXPECT_TRUE(drawn_grid({10, 10, 4}, false, few).is_all());
  EXPECT_TRUE(drawn_grid({2, 10}, true, few).is_all());
  EXPECT_TRUE(drawn_grid({632, 632}, false).is_all());
}

TEST(DrawnGrid, IsCoarserAlongTheLongerAxis) {
  EXPECT_EQ(drawn_grid({10, 11}, false, few).steps, (Steps{1, 2}));
  EXPECT_EQ(drawn_grid({1000, 10}, false, few).steps, (Steps{100, 1}));
  EXPECT_EQ(drawn_grid({1000}, false, few).steps, (Steps{10}));
  EXPECT_EQ(drawn_grid({10, 10, 9}, false, few).steps, (Steps{1, 1, 3}));  // 3 planes of 4 at most
  EXPECT_EQ(drawn_grid({2, 21}, true, few).steps, (Steps{1, 3}));          // both ways
  const CoarseGrid large = drawn_grid({3163, 3163}, false);
  EXPECT_LE(large.points(), 400'000u);
  EXPECT_GE(large.points(), 200'000u);
}

class DrawnStudy : public test::InResultFolder {};

// Of a plane whose exponents say their place, the figure has every second column, each at its
// place, and what says so.
TEST_F(DrawnStudy, IsWhatFiguresShow) {
  constexpr std::size_t side = 640;
  ParameterAxis x{.path = "operation.speed", .unit = "rad/s"},
      y{.path = "gravity", .unit = "m/s^2"};
  for (std::size_t i = 0; i < side; ++i) {
    x.values.push_back(static_cast<double>(i));
    y.values.push_back(static_cast<double>(i));
  }
  MapResult map{.system = {.states = 1}};
  map.points.resize(side * side);
  const auto exponent = [](std::size_t i, std::size_t j) {
    return 1e-3 * static_cast<double>(i) + 1e-6 * static_cast<double>(j);
  };
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      map.points.set(i * side + j, {.kind = MotionKind::chaotic, .exponents = {exponent(i, j)}});
    }
  }
  {
    ResultWriter file(path);
    Model model;
    model.source = "title = \"a rotor\"";
    write_origin(file, {{.verb = "map", .file = "rotor.toml"}, {"whirl", "map"}, "1"}, model);
    write_study(file, {x, y}, map);
    file.commit();
  }
  const ResultView view(path);
  for (const FigureKind& kind : figure_kinds()) {
    if (kind.name != "exponent_map") continue;
    const std::vector<Figure> all = figures_of(kind, view);
    ASSERT_EQ(all.size(), 1u);
    const Cells& cells = all[0].panels.at(0).cells;
    ASSERT_EQ(cells.x.size(), side / 2);
    ASSERT_EQ(cells.y.size(), side);
    for (std::size_t i = 0; i < side / 2; ++i) {
      EXPECT_EQ(cells.x[i], cells.x[1] * static_cast<double>(i));
      for (std::size_t j = 0; j < side; j += 50) {
        ASSERT_EQ(cells.values[j * side / 2 + i], exponent(2 * i, j)) << i << ' ' << j;
      }
    }
    ASSERT_EQ(all[0].notes.size(), 1u);
    EXPECT_EQ(
        all[0].notes[0],
        "A coarser picture, as the study has many points: drawn is every 2nd of 640 values of "
        "operation.speed. Shares are of what is drawn.");
  }
}

}  // namespace whirl::drawn_grid_test
