#pragma once
/// Families: lists of structs that have a name and a table of fields, as alternatives of a variant.

#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace whirl::inline base {

/// Calls f with every member of a family, default-constructed, in the order of the list.
template <class Any, class F>
void for_each_member(F f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f(std::variant_alternative_t<I, Any>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Any>>{});
}

/// Names of the members, in the order of the list.
template <class Any>
std::vector<std::string> member_names() {
  std::vector<std::string> names;
  for_each_member<Any>([&](const auto& member) { names.emplace_back(member.name); });
  return names;
}

/// The member of a name, default-constructed; the first member if none has this name.
template <class Any>
Any member_named(std::string_view name) {
  Any found;
  for_each_member<Any>([&](const auto& member) {
    if (member.name == name) found = member;
  });
  return found;
}

/// Keys of a struct that has fields, in their order.
template <class Struct>
std::vector<std::string> keys_of() {
  return std::apply(
      [](const auto&... field) { return std::vector<std::string>{std::string(field.name)...}; },
      Struct::fields());
}

}  // namespace whirl::inline base
