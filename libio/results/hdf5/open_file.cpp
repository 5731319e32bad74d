#include "libio/results/hdf5/open_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/hdf5/handle.hpp"

namespace whirl::inline io::hdf5 {

namespace fs = std::filesystem;

namespace {

/// deflate makes at most so many bytes of one [zlib's manual: 1032], and a little of nothing.
constexpr hsize_t most_of_one = 1100;
/// Chunks may be larger than a small dataset that can grow, but not by more than this [bytes].
constexpr hsize_t most_spare = 16 * 1024 * 1024;
constexpr std::size_t widest_number = 8;  ///< bytes

/// A dataset or attribute that is open, with its type in the file and its sizes.
struct Source {
  Handle id, type;
  std::vector<hsize_t> sizes;
  hsize_t count = 1;

  bool is_number() const {
    const H5T_class_t kind = H5Tget_class(type);
    return (kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Tget_size(type) <= widest_number;
  }
  bool is_text() const { return H5Tget_class(type) == H5T_STRING; }
  bool is_complex() const {
    return H5Tget_class(type) == H5T_COMPOUND && H5Tget_nmembers(type) == 2 &&
           H5Tget_member_index(type, "r") == 0 && H5Tget_member_index(type, "i") == 1 &&
           H5Tget_member_class(type, 0) == H5T_FLOAT && H5Tget_member_class(type, 1) == H5T_FLOAT &&
           H5Tget_size(type) <= 2 * widest_number;
  }
};

/// Product of sizes; none beyond what a vector can count in bytes.
std::optional<hsize_t> product(const std::vector<hsize_t>& sizes, hsize_t bytes) {
  hsize_t all = bytes;
  for (const hsize_t size : sizes) {
    if (__builtin_mul_overflow(all, size, &all)) return std::nullopt;
  }
  if (all > static_cast<hsize_t>(std::numeric_limits<std::ptrdiff_t>::max())) return std::nullopt;
  return all;
}

Source make_source(const Attempt& attempt, Handle id, Handle type, const Handle& space) {
  Source source{std::move(id), std::move(type), sizes_of(space)};
  if (H5Sget_simple_extent_type(space) == H5S_NULL) source.sizes = {0};  // h5py's h5py.Empty
  const bool is_empty = std::count(source.sizes.begin(), source.sizes.end(), 0u) > 0;
  const auto bytes = is_empty ? 0 : product(source.sizes, sizeof(Complex));
  if (!bytes) attempt.fail("it says to hold more numbers than can be counted");
  source.count = *bytes / sizeof(Complex);
  return source;
}

/// Refuses datasets whose numbers are elsewhere, or of which the file cannot hold as many as it
/// says.
void check_storage(const Attempt& attempt, const Source& source, hid_t file) {
  const Handle how(attempt(H5Dget_create_plist(source.id)));
  const H5D_layout_t layout = H5Pget_layout(how);
  if (H5Pget_external_count(how) != 0 || layout == H5D_VIRTUAL) {
    attempt.fail("its numbers are in another file, which is not read");
  }
  for (int i = 0, n = attempt(H5Pget_nfilters(how)); i < n; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(how, static_cast<unsigned>(i), &flags, &values,
                                               nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32) {
      attempt.fail("it is compressed in a way that is not known (known: deflate)");
    }
  }
  if (source.count == 0) return;
  const std::size_t item = H5Tget_size(source.type);
  const auto bytes = product(source.sizes, item);
  hsize_t file_bytes = 0;
  attempt(H5Fget_filesize(file, &file_bytes));
  const hsize_t stored = H5Dget_storage_size(source.id);
  const bool fits = bytes && stored <= file_bytes &&
                    (layout == H5D_CHUNKED ? *bytes / most_of_one <= stored : *bytes <= stored);
  if (!fits) {
    attempt.fail(fmt::format("it says to hold {} values, the file holds {} bytes of them",
                             source.count, stored));
  }
  if (layout != H5D_CHUNKED) return;
  std::vector<hsize_t> chunk(source.sizes.size());
  attempt(H5Pget_chunk(how, static_cast<int>(chunk.size()), chunk.data()));
  const auto chunk_bytes = product(chunk, item);
  if (!chunk_bytes || *chunk_bytes > *bytes + most_spare) attempt.fail("its pieces are too large");
}

Source open_dataset(const Attempt& attempt, hid_t file) {
  const std::string& path = attempt.object();
  if (!exists(file, path)) attempt.fail("there is none");
  Handle id(attempt(H5Dopen2(file, path.c_str(), H5P_DEFAULT)));
  Handle type(attempt(H5Dget_type(id)));
  const Handle space(attempt(H5Dget_space(id)));
  Source source = make_source(attempt, std::move(id), std::move(type), space);
  check_storage(attempt, source, file);
  return source;
}

Source open_attribute(const Attempt& attempt, hid_t file, const std::string& object,
                      const std::string& name) {
  if (object != "/" && !exists(file, object)) attempt.fail("there is none");
  const Handle owner(attempt(H5Oopen(file, object.c_str(), H5P_DEFAULT)));
  if (H5Aexists(owner, name.c_str()) <= 0) attempt.fail("there is none");
  Handle id(attempt(H5Aopen(owner, name.c_str(), H5P_DEFAULT)));
  Handle type(attempt(H5Aget_type(id)));
  const Handle space(attempt(H5Aget_space(id)));
  return make_source(attempt, std::move(id), std::move(type), space);
}

/// Paths of the datasets along each dimension, from the list of references that HDF5's dimension
/// scales leave at a dataset; "" for none.
std::vector<std::string> read_axes(const Attempt& attempt, hid_t file, const Source& dataset) {
  constexpr const char* list = "DIMENSION_LIST";
  std::vector<std::string> names(dataset.sizes.size());
  if (names.empty() || H5Aexists(dataset.id, list) <= 0) return names;
  const Source source = open_attribute(attempt, file, attempt.object(), list);
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ));
  if (source.count != names.size() || H5Tequal(source.type, type) <= 0) {
    attempt.fail("its list of axes is damaged");
  }
  std::vector<hvl_t> references(names.size(), hvl_t{0, nullptr});
  attempt(H5Aread(source.id, type, references.data()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (references[i].len == 0 || !references[i].p) continue;
    const Handle axis(H5Rdereference2(file, H5P_DEFAULT, H5R_OBJECT, references[i].p));
    if (axis < 0 || H5Iget_type(axis) != H5I_DATASET) continue;
    names[i].resize(static_cast<std::size_t>(std::max<ssize_t>(0, H5Iget_name(axis, nullptr, 0))));
    H5Iget_name(axis, names[i].data(), names[i].size() + 1);
  }
  const hsize_t size = references.size();
  const Handle space(H5Screate_simple(1, &size, nullptr));
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, references.data());
  return names;
}

/// Goes along every link of a file, but into every group once, however many links lead there.
class Visit {
 public:
  Visit(hid_t file, Outline& outline) : outline_(outline) {
    H5O_info_t root;
    outline_.groups = {"/"};
    outline_.is_whole = H5Oget_info2(file, &root, H5O_INFO_BASIC) >= 0;
    known_.insert(root.addr);
    const auto look = [](hid_t from, const char* name, const H5L_info_t* link, void* visit) {
      static_cast<Visit*>(visit)->look(from, name, *link);
      return herr_t{0};
    };
    if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, look, this) < 0) outline_.is_whole = false;
  }

 private:
  void look(hid_t from, const char* name, const H5L_info_t& link) {
    const std::string path = std::string("/") + name;
    H5O_info_t object;
    if (link.type != H5L_TYPE_HARD) {
      if (outline_.elsewhere.empty()) outline_.elsewhere = path;
    } else if (H5Oget_info_by_name2(from, name, &object, H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
      outline_.is_whole = false;
    } else if (object.type == H5O_TYPE_GROUP) {
      const bool is_new = known_.insert(object.addr).second;
      if (is_new) outline_.groups.push_back(path);
      if (!is_new) outline_.has_other_paths = true;
    } else {
      (object.type == H5O_TYPE_DATASET ? outline_.datasets : outline_.others).push_back(path);
    }
  }

  Outline& outline_;
  std::set<haddr_t> known_;  ///< groups
};

