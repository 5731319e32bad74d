#pragma once
/// From the tree of a model file to structs, by their tables of fields; every problem is collected.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "libbase/error.hpp"
#include "libbase/numerics/linalg.hpp"
#include "libbase/structs/field.hpp"
#include "libio/model/asked_key.hpp"
#include "libio/model/config.hpp"

namespace whirl::inline io {

/// Reads one table. Keys that are read or accepted are known; `finish` reports all others.
class TableReader {
 public:
  /// @param table     null: the table is absent, everything in it is left out
  /// @param path      of the table, for messages
  /// @param problems  receives what is wrong
  /// @param asked     receives what is asked for; null: not wanted
  TableReader(const ConfigNode* table, std::string path, std::vector<Problem>& problems,
              std::vector<AskedKey>* asked = nullptr);

  bool has(std::string_view key) const { return table_ && table_->find(key); }
  /// Whether something stands here that is no table; only this is reported, and nothing inside.
  bool is_malformed() const { return is_malformed_; }
  const ConfigNode* node(std::string_view key);  ///< value of a key, which becomes known; or null
  std::string path(std::string_view key) const;
  Where where() const { return table_ ? table_->where : Where{}; }
  Where where(std::string_view key) const;  ///< of the key's value, or of the table

  /// Reads all fields of a struct. Members whose key is absent or wrong stay as they are.
  /// @param other  other(field, member) reads a member of a type that is not known here
  template <class Struct, class... Other>
  void read(Struct& to, const Other&... other) {
    std::apply([&](const auto&... field) { (read_field(to, field, other...), ...); },
               Struct::fields());
  }

  /// A physical quantity in SI; reports wrong units, ranges, a required one that is missing.
  std::optional<double> quantity(std::string_view key, std::string_view unit, Range range,
                                 bool is_required = false);
  /// The same of a value that stands in an array or an inline table.
  std::optional<double> quantity(const ConfigNode& value, const std::string& at,
                                 std::string_view unit, Range range);
  /// A list of two, such as [x, y].
  /// @param expected  for messages: "[x, y]"
  std::optional<std::array<double, 2>> pair(std::string_view key, std::string_view unit,
                                            Range range, std::string_view expected);
  /// A list of one or more.
  std::vector<double> list(std::string_view key, std::string_view unit, Range range);
  /// A matrix by its rows, all of one length, or one row: numbers without unit.
  std::optional<Mat> rows(std::string_view key, std::string_view unit = "");
  /// A matrix of two rows: one value that stands for both of the diagonal, or { xx, yy, xy, yx },
  /// of which xy and yx are zero if left out.
  /// @param range  of the one value; each of the four may be any number
  std::optional<Mat2> matrix(std::string_view key, std::string_view unit, Range range);
  std::optional<long> integer(std::string_view key, Range range, bool is_required = false);
  /// Reports a value that is more than it may be.
  void at_most(std::string_view key, long value, long most);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> string(std::string_view key, bool is_required = false);

  /// One of the names of an enum; reports the known ones otherwise.
  template <class Enum>
  std::optional<Enum> choice(std::string_view key) {
    std::vector<std::string> known;
    for (const auto& [candidate, value] : choices(Enum{})) known.emplace_back(candidate);
    const auto name = choice(key, known);
    return name ? value_named<Enum>(*name) : std::nullopt;
  }
  /// One of some names; reports any other.
  std::optional<std::string> choice(std::string_view key, const std::vector<std::string>& known);

  /// Reports a required key that is missing, as all others that would do as well are.
  void missing(std::string_view key, std::string_view expected,
               std::vector<std::string> alternatives = {});
  void problem(std::string_view key, std::string message);
  void unknown_choice(std::string_view key, const std::string& found,
                      const std::vector<std::string>& known);

  /// Reports keys that nobody asked for, with the nearest known one, and required keys that are
  /// missing, unless an unknown key was meant for one.
  void finish();

 private:
  template <class Struct, class Member, class... Other>
  void read_field(Struct& to, const Field<Struct, Member>& field, const Other&... other) {
    if (asked_) note_field(field.name, field.meaning, otherwise(to, field));
    if constexpr (std::is_same_v<Member, double>) {
      if (const auto v = quantity(field.name, field.unit, field.range, field.is_required))
        to.*field.member = *v;
    } else if constexpr (std::is_same_v<Member, int>) {
      if (const auto v = integer(field.name, field.range, field.is_required))
        to.*field.member = static_cast<int>(*v);
    } else if constexpr (std::is_same_v<Member, bool>) {
      if (const auto v = boolean(field.name)) to.*field.member = *v;
    } else if constexpr (std::is_enum_v<Member>) {
      if (const auto v = choice<Member>(field.name)) to.*field.member = *v;
    } else if constexpr (std::is_same_v<Member, Mat2>) {
      if (const auto v = matrix(field.name, field.unit, field.range)) to.*field.member = *v;
    } else if constexpr (std::is_same_v<Member, std::string>) {
      if (const auto v = string(field.name, field.is_required)) to.*field.member = *v;
    } else {
      static_assert(sizeof...(Other) > 0, "a field of a type that is not read");
      (other(field, to.*field.member), ...);
    }
  }
  /// What holds if a field is left out, as it would be written; empty: something else.
  template <class Struct, class Member>
  static std::string otherwise(const Struct& to, const Field<Struct, Member>& field) {
    if (!field.has_default) return "";
    const Member& value = to.*field.member;
    if constexpr (std::is_same_v<Member, Mat2>) {
      return value.isZero(0.0) ? "0" : "";
    } else if constexpr (std::is_same_v<Member, bool>) {
      return value ? "true" : "false";
    } else if constexpr (std::is_arithmetic_v<Member>) {
      ConfigNode number;
      number.kind = std::is_integral_v<Member> ? ConfigNode::Kind::integer : ConfigNode::Kind::real;
      number.number = value;
      return number.as_written();
    } else if constexpr (std::is_enum_v<Member>) {
      return '"' + std::string(name_of(value)) + '"';
    } else if constexpr (std::is_same_v<Member, std::string>) {
      return '"' + value + '"';
    } else {
      return "";
    }
  }
  std::optional<std::string> text(std::string_view key, bool is_required);
  void note(std::string_view key, AskedKey what);
  void note_field(std::string_view key, std::string_view meaning, std::string otherwise);

  bool in_range(const ConfigNode& value, const std::string& at, double number, Range range,
                const std::string& expected);

  const ConfigNode* table_;
  bool is_malformed_ = false;
  std::string path_;
  std::vector<Problem>& problems_;
  std::vector<AskedKey>* asked_;
  std::vector<std::string> known_;

  struct Missing {
    std::vector<std::string> keys;  ///< the key to name, and alternatives
    Problem problem;
  };
  std::vector<Missing> missing_;
};

}  // namespace whirl::inline io
