// Completion by bash: what it offers, asked of bash itself.

#include "libio/text/bash_completion.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "libbase/system/program.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::test {
namespace bash_completion_test {

class BashCompletion : public InResultFolder {
 protected:
  /// What is offered for the last of some words, one a line.
  std::string offered(const std::string& words, int last) const {
    std::ofstream(folder / "script")
        << bash_completion("spin", {{{"run", "go"}, {"--speed", "--out"}, {"--speed"}},
                                    {{"draw"}, {"--size"}, {"--size"}}});
    const std::string ask = "source " + (folder / "script").string() + "; COMP_WORDS=(" + words +
                            "); COMP_CWORD=" + std::to_string(last) +
                            "; _spin; printf '%s\\n' \"${COMPREPLY[@]}\"";
    EXPECT_EQ(run_program({"bash", "-c", ask}, folder / "said"), 0);
    return content(folder / "said");
  }
};

TEST_F(BashCompletion, OffersVerbsAndTheOptionsOfEach) {
  EXPECT_EQ(offered("spin ''", 1), "run\ngo\ndraw\nhelp\n--help\n--version\n");
  EXPECT_EQ(offered("spin r", 1), "run\n");
  EXPECT_EQ(offered("spin run --", 2), "--speed\n--out\n--help\n");
  EXPECT_EQ(offered("spin go --", 2), offered("spin run --", 2));  // another name of it
  EXPECT_EQ(offered("spin draw --s", 2), "--size\n");
}

TEST_F(BashCompletion, OffersFilesButNotWhereAValueIsNone) {
  const std::string start = (folder / "sc").string();
  EXPECT_EQ(offered("spin run " + start, 2), start + "ript\n");
  EXPECT_EQ(offered("spin run --out " + start, 3), start + "ript\n");
  EXPECT_EQ(offered("spin run --speed " + start, 3), "\n");
}

}  // namespace bash_completion_test
}  // namespace whirl::test
