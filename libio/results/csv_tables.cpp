#include "libio/results/csv_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <ostream>
#include <set>
#include <tuple>

#include "libio/results/own_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

using Index = Eigen::Index;

constexpr Index most_columns = 16;       ///< that a dimension without an axis is spread over
constexpr Index rows_at_once = 1 << 16;  ///< of a table, that are in memory

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

/// A text as a cell: in quotation marks where it needs them.
std::string csv_text(const std::string& text) {
  const std::string cell = spreadsheet_text(text);
  return cell.find_first_of(",\"\n\r") == std::string::npos ? cell : csv_quoted(cell);
}

/// A number as a cell.
void append_number(std::string& out, double value) {
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(out), "{}", value);
}

std::vector<std::string> texts_of(const std::vector<double>& values) {
  std::vector<std::string> texts(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) append_number(texts[i], values[i]);
  return texts;
}

std::vector<std::string> read_texts(const ResultReader& file, const std::string& path) {
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
  Index size = 0;
  std::size_t number = 0;  ///< of the dimensions of the dataset
};

/// A dataset of a table. Numbers are read for some rows at a time, texts and complex numbers at
/// once.
struct TableSource {
  std::string path;
  std::vector<std::size_t> rows{};   ///< dimensions that are along the rows of the table
  std::vector<Stretch> read{};       ///< what of it is there, per dimension
  bool is_whole = false;             ///< that is all of it
  std::vector<double> numbers{};     ///< the last index runs fastest
  std::vector<std::string> texts{};  ///< instead of numbers

  /// How far two numbers are apart along each dimension.
  std::vector<Index> strides() const {
    std::vector<Index> all(read.size(), 1);
    for (std::size_t i = read.size(); i-- > 1;) all[i - 1] = all[i] * read[i].count;
    return all;
  }
};

/// A column of a table: of a dataset that has further dimensions, one of each.
struct TableColumn {
  std::string head;
  std::size_t source = 0;
  std::vector<Index> at;  ///< per dimension of the dataset; of those along rows 0
};

struct CsvTable {
  std::string name;
  std::vector<TableDimension> rows;
  std::vector<TableSource> sources{};
  std::vector<TableColumn> columns{};
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

/// What a dataset has for a table: of complex numbers two, "re" and "im".
std::vector<std::pair<std::string, TableSource>> sources_of(
    const ResultReader& file, const std::string& path, const std::vector<TableDimension>& rows) {
  TableSource source{.path = path};
  for (const TableDimension& d : rows) source.rows.push_back(d.number);
  for (const Index size : file.shape(path)) source.read.push_back({0, size});
  const ObjectKind kind = file.kind(path);
  if (kind != ObjectKind::complex && kind != ObjectKind::text) return {{"", std::move(source)}};
  source.is_whole = true;
  if (kind == ObjectKind::text) {
    source.texts = read_texts(file, path);
    return {{"", std::move(source)}};
  }
  TableSource other = source;
  std::tie(source.numbers, other.numbers) = read_parts(file, path);
  return {{"re", std::move(source)}, {"im", std::move(other)}};
}

void add_columns(const ResultReader& file, const std::string& path,
                 const std::vector<TableDimension>& across, const std::vector<TableDimension>& rows,
                 CsvTable& table) {
  // every combination of what stands along the columns
  using Place = std::pair<std::string, std::vector<Index>>;
  std::vector<Place> places{{"", std::vector<Index>(across.size() + rows.size(), 0)}};
  for (const TableDimension& d : across) {
    std::vector<std::string> labels;
    if (!d.axis.empty()) {
      labels = file.kind(d.axis) == ObjectKind::text ? file.strings(d.axis)
                                                     : texts_of(file.numbers(d.axis));
    }
    std::vector<Place> next;
    for (const auto& [label, first] : places) {
      for (Index i = 0; i < d.size; ++i) {
        const std::string own =
            labels.empty() ? fmt::format("{}", i + 1) : labels[static_cast<std::size_t>(i)];
        next.emplace_back(label.empty() ? own : label + ' ' + own, first);
        next.back().second[d.number] = i;
      }
    }
    places = std::move(next);
  }
  auto parts = sources_of(file, path, rows);
  for (const auto& [label, at] : places) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string& name = parts[i].first;
      const std::string more = label.empty() || name.empty() ? label + name : label + ' ' + name;
      table.columns.push_back({heading(file, path, more), table.sources.size() + i, at});
    }
  }
  for (auto& [name, source] : parts) table.sources.push_back(std::move(source));
}

/// Calls f with stretches of the rows of a table, one per dimension, that make no more than so
/// many.
template <class F>
void each_block(const std::vector<Stretch>& rows, Index most, const F& f) {
  if (std::any_of(rows.begin(), rows.end(), [](const Stretch& s) { return s.count == 0; })) return;
  std::size_t d = rows.size() - 1;  // the dimension that is cut: those behind it are whole
  Index behind = 1;
  for (; d > 0 && behind * rows[d].count <= most; --d) behind *= rows[d].count;
  const Index at_once = std::max<Index>(1, most / behind);
  std::vector<Stretch> block = rows;
  for (std::size_t i = 0; i < d; ++i) block[i].count = 1;
  for (bool has_more = true; has_more;) {
    for (Index first = 0; first < rows[d].count; first += at_once) {
      block[d] = {rows[d].first + first, std::min(at_once, rows[d].count - first)};
      f(block);
    }
    has_more = false;
    for (std::size_t i = d; i-- > 0 && !has_more;) {
      has_more = ++block[i].first < rows[i].first + rows[i].count;
      if (!has_more) block[i].first = rows[i].first;
    }
  }
}

