#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>

#include "libio/hdf5.hpp"
#include "libio/hdf5/handle.hpp"

namespace whirl {

namespace fs = std::filesystem;
using namespace hdf5;

namespace {

/// A dataset or attribute that is open, with its type in the file and its sizes.
struct Source {
  Handle id, type;
  std::vector<hsize_t> sizes;

  hsize_t count() const {
    hsize_t n = 1;
    for (const hsize_t size : sizes) n *= size;
    return n;
  }
  bool is_number() const {
    return H5Tget_class(type) == H5T_FLOAT || H5Tget_class(type) == H5T_INTEGER;
  }
  bool is_text() const { return H5Tget_class(type) == H5T_STRING; }
  bool is_complex() const {
    return H5Tget_class(type) == H5T_COMPOUND && H5Tget_nmembers(type) == 2 &&
           H5Tget_member_index(type, "r") == 0 && H5Tget_member_index(type, "i") == 1;
  }
};

Source open_dataset(const Attempt& attempt, hid_t file) {
  const std::string& path = attempt.object();
  if (!exists(file, path)) attempt.fail("there is none");
  Handle id(attempt(H5Dopen2(file, path.c_str(), H5P_DEFAULT)));
  Handle type(attempt(H5Dget_type(id)));
  const Handle space(attempt(H5Dget_space(id)));
  return {std::move(id), std::move(type), sizes_of(space)};
}

Source open_attribute(const Attempt& attempt, hid_t file, const std::string& object,
                      const std::string& name) {
  if (object != "/" && !exists(file, object)) attempt.fail("there is none");
  const Handle owner(attempt(H5Oopen(file, object.c_str(), H5P_DEFAULT)));
  if (H5Aexists(owner, name.c_str()) <= 0) attempt.fail("there is none");
  Handle id(attempt(H5Aopen(owner, name.c_str(), H5P_DEFAULT)));
  Handle type(attempt(H5Aget_type(id)));
  const Handle space(attempt(H5Aget_space(id)));
  return {std::move(id), std::move(type), sizes_of(space)};
}

void read(const Attempt& attempt, const Source& source, hid_t memory_type, void* result) {
  if (source.count() == 0) return;
  const bool is_attribute = H5Iget_type(source.id) == H5I_ATTR;
  attempt(is_attribute ? H5Aread(source.id, memory_type, result)
                       : H5Dread(source.id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result));
}

/// Texts of any kind: of variable or of fixed length, ASCII or UTF-8.
std::vector<std::string> read_texts(const Attempt& attempt, const Source& source) {
  if (!source.is_text()) attempt.fail("it is not text");
  const std::size_t count = source.count();
  std::vector<std::string> texts;
  if (H5Tis_variable_str(source.type) > 0) {
    std::vector<char*> pointers(count, nullptr);
    read(attempt, source, source.type, pointers.data());
    for (const char* pointer : pointers) texts.emplace_back(pointer ? pointer : "");
    const hsize_t size = count;
    const Handle space(attempt(H5Screate_simple(1, &size, nullptr)));
    H5Dvlen_reclaim(source.type, space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t size = H5Tget_size(source.type);
  std::string all(count * size, '\0');
  read(attempt, source, source.type, all.data());
  for (std::size_t i = 0; i < count; ++i) {
    texts.push_back(all.substr(i * size, size));
    texts.back().resize(std::min(texts.back().find('\0'), size));
  }
  return texts;
}

/// All numbers of a dataset of given rank; a vector is a matrix of one column.
template <class Scalar>
auto read_matrix(const Attempt& attempt, hid_t file, std::size_t rank) {
  constexpr bool is_complex = std::is_same_v<Scalar, Complex>;
  const Source source = open_dataset(attempt, file);
  if (is_complex ? !source.is_complex() : !source.is_number()) {
    attempt.fail(is_complex ? "it does not hold complex numbers" : "it does not hold real numbers");
  }
  if (source.sizes.size() != rank) {
    attempt.fail(fmt::format("it has {} dimensions, expected {}", source.sizes.size(), rank));
  }
  const auto rows = static_cast<Eigen::Index>(source.sizes[0]);
  const auto columns = rank == 1 ? 1 : static_cast<Eigen::Index>(source.sizes[1]);
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(rows, columns);
  read(attempt, source, is_complex ? complex_type() : Handle(H5Tcopy(H5T_NATIVE_DOUBLE)),
       values.data());
  return values;
}

}  // namespace

ResultReader::ResultReader(const fs::path& path) : path_(path) {
  const auto fail = [&](std::string_view why) {
    throw FileError(fmt::format("cannot open {}: {}", path_.string(), why));
  };
  prepare();
  std::error_code ignored;
  if (!fs::exists(path_, ignored)) fail("there is no such file");
  const htri_t is_hdf5 = fs::is_directory(path_, ignored) ? 0 : H5Fis_hdf5(path_.c_str());
  if (is_hdf5 < 0) fail(reason());
  if (is_hdf5 == 0) fail("not an HDF5 file");
  const Handle access = file_access();
  id_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access);
  if (id_ < 0) fail(fmt::format("damaged HDF5 file ({})", reason()));
}

ResultReader::~ResultReader() {
  H5Fclose(id_);
}

bool ResultReader::has(const std::string& object) const {
  return object == "/" || exists(id_, object);
}

bool ResultReader::has_attribute(const std::string& object, const std::string& name) const {
  return has(object) && H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string ResultReader::string_attribute(const std::string& object,
                                           const std::string& name) const {
  const Attempt attempt(path_, "read attribute", object + '@' + name);
  const auto texts = read_texts(attempt, open_attribute(attempt, id_, object, name));
  if (texts.size() != 1) attempt.fail("it is not one text");
  return texts.front();
}

double ResultReader::number_attribute(const std::string& object, const std::string& name) const {
  const Attempt attempt(path_, "read attribute", object + '@' + name);
  const Source source = open_attribute(attempt, id_, object, name);
  if (!source.is_number() || source.count() != 1) attempt.fail("it is not one number");
  double value = 0.0;
  read(attempt, source, H5T_NATIVE_DOUBLE, &value);
  return value;
}

ObjectKind ResultReader::kind(const std::string& object) const {
  const Attempt attempt(path_, "read", object);
  if (!has(object)) attempt.fail("there is none");
  const Handle id(attempt(H5Oopen(id_, object.c_str(), H5P_DEFAULT)));
  if (H5Iget_type(id) == H5I_GROUP) return ObjectKind::group;
  if (H5Iget_type(id) != H5I_DATASET) return ObjectKind::other;
  const Source source = open_dataset(attempt, id_);
  if (source.is_text()) return ObjectKind::text;
  if (source.is_complex()) return ObjectKind::complex;
  if (!source.is_number()) return ObjectKind::other;
  return H5Tget_class(source.type) == H5T_INTEGER ? ObjectKind::integer : ObjectKind::real;
}

std::vector<std::string> ResultReader::axes(const std::string& path) const {
  const Attempt attempt(path_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  std::vector<std::string> names(source.sizes.size());
  const auto take = [](hid_t, unsigned, hid_t axis, void* name) -> herr_t {
    std::string& text = *static_cast<std::string*>(name);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, H5Iget_name(axis, nullptr, 0))));
    H5Iget_name(axis, text.data(), text.size() + 1);
    return 1;  // the first of them
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto dimension = static_cast<unsigned>(i);
    if (H5DSget_num_scales(source.id, dimension) <= 0) continue;
    attempt(H5DSiterate_scales(source.id, dimension, nullptr, take, &names[i]));
  }
  return names;
}

std::vector<Eigen::Index> ResultReader::shape(const std::string& path) const {
  const Source source = open_dataset(Attempt(path_, "read dataset", path), id_);
  return {source.sizes.begin(), source.sizes.end()};
}

Vec ResultReader::vector(const std::string& path) const {
  return read_matrix<double>(Attempt(path_, "read dataset", path), id_, 1);
}

std::vector<double> ResultReader::numbers(const std::string& path) const {
  const Attempt attempt(path_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (!source.is_number()) attempt.fail("it does not hold real numbers");
  std::vector<double> values(source.count());
  read(attempt, source, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

Mat ResultReader::matrix(const std::string& path) const {
  return read_matrix<double>(Attempt(path_, "read dataset", path), id_, 2);
}

CVec ResultReader::complex_vector(const std::string& path) const {
  return read_matrix<Complex>(Attempt(path_, "read dataset", path), id_, 1);
}

CMat ResultReader::complex_matrix(const std::string& path) const {
  return read_matrix<Complex>(Attempt(path_, "read dataset", path), id_, 2);
}

std::vector<int> ResultReader::integers(const std::string& path) const {
  const Attempt attempt(path_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (H5Tget_class(source.type) != H5T_INTEGER) attempt.fail("it does not hold integers");
  std::vector<int> values(source.count());
  read(attempt, source, H5T_NATIVE_INT, values.data());
  return values;
}

std::vector<std::string> ResultReader::strings(const std::string& path) const {
  const Attempt attempt(path_, "read dataset", path);
  return read_texts(attempt, open_dataset(attempt, id_));
}

std::vector<std::string> ResultReader::list(const std::string& group) const {
  const Attempt attempt(path_, "read group", group);
  if (!has(group)) attempt.fail("there is none");
  const Handle id(attempt(H5Gopen2(id_, group.c_str(), H5P_DEFAULT)));
  H5G_info_t info;
  attempt(H5Gget_info(id, &info));
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto get = [&](char* text, std::size_t size) {
      return attempt(
          H5Lget_name_by_idx(id, ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size, H5P_DEFAULT));
    };
    std::string name(static_cast<std::size_t>(get(nullptr, 0)), '\0');
    get(name.data(), name.size() + 1);
    names.push_back(name);
  }
  return names;
}

}  // namespace whirl
