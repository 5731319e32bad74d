// Disks given by mass and inertia have no size: every picture draws a symbol and says so.

#include <map>

#include "tests/cli/plots.hpp"

namespace whirl::test {
namespace disk_symbols_test {

using plot_test::figures_in;
using plot_test::named;
using plot_test::panel_of;

const std::string rotor = R"(format = 1
[operation]
speed = "1000 rpm"
[material.steel]
density = 7800
youngs_modulus = "200 GPa"
poisson_ratio = 0.3
[[shaft]]
material = "steel"
length = 1
outer_diameter = "100 mm"
elements = 4
[[disk]]
name = "wheel"
at = 0.5
mass = 50
polar_inertia = 2
diametral_inertia = 1.5
SIZE
[[bearing]]
at = 0
stiffness = 1e7
damping = 500
[[bearing]]
at = 1
stiffness = 1e7
damping = 500
)";

class DiskSymbols : public plot_test::Plot {
 protected:
  /// Modes of the rotor with a size of its disk, or without.
  void make_modes(const std::string& size) const {
    std::string text = rotor;
    text.replace(text.find("SIZE"), 4, size);
    write("rotor.toml", text);
    make({"modes", "rotor.toml"}, "m.h5");
  }
};

const std::string told = "disk, size not given (not to scale)";

// In the layout and behind mode shapes it is a broken line, named in the legend. With a size it is
// the area that it takes.
TEST_F(DiskSymbols, FiguresDrawABrokenLineAndNameIt) {
  make_modes("");
  const ResultView view(folder / "m.h5");
  for (const auto& [kind, number] : {std::pair{"layout", 0u}, std::pair{"modes", 1u}}) {
    SCOPED_TRACE(kind);
    const Panel p = figures_in(kind, view).at(number).panels.at(0);
    const auto symbols = named(p, told);
    ASSERT_FALSE(symbols.empty());
    for (const Curve& c : symbols) {
      EXPECT_EQ(c.dash, Dash::dashed);
      EXPECT_EQ(c.fill, 0.0);
      for (const double z : c.x) EXPECT_NEAR(z, 500.0, 1e-9);
    }
    EXPECT_TRUE(named(p, "disk").empty());
  }
  ASSERT_EQ(whirl({"plot", "m.h5", "layout", "--out", "l.svg"}).status, 0);
  EXPECT_TRUE(has(content(folder / "l.svg"), told));
  EXPECT_FALSE(has(content(folder / "l.svg"), "Layout, to scale"));

  make_modes("outer_diameter = \"600 mm\"\nwidth = \"80 mm\"");
  const ResultView sized(folder / "m.h5");
  const Panel p = figures_in("layout", sized).at(0).panels.at(0);
  EXPECT_TRUE(named(p, told).empty());
  const Curve disk = named(p, "disk").at(0);
  EXPECT_NEAR(largest_of(disk.y), 300.0, 1e-9);
  EXPECT_NEAR(largest_of(disk.x), 540.0, 1e-9);
}

// A symbol says the inertia by its height above the shaft: from 1.5 % of the length without any to
// 6 % of the largest, whatever the mass is.
TEST_F(DiskSymbols, TheirHeightSaysTheInertia) {
  const auto more = [](const char* at, const char* Ip) {
    return std::string("[[disk]]\nat = ") + at + "\nmass = 50\npolar_inertia = " + Ip +
           "\ndiametral_inertia = 1.5\n";
  };
  make_modes(more("0.25", "1") + more("0.75", "0"));
  const auto symbols = named(panel_of("layout", ResultView(folder / "m.h5")), told);
  const std::map<double, double> height{{500.0, 60.0}, {250.0, 37.5}, {750.0, 15.0}};  // [mm]
  ASSERT_EQ(symbols.size(), 6u);
  for (const Curve& c : symbols) EXPECT_NEAR(largest_of(c.y), 50.0 + height.at(c.x[0]), 1e-9);
}

// The page's picture in space is told which disks are symbols, and what to say of them.
TEST_F(DiskSymbols, ThePageKnowsThem) {
  make_modes("");
  ASSERT_EQ(whirl({"report", "m.h5"}).status, 0);
  const json motion = page_data(content(folder / "m.html"))["results"][0]["motion"];
  EXPECT_EQ(motion["disks"][0]["not_given"], "size");
  EXPECT_LT(motion["disks"][0]["width"], 0.01);
  EXPECT_TRUE(has(motion["symbols"], "the size of wheel"));
  EXPECT_TRUE(has(content(folder / "m.html"), "this.data.symbols"));

  make_modes("outer_diameter = \"600 mm\"\nwidth = \"80 mm\"");
  ASSERT_EQ(whirl({"report", "m.h5"}).status, 0);
  const json sized = page_data(content(folder / "m.html"))["results"][0]["motion"];
  EXPECT_FALSE(sized["disks"][0].contains("not_given"));
  EXPECT_FALSE(sized.contains("symbols"));
}

// Series for ParaView say it, and a surface for other programs has no size that nobody gave.
TEST_F(DiskSymbols, ExportsNameThem) {
  make_modes("");
  const Outcome series = whirl({"export", "rotor.toml", "--out", "p"});
  EXPECT_EQ(series.status, 0) << series.err;
  EXPECT_TRUE(has(series.out, "not to scale, as the model does not give the size of wheel"));
  const bool has_meshio = wait(start("sh", {"-c", "command -v meshio"})).status == 0;
  if (!has_meshio) GTEST_SKIP() << "there is no meshio (Debian package meshio-tools)";
  const Outcome surface = whirl({"export", "rotor.toml", "--format", "stl", "--out", "p"});
  EXPECT_EQ(surface.status, 0) << surface.err;
  EXPECT_TRUE(has(surface.out + surface.err, "\"wheel\" is left out"));
}

}  // namespace disk_symbols_test
}  // namespace whirl::test
