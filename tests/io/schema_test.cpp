// The schema of model files: it names the keys, units and defaults of the manual, no more, no less.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "libio/model/model_schema.hpp"

namespace whirl::schema_test {

using nlohmann::json;

std::string manual() {
  std::ifstream file(std::filesystem::path(WHIRL_SOURCE_DIR) / "docs/model-file.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

const json& schema() {
  static const json tree = json::parse(model_schema().json());
  return tree;
}

/// Schema of a table: of an element of an array, of a material.
const json& table_of(const json& key) {
  if (key.contains("items")) return key["items"];
  return key.contains("additionalProperties") && key["additionalProperties"].is_object()
             ? key["additionalProperties"]
             : key;
}

/// A row of the manual's tables: a key, and what stands for its unit and its default.
struct Row {
  std::string key, unit, otherwise;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 1; at < line.size();) {
    const auto bar = std::min(line.find('|', at), line.size());
    std::string cell = line.substr(at, bar - at);
    const auto first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    at = bar + 1;
  }
  return cells;
}

/// Rows of the sections "## `[[disk]]`" and "## Top of the file" by table, and their texts.
struct Section {
  std::vector<Row> rows;
  std::string text;
};
std::map<std::string, Section> sections() {
  std::map<std::string, Section> found;
  const std::string text = manual();
  const std::regex heading(R"(\n## (?:`\[{1,2}(\w+)(?:\.NAME)?\]{1,2}`|(Top of the file))\n)");
  const std::regex key(R"(`(\w+)`)");
  for (std::sregex_iterator s(text.begin(), text.end(), heading), end; s != end; ++s) {
    const auto from = static_cast<std::size_t>(s->position() + s->length());
    Section section{{}, text.substr(from, text.find("\n## ", from) - from)};
    std::istringstream lines(section.text);
    bool has_units = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("| key | SI unit | default")) has_units = true;
      if (!line.starts_with("|")) has_units = false;
      const auto cells = cells_of(line);
      if (!has_units || cells.size() < 4 || !cells[0].starts_with("`")) continue;
      for (std::sregex_iterator k(cells[0].begin(), cells[0].end(), key); k != end; ++k) {
        section.rows.push_back({(*k)[1], cells[1], cells[2]});
      }
    }
    // keys that a law adds, in rows that begin with its name
    const std::regex law(R"re(\n\| `"[\w-]+"` \|[^|]*\|([^|]*)\|)re");
    const std::string whole = section.text;
    auto at = whole.cbegin();
    for (std::smatch row; std::regex_search(at, whole.cend(), row, law); at = row[0].second) {
      const std::string cell = row[1];
      for (std::sregex_iterator k(cell.begin(), cell.end(), key); k != end; ++k) {
        section.rows.push_back({(*k)[1], "?", "?"});
      }
    }
    found[(*s)[1]] = section;
  }
  return found;
}

/// Properties of a table of the manual; of the top without the tables.
json keys_of(const std::string& table) {
  if (!table.empty()) return table_of(schema()["properties"][table])["properties"];
  json top = schema()["properties"];
  for (const auto& [name, section] : sections()) top.erase(name);
  return top;
}

TEST(Schema, HasEveryKeyOfTheManual) {
  int rows = 0;
  for (const auto& [table, section] : sections()) {
    const json keys = keys_of(table);
    for (const Row& row : section.rows) {
      EXPECT_TRUE(keys.contains(row.key)) << table << "." << row.key;
      ++rows;
    }
  }
  EXPECT_GT(rows, 80);
}

// A disk has `body` in the reader, which then says that it sits on the shaft.
TEST(Schema, HasNoKeyThatTheManualDoesNotName) {
  const auto all = sections();
  const json tables = schema()["properties"];
  for (const auto& [name, key] : tables.items()) {
    const bool is_table = all.contains(name);
    const std::string table = is_table ? name : "";
    const json keys = is_table ? keys_of(name) : json{{name, key}};
    for (const auto& [inner, value] : keys.items()) {
      if (table == "disk" && inner == "body") continue;
      const auto& rows = all.at(table).rows;
      EXPECT_TRUE(std::any_of(rows.begin(), rows.end(),
                              [&, k = inner](const Row& row) { return row.key == k; }))
          << table << "." << inner;
      // tables within tables are described in the text
      for (const json& form : value.contains("anyOf") ? value["anyOf"] : json::array({value})) {
        const json parts = table_of(form).value("properties", json::object());
        for (const auto& [part, ignored] : parts.items()) {
          EXPECT_TRUE(std::regex_search(all.at(table).text, std::regex("\\b" + part + "\\b")) ||
                      std::regex_search(all.at("bearing").text, std::regex("\\b" + part + "\\b")) ||
                      std::set<std::string>({"at", "node", "body"}).contains(part))
              << table << "." << inner << "." << part;
        }
      }
    }
  }
}

