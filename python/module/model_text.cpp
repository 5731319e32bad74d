#include "python/module/model_text.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "libdyn/system/film_equilibrium.hpp"
#include "libio/export/matrices.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::inline python {

namespace py = pybind11;

namespace {

py::object value_of(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::boolean:
      return py::bool_(node.boolean);
    case ConfigNode::Kind::integer:
      return py::int_(static_cast<long>(node.number));
    case ConfigNode::Kind::real:
      return py::float_(node.number);
    case ConfigNode::Kind::array: {
      py::list list;
      for (const ConfigNode& item : node.items) list.append(value_of(item));
      return list;
    }
    case ConfigNode::Kind::table: {
      py::dict table;
      for (const auto& [key, entry] : node.entries) table[py::str(key)] = value_of(entry);
      return table;
    }
    default:
      return py::str(node.text);
  }
}

/// Sets with one more; an earlier one of the same path has no effect any more, unless what was set
/// after it was found by its value.
void add(std::vector<std::string>& sets, const std::string& set) {
  const std::string path = set.substr(0, set.find('=') + 1);
  const bool names = path.ends_with(".name=");
  if (!names) {
    std::erase_if(sets, [&](const std::string& before) { return before.starts_with(path); });
  }
  sets.push_back(set);
}

/// A sparse matrix by columns, whose arrays look at it.
py::tuple compressed_columns(Sparse matrix) {
  matrix.makeCompressed();
  auto* const kept = new Sparse(std::move(matrix));
  const py::capsule owner(kept, [](void* pointer) { delete static_cast<Sparse*>(pointer); });
  const auto n = kept->nonZeros();
  return py::make_tuple(py::array_t<double>(n, kept->valuePtr(), owner),
                        py::array_t<int>(n, kept->innerIndexPtr(), owner),
                        py::array_t<int>(kept->outerSize() + 1, kept->outerIndexPtr(), owner));
}

}  // namespace

ModelText::ModelText(std::string file, std::string text, std::vector<std::string> sets, bool stored)
    : file_(std::move(file)), text_(std::move(text)), sets_(std::move(sets)), is_stored_(stored) {
  const std::filesystem::path folder = std::filesystem::path(file_).parent_path();
  made_ = std::make_shared<const Model>(
      parse_model(text_, file_, sets_,
                  (stored ? NamedFiles::of_sets_in(folder) : NamedFiles(folder)).with(law_table)));
}

ModelText ModelText::with(const std::vector<std::string>& sets) const {
  std::vector<std::string> all = sets_;
  for (const std::string& set : sets) add(all, set);
  return {file_, text_, std::move(all), is_stored_};
}

py::object ModelText::value(const std::string& path) const {
  ConfigNode root = parse_toml(text_, file_);
  for (const std::string& set : sets_) set_value(root, set);
  return value_of(value_at(root, path));
}

py::dict ModelText::matrices() const {
  const Model& model = *made_;
  auto [assembler, system] = [&] {
    const py::gil_scoped_release others_run;
    Assembler made(linear_structure(model));
    System at_speed = made.uncondensed(model.speed);
    return std::pair(std::move(made), std::move(at_speed));
  }();
  py::dict all;
  all["M"] = compressed_columns(system.M);
  all["C"] = compressed_columns(system.C);
  all["G"] = compressed_columns(system.G());
  all["K"] = compressed_columns(system.stiffness());
  all["names"] = coordinate_names(system.dofs, model);
  all["z"] = coordinate_places(system.dofs, model, assembler);
  all["speed"] = model.speed;
  return all;
}

}  // namespace whirl::inline python
