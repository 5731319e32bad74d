// Tables for spreadsheets: cells that hold commas, quotation marks, lines and formulas.

#include <gtest/gtest.h>

#include "libio/results/csv_tables.hpp"
#include "tests/io/result_folder.hpp"

namespace whirl::csv_test {

class CsvTables : public test::InResultFolder {
 protected:
  /// The table of a group with names and a number for each.
  std::string table(const std::vector<std::string>& names) const {
    {
      ResultWriter file(path, Replaces::anything);
      file.dataset("/contacts/name", names, {"", "contact", {""}});
      file.dataset("/contacts/duty", Vec(Vec::LinSpaced(std::ssize(names), 1.0, 9.0)),
                   {"", "share of time", {"/contacts/name"}});
      file.commit();
    }
    const auto files = write_csv_tables(ResultReader(path), folder / "t");
    return files.size() == 1 ? test::content(files[0]) : "not one table";
  }
};

// RFC 4180, rules 5 to 7: cells with commas, quotation marks or line breaks stand in quotation
// marks, which are doubled within.
TEST_F(CsvTables, QuoteWhatWouldBeCutApart) {
  EXPECT_EQ(table({"ring, left", "a \"b\"", "two\nlines", "plain"}),
            "name,duty\n"
            "\"ring, left\",1\n"
            "\"a \"\"b\"\"\",3.6666666666666665\n"
            "\"two\nlines\",6.333333333333333\n"
            "plain,9\n");
}

// A name in a stranger's model must not become a formula when its table is opened [OWASP, CSV
// injection]; numbers below zero stay numbers.
TEST_F(CsvTables, TextsAreNoFormulas) {
  EXPECT_EQ(table({"=1+1", "+a", "-b", "@c", "d=1"}),
            "name,duty\n'=1+1,1\n'+a,3\n'-b,5\n'@c,7\nd=1,9\n");
  EXPECT_EQ(table({"=HYPERLINK(\"x\",\"y\")"}),
            "name,duty\n\"'=HYPERLINK(\"\"x\"\",\"\"y\"\")\",9\n");
}

}  // namespace whirl::csv_test
