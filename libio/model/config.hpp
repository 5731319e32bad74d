#pragma once
/// The tree of a model file: values with their places, before anything is made of them.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/error.hpp"

namespace whirl::inline io {

/// A value of a model file, or a table or array of them.
struct ConfigNode {
  struct Entry;  ///< a key of a table and its value
  enum class Kind { table, array, string, integer, real, boolean, other };
  Kind kind = Kind::table;
  std::string text;     ///< of a string
  double number = 0.0;  ///< of an integer or real
  bool boolean = false;
  std::vector<Entry> entries;     ///< of a table, in the order of the file
  std::vector<ConfigNode> items;  ///< of an array
  Where where;                    ///< of the value
  Where key_where;                ///< of the key in front of it

  const ConfigNode* find(std::string_view key) const;
  ConfigNode* find(std::string_view key);

  /// The value as it would be written, for messages.
  std::string as_written() const;
};

struct ConfigNode::Entry {
  std::string key;
  ConfigNode value;
};

/// Parses TOML.
///
/// A key may have 16 parts ("a.b.c" has three), and 32 tables or arrays may lie within one another:
/// more than any model has, and few enough for the stack.
///
/// @param file  name for messages
/// @throws ModelError  with the place of a syntax error, for an empty text and for one that is
///                     no text, and for keys or tables that are nested too deep
ConfigNode parse_toml(std::string_view text, const std::string& file);

/// Sets a value by its path, as the command line does: "contact.seal.friction=0.1".
///
/// Elements of arrays go by name or by number from 1. The value is read as TOML where it is TOML,
/// else as a string. Tables that do not exist yet are made; elements of arrays are not.
///
/// @throws ModelError  for a line without "=", an element that does not exist, a path of more than
///                     16 parts
void set_value(ConfigNode& root, std::string_view assignment);

/// The value at a path as set_value takes one.
///
/// @throws ModelError  if there is no such value, saying what is there instead
const ConfigNode& value_at(ConfigNode& root, std::string_view path);

/// A text between quotation marks, as TOML has it.
std::string toml_text(std::string_view text);
/// A key as TOML has it: without quotation marks if it needs none.
std::string toml_key(std::string_view key);
/// The tree as TOML.
std::string to_toml(const ConfigNode& root);

}  // namespace whirl::inline io
