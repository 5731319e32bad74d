#pragma once
/// Columns of results (column.hpp) whose numbers are values of a parameter of the model: which one,
/// and in which unit, only a call knows.

#include <concepts>
#include <string>
#include <string_view>

namespace whirl::inline base {

/// Unit of such columns; their result says the parameter, see HasParameters.
constexpr std::string_view unit_of_parameter = "SI";

/// A parameter: its path and its SI unit.
struct ParameterName {
  std::string path, unit;
};

/// A result with such columns: `static auto& parameter_of(auto& result, std::string_view dataset)`
/// gives the ParameterName of a dataset.
template <class T>
concept HasParameters = requires(T& result) {
  { T::parameter_of(result, "") } -> std::convertible_to<ParameterName>;
};

}  // namespace whirl::inline base
