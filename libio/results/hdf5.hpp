#pragma once
/// Result files: self-describing HDF5, always whole.

#include <complex>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

class ConfinedChild;

/// What stands beside the numbers of a dataset.
struct DatasetInfo {
  std::string units;              ///< SI unit; empty for plain numbers, names and counts
  std::string long_name;          ///< what it is, for a plot's axis: "whirl frequency"
  std::vector<std::string> axes;  ///< per dimension the path of the dataset along it, "" for none
};

/// What an object of a file holds.
enum class ObjectKind { group, real, integer, complex, text, other };

/// What a result file would hold, kept in memory instead.
struct KeptResult {
  struct Dataset {
    std::string path;
    /// The last index runs fastest.
    std::variant<std::vector<double>, std::vector<int>, std::vector<Complex>,
                 std::vector<std::string>>
        values;
    std::vector<Eigen::Index> shape;
    DatasetInfo info;
  };
  struct Attribute {
    std::string object, name;
    std::variant<std::string, double, int> value;
  };
  std::vector<Dataset> datasets;      ///< in the order of their writing
  std::vector<Attribute> attributes;  ///< likewise, without those that DatasetInfo says
};

/// A dataset of numbers that is written block by block. Every member throws as ResultWriter.
class DatasetBlocks {
 public:
  DatasetBlocks(DatasetBlocks&& other) noexcept;
  DatasetBlocks& operator=(DatasetBlocks&&) = delete;
  ~DatasetBlocks();

  /// Writes the next numbers, as many as there are; the last index runs fastest.
  void add(std::span<const double> values);
  /// Nothing more comes: all numbers have been written.
  void finish();

 private:
  friend class ResultWriter;
  DatasetBlocks(std::filesystem::path place, std::string path, std::size_t count)
      : place_(std::move(place)), path_(std::move(path)), count_(count) {}
  void write(std::span<const double> values);

  std::filesystem::path place_;  ///< of the file
  std::string path_;
  std::size_t count_ = 0;  ///< of all numbers
  std::size_t next_ = 0;
  std::int64_t id_ = -1;  ///< HDF5's handle; -1: there is no file, or it is closed
  KeptResult* kept_ = nullptr;
  std::size_t kept_number_ = 0;  ///< of the dataset there
};

/// Thrown out of a writing that is given up.
struct WritingGivenUp {};

