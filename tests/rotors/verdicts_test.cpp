// Verdicts of linear analyses on rotors drawn at random agree with each other.

#include <gtest/gtest.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libdyn/linear/lateral_report.hpp"
#include "libfe/analyses/campbell.hpp"
#include "libio/model/model_file.hpp"
#include "tests/support/random_rotors.hpp"

namespace whirl::verdicts_test {

constexpr double clear = 1e-6;  // Re over size of an eigenvalue that grows beyond doubt

bool grows(const Modes& modes) {
  const auto is_growing = [](Complex l) { return l.real() > clear * std::abs(l); };
  return std::any_of(modes.oscillatory.begin(), modes.oscillatory.end(),
                     [&](const Mode& m) { return is_growing(m.lambda); }) ||
         std::any_of(modes.overdamped.begin(), modes.overdamped.end(), is_growing);
}

// A rotor that has a growing mode at its largest speed fails in the lateral report, with Q_0 = 0
// and a decrement below zero, and a decrement of a Campbell diagram at that speed is below zero
// likewise.
TEST(Verdicts, PassNoRotorWithAGrowingMode) {
  int unstable = 0, looked = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Model model = parse_model(test::random_rotor_text({.seed = seed, .most_elements = 6}));
    if (model.speed == 0.0) continue;
    const Assembler assembler(model.structure);
    const Modes modes = complex_modes(assembler, model.speed, 8);
    if (!grows(modes)) continue;
    ++unstable;
    const Campbell diagram = campbell(assembler, {model.speed}, 8);
    const bool told = std::any_of(diagram.branches.begin(), diagram.branches.end(),
                                  [](const auto& b) { return b.log_decrement.front() < 0.0; });
    EXPECT_TRUE(told || std::none_of(modes.oscillatory.begin(), modes.oscillatory.end(),
                                     [](const Mode& m) { return m.log_decrement() < 0.0; }))
        << "seed " << seed;
    try {
      const LateralReport r = lateral_report(model, {.range = operating_range(model)}).report;
      ++looked;
      EXPECT_FALSE(r.is_passed()) << "seed " << seed;
      EXPECT_EQ(r.limit, 0.0) << "seed " << seed;
      EXPECT_LT(r.log_decrement, 0.0) << "seed " << seed;
    } catch (const ModelError&) {      // a free rotor has no such report
    } catch (const NumericalError&) {  // nor one without a critical speed
    }
  }
  EXPECT_GT(looked, 10);
  EXPECT_GE(unstable, looked);
}

// Shafts and pedestals without mass have infinite eigenvalues, which rounding makes as large as
// 1e16 1/s of any sign: rotors that are stable were told to have a root of +2e15 1/s.
TEST(Verdicts, CallNoRotorUnstableForItsPartsWithoutMass) {
  struct Draw {
    unsigned seed;
    int most_elements;
  };
  for (const auto [seed, elements] : {Draw{111, 6}, {113, 6}, {115, 6}, {2375, 4}}) {
    const Model model =
        parse_model(test::random_rotor_text({.seed = seed, .most_elements = elements}));
    const Modes modes = complex_modes(Assembler(model.structure), 300.0, 8);
    for (const Complex lambda : modes.overdamped) EXPECT_LT(lambda.real(), 0.0) << "seed " << seed;
    EXPECT_EQ(modes.oscillatory.size(), 8u);
    EXPECT_FALSE(grows(modes)) << "seed " << seed;
  }
}

}  // namespace whirl::verdicts_test
