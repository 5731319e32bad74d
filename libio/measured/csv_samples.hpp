#pragma once
/// The numbers of a table of a data logger.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libio/measured/csv_header.hpp"
#include "libio/measured/day_time.hpp"
#include "libio/measured/raw_record.hpp"
#include "libio/measured/sample_cell.hpp"

namespace whirl::inline io {

/// How numbers stand in a table.
struct CsvForm {
  Delimiter delimiter = Delimiter::comma;
  bool ends_with_delimiter = false;  ///< each line, or words follow
  std::size_t columns = 0;
};

/// Words, which are no sample: neither a number, nor what looks like one or stands for one.
bool is_remark(const Cell& cell);

/// Whether a cell is a sample, a missing one, or a date or time of the day.
bool is_sample(const std::string& cell);

/// Cells of a line of a form, without what is behind a delimiter at its end.
std::vector<Cell> csv_cells(std::string_view line, const CsvForm& form);

/// The samples of a table, whose numbers say together what their commas and points are.
class CsvSamples {
 public:
  CsvSamples(RawRecord& raw, const CsvForm& form, bool has_names);

  /// Takes a line.
  /// @param first_line  number of the first one, for messages
  /// @throws ModelError  for a line of other columns, or a cell that is no sample
  void add(const CsvLine& line, int first_line);

  /// Tells what was found in all lines, and makes columns of times of the day times.
  /// @throws ModelError  for a comma or point that may be that of thousands or of decimals, and for
  ///                     dates without times of the day
  void finish();

 private:
  /// The first number whose comma, or point, may be that of thousands or of decimals.
  struct Doubt {
    std::string cell, channel;
    Where where{};
  };
  /// A column of dates, or of times of the day.
  struct Stamps {
    std::string first;            ///< as it is written
    std::optional<Stamp> last{};  ///< none: it has dates alone
    double since_first = 0.0;     ///< [s]
    bool passes_midnight = false;
  };

  void add(const Cell& cell, const CsvLine& line, std::size_t c);
  /// @return  seconds since the first stamp of the column; nothing: the cell is no stamp
  std::optional<double> stamp(const std::string& cell, std::size_t c);
  void require_one_reading();
  void take_stamps();

  RawRecord& raw_;
  CsvForm form_;
  NumberMarks marks_;
  NoReadings no_readings_;
  std::map<std::size_t, Stamps> stamps_;  ///< by their columns
  Doubt comma_, point_;
  bool may_be_decimals_ = false;  ///< commas: nothing shows that they stand between columns
};

}  // namespace whirl::inline io
