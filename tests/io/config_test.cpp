// The tree of a model file: places, --set paths, and back to TOML.

#include "libio/model/config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whirl::config_test {

using Kind = ConfigNode::Kind;

/// The same values under the same keys; places and the order of keys do not count.
bool same(const ConfigNode& a, const ConfigNode& b) {
  if (a.kind != b.kind || a.text != b.text || a.boolean != b.boolean) return false;
  const bool both_nan = std::isnan(a.number) && std::isnan(b.number);
  if (a.number != b.number && !both_nan) return false;
  if (a.items.size() != b.items.size() || a.entries.size() != b.entries.size()) return false;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (!same(a.items[i], b.items[i])) return false;
  }
  return std::all_of(a.entries.begin(), a.entries.end(), [&](const auto& entry) {
    const ConfigNode* other = b.find(entry.key);
    return other && same(entry.value, *other);
  });
}

/// The problem of a text or an assignment: "file:line:column: key: message".
template <class Action>
std::string problem_of(Action action) {
  try {
    action();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

ConfigNode model() {
  return parse_toml(R"(format = 1
title = "seal rub"
[operation]
speed = "3650 rpm"

[[bearing]]
name = "left"
stiffness = "4 MN/m"
[[bearing]]
name = "right side"
stiffness = { xx = 1.0, yy = 2.0 }
[[contact]]
clearance = 1e-3
)",
                    "model.toml");
}

TEST(Config, KnowsKindsAndPlaces) {
  const ConfigNode root = parse_toml(
      "a = 1\n"
      "  b = 2.5\n"
      "c = \"text\"\n"
      "d = true\n"
      "e = [1, \"two\"]\n"
      "f = { g = 3 }\n"
      "h = 1979-05-27\n"
      "[t]\n"
      "u = 4\n"
      "[[list]]\n"
      "v = 5\n",
      "file");
  EXPECT_EQ(root.find("a")->kind, Kind::integer);
  EXPECT_EQ(root.find("b")->kind, Kind::real);
  EXPECT_EQ(root.find("c")->kind, Kind::string);
  EXPECT_EQ(root.find("d")->kind, Kind::boolean);
  EXPECT_EQ(root.find("e")->kind, Kind::array);
  EXPECT_EQ(root.find("f")->kind, Kind::table);
  EXPECT_EQ(root.find("h")->kind, Kind::other);
  EXPECT_EQ(root.find("nothing"), nullptr);

  EXPECT_EQ(root.where, (Where{"file", 1, 1}));
  EXPECT_EQ(root.find("a")->key_where, (Where{"file", 1, 1}));
  EXPECT_EQ(root.find("a")->where, (Where{"file", 1, 5}));
  EXPECT_EQ(root.find("b")->key_where, (Where{"file", 2, 3}));
  EXPECT_EQ(root.find("b")->where, (Where{"file", 2, 7}));
  EXPECT_EQ(root.find("e")->items[1].where, (Where{"file", 5, 9}));
  EXPECT_EQ(root.find("f")->find("g")->where, (Where{"file", 6, 11}));
  EXPECT_EQ(root.find("t")->where.line, 8);
  EXPECT_EQ(root.find("t")->find("u")->key_where, (Where{"file", 9, 1}));
  EXPECT_EQ(root.find("list")->items[0].where.line, 10);
}

TEST(Config, KeepsTheOrderOfTheFile) {
  const ConfigNode root = parse_toml("z = 1\na = 2\n[m]\nk = 1\n[b]\n", "file");
  std::vector<std::string> keys;
  for (const auto& [key, value] : root.entries) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"z", "a", "m", "b"}));
}

