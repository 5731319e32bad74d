#pragma once
/// Results by their columns (libbase/column.hpp): into a result file and back, as JSON, and as what a
/// file is checked against.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libbase/column.hpp"
#include "libbase/constants.hpp"
#include "libbase/parameter_name.hpp"
#include "libio/results/cells.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

template <HasColumns T>
Record record_of(const T& result);

namespace columns {

/// What all columns are described by, whatever their type.
struct Facts {
  std::string name;  ///< of the dataset or attribute, below the group
  std::string unit, meaning;
  std::string dimensions;  ///< those of the rows first
  ValidValues values{};
  bool is_axis = false, is_optional = false;
};

template <class Member>
Facts facts_of(const Column<Member>& c, std::string_view rows = "", std::string_view prefix = "") {
  Facts f{.name = std::string(prefix) + std::string(c.key),
          .unit = std::string(c.unit),
          .meaning = std::string(c.meaning),
          .dimensions = std::string(rows),
          .values = c.values,
          .is_axis = c.is_axis,
          .is_optional = c.is_optional};
  if (!rows.empty() && !c.dimensions.empty()) f.dimensions += ' ';
  f.dimensions += c.dimensions;
  return f;
}

/// The dataset of the numbers of rows.
template <class Member>
Facts number_facts(const RowsColumn<Member>& c) {
  std::string_view name = c.dimension;
  if (name.ends_with('+')) name.remove_suffix(1);
  return {.name = std::string(c.prefix) + std::string(c.number),
          .unit = "",
          .meaning = std::string(c.meaning),
          .dimensions = std::string(c.dimension),
          .values = valid::numbers_of(name),
          .is_axis = true};
}

/// What a file is checked against that has a dataset or attribute.
ResultEntry entry_of(const std::string& path, const Facts& facts, ObjectKind kind);

/// Writes a group of a result file; knows the datasets along its dimensions.
class GroupWriter {
 public:
  using ParameterOf = std::function<ParameterName(std::string_view dataset)>;

  /// @param parameter_of  says what the parameter of a dataset is; may be empty
  GroupWriter(ResultWriter& file, std::string_view group, ParameterOf parameter_of)
      : file_(file), group_(group), parameter_of_(std::move(parameter_of)) {}

  void attribute(const std::string& name, const Cells& cells);
  void dataset(const Facts& facts, Cells cells);
  void dataset(const Facts& facts, const Mat& values);
  /// Size of a dimension that a dataset written before stands along; 0: none does.
  Eigen::Index size_of(std::string_view dimension) const;

 private:
  struct Axis {
    std::string path;
    Eigen::Index size = 0;
  };
  /// What stands beside a dataset of a shape, whose axis is known from now on if it is one.
  DatasetInfo info_of(const Facts& facts, std::span<const Eigen::Index> shape);

