#include "libio/results/columns.hpp"

#include <utility>

namespace whirl::inline io::columns {

std::vector<std::string> dimension_names(std::string_view list) {
  std::vector<std::string> names;
  for (DimensionName& d : dimensions_of(list)) names.push_back(std::move(d.name));
  return names;
}

ResultEntry entry_of(const std::string& path, const Facts& facts, ObjectKind kind) {
  return {path, kind, facts.dimensions, facts.values, facts.is_optional, facts.unit, facts.meaning};
}

void GroupWriter::attribute(const std::string& name, const Cells& cells) {
  switch (cells.kind) {
    case ObjectKind::text:
      return file_.attribute(group_, name, cells.texts.at(0));
    case ObjectKind::integer:
      return file_.attribute(group_, name, cells.integers.at(0));
    default:
      return file_.attribute(group_, name, cells.reals.at(0));
  }
}

DatasetInfo GroupWriter::info_of(const Facts& facts, std::span<const Eigen::Index> shape) {
  const std::vector<std::string> names = dimension_names(facts.dimensions);
  DatasetInfo info{facts.unit, facts.meaning, {}};
  if (facts.unit == unit_of_parameter && parameter_of_) {
    const ParameterName name = parameter_of_(facts.name);
    info.units = name.unit;
    info.long_name = name.path;
  }
  for (const std::string& name : names) {
    const auto axis = axes_.find(name);
    const bool has_axis = !facts.is_axis && axis != axes_.end();
    info.axes.push_back(name.starts_with('/') ? name : has_axis ? axis->second.path : "");
  }
  info.axes.resize(shape.size());
  if (facts.is_axis) {
    axes_.insert_or_assign(names.at(0), Axis{group_ + "/" + facts.name, shape[0]});
  }
  return info;
}

void GroupWriter::dataset(const Facts& facts, const Mat& values) {
  const Eigen::Index shape[] = {values.rows(), values.cols()};
  file_.dataset(group_ + "/" + facts.name, values, info_of(facts, shape));
}

void GroupWriter::dataset(const Facts& facts, Cells cells) {
  const std::string path = group_ + "/" + facts.name;
  const DatasetInfo info = info_of(facts, cells.shape);
  switch (cells.kind) {
    case ObjectKind::text:
      return file_.dataset(path, cells.texts, info);
    case ObjectKind::integer:
      return file_.dataset(path, cells.integers, cells.shape, info);
    case ObjectKind::complex:
      if (cells.shape.size() == 1) {
        return file_.dataset(path, CVec(CVec::Map(cells.complexes.data(), cells.shape[0])), info);
      }
      return file_.dataset(
          path, CMat(CMat::Map(cells.complexes.data(), cells.shape[1], cells.shape[0]).transpose()),
          info);
    default:
      return file_.dataset(path, cells.reals, cells.shape, info);
  }
}

Eigen::Index GroupWriter::size_of(std::string_view dimension) const {
  Eigen::Index fixed = 0;
  for (const char c : dimension) {
    if (c < '0' || c > '9') {
      const auto axis = axes_.find(dimension);
      return axis == axes_.end() ? 0 : axis->second.size;
    }
    fixed = 10 * fixed + (c - '0');
  }
  return fixed;
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

ParameterName read_parameter(const ResultReader& file, const std::string& path) {
  if (!file.has(path)) return {};
  return {file.string_attribute(path, "long_name"), file.string_attribute(path, "units")};
}

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

}  // namespace whirl::inline io::columns
