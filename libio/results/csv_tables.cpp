#include "libio/results/csv_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "libio/results/own_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

using Index = Eigen::Index;

constexpr Index most_columns = 16;  ///< that a dimension without an axis is spread over

/// States to go on from, in coordinates of no meaning to others.
bool is_internal(const std::string& name) {
  static const std::set<std::string> names{"basis",
                                           "coordinates",
                                           "end_displacement",
                                           "end_velocity",
                                           "start_displacement",
                                           "start_velocity",
                                           "section",
                                           "state",
                                           "walk",
                                           "displacement",
                                           "velocity"};
  return names.count(name) > 0;
}

/// A text as a cell: in quotation marks where it needs them. One that a spreadsheet would take for a
/// formula gets an apostrophe in front, which spreadsheets take for "this is text".
std::string csv_text(const std::string& text) {
  constexpr std::string_view formula = "=+-@\t\r";
  const bool is_formula = !text.empty() && formula.find(text.front()) != std::string_view::npos;
  const std::string cell = is_formula ? '\'' + text : text;
  return cell.find_first_of(",\"\n\r") == std::string::npos ? cell : csv_quoted(cell);
}

/// All values of a dataset as texts, the last index running fastest.
std::vector<std::string> texts_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double v : values) {
    texts.push_back(std::isfinite(v) ? fmt::format("{}", v) : std::string());
  }
  return texts;
}

std::vector<std::string> read_texts(const ResultReader& file, const std::string& path) {
  if (file.kind(path) != ObjectKind::text) return texts_of(file.numbers(path));
  std::vector<std::string> texts = file.strings(path);
  for (std::string& text : texts) text = csv_text(text);
  return texts;
}

/// Real and imaginary parts of a vector or matrix.
std::pair<std::vector<double>, std::vector<double>> read_parts(const ResultReader& file,
                                                               const std::string& path) {
  CMat values;
  if (file.shape(path).size() == 1) {
    values = file.complex_vector(path).transpose();
  } else {
    values = file.complex_matrix(path);
  }
  std::pair<std::vector<double>, std::vector<double>> parts;
  for (Index i = 0; i < values.rows(); ++i) {
    for (Index j = 0; j < values.cols(); ++j) {
      parts.first.push_back(values(i, j).real());
      parts.second.push_back(values(i, j).imag());
    }
  }
  return parts;
}

std::string name_of(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

/// "x left disk [m]"; the axis of a study is named by its parameter.
std::string heading(const ResultReader& file, const std::string& path, const std::string& more) {
  std::string text = name_of(path);
  if ((text.rfind("axis_", 0) == 0 || text == "value") && file.has_attribute(path, "long_name")) {
    text = file.string_attribute(path, "long_name");
  }
  if (!more.empty()) text += ' ' + more;
  const std::string unit =
      file.has_attribute(path, "units") ? file.string_attribute(path, "units") : "";
  return unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

/// A dimension of a dataset.
struct TableDimension {
  std::string axis;  ///< path; empty: none
  Index size = 0, stride = 1;
};

/// TableColumn of a table: one value per row, at first + the row's indices times the strides.
struct TableColumn {
  std::string head;
  std::shared_ptr<const std::vector<std::string>> values;
  Index first = 0;
  std::vector<Index> strides;
};

struct CsvTable {
  std::string name;
  std::vector<TableDimension> rows;
  std::vector<TableColumn> columns;
};

/// Splits the dimensions of a dataset into those along rows and those along columns.
void split(const ResultReader& file, const std::vector<TableDimension>& all,
           std::vector<TableDimension>& rows, std::vector<TableDimension>& columns) {
  for (const TableDimension& d : all) {
    const bool is_row =
        d.axis.empty() ? d.size > most_columns : file.kind(d.axis) == ObjectKind::real;
    (is_row ? rows : columns).push_back(d);
  }
  if (!rows.empty() || columns.empty()) return;
  rows.push_back(columns.front());
  columns.erase(columns.begin());
}

void add_columns(const ResultReader& file, const std::string& path,
                 const std::vector<TableDimension>& across, const std::vector<TableDimension>& rows,
                 CsvTable& table) {
  std::vector<std::pair<std::string, std::shared_ptr<const std::vector<std::string>>>> parts;
  const auto part = [&](const std::string& name, std::vector<std::string> values) {
    parts.emplace_back(name, std::make_shared<const std::vector<std::string>>(std::move(values)));
  };
  if (file.kind(path) == ObjectKind::complex) {
    const auto [real, imaginary] = read_parts(file, path);
    part("re", texts_of(real));
    part("im", texts_of(imaginary));
  } else {
    part("", read_texts(file, path));
  }
  std::vector<Index> strides;
  for (const TableDimension& d : rows) strides.push_back(d.stride);

  // every combination of what stands along the columns
  std::vector<std::pair<std::string, Index>> places{{"", 0}};
  for (const TableDimension& d : across) {
    std::vector<std::string> labels;
    if (!d.axis.empty()) {
      labels = file.kind(d.axis) == ObjectKind::text ? file.strings(d.axis)
                                                     : texts_of(file.numbers(d.axis));
    }
    std::vector<std::pair<std::string, Index>> next;
    for (const auto& [label, first] : places) {
      for (Index i = 0; i < d.size; ++i) {
        const std::string own =
            labels.empty() ? fmt::format("{}", i + 1) : labels[static_cast<std::size_t>(i)];
        next.emplace_back(label.empty() ? own : label + ' ' + own, first + i * d.stride);
      }
    }
    places = std::move(next);
  }
  for (const auto& [label, first] : places) {
    for (const auto& [name, values] : parts) {
      const std::string more = label.empty() || name.empty() ? label + name : label + ' ' + name;
      table.columns.push_back({heading(file, path, more), values, first, strides});
    }
  }
}

std::string csv_of(const ResultReader& file, const CsvTable& table,
                   const std::optional<MotionSamples>& samples) {
  std::string out;
  std::vector<std::vector<std::string>> along;  // values of the rows' axes
  Index count = 1;
  std::vector<Index> first, last;
  for (const TableDimension& d : table.rows) {
    const bool is_cut = samples && d.axis == "/trajectory/time";
    first.push_back(is_cut ? samples->first : 0);
    last.push_back(is_cut ? samples->last : d.size - 1);
    count *= last.back() - first.back() + 1;
    out += (along.empty() ? "" : ",") +
           (d.axis.empty() ? "number" : csv_text(heading(file, d.axis, "")));
    along.push_back(d.axis.empty() ? std::vector<std::string>{} : read_texts(file, d.axis));
  }
  for (const TableColumn& c : table.columns) out += ',' + csv_text(c.head);
  out += '\n';
  std::vector<Index> at = first;
  for (Index row = 0; row < count; ++row) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i > 0) out += ',';
      out += along[i].empty() ? fmt::format("{}", at[i] + 1)
                              : along[i][static_cast<std::size_t>(at[i])];
    }
    for (const TableColumn& c : table.columns) {
      Index place = c.first;
      for (std::size_t i = 0; i < at.size(); ++i) place += at[i] * c.strides[i];
      out += ',' + (*c.values)[static_cast<std::size_t>(place)];
    }
    out += '\n';
    for (std::size_t i = at.size(); i-- > 0;) {
      if (++at[i] <= last[i]) break;
      at[i] = first[i];
    }
  }
  return out;
}