TEST(Config, SaysWhereTheTextIsNoToml) {
  const auto parse = [](const char* text) {
    return problem_of([&] { parse_toml(text, "m.toml"); });
  };
  EXPECT_EQ(parse("a = 1\nb = \n").rfind("m.toml:2:5: not TOML: ", 0), 0u)
      << parse("a = 1\nb = \n");
  EXPECT_NE(parse("a = 1\na = 2\n").find("cannot redefine"), std::string::npos);
  EXPECT_EQ(parse("a = \"open\n"),
            "m.toml:1:10: not TOML: a text without closing quotation mark, or with a control "
            "character in it");
  EXPECT_NE(parse("").find("the file is empty"), std::string::npos);
  EXPECT_NE(parse(" \n\t\r\n").find("the file is empty"), std::string::npos);
  EXPECT_NE(
      problem_of([] { parse_toml(std::string_view("a\0b", 3), "m.toml"); }).find("not a text file"),
      std::string::npos);
}

// ---- --set ----

// toml++ makes a table of every part and calls itself for each: 100 000 of them left the stack.
TEST(Config, RefusesKeysAndTablesThatAreNestedTooDeep) {
  std::string path = "a";
  for (int i = 1; i < 100'000; ++i) path += ".a";
  for (const std::string& text : {path + " = 1", "[" + path + "]", "x = { " + path + " = 1 }",
                                  "y = \"\"\"\n\"\\\"\"\"\" # \"\n" + path + " = 1"}) {
    EXPECT_NE(problem_of([&] { parse_toml(text, "m.toml"); }).find("a key of more than 16 parts"),
              std::string::npos)
        << text.substr(0, 20);
  }
  EXPECT_NE(problem_of([&] {
              ConfigNode root;
              set_value(root, path + "=1");
            }).find("a path has 16 parts at most"),
            std::string::npos);
  const std::string lists = "a = " + std::string(40, '[') + std::string(40, ']');
  EXPECT_NE(problem_of([&] { parse_toml(lists, "m.toml"); }).find("more than 32 tables or lists"),
            std::string::npos);
}

TEST(Config, DotsInTextsAndCommentsAreNoParts) {
  const std::string dots(100, '.');
  std::string numbers = "1.0";
  for (int i = 0; i < 20; ++i) numbers += ", 1.0";
  const std::string text = "a = \"" + dots + "\" # " + dots + "\nb = '" + dots + "'\nc = \"\"\"\n" +
                           dots + "\"" + dots + "\"\"\"\nd = '''\n" + dots + "'''\ne = [" +
                           numbers + "]\n";
  EXPECT_EQ(problem_of([&] { parse_toml(text, "m.toml"); }), "none");
}

TEST(SetValue, FindsElementsByNameByNumberAndInQuotes) {
  ConfigNode root = model();
  set_value(root, "bearing.left.stiffness=8e6");
  EXPECT_EQ(root.find("bearing")->items[0].find("stiffness")->number, 8e6);
  set_value(root, "bearing.1.stiffness=9e6");
  EXPECT_EQ(root.find("bearing")->items[0].find("stiffness")->number, 9e6);
  set_value(root, "bearing.right side.stiffness.xx=3.0");
  set_value(root, "bearing.\"right side\".stiffness.yy=4.0");
  const ConfigNode& stiffness = *root.find("bearing")->items[1].find("stiffness");
  EXPECT_EQ(stiffness.find("xx")->number, 3.0);
  EXPECT_EQ(stiffness.find("yy")->number, 4.0);
  set_value(root, "contact.1.clearance=2e-3");  // an element without a name
  EXPECT_EQ(root.find("contact")->items[0].find("clearance")->number, 2e-3);
}

TEST(SetValue, APartInQuotesMayContainDots) {
  ConfigNode root = parse_toml("[[disk]]\nname = \"no. 1\"\n", "file");
  set_value(root, "disk.\"no. 1\".mass=2");
  EXPECT_EQ(root.find("disk")->items[0].find("mass")->number, 2.0);
}

TEST(SetValue, ANameWinsOverANumber) {
  ConfigNode root = parse_toml("[[disk]]\nname = \"2\"\n[[disk]]\nname = \"1\"\n", "file");
  set_value(root, "disk.1.mass=7");
  EXPECT_EQ(root.find("disk")->items[1].find("mass")->number, 7.0);
}

TEST(SetValue, ReadsTheValueAsTomlWhereItIsTomlElseAsText) {
  const auto set = [](const std::string& value) {
    ConfigNode root = model();
    set_value(root, "title=" + value);
    return *root.find("title");
  };
  EXPECT_EQ(set("5").kind, Kind::integer);
  EXPECT_EQ(set("5.0").kind, Kind::real);
  EXPECT_EQ(set("-1e3").number, -1000.0);
  EXPECT_EQ(set("true").kind, Kind::boolean);
  EXPECT_EQ(set("\"5\"").kind, Kind::string);
  EXPECT_EQ(set("\"5\"").text, "5");
  EXPECT_EQ(set("[1, 2]").items.size(), 2u);
  EXPECT_EQ(set("{ a = 1 }").find("a")->number, 1.0);
  for (const char* text :
       {"4430rpm", "138.4 rad/s", "a = b", "steel", "", "5 mm", "a, b", "\"open"}) {
    EXPECT_EQ(set(text).kind, Kind::string) << text;
    EXPECT_EQ(set(text).text, text);
  }
  const ConfigNode whirl = set("[{mode=1, amplitude=\"2 mm\"}]");
  EXPECT_EQ(whirl.items[0].find("amplitude")->text, "2 mm");
}

TEST(SetValue, MakesTablesThatAreNotThereButNoElements) {
  ConfigNode root = parse_toml("format = 1\n", "file");
  set_value(root, "operation.speed=100");
  EXPECT_EQ(root.find("operation")->find("speed")->number, 100.0);
  set_value(root, "damping.rayleigh.mass=2");
  EXPECT_EQ(root.find("damping")->find("rayleigh")->find("mass")->number, 2.0);
  set_value(root, "gravity=9.81");
  EXPECT_EQ(root.find("gravity")->number, 9.81);
}

TEST(SetValue, ItsPlaceIsTheCommandLine) {
  ConfigNode root = model();
  set_value(root, "operation.speed=[100, 200]");
  const ConfigNode& speed = *root.find("operation")->find("speed");
  EXPECT_EQ(speed.where, (Where{"--set operation.speed=[100, 200]", 0, 0, "operation.speed"}));
  EXPECT_EQ(speed.items[1].where, speed.where);
}

TEST(SetValue, SaysWhatIsWrongWithAPath) {
  const auto set = [](const std::string& assignment) {
    return problem_of([&] {
      ConfigNode root = model();
      set_value(root, assignment);
    });
  };
  EXPECT_EQ(set("bearing.left.stiffness"),
            "--set bearing.left.stiffness: expected PATH=VALUE, such as contact.seal.friction=0.1");
  EXPECT_NE(set("=5").find("expected PATH=VALUE"), std::string::npos);
  EXPECT_EQ(
      set("bearing.lft.stiffness=5"),
      "--set bearing.lft.stiffness=5: bearing.lft.stiffness: there is no element \"lft\"; did "
      "you mean \"left\"?");
  EXPECT_NE(set("bearing.3.stiffness=5").find("expected a number from 1 to 2"), std::string::npos);
  EXPECT_NE(set("bearing.0.stiffness=5").find("expected a number from 1 to 2"), std::string::npos);
  EXPECT_NE(set("bearing.somewhere.stiffness=5").find("there are \"left\", \"right side\""),
            std::string::npos);
  EXPECT_NE(set("contact.seal.friction=5").find("its elements have no names, use numbers from 1"),
            std::string::npos);
  EXPECT_NE(set("title.x=5").find("\"title\" is not a table"), std::string::npos);
  EXPECT_NE(set("title=5\nformat = 2").find("expected one value"), std::string::npos);
}

// ---- back to TOML ----

class RoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, ParsingWhatWasWrittenGivesTheSameTree) {
  const ConfigNode tree = parse_toml(GetParam(), "file");
  const std::string text = to_toml(tree);
  const ConfigNode again = parse_toml(text, "file");
  EXPECT_TRUE(same(tree, again)) << text;
  EXPECT_EQ(to_toml(again), text);
}

