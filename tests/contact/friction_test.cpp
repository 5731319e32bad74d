// Coulomb friction: what it opposes, and where its sign is smoothed.

#include "libcontact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libcontact/contact.hpp"

namespace whirl::friction_test {

// share = tanh(v_t / tolerance): odd, of slope 1 / tolerance at rest, one beyond a few tolerances.
TEST(Friction, ThatIsSmoothedFollowsATanhOfTheSlip) {
  const Friction friction{.mu = 0.2, .tolerance = 0.01};
  EXPECT_EQ(friction.smooth_share(0.0), 0.0);
  for (const double v : {1e-6, 1e-3, 0.01, 0.05, 3.0}) {
    EXPECT_EQ(friction.smooth_share(-v), -friction.smooth_share(v));
    EXPECT_NEAR(friction.smooth_share(v), std::tanh(v / 0.01), 1e-15);
  }
  EXPECT_NEAR(friction.smooth_share(1e-8), 1e-8 / 0.01, 1e-15);
  EXPECT_NEAR(friction.smooth_share(1.0), 1.0, 1e-15);
}

TEST(Friction, ForwardTakesNoNoticeOfTheSlip) {
  const Friction friction{.mu = 0.2, .slip = Slip::forward};
  for (const double v : {-5.0, 0.0, 5.0}) EXPECT_EQ(friction.smooth_share(v), 1.0);
}

// Only friction that follows the actual slip without a tolerance switches, and can stick.
TEST(Friction, IsExactOnlyIfItSwitches) {
  EXPECT_TRUE((Friction{.mu = 0.1}.is_exact()));
  EXPECT_FALSE((Friction{.mu = 0.0}.is_exact()));
  EXPECT_FALSE((Friction{.mu = 0.1, .slip = Slip::forward}.is_exact()));
  EXPECT_FALSE((Friction{.mu = 0.1, .tolerance = 1e-3}.is_exact()));
}

TEST(Friction, NamesWhatItOpposes) {
  EXPECT_EQ(name_of(Slip::actual), "actual");
  EXPECT_EQ(name_of(Slip::forward), "forward");
}

// The clearance is the one number that every contact must state: its field leads to the member.
TEST(Contact, RequiresItsClearance) {
  const auto field = std::get<0>(Contact::fields());
  Contact contact;
  contact.*(field.member) = 5e-3;
  EXPECT_EQ(contact.clearance, 5e-3);
  EXPECT_TRUE(field.is_required);
  EXPECT_EQ(field.range, Range::positive);
  EXPECT_EQ(field.unit, "m");
}

}  // namespace whirl::friction_test
