// Antinodes of modes, where unbalance is placed.

#include "libfe/lateral/antinodes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "libfe/analyses/critical.hpp"
#include "tests/support/rotors.hpp"

namespace whirl::antinodes_test {

// A uniform shaft, slender enough, between rigid bearings: sin(n pi z / L), antinodes at (2 i - 1)
// L / (2 n), each against its neighbors. 24 elements have a node at each of them for n = 1, 2, 3.
TEST(Antinodes, OfAUniformShaftAreThoseOfSines) {
  constexpr double L = 2.0;
  const Structure s = test::pinned(test::cylinder(L, 0.05, 24));
  const Assembler assembler(s);
  const System system = assembler.at(0.0);
  std::size_t n = 0;
  for (const Critical& c : undamped_criticals(system, {.count = 6})) {
    const auto found = antinodes(assembler.mesh(), system.dofs, c.shape);
    if (c.whirl == Whirl::backward) {
      EXPECT_TRUE(found.empty());
      continue;
    }
    ++n;
    ASSERT_EQ(found.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const double z = (2.0 * static_cast<double>(i) + 1.0) * L / (2.0 * static_cast<double>(n));
      EXPECT_NEAR(assembler.mesh().z[static_cast<std::size_t>(found[i].node)], z, 1e-9) << n;
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      EXPECT_NEAR(found[i].deflection * found[0].deflection, sign, 1e-6) << n;
    }
    for (int node = 0; node < assembler.mesh().nodes(); ++node) {
      const double z = assembler.mesh().z[static_cast<std::size_t>(node)];
      EXPECT_NEAR(forward_share(assembler.mesh(), system.dofs, c.shape, node),
                  std::abs(std::sin(static_cast<double>(n) * test::pi * z / L)), 1e-6);
    }
  }
  EXPECT_EQ(n, 3u);
}

// A wheel at the free end of a shaft moves most there; the other end does not count.
TEST(Antinodes, CanBeAtAnEnd) {
  const Structure s = test::Overhung{}.structure();
  const Assembler assembler(s);
  const System system = assembler.at(0.0);
  int forward = 0;
  for (const Critical& c : undamped_criticals(system, {.count = 2})) {
    const auto found = antinodes(assembler.mesh(), system.dofs, c.shape);
    if (c.whirl == Whirl::backward) continue;
    ++forward;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].node, 2);
  }
  EXPECT_EQ(forward, 1);
}

}  // namespace whirl::antinodes_test
