// The first critical speed on rigid supports, beside closed forms.

#include "libfe/lateral/rigid_supports.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/support/rotors.hpp"

namespace whirl::rigid_supports_test {

constexpr double exact = 1e-9;  // relative: a beam without mass between its disks is exact

/// A disk amid a massless shaft, on soft and damped bearings at its ends.
Structure soft(const test::Jeffcott& rotor) {
  Structure s = rotor.structure();
  s.bearings = {test::bearing(test::at(0.0), test::isotropic(1e4, 50.0)),
                test::bearing(test::at(rotor.length), test::orthotropic(2e4, 5e4, 80.0))};
  return s;
}

// (48 E I / (L^3 m))^(1/2), whatever the bearings are, and whatever seals hold.
TEST(RigidSupports, GiveTheCriticalSpeedOfTheShaftAlone) {
  const test::Jeffcott rotor;
  Structure s = soft(rotor);
  EXPECT_NEAR(critical_on_rigid_supports(s), rotor.omega(), exact * rotor.omega());
  s.seals = {test::bearing(test::node(2), test::isotropic(1e7, 10.0))};
  EXPECT_NEAR(critical_on_rigid_supports(s), rotor.omega(), exact * rotor.omega());
}

// Films are supports, too, and several at one place are one.
TEST(RigidSupports, AreOilFilmsToo) {
  const test::Jeffcott rotor;
  Structure s = soft(rotor);
  s.bearings.pop_back();
  s.bearings.push_back(s.bearings.front());
  const auto at = [](double, double) { return test::isotropic(1e5); };
  s.linearized = {{"film", test::at(rotor.length), test::ground(), at}};
  EXPECT_NEAR(critical_on_rigid_supports(s), rotor.omega(), exact * rotor.omega());
}

// A disk that tilts, overhung by b beyond the second bearing, is critical in backward whirl first;
// that does not count. K = 3 E I [..]: both senses from (K - w^2 diag(m, Id -+ Ip)) singular.
TEST(RigidSupports, LeaveBackwardWhirlOut) {
  Structure s = {
      .shaft = {test::massless_cylinder(0.6, 0.02, 2), test::massless_cylinder(0.2, 0.02, 1)}};
  const double m = 4.0, Id = 0.03, Ip = 0.05, a = 0.6, b = 0.2, EI = test::EI(s.shaft[0]);
  s.disks = {{.at = test::node(4), .m = m, .Id = Id, .Ip = Ip}};
  s.bearings = {test::bearing(test::at(0.0), test::isotropic(1e5)),
                test::bearing(test::at(a), test::isotropic(1e5))};
  // flexibility of (w, theta) at the end: deflection and slope by a force and by a moment there
  Mat2 flexibility;
  flexibility << b * b * (a + b) / 3.0, b * (2.0 * a + 3.0 * b) / 6.0,
      b * (2.0 * a + 3.0 * b) / 6.0, (a + 3.0 * b) / 3.0;
  const Mat2 K = (flexibility / EI).inverse();
  const auto lowest = [&](double sense) {  // det(K - w^2 diag(m, Id - sense Ip)) = 0
    const double I = Id - sense * Ip;
    const double A = m * I, B = -(K(0, 0) * I + K(1, 1) * m), C = K.determinant();
    const double root = std::sqrt(B * B - 4.0 * A * C);
    const double first = (-B - root) / (2.0 * A), second = (-B + root) / (2.0 * A);
    return std::sqrt(std::min(first > 0.0 ? first : second, second > 0.0 ? second : first));
  };
  const double forward = lowest(+1.0);
  EXPECT_LT(lowest(-1.0), 0.9 * forward);
  EXPECT_NEAR(critical_on_rigid_supports(s), forward, exact * forward);
}

// What nothing holds has none.
TEST(RigidSupports, OfAFreeRotorAreNone) {
  Structure s = test::Jeffcott{}.structure();
  s.bearings.clear();
  EXPECT_TRUE(std::isnan(critical_on_rigid_supports(s)));
}

}  // namespace whirl::rigid_supports_test
