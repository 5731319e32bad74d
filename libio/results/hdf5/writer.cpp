#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cassert>

#include "libio/results/hdf5.hpp"
#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/hdf5/handle.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;
using namespace hdf5;

namespace {

constexpr std::size_t uncompressed_bytes = 64 * 1024;  ///< up to here datasets stay as they are
constexpr std::size_t chunk_bytes = 1024 * 1024;       ///< what is compressed and read at a time
constexpr std::size_t kept_bytes = 4 * chunk_bytes;    ///< of a dataset that is written in blocks
constexpr unsigned deflate_level = 1;  ///< of 9; higher ones take longer and gain next to nothing

/// Properties of a new object: no times, which would make equal files differ.
Handle creation(hid_t kind) {
  Handle properties(H5Pcreate(kind));
  H5Pset_obj_track_times(properties, false);
  return properties;
}

/// Makes the groups that an object lies in, as far as there are none.
void make_groups(const Attempt& attempt, hid_t file, const std::string& object) {
  const Handle properties = creation(H5P_GROUP_CREATE);
  for (std::size_t end = object.find('/', 1); end < object.size();
       end = object.find('/', end + 1)) {
    const std::string group = object.substr(0, end);
    if (exists(file, group)) continue;
    const Handle made(
        attempt(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT)));
  }
}

/// Whole rows, or a piece of one where rows are long.
std::vector<hsize_t> chunks(const std::vector<hsize_t>& sizes, std::size_t item_bytes) {
  std::vector<hsize_t> chunk = sizes;
  hsize_t room = std::max<hsize_t>(1, chunk_bytes / item_bytes);
  for (std::size_t i = chunk.size(); i-- > 0;) {
    chunk[i] = std::min(chunk[i], room);
    room = std::max<hsize_t>(1, room / chunk[i]);
  }
  return chunk;
}

std::size_t numbers_of(const std::vector<Eigen::Index>& shape) {
  std::size_t count = 1;
  for (const Eigen::Index size : shape) count *= static_cast<std::size_t>(size);
  return count;
}

/// Has compressed pieces go to the file, or a full disk is not seen before it is closed.
void flush_chunks(const Attempt& attempt, hid_t dataset) {
  const Handle how(attempt(H5Dget_create_plist(dataset)));
  if (H5Pget_layout(how) == H5D_CHUNKED) attempt(H5Dflush(dataset));
}

template <class Matrix>
auto row_major(const Matrix& values) {
  using Scalar = typename Matrix::Scalar;
  return Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>(values);
}

}  // namespace

ResultWriter::ResultWriter(const fs::path& path, Replaces what, KeptResult* kept) : kept_(kept) {
  file_.emplace(path, what);
  const Attempt attempt(file_->place(), "create", "the file");
  const Handle properties = creation(H5P_FILE_CREATE), access = file_access();
  id_ = attempt(H5Fcreate(file_->temporary().c_str(), H5F_ACC_TRUNC, properties, access));
}

ResultWriter::~ResultWriter() {
  const std::lock_guard alone(library_lock());
  if (id_ >= 0) H5Fclose(id_);
}

void ResultWriter::go_on() const {
  if (is_given_up_ && is_given_up_()) throw WritingGivenUp();
}

void ResultWriter::commit() {
  if (!file_) return;
  assert(id_ >= 0);
  const Attempt attempt(file_->place(), "write", "the file");
  attempt(H5Fflush(id_, H5F_SCOPE_GLOBAL));
  attempt(H5Fclose(std::exchange(id_, -1)));
  seal(file_->temporary());
  file_->commit();
}

void ResultWriter::write(const KeptResult& kept) {
  for (const KeptResult::Dataset& d : kept.datasets) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&d.values)) {
      dataset(d.path, *texts, d.info);
    } else if (const auto* numbers = std::get_if<std::vector<double>>(&d.values)) {
      dataset(d.path, *numbers, d.shape, d.info);
    } else if (const auto* integers = std::get_if<std::vector<int>>(&d.values)) {
      dataset(d.path, *integers, d.shape, d.info);
    } else {
      const auto& complexes = std::get<std::vector<Complex>>(d.values);
      write_or_keep(d.path, ObjectKind::complex, complexes.data(), d.shape, d.info);
    }
  }
  for (const KeptResult::Attribute& a : kept.attributes) {
    std::visit([&](const auto& value) { attribute(a.object, a.name, value); }, a.value);
  }
}