/// Axes of a dataset. Complex numbers label nothing: their dimension is numbered, and they are two
/// columns beside the values they belong to.
std::vector<std::string> real_axes(const ResultReader& file, const std::string& path) {
  std::vector<std::string> axes = file.axes(path);
  for (std::string& axis : axes) {
    if (!axis.empty() && file.kind(axis) == ObjectKind::complex) axis.clear();
  }
  return axes;
}

}  // namespace

std::string csv_quoted(std::string_view cell) {
  std::string result = "\"";
  for (const char c : cell) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::vector<fs::path> write_csv_tables(const ResultReader& result, const fs::path& stem,
                                       Replaces replaces,
                                       const std::optional<MotionSamples>& samples) {
  std::vector<std::pair<std::string, std::string>> datasets;  // group, path
  std::set<std::string> is_axis;
  for (const std::string& group : result.list("/")) {
    if (group == "call" || result.kind('/' + group) != ObjectKind::group) continue;
    for (const std::string& name : result.list('/' + group)) {
      const std::string path = fmt::format("/{}/{}", group, name);
      const ObjectKind kind = result.kind(path);
      if (kind == ObjectKind::group || kind == ObjectKind::other || is_internal(name)) continue;
      datasets.emplace_back(group, path);
      for (const std::string& axis : real_axes(result, path)) is_axis.insert(axis);
    }
  }

  std::vector<CsvTable> tables;
  std::map<std::string, std::size_t> of_rows;  // tables by group and what is along their rows
  for (const auto& [group, path] : datasets) {
    if (is_axis.count(path) > 0) continue;
    const auto shape = result.shape(path);
    if (shape.empty()) continue;
    const auto axes = real_axes(result, path);
    std::vector<TableDimension> all(shape.size()), rows, across;
    Index stride = 1;
    for (std::size_t i = shape.size(); i-- > 0;) {
      all[i] = {axes[i], shape[i], stride};
      stride *= shape[i];
    }
    split(result, all, rows, across);
    std::string key = group, name = group;
    for (const TableDimension& d : rows) {
      key += d.axis.empty() ? fmt::format(" #{}", d.size) : ' ' + d.axis;
      name += '_' + name_of(d.axis.empty() ? path : d.axis);
    }
    const auto [found, is_new] = of_rows.try_emplace(key, tables.size());
    if (is_new) tables.push_back({name, rows, {}});
    add_columns(result, path, across, rows, tables[found->second]);
  }

  std::vector<fs::path> files;
  for (const CsvTable& table : tables) {
    const fs::path place = fmt::format("{}_{}.csv", stem.string(), table.name);
    const std::string text = csv_of(result, table, samples);
    const bool is_same = first_line(place) == text.substr(0, text.find('\n'));
    replace_file(place, text, is_same ? Replaces::anything : replaces);
    files.push_back(place);
  }
  return files;
}

}  // namespace whirl::inline io
