// JSON: read back by another library.

#include "libio/text/record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace whirl::record_test {

using nlohmann::json;

json read_back(const Record& record) {
  return json::parse(record.json());
}

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Record, EveryKindOfValueIsReadBack) {
  Record r;
  r.set("null", nullptr).set("yes", true).set("no", false);
  r.set("int", -5).set("long", 4'000'000'000L).set("double", 0.1).set("text", "seal");
  r.set("complex", Complex(1.5, -2.5));
  r.set("vector", Vec(Vec::LinSpaced(3, 0.0, 1.0))).set("doubles", std::vector<double>{1.0, 2.0});
  r.set("empty object", Record()).set("empty array", Record::array());
  EXPECT_EQ(read_back(r), json::parse(R"({
    "null": null, "yes": true, "no": false, "int": -5, "long": 4000000000, "double": 0.1,
    "text": "seal", "complex": [1.5, -2.5], "vector": [0, 0.5, 1], "doubles": [1, 2],
    "empty object": {}, "empty array": []})"));
}

TEST(Record, NumbersComeBackBitForBit) {
  for (const double value :
       {0.1, 1.0 / 3.0, 1e-308, 5e-324, 1.7976931348623157e308, -0.0, 1e16, 123456789.123456789}) {
    Record r;
    r.set("value", value);
    EXPECT_EQ(read_back(r)["value"].get<double>(), value) << r.json();
  }
}

// Only objects and arrays have entries: what has one is not empty, and neither is an empty text.
TEST(Record, IsEmptyWithoutEntries) {
  EXPECT_TRUE(Record().is_empty());
  EXPECT_TRUE(Record::array().is_empty());
  EXPECT_FALSE(Record().set("motions", Record::array()).is_empty());
  EXPECT_FALSE(Record(Record::Array{Record()}).is_empty());
  EXPECT_FALSE(Record("").is_empty());
  EXPECT_FALSE(Record(nullptr).is_empty());
}

TEST(Record, WhatIsNoNumberIsNull) {
  Record r;
  r.set("a", std::nan("")).set("b", infinity).set("c", -infinity);
  r.set("d", std::vector<double>{1.0, std::nan("")}).set("e", Complex(infinity, 0.0));
  EXPECT_EQ(read_back(r),
            json::parse(R"({"a": null, "b": null, "c": null, "d": [1, null], "e": [null, 0]})"));
}

TEST(Record, TextsAreEscaped) {
  std::string text = "quote \" backslash \\ slash / newline \n tab \t return \r L\u00e4ufer \u2300";
  for (char c = 1; c < 0x20; ++c) text += c;
  text += '\x7f';
  Record r;
  r.set("text", text).set(text, 1);
  EXPECT_EQ(read_back(r)["text"].get<std::string>(), text);
  EXPECT_TRUE(read_back(r).contains(text));
}

TEST(Record, NestsAsDeepAsItIsBuilt) {
  Record inner;
  inner.set("x", 1.0);
  for (int i = 0; i < 100; ++i) {
    Record list = Record::array(), outer;
    list.add(inner);
    list.add(nullptr);
    outer.set("list", list).set("n", i);
    inner = outer;
  }
  json tree = read_back(inner);
  for (int i = 99; i >= 0; --i) {
    EXPECT_EQ(tree["n"], i);
    tree = json(tree["list"][0]);
  }
  EXPECT_EQ(tree["x"], 1.0);
}

TEST(Record, KeysStayInTheOrderOfTheCalls) {
  Record r;
  r.set("z", 1).set("a", 2).set("m", 3);
  EXPECT_EQ(r.json(), "{\"z\": 1, \"a\": 2, \"m\": 3}\n");
}

TEST(Record, SmallThingsStayOnOneLine) {
  Record point, list = Record::array(), r;
  point.set("x_m", 1.0).set("y_m", 2.0);
  list.add(point);
  list.add(point);
  r.set("points", list).set("values", std::vector<double>{1.0, 2.0});
  EXPECT_EQ(r.json(),
            "{\n"
            "  \"points\": [\n"
            "    {\"x_m\": 1, \"y_m\": 2},\n"
            "    {\"x_m\": 1, \"y_m\": 2}\n"
            "  ],\n"
            "  \"values\": [1, 2]\n"
            "}\n");
}

}  // namespace whirl::record_test
