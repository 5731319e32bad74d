#pragma once
/// What tests of pictures and pages share.

#include "tests/cli/program.hpp"

namespace whirl::test {

/// Tests that draw results of `rub.toml` and of other models.
class Pictures : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("rub.toml", rubbing);
  }

  void make(std::vector<std::string> words, const std::string& out) const {
    words.insert(words.end(), {"--out", out, "--quiet"});
    const Outcome outcome = whirl(briefly(words));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

/// What a report's page holds.
inline json page_data(const std::string& page) {
  const auto from = page.find("id=\"data\">") + 10;
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

}  // namespace whirl::test
