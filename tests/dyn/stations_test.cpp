// Names of points: what is asked for is found, what is not there is refused with what is.

#include "libdyn/system/stations.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "tests/support/scenes.hpp"

namespace whirl::stations_test {

/// Two disks, bearings at the ends, a ring at the left disk, and a stator.
Model model() {
  Model m = test::TwoDiskRub{.contact_nodes = {4}}.model();
  m.structure.disks[0].name = "left disk";
  m.structure.disks[1].name = "right disk";
  m.structure.bearings[0].name = "front";
  m.structure.bearings[1].name = "rear";
  m.structure.bodies = {{.name = "stator", .m = 10.0}};
  m.structure.bearings.push_back(test::bearing(test::body("stator"), test::isotropic(1e6)));
  m.structure.bearings[2].name = "mount";
  return m;
}

std::vector<std::string> names(const std::string& list) {
  const Model m = model();
  std::vector<std::string> all;
  for (const NamedPoint& p : select_points(m, Assembler(m.structure), list)) {
    all.push_back(p.name.empty() ? std::to_string(p.node()) : p.name);
  }
  return all;
}

using Names = std::vector<std::string>;

TEST(Stations, HaveTheNamesOfWhatIsThere) {
  const Model m = model();
  const std::vector<NamedPoint> all = named_points(m, Assembler(m.structure));
  ASSERT_EQ(all.size(), 14u);  // 13 nodes from left to right, then the body
  EXPECT_EQ(all[0].name, "front");
  EXPECT_EQ(all[3].name, "left disk + ring");
  EXPECT_EQ(all[3].node(), 4);
  EXPECT_EQ(all[6].name, "");
  EXPECT_EQ(all[13].name, "stator");
  EXPECT_EQ(all[13].node(), 0);
}

TEST(Stations, LeftOutAreContactsDisksBearingsAndBodies) {
  EXPECT_EQ(names(""), (Names{"front", "left disk + ring", "right disk", "rear", "stator"}));
}

TEST(Stations, AreSelectedByNameNumberAndAll) {
  EXPECT_EQ(names("all").size(), 14u);
  EXPECT_EQ(names("right disk"), (Names{"right disk"}));
  EXPECT_EQ(names("ring"), (Names{"left disk + ring"}));
  EXPECT_EQ(names("7,stator"), (Names{"7", "stator"}));
  EXPECT_EQ(names("rear,1"), (Names{"rear", "front"}));               // in the order asked for
  EXPECT_EQ(names("ring,left disk,4"), (Names{"left disk + ring"}));  // one point once
}

TEST(Stations, ThatAreNotThereAreRefused) {
  for (const char* wrong : {"sael", "14", "0", "-1", "7x", "front,,rear"}) {
    try {
      names(wrong);
      ADD_FAILURE() << wrong;
    } catch (const OptionError& error) {
      EXPECT_EQ(error.option(), "stations");
      EXPECT_NE(std::string(error.what()).find("left disk"), std::string::npos) << error.what();
    }
  }
}

}  // namespace whirl::stations_test
