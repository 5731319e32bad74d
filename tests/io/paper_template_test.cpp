// Templates of printed reports: places are filled once, what is wrong is told with its line, and
// nothing of a template may run or come from the network.

#include "libio/page/paper_template.hpp"

#include <gtest/gtest.h>

#include "libio/page/cover.hpp"
#include "libio/results/digest.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::paper_template_test {

TemplateValues values() {
  return {.texts = {{"title", "A <b> {{author}}"}, {"company", ""}},
          .blocks = {{"style", "p { }"}, {"verdict", "<p>passed</p>"}, {"report", "{{title}}"}}};
}

std::string problem(const std::string& page) {
  try {
    filled_template(page, "folder/house.html", values());
  } catch (const FileError& error) {
    return error.what();
  }
  return "none";
}

constexpr const char* whole = "<p>{{style}}\n{{ title }} {{verdict}}{{report}}</p>";

// Values are text, blocks are HTML; neither is looked through for places again.
TEST(PaperTemplate, FillsEveryPlaceOnce) {
  const std::string page = filled_template(whole, "folder/house.html", values());
  EXPECT_TRUE(page.ends_with("<p>p { }\nA &lt;b&gt; {{author}} <p>passed</p>{{title}}</p>"))
      << page;
}

TEST(PaperTemplate, TellsTheLineOfWhatIsWrong) {
  const std::string page(whole);
  EXPECT_EQ(problem(page), "none");
  EXPECT_EQ(problem(page + "\n\n{{titel}}"),
            "folder/house.html:4: {{titel}} stands for nothing; places are company, report, style, "
            "title, verdict");
  EXPECT_EQ(problem("\n{{company}}" + page),
            "folder/house.html:2: {{company}} has no value: say it by company in [report] of the "
            "model, or by --cover company=...");
  EXPECT_EQ(problem(page + "{{title"), "folder/house.html:2: \"{{\" without \"}}\"");
  EXPECT_EQ(problem("{{style}}{{verdict}}"),
            "folder/house.html: the place {{report}} is missing: a template needs {{style}}, "
            "{{verdict}}, {{report}}");
}

// The policy stands before everything that a template says, so that it holds for all of it; only
// names beside the template lead to files.
TEST(PaperTemplate, ForbidsScriptsAndTheNetworkBeforeAnythingElse) {
  const std::string page = filled_template(whole, "/a b/house.html", values());
  EXPECT_LT(page.find("default-src 'none'"), page.find("<p>"));
  EXPECT_EQ(page.find("script-src"), std::string::npos);
  EXPECT_NE(page.find("<base href=\"file:///a%20b/\">"), std::string::npos) << page;
}

TEST(Cover, TakesWordsByTheKeysOfTheTable) {
  ReportWords words{.author = "A"};
  set_words(words, {"author=B = C", "revision="});
  EXPECT_EQ(words.author, "B = C");
  EXPECT_EQ(words.revision, "");
  for (const char* wrong : {"author", "auther=B", "=B", ""}) {
    EXPECT_THROW(set_words(words, {wrong}), ModelError) << wrong;
  }
}

TEST(Cover, FindsTheWordsOfAModelFile) {
  EXPECT_EQ(report_words("[report]\nauthor = \"A\"\n").author, "A");
  EXPECT_EQ(report_words("[report]\nauthor = 3\n").author, "");
  EXPECT_EQ(report_words("author").author, "");
}

// Printed in FIPS 180-2, appendix B.1.
TEST(Digest, IsSha256) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace whirl::paper_template_test
