#pragma once
/// What the columns of a table of bearing coefficients mean, by the names that programs give them.

#include <string>
#include <vector>

#include "libfe/parts/bearings/coefficients.hpp"
#include "libio/text/delimited.hpp"

namespace whirl::inline io {

/// A column: the speed, the whirl frequency, or an entry of a matrix.
struct CoefficientColumn {
  enum class Kind { speed, whirl, entry };
  std::string name;     ///< "speed", "whirl", "kxx"
  std::string si_unit;  ///< "N/m"
  std::string unit{};   ///< that values are in; empty: SI, or as written beside each
  Kind kind = Kind::entry;
  Mat2 BearingCoefficients::*matrix = nullptr;  ///< of an entry
  int row = 0, column = 0;
  bool needs_unit = false;  ///< named as by other programs, which do not mean SI
  int place = 1;            ///< of its name in the line
  bool is_remark = false;   ///< words, which nobody reads
};

/// Columns that a line names, one per cell; what is not understood is reported.
///
/// Names: speed, rpm, n, rotor speed ...; whirl, frequency, excitation frequency ...; kxx ... cyy,
/// mxx ... myy, ktxx ... ctyy. Capitals, blanks, "_", "-" and "." in them do not count. A unit may
/// follow in [] or (), or behind a blank.
std::vector<CoefficientColumn> columns_named(const std::string& line, Delimiter delimiter,
                                             const ReportProblem& report);

/// How many known columns a line names.
std::size_t coefficients_named_in(const std::string& line);

/// Gives columns the units in the cells of a line.
void take_units(std::vector<CoefficientColumn>& columns, const std::vector<Cell>& cells,
                const ReportProblem& report);

/// Reports what is wrong with columns as a whole: no speeds or frequencies, a unit that is missing,
/// a column that is there twice.
void check_columns(const std::vector<CoefficientColumn>& columns, const ReportProblem& report);

/// Reports what may be forgotten: one of kxx and kyy, of kxy and kyx, ...
void doubt_columns(const std::vector<CoefficientColumn>& columns, const ReportProblem& report);

}  // namespace whirl::inline io