  ResultWriter& file_;
  std::string group_;
  ParameterOf parameter_of_;
  std::map<std::string, Axis, std::less<>> axes_;
};

/// Names of dimensions, those of a list that a space separates, without their "+".
std::vector<std::string> dimension_names(std::string_view list);

/// Reads a dataset of a kind, or an attribute, "group@name"; nothing where a file is without it.
std::optional<Cells> read_cells(const ResultReader& file, const std::string& path, ObjectKind kind);

/// What a dataset of a parameter says of itself; nothing where a file is without it.
ParameterName read_parameter(const ResultReader& file, const std::string& path);

/// Whether a column is a member of a result, or of a part of one, and no function of it.
template <class T, class Member>
constexpr bool is_read =
    std::is_same_v<std::invoke_result_t<const Member&, T&>, ColumnValue<T, Member>&>;

/// Calls f with every column of a row that a file can hold; rows of rows are for JSON only.
template <class Row, class F>
void for_each_in_row(const F& f) {
  for_each_column<Row>([&](const auto& c) {
    if constexpr (!is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      if constexpr (fits_files<ColumnValue<Row, decltype(c.member)>>) f(c);
    }
  });
}

template <class Row, class Member>
void write_column(GroupWriter& group, const std::vector<Row>& rows, const Column<Member>& c,
                  std::string_view dimension, std::string_view prefix) {
  using Value = ColumnValue<Row, Member>;
  if (c.written == Written::in_json) return;
  Cells cells{.kind = kind_of<Value>(), .shape = {static_cast<Eigen::Index>(rows.size())}};
  for (const Row& row : rows) put(cells, std::invoke(c.member, row), c.is_from_one ? 1 : 0);
  if constexpr (rank_of<Value>() > 0) {
    if (!rows.empty()) {
      for (const auto n : extents_of(std::invoke(c.member, rows.front()))) cells.shape.push_back(n);
    } else {
      for (const std::string& d : dimension_names(c.dimensions)) {
        cells.shape.push_back(group.size_of(d));
      }
    }
  }
  if (c.is_optional && cells.is_empty()) return;
  group.dataset(facts_of(c, dimension, prefix), std::move(cells));
}

template <class T, class Member>
void write_column(GroupWriter& group, const T& result, const Column<Member>& c) {
  using Value = ColumnValue<T, Member>;
  if (c.written == Written::in_json) return;
  if constexpr (std::same_as<Value, Mat>) {  // may be large: not copied
    const auto& value = std::invoke(c.member, result);
    if (!c.is_optional || value.size() > 0) group.dataset(facts_of(c), value);
  } else if constexpr (fits_files<Value>) {
    const auto& value = std::invoke(c.member, result);
    Cells cells{.kind = kind_of<Value>(), .shape = extents_of(value)};
    put(cells, value, c.is_from_one ? 1 : 0);
    if (c.is_optional && cells.is_empty()) return;
    if constexpr (rank_of<Value>() == 0) {
      group.attribute(std::string(c.key), cells);
    } else {
      group.dataset(facts_of(c), std::move(cells));
    }
  } else if constexpr (fits_attributes<Value>) {
    const auto& value = std::invoke(c.member, result);
    if (!c.is_optional || !value) return;
    Cells cells{.kind = kind_of<Value>()};
    put(cells, *value, c.is_from_one ? 1 : 0);
    group.attribute(std::string(c.key), cells);
  }
}

template <class T, class Member>
void write_column(GroupWriter& group, const T& result, const RowsColumn<Member>& c) {
  const auto& list = std::invoke(c.member, result);
  if (c.written == Written::in_json || (c.is_optional && list.empty())) return;
  if (!c.number.empty()) {
    Cells numbers{.kind = ObjectKind::integer};
    for (std::size_t i = 1; i <= list.size(); ++i) numbers.integers.push_back(static_cast<int>(i));
    numbers.shape = {static_cast<Eigen::Index>(list.size())};
    group.dataset(number_facts(c), std::move(numbers));
  }
  for_each_in_row<RowOf<T, Member>>(
      [&](const auto& column) { write_column(group, list, column, c.dimension, c.prefix); });
}

template <class Row, class Member>
void read_column(const ResultReader& file, const std::string& group, std::vector<Row>& rows,
                 const Column<Member>& c, std::string_view prefix) {
  if constexpr (is_read<Row, Member>) {
    if (c.written == Written::in_json) return;
    const auto cells = read_cells(file, group + "/" + facts_of(c, "", prefix).name,
                                  kind_of<ColumnValue<Row, Member>>());
    if (!cells) return;
    rows.resize(static_cast<std::size_t>(cells->shape.at(0)));
    Taking taking(*cells);
    const std::span<const Eigen::Index> shape(cells->shape);
    for (Row& row : rows)
      taking.take(std::invoke(c.member, row), shape.subspan(1), c.is_from_one ? 1 : 0);
  }
}

template <class T, class Member>
void read_column(const ResultReader& file, const std::string& group, T& result,
                 const Column<Member>& c) {
  if constexpr (is_read<T, Member> && fits_files<ColumnValue<T, Member>>) {
    using Value = ColumnValue<T, Member>;
    if (c.written == Written::in_json) return;
    const char* below = rank_of<Value>() == 0 ? "@" : "/";
    const auto cells = read_cells(file, group + below + std::string(c.key), kind_of<Value>());
    if (cells)
      Taking(*cells).take(std::invoke(c.member, result), cells->shape, c.is_from_one ? 1 : 0);
  } else if constexpr (is_read<T, Member> && fits_attributes<ColumnValue<T, Member>>) {
    using Value = ColumnValue<T, Member>;
    if (c.written == Written::in_json || !c.is_optional) return;
    const auto cells = read_cells(file, group + "@" + std::string(c.key), kind_of<Value>());
    if (cells)
      Taking(*cells).take(std::invoke(c.member, result).emplace(), {}, c.is_from_one ? 1 : 0);
  }
}

template <class T, class Member>
void read_column(const ResultReader& file, const std::string& group, T& result,
                 const RowsColumn<Member>& c) {
  if constexpr (is_read<T, Member>) {
    if (c.written == Written::in_json) return;
    for_each_in_row<RowOf<T, Member>>([&](const auto& column) {
      read_column(file, group, std::invoke(c.member, result), column, c.prefix);
    });
  }
}

/// Unit as it ends a key of JSON: "_rpm" of rad/s, "_m_s" of m/s.
std::string key_suffix(std::string_view unit);

template <class T>
Record record_value(const T& value, double divisor, int offset = 0) {
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

template <class Member>
std::string json_key(const Column<Member>& c) {
  return c.json_key.empty() ? std::string(c.key) + key_suffix(c.unit) : std::string(c.json_key);
}

}  // namespace columns

/// Writes a result as the group of a file that it names.
/// @throws FileError  as ResultWriter
template <HasGroup T>
void write_result(ResultWriter& file, const T& result) {
  columns::GroupWriter::ParameterOf parameter_of;
  if constexpr (HasParameters<T>) {
    parameter_of = [&](std::string_view dataset) { return T::parameter_of(result, dataset); };
  }
  columns::GroupWriter group(file, T::group, parameter_of);
  for_each_column<T>([&](const auto& c) { columns::write_column(group, result, c); });
}

/// Reads what a file holds of a result; columns that are functions of others are not read.
/// @throws FileError  as ResultReader
template <HasGroup T>
T read_result(const ResultReader& file) {
  T result{};
  const std::string group(T::group);
  const auto read_parameter = [&](const auto& c, std::string_view prefix) {
    if constexpr (HasParameters<T>) {
      if (c.unit != unit_of_parameter || c.written == Written::in_json) return;
      const std::string name = columns::facts_of(c, "", prefix).name;
      // rows of which there are none have no dataset that says it
      const ParameterName parameter = columns::read_parameter(file, group + "/" + name);
      if (!parameter.path.empty()) T::parameter_of(result, name) = parameter;
    }
  };
  for_each_column<T>([&](const auto& c) {
    columns::read_column(file, group, result, c);
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      for_each_column<RowOf<T, decltype(c.member)>>([&](const auto& of_row) {
        if constexpr (!is_rows_column<std::remove_cvref_t<decltype(of_row)>>) {
          read_parameter(of_row, c.prefix);
        }
      });
    } else {
      read_parameter(c, "");
    }
  });
  return result;
}