void read(const Attempt& attempt, const Source& source, hid_t memory_type, void* result) {
  if (source.count == 0) return;
  const bool is_attribute = H5Iget_type(source.id) == H5I_ATTR;
  attempt(is_attribute ? H5Aread(source.id, memory_type, result)
                       : H5Dread(source.id, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result));
}

/// Real numbers of a dataset that are in a box.
std::vector<double> read_box(const Attempt& attempt, const Source& source,
                             const std::vector<hsize_t>& at, const std::vector<hsize_t>& box) {
  if (!source.is_number()) attempt.fail("it does not hold real numbers");
  bool fits = at.size() == source.sizes.size();
  for (std::size_t i = 0; fits && i < at.size(); ++i) {
    fits = at[i] <= source.sizes[i] && box[i] <= source.sizes[i] - at[i];
  }
  if (!fits) attempt.fail("it has not all of the numbers that are asked for");
  const auto bytes = product(box, sizeof(double));
  const hsize_t count = bytes.value_or(0) / sizeof(double);
  std::vector<double> values(count);
  if (count == 0) return values;
  const Handle space(attempt(H5Dget_space(source.id)));
  const Handle memory(attempt(memory_of(box)));
  if (!box.empty()) {
    attempt(H5Sselect_hyperslab(space, H5S_SELECT_SET, at.data(), nullptr, box.data(), nullptr));
  }
  attempt(H5Dread(source.id, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()));
  return values;
}

