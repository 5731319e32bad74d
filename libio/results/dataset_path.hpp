#pragma once
/// Paths of datasets by the members of results that they hold.

#include <concepts>
#include <string>

#include "libio/results/columns.hpp"

namespace whirl::inline io {

/// Path of the dataset that a member of a result, or of its rows, is written as; of a list of rows
/// that of their first column. Empty: no file has it.
///
///   dataset_of<Campbell>(&CampbellBranch::frequency) = "/campbell/frequency"
template <HasGroup T, class Member>
std::string dataset_of(Member member) {
  std::string path;
  const auto offer = [&](bool is_it, std::string_view prefix, std::string_view key) {
    if (is_it && path.empty()) {
      path = std::string(T::group) + '/' + std::string(prefix) + std::string(key);
    }
  };
  const auto is = [&](const auto& other) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(other)>, Member>) {
      return other == member;
    } else {
      return false;
    }
  };
  for_each_column<T>([&](const auto& c) {
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Row = RowOf<T, decltype(c.member)>;
      if constexpr (HasColumns<Row>) {  // points of studies: see point_dataset
        columns::for_each_in_row<Row>([&](const auto& inner) {
          const bool is_written =
              c.written != Written::in_json && inner.written != Written::in_json;
          offer(is_written && (is(c.member) || is(inner.member)), c.prefix, inner.key);
        });
      }
    } else {
      offer(c.written != Written::in_json && is(c.member), "", c.key);
    }
  });
  return path;
}

}  // namespace whirl::inline io