/// Entries of a result, or of one of its rows, for JSON.
template <HasColumns T>
Record record_of(const T& result) {
  Record record;
  for_each_column<T>([&](const auto& c) {
    if (c.written == Written::in_file) return;
    const auto& value = std::invoke(c.member, result);
    if (c.is_optional && c.written == Written::in_json && columns::is_empty(value)) return;
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      Record list = Record::array();
      for (const auto& row : value) {
        Record entry;
        if (!c.number.empty()) entry.set("number", static_cast<long>(&row - &value.front()) + 1);
        list.add(entry.merge(record_of(row)));
      }
      record.set(columns::dimension_names(c.dimension).front(), std::move(list));
    } else {
      const std::string key = columns::json_key(c);
      if constexpr (columns::Maybe<std::remove_cvref_t<decltype(value)>>) {
        if (c.is_optional && !value) return;
      }
      record.set(key, columns::record_value(value, key.ends_with("_rpm") ? rpm : 1.0,
                                            c.is_from_one ? 1 : 0));
    }
  });
  return record;
}

/// What a file is checked against that holds a result: what is never missing in one set; datasets
/// that may be, a set of all along one dimension; of rows a set of all along the same ones, which
/// needs the datasets that say these; then rows that may be. All of these need the first set.
template <HasGroup T>
std::vector<ResultSet> schema_of() {
  std::vector<ResultSet> sets(1);
  std::map<std::string, std::size_t> optional_sets;  // by their first dimension; of rows by all
  std::map<std::string, std::string> axes;           // by their dimension
  const std::string group(T::group);
  const auto add = [&](std::size_t set, const columns::Facts& f, ObjectKind kind,
                       bool is_attribute) {
    const std::string path = group + (is_attribute ? "@" : "/") + f.name;
    sets[set].entries.push_back(columns::entry_of(path, f, kind));
    if (f.is_axis) axes[columns::dimension_names(f.dimensions).at(0)] = path;
  };
  const auto add_optional = [&](const std::string& dimensions) {
    const auto [known, is_new] = optional_sets.try_emplace(dimensions, sets.size());
    if (is_new) sets.push_back({});
    return known->second;
  };
  const auto add_optional_of_row = [&](columns::Facts f, ObjectKind kind) {
    const std::size_t set = add_optional(f.dimensions);
    f.is_optional = false;
    add(set, f, kind, false);
    if (sets[set].entries.size() > 1) return;
    for (const std::string& name : columns::dimension_names(f.dimensions)) {
      if (axes.contains(name)) sets[set].needs.push_back(axes.at(name));
    }
  };
  for_each_column<T>([&](const auto& c) {
    if (c.written == Written::in_json) return;
    if constexpr (is_rows_column<std::remove_cvref_t<decltype(c)>>) {
      using Row = RowOf<T, decltype(c.member)>;
      if (c.is_optional) sets.push_back({});
      const std::size_t set = c.is_optional ? sets.size() - 1 : 0;
      if (!c.number.empty()) add(set, columns::number_facts(c), ObjectKind::integer, false);
      columns::for_each_in_row<Row>([&](const auto& column) {
        if (column.written == Written::in_json) return;
        const columns::Facts f = columns::facts_of(column, c.dimension, c.prefix);
        const auto kind = columns::kind_of<ColumnValue<Row, decltype(column.member)>>();
        if (f.is_optional && !column.dimensions.empty() && !f.is_axis) {
          add_optional_of_row(f, kind);
        } else {
          add(set, f, kind, false);
        }
      });
    } else {
      using Value = ColumnValue<T, decltype(c.member)>;
      columns::Facts facts = columns::facts_of(c);
      const bool is_attribute = columns::rank_of<Value>() == 0;
      std::size_t set = 0;
      if (c.is_optional && !is_attribute) {
        set = add_optional(columns::dimension_names(c.dimensions).at(0));
        facts.is_optional = false;
      }
      add(set, facts, columns::kind_of<Value>(), is_attribute);
    }
  });
  if (sets.front().entries.empty()) {
    sets.erase(sets.begin());
    return sets;
  }
  // the first entry says whether a set is there: it is never missing
  std::stable_partition(sets.front().entries.begin(), sets.front().entries.end(),
                        [](const ResultEntry& e) { return !e.is_optional; });
  for (std::size_t i = 1; i < sets.size(); ++i) {
    sets[i].needs.push_back(sets.front().entries.front().path);
  }
  return sets;
}

}  // namespace whirl::inline io
