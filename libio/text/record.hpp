#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "libbase/numerics/linalg.hpp"

namespace whirl::inline io {

/// An ordered tree of named values: what a verb found, for JSON. Keys carry their unit (_rpm, _m).
class Record {
 public:
  using Array = std::vector<Record>;
  using Object = std::vector<std::pair<std::string, Record>>;

  Record() : value_(Object{}) {}  ///< an empty object
  Record(std::nullptr_t) : value_(nullptr) {}
  Record(bool value) : value_(value) {}
  Record(double value) : value_(value) {}  ///< NaN and infinity become null
  Record(int value) : value_(static_cast<std::int64_t>(value)) {}
  Record(long value) : value_(static_cast<std::int64_t>(value)) {}
  Record(const char* text) : value_(std::string(text)) {}
  Record(std::string text) : value_(std::move(text)) {}
  Record(std::string_view text) : value_(std::string(text)) {}
  Record(Array items) : value_(std::move(items)) {}
  Record(Complex value) : value_(Array{value.real(), value.imag()}) {}
  Record(const Vec& values) : Record(Array(values.begin(), values.end())) {}
  Record(const std::vector<double>& values) : Record(Array(values.begin(), values.end())) {}

  /// Sets an entry of an object, in the order of the calls.
  Record& set(std::string_view key, Record value);
  /// Adds the entries of another object.
  Record& merge(const Record& other);
  /// Adds an item to an array.
  void add(Record item);
  static Record array() { return Record(Array{}); }
  /// Whether it is an object or array without entries.
  bool is_empty() const;

  /// Text of the tree; small objects and arrays of numbers stay on one line.
  std::string json() const;

 private:
  void write(std::string& out, int depth) const;
  bool is_flat() const;

  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, Array, Object> value_;
};

}  // namespace whirl::inline io
