#pragma once
/// Figures as the page of a report reads them.

#include <string>
#include <unordered_map>
#include <vector>

#include "libio/drawing/figure.hpp"
#include "libio/text/record.hpp"

namespace whirl::inline io {

/// Arrays of a page, each distinct one stored once and referred to by its number.
///
/// An array is base64 of little-endian numbers: float64 of short ones, float32 (seven digits) of
/// those above 4096 numbers.
class ArrayStore {
 public:
  /// Stores an array; returns its number.
  int add(const std::vector<double>& values);
  /// [{type, data}, ...]
  Record record() const;

 private:
  std::vector<std::string> texts_;  ///< type, a colon, base64
  std::unordered_map<std::string, int> numbers_;
};

std::string base64(const void* bytes, std::size_t size);

/// A figure with its long arrays in a store.
Record record_of(const Figure& figure, ArrayStore& arrays);

/// Colors by name, on light and on dark pages, and the stops of the color maps.
Record color_record();

/// Distances around panels and dashes of lines, as files of pictures have them: Rooms and
/// dashes_of.
Record style_record();

}  // namespace whirl::inline io
