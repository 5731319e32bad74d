/// HDF5 files of laws: datasets at the root or in a group.

#include <fmt/format.h>

#include <algorithm>

#include "libio/measured/law_parts.hpp"
#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

namespace {

/// A dataset with one or two dimensions, or of a response n x p x p.
LawArray array_at(const ResultReader& file, const std::string& path, const std::string& name) {
  const auto fail = [&](const std::string& why) {
    throw ModelError({file.path().string()}, path, why);
  };
  const ObjectKind kind = file.kind(path);
  const bool is_real = kind == ObjectKind::real || kind == ObjectKind::integer;
  LawArray array{.name = name, .is_complex = kind == ObjectKind::complex};
  if (!is_real && !array.is_complex) {
    fail("has neither real nor complex numbers, which are compounds of r and i");
  }
  const std::vector<Eigen::Index> shape = file.shape(path);
  std::vector<std::size_t> sizes;
  for (const Eigen::Index n : shape) sizes.push_back(static_cast<std::size_t>(n));
  require_law_size(file.path().string(), path, sizes);
  if (shape.size() > 2 || (shape.empty() && array.is_complex)) {
    fail(fmt::format("has {} dimensions, expected a vector or a matrix", shape.size()));
  }
  if (array.is_complex) {
    array.values = shape.size() == 1 ? CMat(file.complex_vector(path)) : file.complex_matrix(path);
  } else {
    const std::vector<double> numbers = file.numbers(path);
    const Eigen::Index rows = shape.empty() ? 1 : shape[0], cols = shape.size() < 2 ? 1 : shape[1];
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    array.values = Eigen::Map<const RowMajor>(numbers.data(), rows, cols).cast<Complex>();
  }
  for (const char* unit : {"units", "unit"}) {
    if (file.has_attribute(path, unit)) array.unit = file.string_attribute(path, unit);
  }
  return array;
}

}  // namespace

std::vector<LawArray> hdf5_law_arrays(const std::filesystem::path& file, const std::string& part) {
  const ResultReader reader(file);
  const std::string group = part.empty() ? "" : (part.front() == '/' ? part : "/" + part);
  const std::vector<std::string> there = reader.datasets(), groups = reader.groups();
  if (!part.empty() && std::ranges::find(groups, group) == groups.end()) {
    throw ModelError({file.string()}, part, "is no group of the file");
  }
  std::vector<LawArray> arrays;
  for (const std::string_view name : law_array_names) {
    const std::string path = fmt::format("{}/{}", group, name);
    if (std::ranges::find(there, path) == there.end()) continue;
    arrays.push_back(array_at(reader, path, std::string(name)));
  }
  return arrays;
}

}  // namespace whirl::inline io
