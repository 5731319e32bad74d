#pragma once
/// Tables as oscilloscopes write them, whose settings stand beside the numbers.

#include <optional>
#include <string>
#include <vector>

#include "libio/measured/csv_header.hpp"
#include "libio/measured/raw_record.hpp"

namespace whirl::inline io {

/// Whether the lines of a table have settings in their first columns, time and voltage in the
/// fourth and fifth: "Record Length,2500,,-0.0025,0.1".
bool has_scope_columns(const std::vector<CsvLine>& lines);

/// The record of such a table.
/// @throws ModelError  for a line with other columns, and as csv_settings
RawRecord scope_record(const std::vector<CsvLine>& lines, const std::string& file);

/// What two lines say: "X,CH1,CH2,Start,Increment", "Sequence,Volt,Volt,-6e-3,1e-5", or one:
/// "CH1V,CH2V,t0 = -5e-4, tInc = 2e-6".
struct ScopeHeader {
  std::vector<std::string> names, units;  ///< of the columns that have numbers
  double start = 0.0, step = 0.0;         ///< [s]
  bool counts_samples = false;            ///< the first column has numbers of samples
};

/// @param lines  above the numbers
/// @return       nothing: they are no such lines
std::optional<ScopeHeader> scope_header(const std::vector<CsvLine>& lines);

}  // namespace whirl::inline io
