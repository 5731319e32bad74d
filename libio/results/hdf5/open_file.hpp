#pragma once
/// An HDF5 file as HDF5 reads it. Only in a child process: see ResultReader.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "libio/results/hdf5.hpp"

namespace whirl::inline io::hdf5 {

using Sizes = std::vector<std::uint64_t>;

/// What links of a file lead to. Paths lead through every group once.
struct Outline {
  std::vector<std::string> groups{}, datasets{}, others{};
  std::string elsewhere{};       ///< the first link that leads to another place; empty: none does
  bool has_other_paths = false;  ///< several links lead to a group
  bool is_whole = true;          ///< false: the file is damaged
};

/// Members are those of ResultReader of the same names, and throw what these do.
class OpenFile {
 public:
  explicit OpenFile(std::filesystem::path name);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool has(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  ObjectKind kind(const std::string& object) const;
  std::vector<std::string> axes(const std::string& path) const;
  Sizes shape(const std::string& path) const;
  /// All numbers, the last index running fastest; of any number of dimensions.
  std::vector<double> numbers(const std::string& path) const;
  /// All numbers of so many dimensions.
  std::vector<double> numbers(const std::string& path, std::size_t dimensions) const;
  /// All complex numbers, each as two numbers.
  std::vector<double> complex_numbers(const std::string& path, std::size_t dimensions) const;
  /// The numbers in a box.
  std::vector<double> numbers(const std::string& path, const Sizes& at, const Sizes& box) const;
  /// Some numbers, from number `first` on.
  std::vector<double> numbers_from(const std::string& path, std::size_t first,
                                   std::size_t count) const;
  std::vector<int> integers(const std::string& path) const;
  std::vector<std::string> strings(const std::string& path) const;
  std::vector<std::string> attributes(const std::string& object) const;
  std::vector<std::string> list(const std::string& group) const;
  const Outline& outline() const { return outline_; }
  /// @throws FileError  if not all of it could be read
  const Outline& whole_outline() const;

 private:
  std::filesystem::path name_;
  std::int64_t id_ = -1;  ///< HDF5's handle
  Outline outline_{};
};

}  // namespace whirl::inline io::hdf5