/// What stands along a dimension of the rows.
std::vector<std::string> labels_of(const ResultReader& file, const TableDimension& d,
                                   const Stretch& s) {
  if (d.axis.empty()) {
    std::vector<std::string> numbers;
    for (Index i = 0; i < s.count; ++i) numbers.push_back(fmt::format("{}", s.first + i + 1));
    return numbers;
  }
  if (file.kind(d.axis) != ObjectKind::text) return texts_of(file.numbers(d.axis, {s}));
  const std::vector<std::string> all = read_texts(file, d.axis);
  return {all.begin() + s.first, all.begin() + s.first + s.count};
}

/// Some rows of a table as lines.
std::string lines_of(const ResultReader& file, CsvTable& table, const std::vector<Stretch>& rows) {
  std::vector<std::vector<std::string>> along;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    along.push_back(labels_of(file, table.rows[i], rows[i]));
  }
  for (TableSource& source : table.sources) {
    if (source.is_whole) continue;
    for (std::size_t i = 0; i < rows.size(); ++i) source.read[source.rows[i]] = rows[i];
    source.numbers = file.numbers(source.path, source.read);
  }
  struct Cell {
    const TableSource* source;
    Index at;                    ///< of the first row
    std::vector<Index> strides;  ///< along the rows
  };
  std::vector<Cell> cells;
  for (const TableColumn& c : table.columns) {
    const TableSource& source = table.sources[c.source];
    const std::vector<Index> strides = source.strides();
    Cell cell{&source, 0, {}};
    for (std::size_t i = 0; i < strides.size(); ++i) cell.at += c.at[i] * strides[i];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      cell.strides.push_back(strides[source.rows[i]]);
      if (source.is_whole) cell.at += rows[i].first * cell.strides[i];
    }
    cells.push_back(std::move(cell));
  }
  std::string out;
  Index count = 1;
  for (const Stretch& s : rows) count *= s.count;
  std::vector<Index> at(rows.size(), 0);
  for (Index row = 0; row < count; ++row) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (i > 0) out += ',';
      out += along[i][static_cast<std::size_t>(at[i])];
    }
    for (const Cell& cell : cells) {
      Index place = cell.at;
      for (std::size_t i = 0; i < at.size(); ++i) place += at[i] * cell.strides[i];
      out += ',';
      if (cell.source->texts.empty()) {
        append_number(out, cell.source->numbers[static_cast<std::size_t>(place)]);
      } else {
        out += cell.source->texts[static_cast<std::size_t>(place)];
      }
    }
    out += '\n';
    for (std::size_t i = at.size(); i-- > 0;) {
      if (++at[i] < rows[i].count) break;
      at[i] = 0;
    }
  }
  return out;
}

/// What stands in the first line of a table.
std::string head_of(const ResultReader& file, const CsvTable& table) {
  std::string head;
  for (const TableDimension& d : table.rows) {
    head += (head.empty() ? "" : ",") +
            (d.axis.empty() ? "number" : csv_text(heading(file, d.axis, "")));
  }
  for (const TableColumn& c : table.columns) head += ',' + csv_text(c.head);
  return head;
}

void write_table(const ResultReader& file, CsvTable& table, const fs::path& place,
                 Replaces replaces, const std::optional<MotionSamples>& samples) {
  std::vector<Stretch> rows;
  for (const TableDimension& d : table.rows) {
    const bool is_cut = samples && d.axis == "/trajectory/time";
    rows.push_back(is_cut ? Stretch{samples->first, samples->size()} : Stretch{0, d.size});
  }
  const std::string head = head_of(file, table);
  const bool is_same = first_line(place) == head;
  replace_file(
      place,
      [&](std::ostream& out) {
        out << head << '\n';
        each_block(rows, rows_at_once,
                   [&](const std::vector<Stretch>& block) { out << lines_of(file, table, block); });
      },
      is_same ? Replaces::anything : replaces);
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

std::string spreadsheet_text(const std::string& text) {
  constexpr std::string_view formula = "=+-@\t\r";
  const bool is_formula = !text.empty() && formula.find(text.front()) != std::string_view::npos;
  return is_formula ? '\'' + text : text;
}

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
    for (std::size_t i = 0; i < shape.size(); ++i) all[i] = {axes[i], shape[i], i};
    split(result, all, rows, across);
    std::string key = group, name = group;
    for (const TableDimension& d : rows) {
      key += d.axis.empty() ? fmt::format(" #{}", d.size) : ' ' + d.axis;
      name += '_' + name_of(d.axis.empty() ? path : d.axis);
    }
    const auto [found, is_new] = of_rows.try_emplace(key, tables.size());
    if (is_new) tables.push_back({name, rows});
    add_columns(result, path, across, rows, tables[found->second]);
  }

  std::vector<fs::path> files;
  for (CsvTable& table : tables) {
    files.emplace_back(fmt::format("{}_{}.csv", stem.string(), table.name));
    write_table(result, table, files.back(), replaces, samples);
  }
  return files;
}

}  // namespace whirl::inline io
