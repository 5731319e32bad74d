// Level I of the lateral analysis beside all eigenvalues over the cross-coupled stiffness, by LAPACK's
// QZ: rotors drawn at random with unlike bearings.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "libfe/coupling_stability.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/qz.hpp"
#include "tests/support/random_rotors.hpp"

namespace whirl::coupling_test {

using test::Eigenpair;

constexpr double clear = 1e-5;   // Re over size: rounding of QZ is far below at 28 coordinates
constexpr double beside = 0.01;  // of Q_0: there a real part has left zero, or not yet

/// All finite eigenvalues of a rotor with Q at a node, those that creep too.
std::vector<Complex> eigenvalues(const Structure& structure, double Omega, const Station& at,
                                 double Q) {
  Structure s = structure;
  BearingCoefficients coupling;
  coupling.K << 0.0, Q, -Q, 0.0;
  s.links.push_back({.name = "Q", .from = at, .coefficients = constant_bearing(coupling)});
  const System system = assemble(s, Omega);
  const Sparse D = system.D();
  std::vector<Complex> all;
  for (const Eigenpair& rough : test::qz_eigenpairs(Mat(system.M), Mat(D), Mat(system.K))) {
    all.push_back(rough.lambda);
  }
  return all;
}

/// The largest real part over size.
double growth(const std::vector<Complex>& eigenvalues) {
  double most = -INFINITY;
  for (const Complex l : eigenvalues) most = std::max(most, l.real() / std::abs(l));
  return most;
}

// Below Q_0 no eigenvalue of 1000 rotors is right of the imaginary axis, above it one is; Q_0 is zero
// where one is without Q, and there is none where 1000 times the largest stiffness drives none. Modes
// were followed by the name of their whirl at Q = 0 before, and 1 in 5 such rotors passed.
TEST(CouplingStability, IsThatOfAllEigenvaluesOfRandomRotors) {
  constexpr unsigned last = 1000;
  int unstable = 0, limited = 0, unlimited = 0;
  for (unsigned seed = 1; seed <= last; ++seed) {
    const Model model = parse_model(test::random_rotor_text({.seed = seed, .most_elements = 4}));
    const Structure& s = model.structure;
    const double Omega = model.speed > 0.0 ? model.speed : 300.0;
    const Station at{.kind = Station::Kind::node, .node = 1 + make_mesh(s).nodes() / 2};
    const CouplingStability found = coupling_stability(s, Omega, at, {.steps = 8});
    const double own = growth(eigenvalues(s, Omega, at, 0.0));
    if (std::abs(own) < clear) continue;  // on the axis, as rounding has it
    if (own > 0.0) {
      ++unstable;
      EXPECT_TRUE(found.at_limit && found.at_limit->coupling == 0.0) << "seed " << seed;
      EXPECT_TRUE(found.at_anticipated && found.at_anticipated->log_decrement < 0.0) << seed;
      continue;
    }
    if (!found.at_limit) {
      ++unlimited;
      for (const double Q : {1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10}) {
        EXPECT_LT(growth(eigenvalues(s, Omega, at, Q)), clear) << "seed " << seed << ", " << Q;
      }
      continue;
    }
    ++limited;
    const double Q0 = found.at_limit->coupling;
    EXPECT_GT(growth(eigenvalues(s, Omega, at, Q0 * (1.0 + beside))), 0.0) << "seed " << seed;
    for (const double share : {0.3, 0.7, 1.0 - beside}) {
      EXPECT_LT(growth(eigenvalues(s, Omega, at, Q0 * share)), 0.0)
          << "seed " << seed << ", " << share << " of " << Q0;
    }
  }
  EXPECT_GT(unstable, 20);
  EXPECT_GT(limited, 300);
  RecordProperty("unlimited", unlimited);
}

}  // namespace whirl::coupling_test