INSTANTIATE_TEST_SUITE_P(
    Config, RoundTrip,
    testing::Values(
        "a = 1\nb = -2\nc = 1.5\nd = 1e300\ne = 2.0\nf = 1e-300\ng = 123456789012\n",
        "a = true\nb = false\nc = \"\"\nd = []\ne = {}\n", "a = nan\nb = inf\nc = -inf\n",
        R"(a = "with \"quotes\" and \\ and # and = and [brackets]")",
        "a = \"line\\nline\\r\\n\\ttab\"\nb = \"\"\"\nover\nlines\n\"\"\"\nc = 'literal \\ text'\n",
        "a = \"control \\u0001 \\u007F \\u0000 signs\"\n", "a = \"L\u00e4ufer \u2300 20 mm\"\n",
        "\"key with blanks\" = 1\n\"key.with.dots\" = 2\n\"\" = 3\n\"L\u00e4nge\" = 4\n",
        "a = [1, [2.0, \"three\"], { b = 4, c = { d = [5] } }]\n",
        "[material.steel]\nE = 1\n[material.\"cast iron\"]\nE = 2\n",
        "[damping]\nrayleigh = { mass = 1.0, stiffness = 0.0 }\n",
        "[[shaft]]\nlength = 1\n[[shaft]]\nlength = 2\nouter = [1, 2]\n",
        "[[disk]]\nname = \"a\"\nunbalance = { offset = \"1 mm\", phase = 0.5 }\n[[disk]]\n",
        "[[a]]\nb = 1\n[[a.c]]\nd = 2\n[[a.c]]\nd = 3\n[a.e.f]\ng = 4\n",
        "[start]\nfrom = \"rest\"\nwhirl = [ { mode = 1, amplitude = \"2 mm\" }, { mode = 2 } ]\n",
        "[a.b.c]\nd = 1\n[a.b]\ne = 2\n[a]\nf = 3\n", "mixed = [ { a = 1 }, 2 ]\n[t]\n[u.v]\n"));

