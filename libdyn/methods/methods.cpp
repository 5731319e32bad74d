#include "libdyn/methods/methods.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "libbase/error.hpp"

namespace whirl::inline dyn {

namespace {

/// Calls f with a value of every alternative of the list.
template <class F, std::size_t... I>
void for_each_method(F f, std::index_sequence<I...>) {
  (f(std::variant_alternative_t<I, AnyMethod>{}), ...);
}
template <class F>
void for_each_method(F f) {
  for_each_method(f, std::make_index_sequence<std::variant_size_v<AnyMethod>>{});
}

}  // namespace

AnyMethod suitable_method(const ContactSystem& system) {
  if (prefers_collocation(system)) return Collocation{};
  return Taylor{};
}

std::string_view name_of_method(const AnyMethod& method) {
  return std::visit([](const auto& m) { return m.name; }, method);
}

const Abilities& abilities_of(const AnyMethod& method) {
  return std::visit([](const auto& m) -> const Abilities& { return m.abilities; }, method);
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for_each_method([&](auto method) { names.push_back(decltype(method)::name); });
  return names;
}

AnyMethod method_named(std::string_view name) {
  if (name == "cvode") return CvodeAdams{};
  std::optional<AnyMethod> found;
  for_each_method([&](auto method) {
    if (decltype(method)::name == name) found = method;
  });
  if (found) return *found;
  throw ModelError({}, "method",
                   fmt::format("unknown method \"{}\", expected one of {}", name,
                               fmt::join(method_names(), ", ")));
}

}  // namespace whirl::inline dyn