/// Calls f with numbers of a dataset, from `first` on, box by box.
template <class F>
void read_boxes(const Attempt& attempt, const Source& source, hsize_t first, hsize_t count,
                const F& f) {
  if (first > source.count || count > source.count - first) {
    attempt.fail("it has not all of the numbers that are asked for");
  }
  for_each_box(source.sizes, first, count, [&](const auto& at, const auto& box, hsize_t) {
    f(read_box(attempt, source, at, box));
  });
}

/// Texts of any kind: of variable or of fixed length, ASCII or UTF-8.
std::vector<std::string> read_texts(const Attempt& attempt, const Source& source) {
  if (!source.is_text()) attempt.fail("it is not text");
  if (source.count == 0) return {};
  const std::size_t count = source.count, size = H5Tget_size(source.type);
  std::vector<std::string> texts;
  if (H5Tis_variable_str(source.type) > 0) {
    std::vector<char*> pointers(count, nullptr);
    read(attempt, source, source.type, pointers.data());
    for (const char* pointer : pointers) texts.emplace_back(pointer ? pointer : "");
    const Handle space(attempt(H5Screate_simple(1, &source.count, nullptr)));
    H5Dvlen_reclaim(source.type, space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  std::string all(count * size, '\0');
  read(attempt, source, source.type, all.data());
  for (std::size_t i = 0; i < count; ++i) {
    texts.push_back(all.substr(i * size, size));
    texts.back().resize(std::min(texts.back().find('\0'), size));
  }
  return texts;
}

void require_rank(const Attempt& attempt, const Source& source, std::size_t rank) {
  if (source.sizes.size() == rank) return;
  attempt.fail(fmt::format("it has {} dimensions, expected {}", source.sizes.size(), rank));
}

}  // namespace

OpenFile::OpenFile(fs::path name) : name_(std::move(name)) {
  const auto fail = [&](std::string_view why) {
    throw FileError(fmt::format("cannot open {}: {}", name_.string(), why));
  };
  prepare();
  const htri_t is_hdf5 = H5Fis_hdf5(name_.c_str());
  if (is_hdf5 < 0) fail(reason());
  if (is_hdf5 == 0) fail("not an HDF5 file");
  if (seal_of(name_) == Seal::broken) fail("damaged HDF5 file (its checksum is another one)");
  const Handle access = file_access();
  id_ = H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access);
  if (id_ < 0) fail(fmt::format("damaged HDF5 file ({})", reason()));
  open_nothing_more();
  Visit(id_, outline_);
  if (outline_.elsewhere.empty()) return;
  H5Fclose(id_);
  fail(outline_.elsewhere + " is a link to another place, which is not followed");
}

OpenFile::~OpenFile() {
  H5Fclose(id_);
}

bool OpenFile::has(const std::string& object) const {
  return object == "/" || exists(id_, object);
}

