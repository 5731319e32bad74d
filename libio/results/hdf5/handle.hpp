#pragma once
/// What reading and writing HDF5 share. For the files of this folder only, which alone see HDF5.
///
/// Every call of HDF5 happens while an Attempt lives or library_lock() is held, the names of types
/// included (H5T_NATIVE_DOUBLE is a call): a child made meanwhile by another thread would wait for
/// ever for HDF5's own lock.

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libio/results/confined_child.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io::hdf5 {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// Owner of one of HDF5's handles.
class Handle {
 public:
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  operator hid_t() const { return id_; }
  /// Hands the handle over.
  hid_t release() { return std::exchange(id_, -1); }

 private:
  hid_t id_;
};

/// To be called in every thread before anything else is asked of HDF5: HDF5 then prints no errors,
/// which this program prints itself, and cleans nothing up when the process ends, where HDF5 1.10
/// would crash after a full disk.
inline void prepare() {
  [[maybe_unused]] static const herr_t in_process = H5dont_atexit();
  [[maybe_unused]] thread_local const herr_t in_thread =
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// The innermost of HDF5's reasons for the last failure; any further call of HDF5 forgets it.
inline std::string reason() {
  std::string text;
  const auto take_first = [](unsigned n, const H5E_error2_t* error, void* result) -> herr_t {
    if (n == 0 && error->desc) *static_cast<std::string*>(result) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  if (text.empty()) return "HDF5 gives no reason";
  // of a long list of details only what the system says: "... error message = 'File too large' ..."
  constexpr std::string_view key = "error message = '";
  const std::size_t start = text.find(key);
  if (start == std::string::npos) return text;
  text.erase(0, start + key.size());
  return text.substr(0, text.find('\''));
}

/// Something done with an object of a file; turns HDF5's negative results into errors. While an
/// Attempt lives no child process is made.
class Attempt {
 public:
  Attempt(const std::filesystem::path& file, std::string_view action, std::string object)
      : file_(file), action_(action), object_(std::move(object)) {
    prepare();
  }

  [[noreturn]] void fail(std::string_view why) const {
    throw FileError(fmt::format("{}: cannot {} {}: {}", file_.string(), action_, object_, why));
  }
  template <class Result>
  Result operator()(Result result) const {
    if (result < 0) fail(reason());
    return result;
  }
  const std::string& object() const { return object_; }

 private:
  const std::filesystem::path& file_;
  std::string_view action_;  ///< "write dataset"
  std::string object_;
  std::lock_guard<std::recursive_mutex> alone_{library_lock()};
};

inline Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

/// Pairs of doubles named as numpy and h5py name them.
inline Handle complex_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Complex)));
  H5Tinsert(type, "r", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "i", sizeof(double), H5T_NATIVE_DOUBLE);
  return type;
}

/// The type of numbers and texts in memory.
/// @param kind  real, integer, complex or text
inline Handle type_of(ObjectKind kind) {
  if (kind == ObjectKind::text) return text_type();
  if (kind == ObjectKind::complex) return complex_type();
  return Handle(H5Tcopy(kind == ObjectKind::integer ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE));
}

/// Files are private to their writer and never change under a reader: no locks are needed, which
/// some network file systems refuse.
inline Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_locking(access, false, true);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  return access;
}

/// Whether a file itself has an object of that path: links to other places do not count.
inline bool exists(hid_t file, const std::string& object) {
  prepare();
  // HDF5 wants every group on the way asked for
  for (std::size_t end = object.find_first_not_of('/'); end < object.size();) {
    end = std::min(object.find('/', end), object.size());
    const std::string part = object.substr(0, end);
    H5L_info_t link;
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0) return false;
    if (link.type != H5L_TYPE_HARD) return false;
    end = object.find_first_not_of('/', end);
  }
  return !object.empty();
}

/// Calls f with the boxes, as few as possible, that numbers of a dataset from `first` on fill, in
/// their order: f(first indices, sizes, how many numbers). A dataset without dimensions is one
/// number.
template <class F>
void for_each_box(const std::vector<hsize_t>& sizes, hsize_t first, hsize_t count, const F& f) {
  if (sizes.empty()) {
    if (count > 0) f(sizes, sizes, hsize_t{1});
    return;
  }
  while (count > 0) {
    std::vector<hsize_t> at(sizes.size()), box(sizes.size(), 1);
    for (hsize_t i = sizes.size(), rest = first; i-- > 0; rest /= sizes[i]) at[i] = rest % sizes[i];
    // the outermost dimension of which whole slices are asked for, from the beginning of one on
    std::size_t d = sizes.size() - 1;
    hsize_t slice = 1;
    for (; d > 0 && at[d] == 0 && slice * sizes[d] <= count; --d) slice *= box[d] = sizes[d];
    box[d] = std::min(sizes[d] - at[d], count / slice);
    f(at, box, slice * box[d]);
    first += slice * box[d];
    count -= slice * box[d];
  }
}

/// The space of a box in memory. It has the shape of the box in the file, since HDF5 then copies
/// the box whole, and else number by number.
inline hid_t memory_of(const std::vector<hsize_t>& box) {
  return H5Screate_simple(static_cast<int>(box.size()), box.data(), nullptr);
}

inline std::vector<hsize_t> sizes_of(hid_t space) {
  std::vector<hsize_t> sizes(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return sizes;
}

}  // namespace whirl::inline io::hdf5
