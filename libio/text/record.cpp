#include "libio/text/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "libio/text/terminal.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace {

/// A character of two or three bytes, which a terminal must not see where JSON is printed there.
std::string escaped_character(std::string_view character) {
  unsigned code =
      static_cast<unsigned char>(character[0]) & (character.size() == 2 ? 0x1fu : 0x0fu);
  for (const char byte : character.substr(1)) {
    code = code << 6u | (static_cast<unsigned char>(byte) & 0x3fu);
  }
  return fmt::format("\\u{:04x}", code);
}

std::string escaped(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const char c = text.front();
    if (static_cast<unsigned char>(c) >= 0x80) {
      const std::size_t length = character_length(text);
      if (length > 0 && steers_terminal(text.substr(0, length))) {
        out += escaped_character(text.substr(0, length));
      } else {
        out += length > 0 ? text.substr(0, length) : "\ufffd";  // JSON is UTF-8
      }
      text.remove_prefix(std::max<std::size_t>(1, length));
      continue;
    }
    text.remove_prefix(1);
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '\r':
        out += "\\r";
        break;
      default:
        if (steers_terminal({&c, 1})) {
          out += fmt::format("\\u{:04x}", static_cast<int>(c));
        } else {
          out += c;
        }
    }
  }
  return out + "\"";
}

}  // namespace

Record& Record::set(std::string_view key, Record value) {
  assert(std::holds_alternative<Object>(value_));
  std::get<Object>(value_).emplace_back(std::string(key), std::move(value));
  return *this;
}

Record& Record::merge(const Record& other) {
  for (const auto& [key, value] : std::get<Object>(other.value_)) set(key, value);
  return *this;
}

void Record::add(Record item) {
  assert(std::holds_alternative<Array>(value_));
  std::get<Array>(value_).push_back(std::move(item));
}

bool Record::is_empty() const {
  const auto* array = std::get_if<Array>(&value_);
  const auto* object = std::get_if<Object>(&value_);
  return (array && array->empty()) || (object && object->empty());
}

bool Record::is_flat() const {
  if (const auto* array = std::get_if<Array>(&value_)) {
    return std::all_of(array->begin(), array->end(), [](const Record& r) {
      return !std::holds_alternative<Object>(r.value_) && r.is_flat();
    });
  }
  if (const auto* object = std::get_if<Object>(&value_)) {
    return object->size() <= 8 && std::all_of(object->begin(), object->end(), [](const auto& e) {
             return !std::holds_alternative<Object>(e.second.value_) &&
                    !std::holds_alternative<Array>(e.second.value_);
           });
  }
  return true;
}

void Record::write(std::string& out, int depth) const {
  const auto list = [&](const auto& items, char open, char close, const auto& write_item) {
    const bool flat = is_flat();
    const std::string indent =
        flat ? "" : "\n" + std::string(static_cast<std::size_t>(2 * depth + 2), ' ');
    out += open;
    bool first = true;
    for (const auto& item : items) {
      if (!first) out += flat ? ", " : ",";
      first = false;
      out += indent;
      write_item(item);
    }
    if (!flat && !items.empty())
      out += "\n" + std::string(static_cast<std::size_t>(2 * depth), ' ');
    out += close;
  };
  struct Writer {
    const Record& self;
    std::string& out;
    decltype(list)& write_list;
    int depth;
    void operator()(std::nullptr_t) { out += "null"; }
    void operator()(bool v) { out += v ? "true" : "false"; }
    void operator()(std::int64_t v) { out += fmt::format("{}", v); }
    void operator()(double v) { out += std::isfinite(v) ? fmt::format("{}", v) : "null"; }
    void operator()(const std::string& v) { out += escaped(v); }
    void operator()(const Array& v) {
      write_list(v, '[', ']', [&](const Record& item) { item.write(out, depth + 1); });
    }
    void operator()(const Object& v) {
      write_list(v, '{', '}', [&](const auto& entry) {
        out += escaped(entry.first) + ": ";
        entry.second.write(out, depth + 1);
      });
    }
  };
  std::visit(Writer{*this, out, list, depth}, value_);
}

std::string Record::json() const {
  std::string out;
  write(out, 0);
  return out + "\n";
}

}  // namespace whirl::inline io
