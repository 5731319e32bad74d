#include "libio/model/model_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "libio/model/model_keys.hpp"
#include "libio/model/model_table.hpp"

namespace whirl::inline io {

namespace {

// ---- words ----

/// Meanings of keys at the top, and of those that mean the same in every table that has them.
constexpr KeyNote common_notes[] = {
    {"format", "format of the file"},
    {"title", "text for tables and pictures"},
    {"gravity", "acceleration along -y; left out: none", "0"},
    {"material.*", "a material; segments, layers and disks name it"},
    {"x", "moved aside along x", "0"},
    {"y", "moved aside along y", "0"},
    {"vx", "thrown along x", "0"},
    {"vy", "thrown along y", "0"},
    {"name", "for messages, --set and --stations"},
    {"at", "position along the shaft, from its left end; the mesh gets a node there"},
    {"node", "node number from 1, for meshes with given elements"},
    {"rotor", "name of the [[rotor]] that is meant; left out: the first shaft"},
    {"body", "name of a [[body]]"},
    {"moment", "mass times eccentricity"},
    {"offset", "eccentricity: of the disk's or the body's mass"},
    {"phase", "angle from +x at t = 0", "0"},
    {"to", "\"ground\", or the name of a body", "\"ground\""},
    {"from", "name of a body, \"ground\", or a table with a station"},
    {"against", "\"ground\", or the name of a body", "\"ground\""},
    {"xx", "force along x by a motion along x"},
    {"yy", "force along y by a motion along y"},
    {"xy", "force along x by a motion along y", "0"},
    {"yx", "force along y by a motion along x", "0"},
    {"rigid", "pins x and y", "false"},
    {"clamped", "pins x, y and the tilts", "false"},
};

/// What tables say of themselves and their keys, by paths.
std::map<std::string, KeyNote> notes_of_tables() {
  std::map<std::string, KeyNote> notes;
  for (const ModelTable& table : model_tables()) {
    notes[std::string(table.name)] = {table.name, table.meaning};
    for (const KeyNote& note : table.notes) {
      notes[table.path() + "." + std::string(note.key)] = note;
    }
  }
  return notes;
}

const KeyNote* note_of(const std::string& path) {
  static const std::map<std::string, KeyNote> of_tables = notes_of_tables();
  if (const auto found = of_tables.find(path); found != of_tables.end()) return &found->second;
  const auto is_it = [&](const KeyNote& note) {
    return note.key == path || note.key == last_part(path);
  };
  const auto found = std::ranges::find_if(common_notes, is_it);
  return found == std::end(common_notes) ? nullptr : &*found;
}

/// A plain value as it is written in TOML.
Record literal(std::string_view text) {
  if (text == "true" || text == "false") return Record(text == "true");
  if (text.front() == '"') return Record(text.substr(1, text.size() - 2));
  if (text == "[0, 0]") return Record(Record::Array{0, 0});
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return Record(number);
}

// ---- JSON ----

Record strings(const std::vector<std::string>& texts) {
  Record list = Record::array();
  for (const std::string& text : texts) list.add(text);
  return list;
}

Record needed(const std::vector<std::string>& one_of) {
  if (one_of.size() == 1) return Record().set("required", strings(one_of));
  Record list = Record::array();
  for (const std::string& key : one_of) list.add(Record().set("required", strings({key})));
  return Record().set("anyOf", list);
}

Record condition_schema(const Condition& c) {
  Record condition, effect, keys;
  if (!c.value.empty()) {
    condition.set("properties", Record().set(c.key, Record().set("const", c.value)));
  }
  if (!c.is_default) condition.set("required", strings({c.key}));
  Record all = Record::array();
  for (const auto& one_of : c.required) all.add(needed(one_of));
  if (!c.required.empty()) effect.set("allOf", all);
  for (const std::string& key : c.unknown) keys.set(key, false);
  if (!c.unknown.empty()) effect.set("properties", keys);
  return Record().set("if", condition).set("then", effect);
}

class SchemaWriter {
 public:
  /// Schema of a table.
  Record table_schema(const Key& key, const std::string& path) {
    Record schema, properties;
    schema.set("type", "object");
    for (const auto& [name, entry] : key.entries) {
      const std::string inner = path.empty() ? name : path + "." + name;
      if (name == "*") {
        schema.set("additionalProperties", described(table_schema(entry, inner), entry, inner));
        return schema;
      }
      properties.set(name, value(entry, inner));
    }
    schema.set("properties", properties);
    schema.set("additionalProperties", false);
    std::vector<std::string> single;
    Record all = Record::array();
    bool has_more = false;
    for (const auto& one_of : key.required) {
      if (one_of.size() == 1) single.push_back(one_of.front());
    }
    for (const auto& one_of : key.required) {
      if (one_of.size() == 1) continue;
      has_more = true;
      all.add(needed(one_of));
    }
    for (const Condition& c : key.conditions) {
      has_more = true;
      all.add(condition_schema(c));
    }
    if (path.empty()) {
      has_more = true;
      all.add(needed({"shaft", "body"}));
    }
    if (!single.empty()) schema.set("required", strings(single));
    if (has_more) schema.set("allOf", all);
    return schema;
  }

