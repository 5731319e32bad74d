#pragma once
/// The keys of model files, as a tree: what the reader asks for.

#include <set>
#include <string>
#include <vector>

#include "libio/model/asked_key.hpp"

namespace whirl::inline io {

/// Sets of keys of which one is required in a table.
using Requirements = std::set<std::vector<std::string>>;

/// What a value of a key changes in its table: what else is needed, what is not known.
struct Condition {
  std::string key{}, value{};  ///< no value: it is enough that the key is there
  bool is_default = false;     ///< whether it also holds if the key is left out
  Requirements required{};
  std::vector<std::string> unknown{};
};

/// A key with all ways to write its value, and the keys in it.
struct Key {
  struct Entry;
  std::vector<AskedKey> asked;
  std::vector<Entry> entries;
  Requirements required;
  std::vector<Condition> conditions;

  Key& entry(const std::string& name);  ///< made if it is not there
  Key& at(const std::string& path);     ///< likewise
  const AskedKey* find(AskedKey::Form form) const;
};

struct Key::Entry {
  std::string name;
  Key key;
};

/// All keys, from the reader as it reads specimens of every kind of table. Elements of arrays are
/// "[]", tables of any name "*": contact.[].stiffness.xx, material.*.density.
Key model_keys();

/// Path of the table that a key is in; empty at the top.
std::string parent_path(const std::string& path);
/// Name of a key, without the path of its table.
std::string last_part(const std::string& path);

}  // namespace whirl::inline io
