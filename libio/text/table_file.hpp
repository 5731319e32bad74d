#pragma once
/// Files with a table: texts in any encoding, or a sheet of a workbook.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "libio/text/file_bytes.hpp"
#include "libio/text/units.hpp"

namespace whirl::inline io {

/// A text and what it is called in messages.
struct NamedText {
  std::string name;  ///< "rotor.csv", "rotor.xlsx#Stations"
  std::string text;  ///< in UTF-8
};

/// The table that a name says: "rotor.csv", "rotor.xlsx", "rotor.xlsx#Stations!B4:H25".
///
/// @param folder      that the name is relative to
/// @param columns_in  how many columns of this kind of table a line names
/// @return            or what is wrong: "cannot read the file ..."
Parsed<NamedText> table_file(const std::filesystem::path& folder, const std::string& name,
                             FileKind kind,
                             const std::function<std::size_t(const std::string&)>& columns_in);

}  // namespace whirl::inline io