/// Writes a result file beside its place, where commit() puts the whole file; or keeps what the
/// file would hold.
///
/// Objects are named by absolute paths, "/trajectory/x"; groups are made on the way. Datasets above
/// 64 kB are compressed. The same calls write the same bytes. Every member throws FileError, which
/// names file and object, when the disk is full or an object is written twice.
class ResultWriter {
 public:
  /// @throws FileError  as FileReplacement
  /// @param kept  receives the same as the file; null: not wanted
  explicit ResultWriter(const std::filesystem::path& path, Replaces what = Replaces::own_results,
                        KeptResult* kept = nullptr);
  /// Without a file.
  explicit ResultWriter(KeptResult& kept) : kept_(&kept) {}
  /// Gives up what was written, unless it was committed.
  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// Sets an attribute of a dataset or group, which is made if there is none; texts are UTF-8.
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, int value);

  /// Writes a dataset: vectors have one dimension, matrices rows x columns. Complex numbers are
  /// compounds (r, i), as numpy reads them. Axes must have been written, with matching sizes; they
  /// become HDF5 dimension scales. An axis keeps a list of its users, which costs some 1 ms for the
  /// thousandth of them: put many equal things into one matrix.
  void dataset(const std::string& path, const Vec& values, const DatasetInfo& info);
  void dataset(const std::string& path, const Mat& values, const DatasetInfo& info);
  void dataset(const std::string& path, const CVec& values, const DatasetInfo& info);
  void dataset(const std::string& path, const CMat& values, const DatasetInfo& info);
  void dataset(const std::string& path, const std::vector<double>& values, const DatasetInfo& info);
  void dataset(const std::string& path, const std::vector<int>& values, const DatasetInfo& info);
  void dataset(const std::string& path, const std::vector<std::string>& values,
               const DatasetInfo& info);
  /// Writes a dataset of any number of dimensions, the last index running fastest.
  void dataset(const std::string& path, const std::vector<double>& values,
               const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  void dataset(const std::string& path, const std::vector<int>& values,
               const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  /// Begins a dataset of real or integer numbers that come block by block: several may be open at a
  /// time.
  DatasetBlocks dataset_blocks(const std::string& path, ObjectKind kind,
                               const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  /// Writes all that another writer has kept.
  void write(const KeptResult& kept);

  /// From now on go_on() asks this whether to give up.
  void give_up_if(std::function<bool()> is_given_up) { is_given_up_ = std::move(is_given_up); }
  /// To be called now and then by code that writes much.
  /// @throws WritingGivenUp
  void go_on() const;

  /// Brings the file to the disk and to its place, with a checksum behind what HDF5 reads; nothing
  /// can be written after it.
  /// @throws FileError  the place then is as it was
  void commit();

 private:
  /// Makes a dataset that holds nothing yet.
  /// @return  HDF5's handle
  std::int64_t create(const std::string& path, ObjectKind kind,
                      const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  void write(const std::string& path, ObjectKind kind, const void* values,
             const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  /// @param values  as many elements as the shape says
  template <class Value>
  void write_or_keep(const std::string& path, ObjectKind kind, const Value* values,
                     const std::vector<Eigen::Index>& shape, const DatasetInfo& info);
  void write_attribute(const std::string& object, const std::string& name, ObjectKind kind,
                       const void* value);

  std::optional<FileReplacement> file_{};
  KeptResult* kept_ = nullptr;
  std::int64_t id_ = -1;  ///< HDF5's handle; -1: there is no file, or it is closed
  std::function<bool()> is_given_up_{};
};

/// Some of the numbers along a dimension.
struct Stretch {
  Eigen::Index first = 0, count = 0;
};

/// Reads a result file, or any other HDF5 file of numbers and texts.
///
/// HDF5 1.10 ends the process on some damaged files, or writes where it must not, and never returns
/// from others. Therefore a child process reads the file (ConfinedChild), whoever wrote it and
/// whatever its checksum says, as anybody can write a checksum. The child holds the file open, and
/// is asked for everything.
///
/// Every member throws FileError, which names file and object, for what is missing, damaged or of
/// another type or shape; has() throws only where HDF5 does not survive. Nothing outside of the
/// file is ever read, and no dataset that says to be larger than the file can hold.
class ResultReader {
 public:
  /// @throws FileError  if there is no such file, if it is no HDF5 file or a damaged one, or if
  ///                    anything in it is a link to another place
  explicit ResultReader(const std::filesystem::path& path);
  ~ResultReader();
  ResultReader(const ResultReader&) = delete;
  ResultReader& operator=(const ResultReader&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool has(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;

  ObjectKind kind(const std::string& object) const;
  /// Per dimension of a dataset the path of the dataset along it, which has as many elements; ""
  /// for none.
  std::vector<std::string> axes(const std::string& path) const;
  /// Sizes of a dataset's dimensions.
  std::vector<Eigen::Index> shape(const std::string& path) const;
  Vec vector(const std::string& path) const;
  /// All numbers of any shape, the last index running fastest.
  std::vector<double> numbers(const std::string& path) const;
  /// Some of these, a stretch along each dimension.
  std::vector<double> numbers(const std::string& path, const std::vector<Stretch>& along) const;
  /// Some of these, from number `first` on.
  std::vector<double> numbers(const std::string& path, std::size_t first, std::size_t count) const;
  /// Calls f with all of these, block by block.
  void each_block(const std::string& path,
                  const std::function<void(std::span<const double>)>& f) const;
  Mat matrix(const std::string& path) const;
  CVec complex_vector(const std::string& path) const;
  CMat complex_matrix(const std::string& path) const;
  std::vector<int> integers(const std::string& path) const;
  std::vector<std::string> strings(const std::string& path) const;

  /// Names of the attributes of a dataset or group, in the order of the alphabet; those that HDF5
  /// keeps axes in are left out.
  std::vector<std::string> attributes(const std::string& object) const;
  /// Names of the members of a group, in the order of the alphabet.
  std::vector<std::string> list(const std::string& group) const;
  /// Paths of all groups, "/" among them, and of all datasets. A group that several links lead to,
  /// or that lies in itself, counts once, and is looked into once.
  std::vector<std::string> groups() const;
  std::vector<std::string> datasets() const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<ConfinedChild> child_;
  std::vector<std::string> paths_;  ///< of all objects, in their order; empty: the child is asked
};

}  // namespace whirl::inline io
