#pragma once
/// Paths of datasets by the members of results that they hold.

#include <concepts>
#include <string>

#include "libio/results/columns.hpp"

namespace whirl::inline io {

namespace columns {

/// The column of a member of a struct, if files have that column; else null.
template <HasColumns T, class Member>
const AnyColumn* column_of(const Member& member) {
  const AnyColumn* found = nullptr;
  const AnyColumn* at = any_columns<T>.data();
  for_each_column<T>([&](const auto& c) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(c.member)>, Member>) {
      if (!found && c.written != Written::in_json && c.member == member) found = at;
    }
    ++at;
  });
  return found;
}

}  // namespace columns

/// Path of the dataset that a member of a result, or of its rows, is written as; of a list of rows
/// the path of their first column. Empty: files do not have the member.
///
///   dataset_of<Campbell>(&CampbellBranch::frequency) = "/campbell/frequency"
template <HasGroup T, class Member>
std::string dataset_of(Member member) {
  using columns::path_of;
  if (const columns::AnyColumn* c = columns::column_of<T>(member)) {
    return c->is_rows ? path_of(T::group, c->first_of_row(), c->rows.prefix)
                      : path_of(T::group, *c);
  }
  std::string path;
  for_each_column<T>([&](const auto& c) {
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Row = RowOf<T, decltype(c.member)>;
      if constexpr (HasColumns<Row>) {  // points of studies: see point_dataset
        if (!path.empty() || c.written == Written::in_json) return;
        const columns::AnyColumn* of_row = columns::column_of<Row>(member);
        if (of_row && of_row->is_in_rows()) path = path_of(T::group, *of_row, c.prefix);
      }
    }
  });
  return path;
}

}  // namespace whirl::inline io
