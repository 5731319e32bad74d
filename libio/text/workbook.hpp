#pragma once
/// Workbooks of spreadsheet programs (.xlsx, ECMA-376): their sheets as texts of lines and cells.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A sheet. Line i of the text is its row i, cells stand between marks (cell_mark of
/// delimited.hpp), so that lines and places of problems are rows and columns.
struct WorkbookSheet {
  std::string name;
  std::string text;
  bool is_hidden = false;
};

/// What a name says: "rotor.xlsx", "rotor.xlsx#Stations", "rotor.xlsx#Stations!B4:H25", as
/// spreadsheet programs write links.
struct SheetName {
  std::string file;
  std::string sheet{};  ///< empty: not said
  std::string range{};  ///< likewise: "B4:H25"
};

/// Splits a name at its "#"; only a file that ends with .xlsx or .xlsm has one.
SheetName sheet_name(const std::string& name);

/// Whether bytes are those of a workbook, or of another archive.
bool is_workbook(const std::string& bytes);

/// All sheets of a workbook, in its order. Numbers are as they are stored, results of formulas as
/// they were saved (else the formula itself, which is no number), dates numbers of days; a cell of
/// several lines becomes one.
///
/// @return  or what is wrong with the file
Parsed<std::vector<WorkbookSheet>> sheets_of(const std::string& bytes);

/// The sheet that a name says, or the visible one that has such a table.
///
/// @param columns_in  how many columns of the table a line names
/// @return            or what is wrong: several sheets have one, or none
Parsed<WorkbookSheet> sheet_of(const std::string& bytes, const SheetName& name,
                               const std::function<std::size_t(const std::string&)>& columns_in);

/// A place in a sheet by the name of its cell, "rotor.xlsx#Stations!C7"; others as they are.
Where with_cell_name(Where where);

}  // namespace whirl::inline io