bool OpenFile::has_attribute(const std::string& object, const std::string& name) const {
  return has(object) && H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string OpenFile::string_attribute(const std::string& object, const std::string& name) const {
  const Attempt attempt(name_, "read attribute", object + '@' + name);
  const Source source = open_attribute(attempt, id_, object, name);
  if (source.count != 1) attempt.fail("it is not one text");
  return read_texts(attempt, source).front();
}

double OpenFile::number_attribute(const std::string& object, const std::string& name) const {
  const Attempt attempt(name_, "read attribute", object + '@' + name);
  const Source source = open_attribute(attempt, id_, object, name);
  if (!source.is_number() || source.count != 1) attempt.fail("it is not one number");
  double value = 0.0;
  read(attempt, source, H5T_NATIVE_DOUBLE, &value);
  return value;
}

ObjectKind OpenFile::kind(const std::string& object) const {
  const Attempt attempt(name_, "read", object);
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

std::vector<std::string> OpenFile::axes(const std::string& path) const {
  const Attempt attempt(name_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  std::vector<std::string> names = read_axes(attempt, id_, source);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const Source axis = open_dataset(Attempt(name_, "read dataset", names[i]), id_);
    if (axis.sizes != std::vector<hsize_t>{source.sizes[i]}) {
      attempt.fail(fmt::format("its axis {} has another size", names[i]));
    }
  }
  return names;
}

Sizes OpenFile::shape(const std::string& path) const {
  const Source source = open_dataset(Attempt(name_, "read dataset", path), id_);
  return {source.sizes.begin(), source.sizes.end()};
}

std::vector<double> OpenFile::numbers(const std::string& path) const {
  const Attempt attempt(name_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (!source.is_number()) attempt.fail("it does not hold real numbers");
  std::vector<double> values(source.count);
  read(attempt, source, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<double> OpenFile::numbers(const std::string& path, std::size_t dimensions) const {
  const Attempt attempt(name_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (!source.is_number()) attempt.fail("it does not hold real numbers");
  require_rank(attempt, source, dimensions);
  std::vector<double> values(source.count);
  read(attempt, source, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<double> OpenFile::complex_numbers(const std::string& path,
                                              std::size_t dimensions) const {
  const Attempt attempt(name_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (!source.is_complex()) attempt.fail("it does not hold complex numbers");
  require_rank(attempt, source, dimensions);
  std::vector<double> values(2 * source.count);
  read(attempt, source, complex_type(), values.data());
  return values;
}

std::vector<double> OpenFile::numbers(const std::string& path, const Sizes& at,
                                      const Sizes& box) const {
  const Attempt attempt(name_, "read dataset", path);
  return read_box(attempt, open_dataset(attempt, id_), {at.begin(), at.end()},
                  {box.begin(), box.end()});
}

std::vector<double> OpenFile::numbers_from(const std::string& path, std::size_t first,
                                           std::size_t count) const {
  const Attempt attempt(name_, "read dataset", path);
  std::vector<double> values;
  read_boxes(attempt, open_dataset(attempt, id_), first, count, [&](std::vector<double> box) {
    if (values.empty()) {
      values = std::move(box);
    } else {
      values.insert(values.end(), box.begin(), box.end());
    }
  });
  return values;
}

std::vector<int> OpenFile::integers(const std::string& path) const {
  const Attempt attempt(name_, "read dataset", path);
  const Source source = open_dataset(attempt, id_);
  if (H5Tget_class(source.type) != H5T_INTEGER) attempt.fail("it does not hold integers");
  std::vector<int> values(source.count);
  read(attempt, source, H5T_NATIVE_INT, values.data());
  return values;
}

std::vector<std::string> OpenFile::strings(const std::string& path) const {
  const Attempt attempt(name_, "read dataset", path);
  return read_texts(attempt, open_dataset(attempt, id_));
}

std::vector<std::string> OpenFile::attributes(const std::string& object) const {
  const Attempt attempt(name_, "read attributes of", object);
  if (!has(object)) attempt.fail("there is none");
  const Handle id(attempt(H5Oopen(id_, object.c_str(), H5P_DEFAULT)));
  H5O_info_t info;
  attempt(H5Oget_info2(id, &info, H5O_INFO_NUM_ATTRS));
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const auto get = [&](char* text, std::size_t size) {
      return attempt(
          H5Aget_name_by_idx(id, ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size, H5P_DEFAULT));
    };
    std::string name(static_cast<std::size_t>(get(nullptr, 0)), '\0');
    get(name.data(), name.size() + 1);
    const bool is_of_axes = name == "CLASS" || name == "NAME" || name == "DIMENSION_LIST" ||
                            name == "REFERENCE_LIST" || name == "DIMENSION_LABELS";
    if (!is_of_axes) names.push_back(name);
  }
  return names;
}

std::vector<std::string> OpenFile::list(const std::string& group) const {
  const Attempt attempt(name_, "read group", group);
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

const Outline& OpenFile::whole_outline() const {
  if (!outline_.is_whole) Attempt(name_, "read", "its groups").fail("the file is damaged");
  return outline_;
}

}  // namespace whirl::inline io::hdf5