TEST(Schema, HasTheDefaultsOfTheManual) {
  int defaults = 0;
  for (const auto& [table, section] : sections()) {
    const json keys = keys_of(table);
    for (const Row& row : section.rows) {
      std::string text = row.otherwise;
      std::erase(text, '`');
      const json expected = json::parse(text, nullptr, false);
      const json key = keys.value(row.key, json{});
      if (!expected.is_discarded()) {
        ++defaults;
        EXPECT_EQ(key.value("default", json{}), expected) << table << "." << row.key;
      } else if (row.otherwise != "?" && row.otherwise != "") {
        EXPECT_FALSE(key.contains("default")) << table << "." << row.key;
      }
    }
  }
  EXPECT_GT(defaults, 30);
}

TEST(Schema, HasTheUnitsOfTheManual) {
  int units = 0;
  for (const auto& [table, section] : sections()) {
    const json keys = keys_of(table);
    for (const Row& row : section.rows) {
      if (row.unit.empty() || row.unit == "?") continue;
      const std::string description = keys.value(row.key, json{}).value("description", "");
      // offsets are pairs, whose items have the unit
      if (keys.value(row.key, json{}).dump().find("maxItems") != std::string::npos) continue;
      EXPECT_TRUE(description.ends_with("[" + row.unit + "]"))
          << table << "." << row.key << ": " << description;
      ++units;
    }
  }
  EXPECT_GT(units, 30);
}

TEST(Schema, SaysWhatEveryKeyMeans) {
  int keys = 0;
  const auto walk = [&](auto&& self, const json& part, const std::string& path) -> void {
    if (part.is_object() && part.contains("properties") && part.contains("type")) {
      EXPECT_EQ(part["additionalProperties"], false) << path;
      for (const auto& [name, key] : part["properties"].items()) {
        ++keys;
        EXPECT_NE(key.value("description", ""), "") << path << "." << name;
      }
    }
    if (part.is_structured()) {
      for (const auto& [name, inner] : part.items()) self(self, inner, path + "." + name);
    }
  };
  walk(walk, schema(), "");
  EXPECT_GT(keys, 100);
}

// What a text with a unit may look like: symbols of the dimension, products and powers of any.
TEST(Schema, KnowsHowQuantitiesAreWritten) {
  const auto matches = [](const std::string& unit, Range range, const std::string& text) {
    const json q = json::parse(quantity_schema(unit, range).json());
    return std::regex_search(text, std::regex(q["anyOf"][1]["pattern"].get<std::string>()));
  };
  for (const char* good : {"20 mm", "20mm", "-3.5e-2 m", "1 in", ".5 ft", "12", "+7 um", "7 µm",
                           "2 m^2/m", "3 1/m^-1", "1e3"}) {
    EXPECT_TRUE(matches("m", Range::any, good)) << good;
  }
  for (const char* bad : {"20 kg", "20 mmm", "", "mm", "1,5 mm", "20 rpm", "nan", "1 m/"}) {
    EXPECT_FALSE(matches("m", Range::any, bad)) << bad;
  }
  for (const char* good : {"4 MN/m", "4e6 N/m", "4 N.m^-1", "4 kg/s^2", "4 lbf/in", "4"}) {
    EXPECT_TRUE(matches("N/m", Range::nonnegative, good)) << good;
  }
  for (const char* bad : {"-4 MN/m", "4 N", "4 MN"}) {
    EXPECT_FALSE(matches("N/m", Range::nonnegative, bad)) << bad;
  }
  for (const char* bad : {"0 mm", "0.0 mm", "-1 mm", "0e5"}) {
    EXPECT_FALSE(matches("m", Range::positive, bad)) << bad;
  }
  for (const char* good : {"0.01 mm", "10 mm", "1e-9", "05 mm"}) {
    EXPECT_TRUE(matches("m", Range::positive, good)) << good;
  }
  EXPECT_TRUE(matches("rad", Range::any, "30°"));
  EXPECT_TRUE(matches("", Range::any, "0.3"));
  EXPECT_FALSE(matches("", Range::any, "0.3 m"));
}

}  // namespace whirl::schema_test
