// Level I of the lateral analysis beside all eigenvalues over the cross-coupled stiffness, by
// LAPACK's QZ: rotors drawn at random with unlike bearings.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "libbase/error.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libfe/lateral/coupling_stability.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/qz.hpp"
#include "tests/support/random_rotors.hpp"

namespace whirl::coupling_test {

using std::numbers::pi;
using test::Eigenpair;

constexpr double clear = 1e-7;    // Re over size: rounding is below once an eigenvalue is polished
constexpr double rough = 1e-2;    // the same of QZ: what may be right of the axis
constexpr double balanced = 0.5;  // parts of a residual hold one another: else it is at infinity

/// The largest real part over size of all eigenvalues of a rotor with Q at a node, those that creep
/// too, and none of those that are infinite.
double growth(const Structure& structure, double Omega, const Station& at, double Q) {
  Structure s = structure;
  BearingCoefficients coupling;
  coupling.K << 0.0, Q, -Q, 0.0;
  s.linearized.push_back({"Q", at, {}, [&](double, double) { return coupling; }});
  const System system = assemble(s, Omega);
  const Sparse D = system.D();
  double most = -INFINITY;
  for (const Eigenpair& found :
       test::qz_eigenpairs(Mat(system.M), Mat(D), Mat(system.stiffness()))) {
    if (found.lambda.real() < -rough * std::abs(found.lambda)) continue;
    const auto& [l, q] = test::polished(system.M, D, system.stiffness(), found);
    const CVec inertia = l * l * (system.M * q), damping = l * (D * q),
               elastic = system.stiffness() * q;
    const double parts = inertia.norm() + damping.norm() + elastic.norm();
    if ((inertia + damping + elastic).norm() > balanced * parts) continue;
    most = std::max(most, l.real() / std::abs(l));
  }
  return most;
}

bool is_held(const Structure& structure, double Omega) {
  return is_supported(symmetric_part(Assembler(structure).uncondensed(Omega, 0.0).K));
}

// Below Q_0 no eigenvalue of 1000 rotors is right of the imaginary axis, above it one is; Q_0 is
// zero where one is without Q, and there is none where none is up to 1e10 N/m. Modes were followed
// by the name of their whirl at Q = 0 before.
TEST(CouplingStability, IsThatOfAllEigenvaluesOfRandomRotors) {
  int unstable = 0, limited = 0, unlimited = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Model model;
    try {
      model = parse_model(test::random_rotor_text({.seed = seed, .most_elements = 4}));
    } catch (const ModelError&) {
      continue;  // two rigid bearings at one place
    }
    const Structure& s = model.structure;
    const double Omega = model.speed > 0.0 ? model.speed : 300.0;
    const Station at{.kind = Station::Kind::node, .node = 1 + make_mesh(s).nodes() / 2};
    const CouplingStability found = coupling_stability(s, Omega, at, {.steps = 4});
    if (!is_held(s, Omega)) continue;
    const double own = growth(s, Omega, at, 0.0);
    if (own > clear) {
      ++unstable;
      EXPECT_TRUE(found.at_limit && found.at_limit->coupling == 0.0);
      EXPECT_TRUE(found.at_anticipated && found.at_anticipated->log_decrement < 0.0);
      continue;
    }
    if (!found.at_limit) {
      ++unlimited;
      for (const double Q : {1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10}) {
        EXPECT_LT(growth(s, Omega, at, Q), clear) << Q;
      }
      continue;
    }
    ++limited;
    const double Q0 = found.at_limit->coupling;
    SCOPED_TRACE("Q0 " + std::to_string(Q0));
    for (const double share : {0.1, 0.5, 0.99}) {
      EXPECT_LT(growth(s, Omega, at, share * Q0), clear) << share;
    }
    if (own > -clear) continue;  // without damping: rounding decides above Q_0
    const double above =
        std::max(growth(s, Omega, at, 1.01 * Q0), growth(s, Omega, at, 1.0001 * Q0));
    EXPECT_GT(above, 0.0) << "at " << found.at_limit->frequency;
  }
  EXPECT_GT(unstable, 100);
  EXPECT_GT(limited, 700);
  EXPECT_GT(unlimited, 5);
}

// Two rotors whose bearings are stiffer along x than along y, or the other way round: the mode that
// Q drives is called mixed without it, and one that is called forward stays well damped. They
// passed with 20 MN/m (decrements of +3.0 and more), and were told to bear any Q.
TEST(CouplingStability, FollowsADrivenModeThatIsCalledMixedWithoutIt) {
  constexpr double QA = 20e6;
  for (const auto& [file, middle] :
       {std::pair{"driven_mode_is_mixed.toml", 7}, std::pair{"driven_mode_is_mixed_2.toml", 6}}) {
    SCOPED_TRACE(file);
    const Model model = read_model(std::string(WHIRL_TEST_DATA) + "/" + file);
    const OperatingRange range = operating_range(model);
    const LateralReport r =
        lateral_report(model, {.range = range, .anticipated = QA, .has_anticipated = true}).report;
    EXPECT_FALSE(r.is_passed());
    const Station at{.kind = Station::Kind::node, .node = middle};
    EXPECT_LT(growth(model.structure, range.maximum, at, 0.999999 * r.limit), 0.0);
    EXPECT_GT(growth(model.structure, range.maximum, at, 1.000001 * r.limit), 0.0);
    const double share = growth(model.structure, range.maximum, at, QA);
    EXPECT_NEAR(r.log_decrement, -2.0 * pi * share / std::sqrt(1.0 - share * share), 1e-6);
  }
}

}  // namespace whirl::coupling_test
