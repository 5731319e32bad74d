#include "libio/text/nearest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace whirl::nearest_test {

const std::vector<std::string> keys = {"friction", "stiffness", "damping", "clearance", "at"};

TEST(Nearest, FindsWhatWasMeant) {
  EXPECT_EQ(nearest("frictoin", keys), "friction");
  EXPECT_EQ(nearest("Friction", keys), "friction");
  EXPECT_EQ(nearest("stifness", keys), "stiffness");
  EXPECT_EQ(nearest("clearence", keys), "clearance");
  EXPECT_EQ(nearest("dampings", keys), "damping");
  EXPECT_EQ(nearest("att", keys), "at");
}

TEST(Nearest, TakesAPartForTheWhole) {
  const std::vector<std::string> parts{"outer_diameter", "inner_diameter", "polar_inertia"};
  EXPECT_EQ(nearest("diameter", parts), "outer_diameter");
  EXPECT_EQ(nearest("inner", parts), "inner_diameter");
  EXPECT_EQ(nearest("inertia", parts), "polar_inertia");
  EXPECT_EQ(nearest("iner", parts), std::nullopt);
  EXPECT_EQ(nearest("meter", parts), std::nullopt);
}

TEST(Nearest, DoesNotGuessWildly) {
  EXPECT_EQ(nearest("viscosity", keys), std::nullopt);
  EXPECT_EQ(nearest("", keys), std::nullopt);
  EXPECT_EQ(nearest("x", keys), std::nullopt);
  EXPECT_EQ(nearest("friction", {}), std::nullopt);
  EXPECT_EQ(nearest(std::string(1'000'000, 'x'), keys), std::nullopt);
}

TEST(UnknownOption, IsNamedWithTheOneThatWasMeant) {
  const std::vector<std::string> known{"--speed", "--out"};
  const auto told = [&](const std::vector<std::string>& words) {
    return unknown_option(words, known);
  };
  EXPECT_EQ(told({"a.toml", "--sped=3rpm"}),
            "there is no option \"--sped\"; did you mean \"--speed\"?");
  EXPECT_EQ(told({"--viscosity", "--sped"}), "there is no option \"--viscosity\"");
  EXPECT_EQ(told({"a.toml", "--speed=3rpm", "--", "-o"}), std::nullopt);
}

}  // namespace whirl::nearest_test
