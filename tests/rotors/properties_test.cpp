// What holds for every linear study, on rotors drawn at random.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/dense.hpp"
#include "libfe/analyses/critical.hpp"
#include "libfe/analyses/static.hpp"
#include "libfe/eigen/dynamic_stiffness.hpp"
#include "libfe/eigen/symmetric.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/random_rotors.hpp"

namespace whirl::rotor_properties_test {

constexpr unsigned rotors = 24;
constexpr int most_elements = 20;
constexpr double condition = 1e-6;  // relative; rounding of the model times 1e10 of the stiffness

Model model_of(unsigned seed, const test::Wording& wording = {}) {
  return parse_model(
      test::random_rotor_text({.seed = seed, .most_elements = most_elements}, wording));
}

bool is_held(const Assembler& assembler) {
  return is_supported(symmetric_part(assembler.uncondensed(0.0).K));
}

// The same rotor in other units, its tables in another order.
TEST(RotorProperties, ModesAndCriticalSpeedsDependNeitherOnUnitsNorOnTheOrderOfTables) {
  for (unsigned seed = 1; seed <= rotors; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model a = model_of(seed), b = model_of(seed, {.has_other_units = true, .order = seed});
    const Assembler of_a(a.structure), of_b(b.structure);
    EXPECT_NEAR(a.speed, b.speed, 1e-12 * a.speed);
    const Modes x = complex_modes(of_a.at(a.speed), 6), y = complex_modes(of_b.at(b.speed), 6);
    ASSERT_EQ(x.oscillatory.size(), y.oscillatory.size());
    for (std::size_t i = 0; i < x.oscillatory.size(); ++i) {
      const Complex l = x.oscillatory[i].lambda;
      EXPECT_LT(std::abs(l - y.oscillatory[i].lambda), condition * std::abs(l)) << l;
    }
    if (!is_held(of_a)) continue;
    const auto p = critical_speeds(of_a, {.count = 3, .has_damped = false}),
               q = critical_speeds(of_b, {.count = 3, .has_damped = false});
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_NEAR(p[i].speed, q[i].speed, condition * p[i].speed);
    }
  }
}

// A load at frequency zero is a static load.
TEST(RotorProperties, TheStaticSagIsTheResponseAtFrequencyZero) {
  for (unsigned seed = 1; seed <= rotors; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = model_of(seed);
    const Assembler assembler(model.structure);
    if (!is_held(assembler)) continue;
    const Vec sag = static_equilibrium(assembler, model.speed).displacement;
    const System s = assembler.uncondensed(model.speed);
    const CVec load = (s.dofs.T.transpose() * assembler.gravity_load()).cast<Complex>();
    const auto q = DynamicStiffness(s).solve(0.0, model.speed, load);
    ASSERT_TRUE(q);
    EXPECT_LT((s.dofs.T * *q - sag.cast<Complex>()).norm(), condition * sag.norm());
  }
}

// Near an eigenvalue l the response grows as 1 / (s - l): half the distance, twice the response.
TEST(RotorProperties, ModesArePolesOfTheResponse) {
  constexpr double distance = 1e-5;  // relative: near, but far above rounding
  constexpr double pole = 0.05;      // relative; other poles and the rest of the response
  int seen = 0;
  for (unsigned seed = 1; seed <= rotors; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Model model = model_of(seed);
    const System s = Assembler(model.structure).at(model.speed);
    if (s.size() > 60) continue;
    const Mat M(s.M), D(s.D()), K(s.stiffness());
    const CMat load = CMat::Ones(s.size(), 1);
    const auto response = [&](Complex l) {
      const CMat Q = l * l * M.cast<Complex>() + l * D.cast<Complex>() + K.cast<Complex>();
      return DenseLu<CMat>(Q).solve(load).norm();
    };
    for (const Mode& mode : complex_modes(s, 4).oscillatory) {
      const Complex step = distance * mode.lambda;
      // a mode in the plane across the load does not answer it
      const double near = response(mode.lambda + 0.5 * step), far = response(mode.lambda + step);
      if (near < 10.0 * response(mode.lambda + 100.0 * step)) continue;
      ++seen;
      EXPECT_NEAR(near / far, 2.0, 2.0 * pole) << mode.lambda;
    }
  }
  EXPECT_GE(seen, static_cast<int>(rotors));
}

}  // namespace whirl::rotor_properties_test
