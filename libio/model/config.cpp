#include "libio/model/config.hpp"

#define TOML_HEADER_ONLY 0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "libio/model/meant_path.hpp"
#include "libio/text/nearest.hpp"

namespace whirl::inline io {

namespace {

Where place(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

constexpr int most_parts = 16;   ///< of a key; contact.ring.stiffness has three
constexpr int most_nested = 32;  ///< tables and arrays within one another

/// @param depth  of the tables and arrays that it lies in
ConfigNode convert(const toml::node& node, const std::string& file, int depth = 0) {
  ConfigNode result;
  result.where = place(node.source(), file);
  if (depth > most_nested) {
    throw ModelError(result.where, "",
                     fmt::format("more than {} tables or lists within one another", most_nested));
  }
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      ConfigNode entry = convert(value, file, depth + 1);
      entry.key_where = place(key.source(), file);
      if (entry.where.line == 0) entry.where = entry.key_where;
      result.entries.push_back({std::string(key.str()), std::move(entry)});
    }
    std::stable_sort(result.entries.begin(), result.entries.end(),
                     [](const auto& a, const auto& b) {
                       const Where &x = a.value.key_where, &y = b.value.key_where;
                       return std::pair(x.line, x.column) < std::pair(y.line, y.column);
                     });
  } else if (const auto* array = node.as_array()) {
    result.kind = ConfigNode::Kind::array;
    for (const toml::node& item : *array) result.items.push_back(convert(item, file, depth + 1));
  } else if (const auto* text = node.as_string()) {
    result.kind = ConfigNode::Kind::string;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = ConfigNode::Kind::integer;
    result.number = static_cast<double>(integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    result.kind = ConfigNode::Kind::real;
    result.number = real->get();
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = ConfigNode::Kind::boolean;
    result.boolean = boolean->get();
  } else {
    result.kind = ConfigNode::Kind::other;
  }
  return result;
}

/// toml++ says "Error while parsing string: ..."; people need to know what is wrong with the text.
std::string syntax_message(const toml::parse_error& error) {
  const std::string what(error.description());
  if (what.find("unescaped control character") != std::string::npos) {
    return "not TOML: a text without closing quotation mark, or with a control character in it";
  }
  constexpr std::string_view start = "Error while parsing ";
  return "not TOML: " + (what.starts_with(start) ? what.substr(start.size()) : what);
}

bool is_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
}

/// Passes over what stands between quotation marks, three of them or one.
/// @param at  the first of them; on return behind the last one, or at the end of the text
void pass_string(std::string_view text, std::size_t& at) {
  const char mark = text[at];
  const std::string three(3, mark);
  const bool is_long = text.substr(at, 3) == three;
  const std::string_view end = is_long ? std::string_view(three) : std::string_view(&mark, 1);
  for (at += end.size(); at < text.size(); ++at) {
    if (text[at] == '\\' && mark == '"') {
      ++at;
    } else if (text.substr(at, end.size()) == end) {
      at += end.size();
      return;
    } else if (text[at] == '\n' && !is_long) {
      return;  // never closed: that is for the parser to say
    }
  }
  at = std::min(at, text.size());
}

/// Refuses keys of too many parts: toml++ makes a table of each, calls itself for every one of them
/// and would leave the stack.
void check_keys(std::string_view text, const Where& where) {
  int parts = 1, line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const std::size_t from = at;
      pass_string(text, at);
      line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(from),
                                          text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '\n') ++line;
    if (c == '.') {
      ++parts;
    } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
      parts = 1;
    }
    if (parts > most_parts) {
      throw ModelError(where.line == 0 ? where : Where{where.file, line, 1}, "",
                       fmt::format("a key of more than {} parts", most_parts));
    }
    ++at;
  }
}

}  // namespace

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        result += "\\\"";
        break;
      case '\\':
        result += "\\\\";
        break;
      case '\n':
        result += "\\n";
        break;
      case '\r':
        result += "\\r";
        break;
      case '\t':
        result += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
          result += fmt::format("\\u{:04X}", static_cast<int>(c));
        } else {
          result += c;
        }
    }
  }
  return result + "\"";
}

std::string toml_key(std::string_view key) {
  const bool is_bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return is_bare ? std::string(key) : toml_text(key);
}