void ResultWriter::write_attribute(const std::string& object, const std::string& name,
                                   ObjectKind kind, const void* value) {
  const Attempt attempt(file_->place(), "write attribute", object + '@' + name);
  const Handle type = type_of(kind);
  if (object != "/" && !exists(id_, object)) make_groups(attempt, id_, object + '/');
  const Handle owner(attempt(H5Oopen(id_, object.c_str(), H5P_DEFAULT)));
  if (H5Aexists(owner, name.c_str()) > 0) attempt(H5Adelete(owner, name.c_str()));
  const Handle space(attempt(H5Screate(H5S_SCALAR)));
  const Handle attribute(
      attempt(H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT)));
  attempt(H5Awrite(attribute, type, value));
}

void ResultWriter::attribute(const std::string& object, const std::string& name,
                             const std::string& value) {
  if (kept_) kept_->attributes.push_back({object, name, value});
  if (!file_) return;
  const char* text = value.c_str();
  write_attribute(object, name, ObjectKind::text, &text);
}

void ResultWriter::attribute(const std::string& object, const std::string& name, double value) {
  if (kept_) kept_->attributes.push_back({object, name, value});
  if (file_) write_attribute(object, name, ObjectKind::real, &value);
}

void ResultWriter::attribute(const std::string& object, const std::string& name, int value) {
  if (kept_) kept_->attributes.push_back({object, name, value});
  if (file_) write_attribute(object, name, ObjectKind::integer, &value);
}

std::int64_t ResultWriter::create(const std::string& path, ObjectKind kind,
                                  const std::vector<Eigen::Index>& shape, const DatasetInfo& info) {
  const Attempt attempt(file_->place(), "write dataset", path);
  const Handle type = type_of(kind);
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  hsize_t count = 1;
  for (const hsize_t size : sizes) count *= size;

  const Handle space(
      attempt(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr)));
  const Handle properties = creation(H5P_DATASET_CREATE);
  make_groups(attempt, id_, path);
  const std::size_t item_bytes = H5Tget_size(type);
  const bool is_compressed = count * item_bytes > uncompressed_bytes && kind != ObjectKind::text;
  if (is_compressed) {
    const auto chunk = chunks(sizes, item_bytes);
    attempt(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()));
    attempt(H5Pset_shuffle(properties));
    attempt(H5Pset_deflate(properties, deflate_level));
  }
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  if (is_compressed) {  // what a block leaves of a chunk is there when the next one comes
    attempt(H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, kept_bytes,
                               H5D_CHUNK_CACHE_W0_DEFAULT));
  }
  Handle dataset(
      attempt(H5Dcreate2(id_, path.c_str(), type, space, H5P_DEFAULT, properties, access)));
  const char *units = info.units.c_str(), *long_name = info.long_name.c_str();
  write_attribute(path, "units", ObjectKind::text, &units);
  write_attribute(path, "long_name", ObjectKind::text, &long_name);

  if (info.axes.size() > sizes.size()) attempt.fail("more axes than dimensions");
  for (std::size_t i = 0; i < info.axes.size(); ++i) {
    const std::string& name = info.axes[i];
    if (name.empty()) continue;
    if (!exists(id_, name)) attempt.fail(fmt::format("its axis {} is not written", name));
    const Handle axis(attempt(H5Dopen2(id_, name.c_str(), H5P_DEFAULT)));
    const Handle axis_space(attempt(H5Dget_space(axis)));
    if (sizes_of(axis_space) != std::vector<hsize_t>{sizes[i]}) {
      attempt.fail(fmt::format("its axis {} has another size", name));
    }
    const std::string label = fs::path(name).filename().string();
    if (H5DSis_scale(axis) <= 0) attempt(H5DSset_scale(axis, label.c_str()));
    attempt(H5DSattach_scale(dataset, axis, static_cast<unsigned>(i)));
    attempt(H5DSset_label(dataset, static_cast<unsigned>(i), label.c_str()));
  }
  return dataset.release();
}

