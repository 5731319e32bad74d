#pragma once
/// Cells of samples in tables of loggers.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/measured/raw_record.hpp"

namespace whirl::inline io {

/// What stands for a sample that is not there: "", "nan", "n/a", "-".
bool is_missing(std::string_view cell);

/// What instruments write for a sample that they could not tell: "Over Range", "OVERFLOW", "#N/A",
/// "-Inf". It is a missing one, and is told.
bool is_no_reading(std::string_view cell);

/// The number of a cell, whose comma or point is that of decimals; NaN where is_missing or
/// is_no_reading say so, nothing for any other text.
std::optional<double> sample_of(std::string_view cell);

/// Likewise, of a number that is finite; nothing for any other text.
std::optional<double> finite_sample_of(std::string_view cell);

/// Counts cells that are no reading.
class NoReadings {
 public:
  /// @param where  the cell
  void add(std::string_view cell, std::size_t channel, const Where& where);
  /// Notes of a record how many there are of each channel, and the first one.
  void tell(RawRecord& raw) const;

 private:
  struct Found {
    std::size_t count = 0;
    std::string cell;  ///< the first one
    Where where{};
  };
  std::vector<Found> found_;
};

}  // namespace whirl::inline io