  Record definitions() const {
    Record all;
    for (const auto& [name, schema] : definitions_) all.set(name, schema);
    return all;
  }

 private:
  Record value(const Key& key, const std::string& path) {
    using enum AskedKey::Form;
    Record forms = Record::array();
    int count = 0;
    Record last;
    const auto add = [&](const Record& form) {
      forms.add(form);
      last = form;
      ++count;
    };
    if (path == "format") return described(Record().set("const", 1), key, path);
    const bool is_list = !key.entries.empty() && key.entries.front().name == "[]";
    bool has_reference = false;
    for (const AskedKey& a : key.asked) {
      if (a.form == quantity || a.form == pair || a.form == list || a.form == rows) {
        has_reference = true;
      }
      if (a.form == quantity) add(reference(a));
      if (a.form == pair) {
        add(Record()
                .set("type", "array")
                .set("items", reference(a))
                .set("minItems", 2)
                .set("maxItems", 2));
      }
      const auto listed = [](const Record& items) {
        return Record().set("type", "array").set("items", items).set("minItems", 1);
      };
      if (a.form == list || a.form == rows) add(listed(reference(a)));
      if (a.form == rows) add(listed(listed(reference(a))));
      if (a.form == integer) {
        Record form;
        form.set("type", "integer");
        if (a.range == Range::positive) form.set("minimum", 1);
        if (a.range == Range::nonnegative) form.set("minimum", 0);
        if (const AskedKey* l = key.find(limit)) form.set("maximum", l->most);
        add(form);
      }
      if (a.form == boolean) add(Record().set("type", "boolean"));
      if (a.form == text) add(Record().set("type", "string"));
      if (a.form == choice) add(Record().set("enum", strings(a.names)));
    }
    if (is_list) {
      const Key& item = key.entries.front().key;
      add(Record().set("type", "array").set("items", table_schema(item, path + ".[]")));
    } else if (key.find(AskedKey::Form::table) || !key.entries.empty()) {
      add(table_schema(key, path));
    }
    // in draft 7 nothing counts beside a reference
    if (count == 1 && !has_reference) return described(last, key, path);
    return described(Record().set("anyOf", forms), key, path);
  }

  /// With the meaning of the key, and what holds if it is left out.
  static Record described(Record schema, const Key& key, const std::string& path) {
    const AskedKey* field = key.find(AskedKey::Form::field);
    const KeyNote* note = field ? nullptr : note_of(path);
    std::string meaning(field ? field->meaning : note ? note->meaning : "");
    const std::string_view otherwise = field ? field->otherwise : note ? note->otherwise : "";
    const AskedKey* q = key.find(AskedKey::Form::quantity);
    if (q && !q->unit.empty()) meaning += " [" + q->unit + "]";
    if (!meaning.empty()) schema.set("description", meaning);
    if (!otherwise.empty() && otherwise != "\"\"") schema.set("default", literal(otherwise));
    return schema;
  }

  Record reference(const AskedKey& a) {
    const std::string name = quantity_definition(a.unit, a.range);
    definitions_.try_emplace(name, quantity_schema(a.unit, a.range));
    return Record().set("$ref", "#/definitions/" + name);
  }

  std::map<std::string, Record> definitions_;
};

}  // namespace

Record model_schema() {
  const Key root = model_keys();
  SchemaWriter writer;
  Record schema;
  schema.set("$schema", "http://json-schema.org/draft-07/schema#");
  schema.set("title", "whirl model");
  schema.set("description", "A rotor, what it may touch, and how it is run: docs/model-file.md");
  const Record table = writer.table_schema(root, "");
  schema.merge(table);
  schema.set("definitions", writer.definitions());
  return schema;
}

}  // namespace whirl::inline io
