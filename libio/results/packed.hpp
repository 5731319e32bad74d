#pragma once
/// Structs as numbers one after another, from which a study goes on.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "libbase/numerics/linalg.hpp"
#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

class ResultReader;
class ResultWriter;

/// Takes structs apart into doubles. One function template serves Packer and Unpacker. It names all
/// members of a struct, also those that it leaves out, so that a new member does not compile until
/// it is named:
///
///   void pack(auto& in, auto& point) {
///     auto& [value, z, name] = point;  // the name is kept elsewhere
///     in(value), in(z);
///   }
///
/// Sizes of vectors and lists stand before what they count.
class Packer {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void operator()(const Number& x) { numbers_.push_back(static_cast<double>(x)); }
  void operator()(const Complex& x) {
    numbers_.push_back(x.real());
    numbers_.push_back(x.imag());
  }
  void operator()(const Vec& v) { size_and_items(v); }
  void operator()(const CVec& v) { size_and_items(v); }
  void operator()(const std::vector<double>& v) { size_and_items(v); }
  /// Columns, then the numbers with their size.
  void operator()(const Mat& m) {
    (*this)(m.cols());
    (*this)(Vec(m.reshaped()));
  }
  /// Only the size, where the items come later.
  template <class List>
  void size(const List& list) {
    (*this)(list.size());
  }
  /// Writes nothing: the size of the list is that of another one.
  template <class List>
  void resize(const List&, std::size_t) {}

  const std::vector<double>& numbers() const { return numbers_; }

 private:
  template <class List>
  void size_and_items(const List& list) {
    size(list);
    for (const auto& x : list) (*this)(x);
  }

  std::vector<double> numbers_;
};

/// Puts structs together again. Whatever the numbers are, lists become no longer than the numbers
/// can fill.
class Unpacker {
 public:
  /// @param path  of the dataset, for errors
  Unpacker(std::string path, std::vector<double> numbers)
      : path_(std::move(path)), numbers_(std::move(numbers)) {}

  /// @throws FileError  where the numbers end too early, or a count is no whole number within its
  ///                    bounds
  void operator()(double& x) { x = take(); }
  template <class Number>
  requires std::is_integral_v<Number> || std::is_enum_v<Number>
  void operator()(Number& x) { x = static_cast<Number>(take_count(most_number)); }
  void operator()(Complex& x) {
    const double real = take();
    x = {real, take()};
  }
  void operator()(Vec& v) { size_and_items(v); }
  void operator()(CVec& v) { size_and_items(v); }
  void operator()(std::vector<double>& v) { size_and_items(v); }
  void operator()(Mat& m) {
    Eigen::Index columns = 0;
    Vec items;
    (*this)(columns);
    (*this)(items);
    if (columns == 0 ? items.size() != 0 : items.size() % columns != 0) {
      fail(fmt::format("{} numbers do not fill {} columns", items.size(), columns));
    }
    m = columns == 0 ? Mat() : Mat(items.reshaped(items.size() / columns, columns));
  }
  template <class List>
  void size(List& list) {
    list.resize(take_count(static_cast<double>(numbers_.size() - next_)));
  }

  template <class List>
  void resize(List& list, std::size_t size) {
    list.resize(size);
  }

  /// @throws FileError  if numbers are left
  void finish() const {
    if (next_ == numbers_.size()) return;
    fail(fmt::format("{} numbers are left behind the last one", numbers_.size() - next_));
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw FileError(
        fmt::format("{}: {}: it is damaged, or of another version or study", path_, why));
  }

 private:
  static constexpr double most_number = 1e9;  ///< of whole numbers that are no sizes of lists

  template <class List>
  void size_and_items(List& list) {
    size(list);
    for (auto& x : list) (*this)(x);
  }
  double take() {
    if (next_ == numbers_.size()) fail("the numbers end too early");
    return numbers_[next_++];
  }
  Eigen::Index take_count(double most) {
    const double x = take();
    if (x >= 0.0 && x <= most && x == static_cast<double>(static_cast<Eigen::Index>(x))) {
      return static_cast<Eigen::Index>(x);
    }
    fail(fmt::format("found {:g}, expected a whole number up to {:g}", x, most));
  }

  std::string path_;
  std::vector<double> numbers_;
  std::size_t next_ = 0;
};

/// Marks dataset `walk` of a group, from which a study goes on, with its arrangement.
void write_walk_format(ResultWriter& file, std::string_view group);
/// @param numbers  of that dataset
/// @throws FileError  if its arrangement is that of another version
Unpacker read_walk(const ResultReader& file, std::string_view group, std::vector<double> numbers);

}  // namespace whirl::inline io
