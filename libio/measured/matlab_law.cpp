/// MATLAB files of laws: variables of the file, or fields of a struct.

#include <fmt/format.h>

#include <algorithm>

#include "libio/measured/law_parts.hpp"
#include "libio/measured/matlab_elements.hpp"
#include "libio/results/confined_child.hpp"
#include "libio/results/matlab_variables.hpp"
#include "libio/text/file_bytes.hpp"

namespace whirl::inline io {

namespace {

bool is_law_name(std::string_view name) {
  return std::ranges::find(law_array_names, name) != std::end(law_array_names);
}

/// A variable as a matrix; of a response p x p x n a row for each of n frequencies.
LawArray array_of(const std::string& file, const matvar_t& v, const std::string& name) {
  const auto fail = [&](const std::string& why) { throw ModelError({file}, name, why); };
  if (v.rank < 2 || v.rank > 3) {
    fail(fmt::format("has {} dimensions, expected a matrix, or p x p x n of a response", v.rank));
  }
  std::vector<std::size_t> sizes(v.dims, v.dims + v.rank);
  require_law_size(file, name, sizes);
  LawArray array{.name = name, .is_complex = v.isComplex != 0};
  const auto rows = static_cast<Eigen::Index>(sizes[0]), cols = static_cast<Eigen::Index>(sizes[1]);
  const Eigen::Index pages = v.rank == 3 ? static_cast<Eigen::Index>(sizes[2]) : 1;
  const auto count = static_cast<std::size_t>(rows * cols * pages);
  std::vector<double> re, im(count, 0.0);
  if (array.is_complex && v.data) {
    const auto* parts = static_cast<const mat_complex_split_t*>(v.data);
    re = matlab_doubles(v, parts->Re);
    im = matlab_doubles(v, parts->Im);
  } else {
    re = matlab_doubles(v, v.data);
  }
  if (re.size() != count || im.size() != count) fail("is no full matrix of numbers");
  const auto at = [&](Eigen::Index i, Eigen::Index j, Eigen::Index k) {
    const auto place = static_cast<std::size_t>(i + rows * (j + cols * k));
    return Complex(re[place], im[place]);
  };
  if (v.rank == 2) {
    array.values = CMat::NullaryExpr(rows, cols, [&](auto i, auto j) { return at(i, j, 0); });
  } else {
    array.values = CMat::NullaryExpr(
        pages, rows * cols, [&](auto k, auto entry) { return at(entry / cols, entry % cols, k); });
  }
  return array;
}

/// In the child.
std::vector<LawArray> arrays_of(const std::string& place, const std::string& file,
                                const std::string& part) {
  const auto bytes = file_bytes(place, FileKind::regular, most_text_bytes);
  if (!bytes) throw FileError(fmt::format("{}: {}", file, bytes.problem));
  require_whole_variables(*bytes, file);
  const MatlabFile mat(Mat_Open(place.c_str(), MAT_ACC_RDONLY), &Mat_Close);
  open_nothing_more();
  if (!mat) throw ModelError({file}, "", "is no MATLAB file, or a damaged one");
  std::vector<LawArray> arrays;
  bool has_part = part.empty();
  while (true) {
    const MatlabVariable v(Mat_VarReadNextInfo(mat.get()), &Mat_VarFree);
    if (!v) break;
    const std::string name = v->name ? v->name : "";
    if (part.empty() ? !is_law_name(name) : name != part) continue;
    if (v->rank < 0 || v->rank > 3) throw ModelError({file}, name, "has too many dimensions");
    require_law_size(file, name, {v->dims, v->dims + v->rank});
    if (Mat_VarReadDataAll(mat.get(), v.get()) != 0) {
      throw ModelError({file}, name, "cannot be read: the file is damaged");
    }
    if (part.empty()) {
      arrays.push_back(array_of(file, *v, name));
      continue;
    }
    has_part = true;
    if (v->class_type != MAT_C_STRUCT || !v->data) {
      throw ModelError({file}, name, "is no struct with the matrices of a law");
    }
    for (const std::string_view field : law_array_names) {
      const std::string key(field);
      const matvar_t* found = Mat_VarGetStructFieldByName(v.get(), key.c_str(), 0);
      if (found) arrays.push_back(array_of(file, *found, key));
    }
  }
  if (!has_part) throw ModelError({file}, part, "is no variable of the file");
  return arrays;
}

}  // namespace

std::vector<LawArray> matlab_law_arrays(const std::filesystem::path& file,
                                        const std::string& part) {
  const OpenedFile opened(file);
  const ConfinedChild child(
      opened, file.string(), "MATLAB", [&, place = opened.place()](const std::string&) {
        return ConfinedChild::Letter{packed(arrays_of(place, file.string(), part))};
      });
  std::vector<LawArray> arrays;
  unpack(child.ask("").bytes, arrays);
  return arrays;
}

}  // namespace whirl::inline io