namespace {

std::string number_text(const ConfigNode& node) {
  if (node.kind == ConfigNode::Kind::integer) return fmt::format("{:.0f}", node.number);
  if (!std::isfinite(node.number))
    return std::isnan(node.number) ? "nan" : node.number > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", node.number);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string inline_text(const ConfigNode& node) {
  std::string text;
  switch (node.kind) {
    case ConfigNode::Kind::string:
      return toml_text(node.text);
    case ConfigNode::Kind::integer:
    case ConfigNode::Kind::real:
      return number_text(node);
    case ConfigNode::Kind::boolean:
      return node.boolean ? "true" : "false";
    case ConfigNode::Kind::other:
      return toml_text("");
    case ConfigNode::Kind::array:
      for (const ConfigNode& item : node.items)
        text += (text.empty() ? "" : ", ") + inline_text(item);
      return "[" + text + "]";
    case ConfigNode::Kind::table:
      break;
  }
  for (const auto& [key, value] : node.entries) {
    text += (text.empty() ? "" : ", ") + toml_key(key) + " = " + inline_text(value);
  }
  return "{ " + text + " }";
}

bool is_array_of_tables(const ConfigNode& node) {
  return node.kind == ConfigNode::Kind::array && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const ConfigNode& n) { return n.kind == ConfigNode::Kind::table; });
}

/// Tables of tables (material.steel) get headers of their own, others stay inline below the top.
void write_table(const ConfigNode& table, const std::string& path, std::string& out) {
  const bool has_headers =
      path.empty() || std::all_of(table.entries.begin(), table.entries.end(), [](const auto& e) {
        return e.value.kind == ConfigNode::Kind::table;
      });
  for (const auto& [key, value] : table.entries) {
    const bool is_table = value.kind == ConfigNode::Kind::table;
    if (has_headers && (is_table || (path.empty() && is_array_of_tables(value)))) continue;
    out += toml_key(key) + " = " + inline_text(value) + "\n";
  }
  if (!has_headers) return;
  for (const auto& [key, value] : table.entries) {
    const std::string inner = path.empty() ? toml_key(key) : path + "." + toml_key(key);
    if (value.kind == ConfigNode::Kind::table) {
      const bool only_tables =
          !value.entries.empty() &&
          std::all_of(value.entries.begin(), value.entries.end(),
                      [](const auto& e) { return e.value.kind == ConfigNode::Kind::table; });
      if (!only_tables || !path.empty()) out += "\n[" + inner + "]\n";
      write_table(value, inner, out);
    } else if (path.empty() && is_array_of_tables(value)) {
      for (const ConfigNode& item : value.items) {
        out += "\n[[" + inner + "]]\n";
        for (const auto& [k, v] : item.entries) out += toml_key(k) + " = " + inline_text(v) + "\n";
      }
    }
  }
}

