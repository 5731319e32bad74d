#include "libio/model/model_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "libbase/error.hpp"
#include "libio/model/config.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/model/model_table.hpp"

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

/// Every table, with some keys of its own each.
std::string specimen(std::string_view ModelTable::*keys) {
  std::string text;
  for (const ModelTable& table : model_tables()) {
    text += fmt::format("{}\n{}", table.header(), table.*keys);
  }
  return text;
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

/// A key in whose presence others are needed.
void add_presence(Key& root, const ModelTable& of, const std::string& key) {
  const auto asked = asked_in(of.header() + "\n" + key + " = \"\"\n");
  insert(root, asked);
  Condition condition{.key = key, .required = missing_in(asked, of.path())};
  Key& table = root.at(of.path());
  for (const auto& always : table.required) condition.required.erase(always);
  table.conditions.push_back(condition);
}

void add_switch(Key& root, const ModelTable& of, const KeySwitch& s) {
  const std::string key(s.key);
  Key& table = root.at(of.path());
  const AskedKey* choice = table.entry(key).find(AskedKey::Form::choice);
  if (!choice) return add_presence(root, of, key);
  const std::vector<std::string> values = choice->names;
  std::vector<std::vector<std::string>> known;
  std::set<std::string> known_to_some;  // others depend on another switch
  std::vector<Condition> conditions;
  for (const std::string& value : values) {
    const auto asked = asked_in(fmt::format("{}\n{} = \"{}\"\n", of.header(), key, value));
    insert(root, asked);
    Key alone;
    insert(alone, asked);
    known.push_back(names_of(alone.at(of.path()).entries));
    known_to_some.insert(known.back().begin(), known.back().end());
    conditions.push_back({key, value, value == s.otherwise, missing_in(asked, of.path()), {}});
  }
  // what all values need is needed anyway, and what the key itself would do for
  Requirements met_by_key;
  for (const auto& one_of : table.required) {
    if (std::find(one_of.begin(), one_of.end(), key) != one_of.end()) met_by_key.insert(one_of);
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
  for (const auto keys : {&ModelTable::bare, &ModelTable::as_tables, &ModelTable::as_values}) {
    const auto asked = asked_in(specimen(keys));
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
  for (const ModelTable& table : model_tables()) {
    for (const KeySwitch& s : table.switches) add_switch(root, table, s);
  }
  return root;
}

}  // namespace whirl::inline io
