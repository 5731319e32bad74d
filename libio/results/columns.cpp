#include "libio/results/columns.hpp"

#include <utility>

namespace whirl::inline io::columns {

std::vector<std::string> dimension_names(std::string_view list) {
  std::vector<std::string> names;
  for (DimensionName& d : dimensions_of(list)) names.push_back(std::move(d.name));
  return names;
}

Facts facts_of(const ColumnInfo& c, std::string_view rows, std::string_view prefix) {
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

Facts number_facts(const RowsInfo& c) {
  std::string_view name = c.dimension;
  if (name.ends_with('+')) name.remove_suffix(1);
  return {.name = std::string(c.prefix) + std::string(c.number),
          .unit = "",
          .meaning = std::string(c.meaning),
          .dimensions = std::string(c.dimension),
          .values = valid::numbers_of(name),
          .is_axis = true};
}

ResultEntry entry_of(const std::string& path, const Facts& facts, ObjectKind kind) {
  return {path, kind, facts.dimensions, facts.values, facts.is_optional, facts.unit, facts.meaning};
}

namespace {

Cells read_attribute(const ResultReader& file, const std::string& object, const std::string& name,
                     ObjectKind kind) {
  Cells cells{.kind = kind == ObjectKind::text ? kind : ObjectKind::real};
  if (kind == ObjectKind::text) {
    cells.texts.push_back(file.string_attribute(object, name));
  } else {
    cells.reals.push_back(file.number_attribute(object, name));
  }
  return cells;
}

}  // namespace

std::optional<Cells> read_cells(const ResultReader& file, const std::string& path,
                                ObjectKind kind) {
  const std::size_t at = path.find('@');
  if (at != std::string::npos) {
    const std::string object = path.substr(0, at), name = path.substr(at + 1);
    if (!file.has_attribute(object, name)) return {};
    return read_attribute(file, object, name, kind);
  }
  if (!file.has(path)) return {};
  Cells cells{.kind = kind, .shape = file.shape(path)};
  switch (kind) {
    case ObjectKind::text:
      cells.texts = file.strings(path);
      break;
    case ObjectKind::integer:
      cells.integers = file.integers(path);
      break;
    case ObjectKind::complex:
      if (cells.shape.size() == 1) {
        const CVec v = file.complex_vector(path);
        cells.complexes.assign(v.begin(), v.end());
      } else {
        const CMat m = file.complex_matrix(path);
        put(cells, m);
      }
      break;
    default:
      cells.reals = file.numbers(path);
  }
  return cells;
}

namespace {

/// Unit as it ends a key of JSON: "_rpm" of rad/s, "_m_s" of m/s.
std::string key_suffix(std::string_view unit) {
  if (unit.empty() || unit == unit_of_parameter) return "";
  if (unit == "rad/s") return "_rpm";
  std::string suffix = "_";
  for (const char c : unit) {
    if (c == '/' || c == '.' || c == ' ') {
      suffix += '_';
    } else if (c != ',') {
      suffix += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
  }
  return suffix;
}

/// Adds a list of rows.
void add_rows(Record& record, const AnyColumn& list, const void* result) {
  if (list.rows.written == Written::in_file) return;
  list.give_rows(result, [&](const void* rows, std::size_t count) {
    const bool may_lack = list.rows.is_optional && list.rows.written == Written::in_json;
    if (may_lack && count == 0) return;
    Record all = Record::array();
    for (std::size_t i = 0; i < count; ++i) {
      Record entry;
      if (!list.rows.number.empty()) entry.set("number", static_cast<long>(i) + 1);
      all.add(entry.merge(record_of_columns(list.of_row, row_at(rows, list.row_size, i))));
    }
    record.set(dimension_names(list.rows.dimension).front(), std::move(all));
  });
}

/// Reads columns of a group of a file.
class GroupReader {
 public:
  GroupReader(const ResultReader& file, std::string_view group, const TakeParameter& take_parameter)
      : file_(file), group_(group), take_parameter_(take_parameter) {}

  /// A column of a result.
  void read(const AnyColumn& c, void* result) const {
    if (!c.take) return;
    const char* below = c.rank == 0 ? "@" : "/";
    const auto cells = read_cells(file_, group_ + below + std::string(c.info.key), c.kind);
    if (!cells) return;
    Taking from(*cells);
    c.take(from, c.member(result), cells->shape, c.offset());
  }

  /// A column of its rows.
  void read(const AnyColumn& list, const AnyColumn& c, void* result) const {
    if (!c.take || !c.fits_files) return;
    const std::string name = facts_of(c.info, "", list.rows.prefix).name;
    const auto cells = read_cells(file_, group_ + "/" + name, c.kind);
    if (!cells) return;
    const auto count = static_cast<std::size_t>(cells->shape.at(0));
    void* rows = list.resize(result, count);
    Taking from(*cells);
    const AnyColumn::Shape shape(cells->shape);
    for (std::size_t i = 0; i < count; ++i) {
      c.take(from, c.member(row_at(rows, list.row_size, i)), shape.subspan(1), c.offset());
    }
  }

  /// What the parameter of a dataset is. Rows of which there are none have no dataset that says it.
  void read_parameter(const AnyColumn& c, std::string_view prefix) const {
    if (!take_parameter_ || c.info.unit != unit_of_parameter) return;
    if (c.is_rows || c.info.written == Written::in_json) return;
    const std::string name = facts_of(c.info, "", prefix).name, path = group_ + "/" + name;
    if (!file_.has(path)) return;
    ParameterName parameter{file_.string_attribute(path, "long_name"),
                            file_.string_attribute(path, "units")};
    if (!parameter.path.empty()) take_parameter_(name, std::move(parameter));
  }

 private:
  const ResultReader& file_;
  std::string group_;
  const TakeParameter& take_parameter_;
};

}  // namespace

std::string json_key(const ColumnInfo& c) {
  return c.json_key.empty() ? std::string(c.key) + key_suffix(c.unit) : std::string(c.json_key);
}

Record record_of_columns(Columns columns, const void* result) {
  Record record;
  for (const AnyColumn& c : columns) {
    if (c.is_rows) {
      add_rows(record, c, result);
      continue;
    }
    if (!c.record) continue;
    const std::string key = json_key(c.info);
    const double divisor = key.ends_with("_rpm") ? rpm : 1.0;
    const bool may_lack = c.info.is_optional && (c.is_maybe || c.info.written == Written::in_json);
    c.give(result, [&](const void* value) {
      if (may_lack && c.is_empty(value)) return;
      record.set(key, c.record(value, divisor, c.offset()));
    });
  }
  return record;
}

void read_group(const ResultReader& file, std::string_view name, Columns columns, void* result,
                const TakeParameter& take_parameter) {
  const GroupReader group(file, name, take_parameter);
  for (const AnyColumn& c : columns) {
    if (!c.is_rows) {
      group.read(c, result);
      group.read_parameter(c, "");
      continue;
    }
    if (c.rows.written != Written::in_json && c.resize) {
      for (const AnyColumn& of_row : c.of_row) group.read(c, of_row, result);
    }
    for (const AnyColumn& of_row : c.of_row) group.read_parameter(of_row, c.rows.prefix);
  }
}

std::string path_of(std::string_view group, const AnyColumn& column, std::string_view prefix) {
  return std::string(group) + '/' + facts_of(column.info, "", prefix).name;
}

}  // namespace whirl::inline io::columns
