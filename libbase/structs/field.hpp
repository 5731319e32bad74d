#pragma once
/// Fields: one table per struct says which keys it has, in which units and ranges, and what they
/// mean. Reader, command line, documentation and tests all work from these tables.

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace whirl::inline base {

enum class Range { any, nonnegative, positive };

/// One key of a struct.
template <class Struct, class Member>
struct Field {
  std::string_view name;     ///< key in the model file
  Member Struct::*member;    ///< where its value goes
  std::string_view unit;     ///< SI unit of the value; empty if it has none
  Range range;               ///< which numbers are allowed
  std::string_view meaning;  ///< half a sentence for the manual
  bool is_required;
  bool has_default;  ///< whether a default-constructed struct has the value of a key left out
};

template <class S, class T>
constexpr Field<S, T> required(std::string_view name, T S::*member, std::string_view unit,
                               Range range, std::string_view meaning) {
  return {name, member, unit, range, meaning, true, false};
}

template <class S, class T>
constexpr Field<S, T> optional(std::string_view name, T S::*member, std::string_view unit,
                               Range range, std::string_view meaning) {
  return {name, member, unit, range, meaning, false, true};
}

/// An optional key without a default: left out, something else is given or found, or nothing is.
template <class S, class T>
constexpr Field<S, T> alternative(std::string_view name, T S::*member, std::string_view unit,
                                  Range range, std::string_view meaning) {
  return {name, member, unit, range, meaning, false, false};
}

/// A name and the enumerator it stands for; an enum read from a file lists its `choices(Enum)`.
template <class Enum>
using Choice = std::pair<std::string_view, Enum>;

/// Name of an enumerator, from its list of choices.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::string_view name_of(Enum value) {
  for (const auto& [name, candidate] : choices(Enum{})) {
    if (candidate == value) return name;
  }
  return "?";
}

/// The enumerator of a name, from its list of choices; nothing: no choice has this name.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::optional<Enum> value_named(std::string_view name) {
  for (const auto& [candidate, value] : choices(Enum{})) {
    if (candidate == name) return value;
  }
  return std::nullopt;
}

}  // namespace whirl::inline base
