// Linear verbs on rotors drawn at random: documented statuses, JSON without what is no number.

#include "tests/support/random_rotors.hpp"

#include "tests/cli/program.hpp"

namespace whirl::cli_test {

class RandomRotors : public test::Program {};

// Status 0, or 2 with the reason where a free rotor cannot have it; nlohmann refuses NaN.
TEST_F(RandomRotors, EndEveryLinearVerbWithADocumentedStatusAndWholeJson) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    write("rotor.toml", test::random_rotor_text({.seed = seed, .most_elements = 12}));
    for (const std::string verb : {"check", "static", "modes", "campbell", "resonances", "critical",
                                   "unbalance", "lateral"}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " " + verb);
      std::vector<std::string> call{verb, "rotor.toml", "--json", "-"};
      if (verb == "campbell" || verb == "unbalance" || verb == "resonances") {
        call.insert(call.end(), {"--speeds", "10rad/s:600rad/s:150rad/s"});
      }
      if (verb == "lateral") call.insert(call.end(), {"--maximum-speed", "400rad/s"});
      const test::Outcome outcome = whirl(call);
      if (outcome.status == 0) {
        EXPECT_NO_THROW(outcome.tree());
        EXPECT_EQ(outcome.err, "");
      } else {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err, "");
      }
    }
  }
}

}  // namespace whirl::cli_test
