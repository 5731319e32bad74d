#pragma once
/// Results by their columns (libbase/structs/column.hpp): into a result file and back, as JSON, and
/// as what a file is checked against.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libbase/numerics/constants.hpp"
#include "libbase/structs/column.hpp"
#include "libbase/structs/parameter_name.hpp"
#include "libio/results/any_column.hpp"
#include "libio/results/cells.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

template <HasColumns T>
Record record_of(const T& result);

namespace columns {

/// What describes a column, whatever its type.
struct Facts {
  std::string name;  ///< of the dataset or attribute, below the group
  std::string unit, meaning;
  std::string dimensions;  ///< those of the rows first
  ValidValues values{};
  bool is_axis = false, is_optional = false;
};

/// @param rows  dimension of the rows that it is a column of
Facts facts_of(const ColumnInfo& c, std::string_view rows = "", std::string_view prefix = "");

/// The dataset of the numbers of rows.
Facts number_facts(const RowsInfo& c);

/// The entry of a dataset or attribute, which files are checked against.
ResultEntry entry_of(const std::string& path, const Facts& facts, ObjectKind kind);

/// Names of the dimensions in a list, which spaces separate, without their "+".
std::vector<std::string> dimension_names(std::string_view list);

/// Reads a dataset of a kind, or an attribute, "group@name"; nothing where a file is without it.
std::optional<Cells> read_cells(const ResultReader& file, const std::string& path, ObjectKind kind);

using Columns = std::span<const AnyColumn>;
/// Says what the parameter of a dataset is; may be empty.
using ParameterOf = std::function<ParameterName(std::string_view dataset)>;
/// Takes what the parameter of a dataset is; may be empty.
using TakeParameter = std::function<void(std::string_view dataset, ParameterName parameter)>;

/// Writes a result as a group.
void write_group(ResultWriter& file, std::string_view group, Columns columns, const void* result,
                 const ParameterOf& parameter_of);

/// Reads what a file holds of a result.
void read_group(const ResultReader& file, std::string_view group, Columns columns, void* result,
                const TakeParameter& take_parameter);

/// Entries of a result, or of one of its rows, for JSON.
Record record_of_columns(Columns columns, const void* result);

std::vector<ResultSet> schema_of_columns(std::string_view group, Columns columns);

/// Path of the dataset of a column.
/// @param prefix  of the rows that it is a column of
std::string path_of(std::string_view group, const AnyColumn& column, std::string_view prefix = "");

/// "speed_rpm" of rad/s, "x_m", unless the column says another key.
std::string json_key(const ColumnInfo& c);

template <class T>
Record record_value(const T& value, double divisor, int offset) {
  if constexpr (Maybe<T>) {
    return value ? record_value(*value, divisor, offset) : Record(nullptr);
  } else if constexpr (std::is_enum_v<T>) {
    return Record(name_of(value));
  } else if constexpr (Text<T>) {
    return Record(std::string_view(value));
  } else if constexpr (std::same_as<T, bool>) {
    return Record(value);
  } else if constexpr (std::is_integral_v<T>) {
    return Record(static_cast<long>(value) + offset);
  } else if constexpr (std::is_floating_point_v<T> || std::same_as<T, Complex>) {
    return Record(value / divisor);
  } else if constexpr (HasColumns<T>) {
    return record_of(value);
  } else {
    Record list = Record::array();
    if constexpr (EigenArray<T> && rank_of<T>() == 2) {
      for (Eigen::Index i = 0; i < value.rows(); ++i) {
        Record row = Record::array();
        for (Eigen::Index j = 0; j < value.cols(); ++j) {
          row.add(record_value(value(i, j), divisor, offset));
        }
        list.add(std::move(row));
      }
    } else {
      for (const auto& element : value) list.add(record_value(element, divisor, offset));
    }
    return list;
  }
}

}  // namespace columns

/// Writes a result as the group of a file that it names.
/// @throws FileError  as ResultWriter
template <HasGroup T>
void write_result(ResultWriter& file, const T& result) {
  columns::ParameterOf parameter_of;
  if constexpr (HasParameters<T>) {
    parameter_of = [&](std::string_view dataset) { return T::parameter_of(result, dataset); };
  }
  columns::write_group(file, T::group, columns::any_columns<T>, &result, parameter_of);
}

/// Reads what a file holds of a result; columns that are functions of others are not read.
/// @throws FileError  as ResultReader
template <HasGroup T>
T read_result(const ResultReader& file) {
  T result{};
  columns::TakeParameter take_parameter;
  if constexpr (HasParameters<T>) {
    take_parameter = [&](std::string_view dataset, ParameterName parameter) {
      T::parameter_of(result, dataset) = std::move(parameter);
    };
  }
  columns::read_group(file, T::group, columns::any_columns<T>, &result, take_parameter);
  return result;
}

/// Entries of a result, or of one of its rows, for JSON.
template <HasColumns T>
Record record_of(const T& result) {
  return columns::record_of_columns(columns::any_columns<T>, &result);
}

/// The sets of entries that a file with a result is checked against. The first set has all that is
/// never missing. Further sets, all of which need the first one, have what may be missing: one set
/// the datasets along one dimension, one the datasets of rows along the same dimensions (it also
/// needs the datasets that say these), and one a list of rows.
template <HasGroup T>
std::vector<ResultSet> schema_of() {
  return columns::schema_of_columns(T::group, columns::any_columns<T>);
}

}  // namespace whirl::inline io