void ResultWriter::write(const std::string& path, ObjectKind kind, const void* values,
                         const std::vector<Eigen::Index>& shape, const DatasetInfo& info) {
  const Attempt attempt(file_->place(), "write dataset", path);
  const Handle type = type_of(kind), dataset(create(path, kind, shape, info));
  if (std::count(shape.begin(), shape.end(), 0) == 0) {
    attempt(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  }
  flush_chunks(attempt, dataset);
}

DatasetBlocks ResultWriter::dataset_blocks(const std::string& path, ObjectKind kind,
                                           const std::vector<Eigen::Index>& shape,
                                           const DatasetInfo& info) {
  const std::size_t count = numbers_of(shape);
  const bool is_integer = kind == ObjectKind::integer;
  DatasetBlocks blocks(file_ ? file_->place() : fs::path(), path, count);
  if (kept_) {
    blocks.kept_ = kept_;
    blocks.kept_number_ = kept_->datasets.size();
    kept_->datasets.push_back({path, std::vector<double>(), shape, info});
    if (is_integer) kept_->datasets.back().values = std::vector<int>();
  }
  if (file_)
    blocks.id_ = create(path, is_integer ? ObjectKind::integer : ObjectKind::real, shape, info);
  return blocks;
}

DatasetBlocks::DatasetBlocks(DatasetBlocks&& other) noexcept
    : place_(std::move(other.place_)),
      path_(std::move(other.path_)),
      count_(other.count_),
      next_(other.next_),
      id_(std::exchange(other.id_, -1)),
      kept_(other.kept_),
      kept_number_(other.kept_number_) {}

DatasetBlocks::~DatasetBlocks() {
  const std::lock_guard alone(library_lock());
  if (id_ >= 0) H5Dclose(id_);
}

void DatasetBlocks::add(std::span<const double> values) {
  if (next_ + values.size() > count_) {
    Attempt(place_, "write dataset", path_).fail("more numbers than it has room for");
  }
  if (kept_) {
    std::visit(
        [&](auto& list) {
          if constexpr (requires { static_cast<double>(list.front()); }) {
            list.insert(list.end(), values.begin(), values.end());
          }
        },
        kept_->datasets[kept_number_].values);
  }
  if (id_ >= 0) write(values);
  next_ += values.size();
}

void DatasetBlocks::write(std::span<const double> values) {
  const Attempt attempt(place_, "write dataset", path_);
  const Handle space(attempt(H5Dget_space(id_)));
  const double* from = values.data();
  for_each_box(
      sizes_of(space), next_, values.size(), [&](const auto& at, const auto& box, hsize_t numbers) {
        attempt(
            H5Sselect_hyperslab(space, H5S_SELECT_SET, at.data(), nullptr, box.data(), nullptr));
        const Handle memory(attempt(memory_of(box)));
        attempt(H5Dwrite(id_, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, from));
        from += numbers;
      });
}

void DatasetBlocks::finish() {
  const Attempt attempt(place_, "write dataset", path_);
  if (next_ != count_) attempt.fail("not all of its numbers were given");
  if (id_ < 0) return;
  flush_chunks(attempt, id_);
  attempt(H5Dclose(std::exchange(id_, -1)));
}

template <class Value>
void ResultWriter::write_or_keep(const std::string& path, ObjectKind kind, const Value* values,
                                 const std::vector<Eigen::Index>& shape, const DatasetInfo& info) {
  if (kept_) {
    const std::vector<Value> all(values, values + numbers_of(shape));
    kept_->datasets.push_back({path, all, shape, info});
  }
  if (file_) write(path, kind, values, shape, info);
}

void ResultWriter::dataset(const std::string& path, const Vec& values, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::real, values.data(), {values.size()}, info);
}

void ResultWriter::dataset(const std::string& path, const Mat& values, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::real, row_major(values).data(), {values.rows(), values.cols()},
                info);
}

void ResultWriter::dataset(const std::string& path, const CVec& values, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::complex, values.data(), {values.size()}, info);
}

void ResultWriter::dataset(const std::string& path, const CMat& values, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::complex, row_major(values).data(), {values.rows(), values.cols()},
                info);
}

void ResultWriter::dataset(const std::string& path, const std::vector<double>& values,
                           const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::real, values.data(), {std::ssize(values)}, info);
}

void ResultWriter::dataset(const std::string& path, const std::vector<int>& values,
                           const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::integer, values.data(), {std::ssize(values)}, info);
}

void ResultWriter::dataset(const std::string& path, const std::vector<double>& values,
                           const std::vector<Eigen::Index>& shape, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::real, values.data(), shape, info);
}

void ResultWriter::dataset(const std::string& path, const std::vector<int>& values,
                           const std::vector<Eigen::Index>& shape, const DatasetInfo& info) {
  write_or_keep(path, ObjectKind::integer, values.data(), shape, info);
}

void ResultWriter::dataset(const std::string& path, const std::vector<std::string>& values,
                           const DatasetInfo& info) {
  if (kept_) kept_->datasets.push_back({path, values, {std::ssize(values)}, info});
  if (!file_) return;
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  write(path, ObjectKind::text, texts.data(), {std::ssize(texts)}, info);
}

}  // namespace whirl::inline io