/// Parts of a path between dots; a part in quotation marks may contain dots.
std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts(1);
  bool in_quotes = false;
  for (const char c : path) {
    if (c == '"') {
      in_quotes = !in_quotes;
    } else if (c == '.' && !in_quotes) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The element of an array that a name or a number from 1 stands for.
ConfigNode& element(ConfigNode& array, const std::string& part, const std::string& path,
                    const Where& where) {
  std::vector<std::string> names;
  for (ConfigNode& item : array.items) {
    const ConfigNode* name = item.find("name");
    if (!name) continue;
    if (name->text == part) return item;
    names.push_back(name->text);
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  const bool is_number = error == std::errc{} && end == part.data() + part.size();
  if (is_number && number >= 1 && number <= array.items.size()) return array.items[number - 1];
  std::string hint;
  if (is_number) {
    hint = fmt::format("expected a number from 1 to {}", array.items.size());
  } else if (const auto near = nearest(part, names)) {
    hint = fmt::format("did you mean \"{}\"?", *near);
  } else {
    hint = names.empty() ? "its elements have no names, use numbers from 1"
                         : fmt::format("there are \"{}\"", fmt::join(names, "\", \""));
  }
  throw ModelError(where, path, fmt::format("there is no element \"{}\"; {}", part, hint));
}

bool is_matrix_entry(const std::string& key) {
  return key == "xx" || key == "yy" || key == "xy" || key == "yx";
}

/// Turns one value that stands for both of a diagonal into a table of these, so that an entry can
/// be set beside them.
void make_matrix(ConfigNode& node) {
  using enum ConfigNode::Kind;
  if (node.kind != integer && node.kind != real && node.kind != string) return;
  const ConfigNode diagonal = node;
  node.kind = table;
  node.text.clear();
  node.entries = {{"xx", diagonal}, {"yy", diagonal}};
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

ConfigNode* ConfigNode::find(std::string_view key) {
  return const_cast<ConfigNode*>(std::as_const(*this).find(key));
}

std::string ConfigNode::as_written() const {
  switch (kind) {
    case Kind::table:
      return "a table";
    case Kind::array:
      return "an array";
    case Kind::other:
      return "a date or time";
    default:
      break;
  }
  std::string written = inline_text(*this);
  if (written.size() > 60) written = written.substr(0, 57) + "...";
  return written;
}

ConfigNode parse_toml(std::string_view text, const std::string& file) {
  if (!is_text(text))
    throw ModelError({file}, "", "this is not a text file; expected a model file (TOML)");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw ModelError({file}, "",
                     "the file is empty; expected a model file beginning with format = 1");
  }
  check_keys(text, {file, 1, 1});
  try {
    const toml::table table = toml::parse(text, std::string_view(file));
    ConfigNode root = convert(table, file);
    root.where = {file, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    throw ModelError(place(error.source(), file), "", syntax_message(error));
  }
}

void set_value(ConfigNode& root, std::string_view assignment) {
  const auto equals = assignment.find('=');
  const Where where{.file = "--set " + std::string(assignment),
                    .set = std::string(assignment.substr(0, equals))};
  if (equals == std::string_view::npos || equals == 0) {
    throw ModelError(where, "", "expected PATH=VALUE, such as contact.seal.friction=0.1");
  }
  const std::string path(assignment.substr(0, equals));
  const std::string text(assignment.substr(equals + 1));
  ConfigNode value;
  check_keys(text, where);
  try {
    const toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() != 1) throw ModelError(where, path, "expected one value");
    value = convert(*parsed.get("value"), "");
  } catch (const toml::parse_error&) {
    value.kind = ConfigNode::Kind::string;
    value.text = text;
  }
  const auto relocate = [&](auto&& self, ConfigNode& node) -> void {
    node.where = node.key_where = where;
    for (auto& [key, entry] : node.entries) self(self, entry);
    for (ConfigNode& item : node.items) self(self, item);
  };
  relocate(relocate, value);

  ConfigNode* node = &root;
  const std::vector<std::string> parts = split_path(path);
  if (parts.size() > most_parts) {
    throw ModelError(where, "", fmt::format("a path has {} parts at most", most_parts));
  }
  if (parts.size() == 1 && !root.find(path)) throw_if_meant(root, path, path, where);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_last = i + 1 == parts.size();
    if (node->kind == ConfigNode::Kind::array) {
      node = &element(*node, parts[i], path, where);
      if (is_last) *node = value;
      continue;
    }
    if (is_last && is_matrix_entry(parts[i])) make_matrix(*node);
    if (node->kind != ConfigNode::Kind::table) {
      throw ModelError(where, path,
                       fmt::format("\"{}\" is not a table and has no entries", parts[i - 1]));
    }
    ConfigNode* next = node->find(parts[i]);
    if (!next) {
      node->entries.push_back({parts[i], {}});
      next = &node->entries.back().value;
      next->where = next->key_where = where;
    }
    if (is_last) {
      *next = value;
    }
    node = next;
  }
}

const ConfigNode& value_at(ConfigNode& root, std::string_view asked) {
  const std::string path(asked);
  ConfigNode* node = &root;
  for (const std::string& part : split_path(path)) {
    if (node->kind == ConfigNode::Kind::array) {
      node = &element(*node, part, path, {});
      continue;
    }
    ConfigNode* const next = node->find(part);
    if (next) {
      node = next;
      continue;
    }
    std::vector<std::string> names;
    for (const auto& [key, value] : node->entries) names.push_back(key);
    if (node == &root) throw_if_meant(root, part, path, {});
    const auto near = nearest(part, names);
    throw ModelError({}, path,
                     near ? fmt::format("is not in the model; did you mean \"{}\"?", *near)
                     : names.empty() ? std::string("is not in the model")
                                     : fmt::format("is not in the model; there are \"{}\"",
                                                   fmt::join(names, "\", \"")));
  }
  return *node;
}

std::string to_toml(const ConfigNode& root) {
  std::string out;
  write_table(root, "", out);
  return out;
}

}  // namespace whirl::inline io
