#include "python/module/store.hpp"

#include <fmt/format.h>
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "libio/results/cells.hpp"
#include "libio/results/columns.hpp"
#include "libio/results/result_schema.hpp"
#include "libio/text/file_bytes.hpp"

namespace whirl::inline python {

namespace py = pybind11;

namespace {

/// Dimensions by name, of what the schema knows of a dataset.
std::vector<std::string> schema_dimensions(const std::string& path) {
  for (const ResultSet& set : result_schema()) {
    for (const ResultEntry& entry : set.entries) {
      if (entry.path == path) return columns::dimension_names(entry.sizes);
    }
  }
  return {};
}

/// All of a group, but for other groups in it, without the numbers.
void list_group(const ResultReader& file, const std::string& group, KeptResult& to) {
  const auto add_attributes = [&](const std::string& object) {
    for (const std::string& name : file.attributes(object)) {
      if (name == "units" || name == "long_name") continue;  // the dataset's own
      KeptResult::Attribute attribute{object, name, 0};
      try {
        attribute.value = file.string_attribute(object, name);
      } catch (const FileError&) {
        attribute.value = file.number_attribute(object, name);
      }
      to.attributes.push_back(std::move(attribute));
    }
  };
  add_attributes(group);
  for (const std::string& name : file.list(group)) {
    const std::string path = group == "/" ? "/" + name : group + "/" + name;
    const ObjectKind kind = file.kind(path);
    if (kind == ObjectKind::group || kind == ObjectKind::other) continue;
    const auto text = [&](const char* of) {
      return file.has_attribute(path, of) ? file.string_attribute(path, of) : std::string();
    };
    to.datasets.push_back({path,
                           std::vector<double>{},
                           file.shape(path),
                           {text("units"), text("long_name"), file.axes(path)}});
    add_attributes(path);
  }
}

template <class Value>
py::array view(const std::vector<Value>& values, const std::vector<Eigen::Index>& shape,
               const std::shared_ptr<KeptResult>& owner) {
  const py::capsule keeps(new std::shared_ptr<KeptResult>(owner), [](void* pointer) {
    delete static_cast<std::shared_ptr<KeptResult>*>(pointer);
  });
  py::array_t<Value> array(std::vector<py::ssize_t>(shape.begin(), shape.end()), values.data(),
                           keeps);
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace

Store::Store(const std::string& file)
    : kept_(std::make_shared<KeptResult>()), reader_(open_result(file)) {
  for (const std::string& group : reader_->groups()) list_group(*reader_, group, *kept_);
}

KeptResult::Dataset& Store::dataset(const std::string& path) const {
  const auto found = std::find_if(kept_->datasets.begin(), kept_->datasets.end(),
                                  [&](const auto& d) { return d.path == path; });
  if (found == kept_->datasets.end()) throw py::key_error(path);
  return *found;
}

std::vector<std::string> Store::paths() const {
  std::vector<std::string> all;
  for (const KeptResult::Dataset& d : kept_->datasets) all.push_back(d.path);
  return all;
}

py::tuple Store::info(const std::string& path) const {
  const KeptResult::Dataset& d = dataset(path);
  std::vector<std::string> axes = d.info.axes;
  axes.resize(d.shape.size());
  return py::make_tuple(d.info.units, d.info.long_name, axes, py::tuple(py::cast(d.shape)),
                        schema_dimensions(path));
}

void Store::load(KeptResult::Dataset& d) {
  if (!reader_ || !loaded_.insert(d.path).second) return;
  columns::Cells cells = columns::read_cells(*reader_, d.path, reader_->kind(d.path)).value();
  switch (cells.kind) {
    case ObjectKind::text:
      d.values = std::move(cells.texts);
      break;
    case ObjectKind::integer:
      d.values = std::move(cells.integers);
      break;
    case ObjectKind::complex:
      d.values = std::move(cells.complexes);
      break;
    default:
      d.values = std::move(cells.reals);
  }
}

py::object Store::values(const std::string& path) {
  KeptResult::Dataset& d = dataset(path);
  load(d);
  if (const auto* texts = std::get_if<std::vector<std::string>>(&d.values)) return py::cast(*texts);
  if (const auto* reals = std::get_if<std::vector<double>>(&d.values)) {
    return view(*reals, d.shape, kept_);
  }
  if (const auto* integers = std::get_if<std::vector<int>>(&d.values)) {
    return view(*integers, d.shape, kept_);
  }
  return view(std::get<std::vector<Complex>>(d.values), d.shape, kept_);
}

py::list Store::attributes() const {
  py::list all;
  for (const auto& a : kept_->attributes) {
    all.append(py::make_tuple(a.object, a.name, py::cast(a.value)));
  }
  return all;
}

void Store::save(const std::string& file, bool replaces_anything) {
  const py::gil_scoped_release others_run;
  const Replaces what = replaces_anything ? Replaces::anything : Replaces::own_results;
  if (reader_) {
    const auto bytes = file_bytes(reader_->path(), FileKind::regular, std::string().max_size());
    if (!bytes) throw FileError(fmt::format("{}: {}", reader_->path().string(), bytes.problem));
    return replace_file(file, *bytes, what);
  }
  ResultWriter writer(file, what);
  writer.write(*kept_);
  writer.commit();
}

}  // namespace whirl::inline python
