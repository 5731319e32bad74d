#include "libio/model/model_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_builder.hpp"

namespace whirl::inline io {

std::string parent_path(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}
std::string last_part(const std::string& path) {
  return path.substr(path.rfind('.') + 1);  // npos + 1 = 0
}

Key& Key::entry(const std::string& name) {
  for (auto& [known, key] : entries) {
    if (known == name) return key;
  }
  entries.push_back({name, {}});
  return entries.back().key;
}

Key& Key::at(const std::string& path) {
  return path.empty() ? *this : at(parent_path(path)).entry(last_part(path));
}

const AskedKey* Key::find(AskedKey::Form form) const {
  const auto found =
      std::find_if(asked.begin(), asked.end(), [&](const AskedKey& a) { return a.form == form; });
  return found == asked.end() ? nullptr : &*found;
}

namespace {

/// An empty table of every kind: what is missing in it is required.
constexpr const char* bare = R"(
[operation]
[material.m]
[[shaft]]
[[layer]]
[[disk]]
[[unbalance]]
[[force]]
[[probe]]
[bow]
[[body]]
[[bearing]]
[[seal]]
[[link]]
[[oil_film]]
[[contact]]
[damping]
rayleigh = {}
[reduction]
[start]
whirl = [{}]
displaced = [{}]
)";

/// Values that may be written as tables or lists, and as plain ones.
constexpr const char* as_tables = R"(
[[shaft]]
outer_diameter = [1, 1]
inner_diameter = [0, 0]
shear_coefficient = "cowper"
[[layer]]
from = {}
to = {}
outer_diameter = [1, 1]
inner_diameter = [0, 0]
shear_coefficient = "cowper"
[[disk]]
unbalance = {}
[[body]]
mass = [1, 1]
[damping]
modal = [0.1]
[[link]]
from = {}
to = {}
)";
constexpr const char* as_values = R"(
[[shaft]]
outer_diameter = 1
inner_diameter = 0
shear_coefficient = 1
[[layer]]
from = 0
to = 1
outer_diameter = 1
inner_diameter = 0
shear_coefficient = 1
[[link]]
from = ""
to = ""
)";

/// Elements of arrays are "[]", tables of any name "*".
std::string general(const std::string& path) {
  std::string result;
  std::size_t at = 0;
  for (int part = 0; at <= path.size(); ++part) {
    const auto end = std::min(path.find('.', at), path.size());
    std::string name = path.substr(at, end - at);
    if (!name.empty() &&
        std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c); }))
      name = "[]";
    if (part == 1 && result == "material") name = "*";
    result += (part > 0 ? "." : "") + name;
    at = end + 1;
  }
  return result;
}

/// What is asked for while a text is read, whatever is wrong with it.
std::vector<AskedKey> asked_in(const std::string& text) {
  std::vector<AskedKey> asked;
  ConfigNode root = parse_toml(text, "specimen");
  try {
    ModelBuilder(root, {}, &asked).build();
  } catch (const ModelError&) {
    // a specimen is no whole model
  }
  for (AskedKey& a : asked) a.path = general(a.path);
  return asked;
}

Requirements missing_in(const std::vector<AskedKey>& asked, const std::string& table) {
  Requirements found;
  for (const AskedKey& a : asked) {
    if (a.form == AskedKey::Form::missing && parent_path(a.path) == table) found.insert(a.names);
  }
  return found;
}

void insert(Key& root, const std::vector<AskedKey>& asked) {
  for (const AskedKey& a : asked) {
    Key& key = root.at(a.path);
    if (a.form != AskedKey::Form::missing && !key.find(a.form)) key.asked.push_back(a);
  }
}

std::vector<std::string> names_of(const std::vector<Key::Entry>& entries) {
  std::vector<std::string> names;
  for (const auto& [name, key] : entries) names.push_back(name);
  return names;
}

/// A key on whose value it depends what else its table holds.
struct Switch {
  const char *table, *key;
  const char* header;     ///< how the table is opened
  const char* otherwise;  ///< value if it is left out; empty: other keys tell it
};
constexpr Switch switches[] = {{"bearing.[]", "kind", "[[bearing]]", ""},
                               {"seal.[]", "kind", "[[seal]]", ""},
                               {"contact.[]", "law", "[[contact]]", "radial"},
                               {"contact.[]", "geometry", "[[contact]]", "ring"},
                               {"oil_film.[]", "law", "[[oil_film]]", "short"},
                               {"start", "from", "[start]", "static"}};

void add_switch(Key& root, const Switch& s) {
  Key& table = root.at(s.table);
  const AskedKey* choice = table.entry(s.key).find(AskedKey::Form::choice);
  const std::vector<std::string> values = choice ? choice->names : std::vector<std::string>{};
  std::vector<std::vector<std::string>> known;
  std::set<std::string> known_to_some;  // others depend on another switch
  std::vector<Condition> conditions;
  for (const std::string& value : values) {
    const auto asked = asked_in(fmt::format("{}\n{} = \"{}\"\n", s.header, s.key, value));
    insert(root, asked);
    Key alone;
    insert(alone, asked);
    known.push_back(names_of(alone.at(s.table).entries));
    known_to_some.insert(known.back().begin(), known.back().end());
    conditions.push_back({s.key, value, value == s.otherwise, missing_in(asked, s.table), {}});
  }
  // what all values need is needed anyway, and what the key itself would do for
  Requirements met_by_key;
  for (const auto& one_of : table.required) {
    if (std::find(one_of.begin(), one_of.end(), s.key) != one_of.end()) met_by_key.insert(one_of);
  }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    Requirements common = met_by_key;
    std::set_intersection(table.required.begin(), table.required.end(),
                          conditions[i].required.begin(), conditions[i].required.end(),
                          std::inserter(common, common.end()));
    table.required = common;
    for (const auto& name : names_of(table.entries)) {
      if (known_to_some.contains(name) &&
          std::find(known[i].begin(), known[i].end(), name) == known[i].end())
        conditions[i].unknown.push_back(name);
    }
  }
  Requirements shared;  // by all values: required by what another switch says
  if (!conditions.empty()) shared = conditions.front().required;
  for (const Condition& c : conditions) {
    std::erase_if(shared, [&](const auto& names) { return !c.required.contains(names); });
  }
  for (Condition& c : conditions) {
    for (const auto& always : table.required) c.required.erase(always);
    for (const auto& elsewhere : shared) c.required.erase(elsewhere);
    if (!c.required.empty() || !c.unknown.empty()) table.conditions.push_back(c);
  }
}

}  // namespace

Key model_keys() {
  Key root;
  std::set<std::string> tables;  // whose requirements are known
  for (const char* specimen : {bare, as_tables, as_values}) {
    const auto asked = asked_in(specimen);
    insert(root, asked);
    std::set<std::string> here;
    for (const AskedKey& a : asked) {
      const bool is_new = a.form == AskedKey::Form::table && !tables.contains(a.path);
      if (is_new && here.insert(a.path).second) {
        root.at(a.path).required = missing_in(asked, a.path);
      }
    }
    tables.merge(here);
  }
  for (const Switch& s : switches) add_switch(root, s);

  // a disk by its shape needs all of it
  const auto asked = asked_in("[[disk]]\nmaterial = \"\"\n");
  insert(root, asked);
  Condition by_shape{.key = "material", .required = missing_in(asked, "disk.[]")};
  Key& disk = root.at("disk.[]");
  for (const auto& always : disk.required) by_shape.required.erase(always);
  disk.conditions.push_back(by_shape);
  return root;
}

}  // namespace whirl::inline io