// One value of a matrix stands for both of its diagonal, and stays there beside another entry.
TEST(Config, AnEntryOfAMatrixMayBeSetBesideItsDiagonal) {
  ConfigNode root = parse_toml("[[bearing]]\nstiffness = \"4 MN/m\"\n", "file");
  set_value(root, "bearing.1.stiffness.xy=2 kN/m");
  set_value(root, "bearing.1.stiffness.yy=5");
  const ConfigNode& stiffness = *root.find("bearing")->items.at(0).find("stiffness");
  EXPECT_EQ(stiffness.find("xx")->as_written(), "\"4 MN/m\"");
  EXPECT_EQ(stiffness.find("xy")->as_written(), "\"2 kN/m\"");
  EXPECT_EQ(stiffness.find("yy")->as_written(), "5");
  EXPECT_EQ(stiffness.find("yx"), nullptr);
}

TEST(Config, ShowsValuesAsTheyWouldBeWritten) {
  const ConfigNode root = parse_toml(
      "a = 5\nb = \"4 MN/m\"\nc = true\nd = [1]\ne = {}\nf = 1.5\ng = 1979-05-27\n", "file");
  EXPECT_EQ(root.find("a")->as_written(), "5");
  EXPECT_EQ(root.find("b")->as_written(), "\"4 MN/m\"");
  EXPECT_EQ(root.find("c")->as_written(), "true");
  EXPECT_EQ(root.find("d")->as_written(), "an array");
  EXPECT_EQ(root.find("e")->as_written(), "a table");
  EXPECT_EQ(root.find("f")->as_written(), "1.5");
  EXPECT_EQ(root.find("g")->as_written(), "a date or time");
  ConfigNode text;
  text.kind = Kind::string;
  text.text = std::string(1000, 'x');
  EXPECT_LE(text.as_written().size(), 60u);
}

}  // namespace whirl::config_test
