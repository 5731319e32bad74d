#pragma once
/// Members of families in model files: a key names one, and its own keys stand beside it.

#include <string>
#include <string_view>
#include <vector>

#include "libbase/structs/family.hpp"
#include "libio/model/read_fields.hpp"

namespace whirl::inline io {

/// Calls f with every member of a family that has keys of its own, or could have.
template <class List, class F>
void for_each_with_keys(const F& f) {
  for_each_member<List>([&](const auto& member) {
    if constexpr (requires { member.fields(); }) f(member);
  });
}
template <class Member>
std::vector<std::string> keys_of_member(const Member&) {
  return keys_of<Member>();
}

/// Reads a member of a list, whose name a key gives; returns whether there is one of that name.
template <class List>
bool read_member(TableReader& table, std::string_view key, List& to) {
  std::vector<std::string> names;
  for_each_with_keys<List>([&](const auto& member) { names.emplace_back(member.name); });
  const auto found = table.choice(key, names);
  if (!found && table.has(key)) {  // one mistake, and not many: the keys of all members are known
    for_each_with_keys<List>([&](const auto& member) {
      for (const std::string& name : keys_of_member(member)) table.node(name);
    });
    return false;
  }
  const std::string name = found.value_or(names.front());
  for_each_with_keys<List>([&](auto member) {
    if (member.name != name) return;
    table.read(member);
    to = member;
  });
  return true;
}

}  // namespace whirl::inline io
