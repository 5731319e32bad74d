/// Sheets of workbooks as tables of data loggers.

#include <fmt/format.h>

#include <algorithm>

#include "libbase/error.hpp"
#include "libio/measured/record_formats.hpp"
#include "libio/text/delimited.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

namespace {

/// The text of a sheet with tabs between its cells.
std::string tabbed(const WorkbookSheet& sheet) {
  std::string text = sheet.text;
  std::ranges::replace(text, cell_mark, '\t');
  return text;
}

/// Names of sheets for a message: "\"Run 1\", \"Run 2\"".
std::string names_of(const std::vector<WorkbookSheet>& sheets) {
  std::string names;
  for (const WorkbookSheet& sheet : sheets) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", in_quotes(sheet.name));
  }
  return names;
}

}  // namespace

RawRecord read_workbook_record(const std::filesystem::path& path) {
  const SheetName name = sheet_name(path.string());
  const std::string bytes = record_bytes(name.file);
  if (!name.sheet.empty()) {
    const auto sheet = sheet_of(bytes, name, [](const std::string&) { return std::size_t{1}; });
    if (!sheet) throw ModelError({path.string()}, "", sheet.problem);
    return read_csv_text(tabbed(*sheet), path.string());
  }
  const auto sheets = sheets_of(bytes);
  if (!sheets) throw ModelError({path.string()}, "", sheets.problem);
  std::vector<WorkbookSheet> with_numbers;
  for (const WorkbookSheet& sheet : *sheets) {
    if (!sheet.is_hidden && has_csv_numbers(tabbed(sheet))) with_numbers.push_back(sheet);
  }
  if (with_numbers.size() == 1) {
    return read_csv_text(tabbed(with_numbers.front()),
                         fmt::format("{}#{}", name.file, with_numbers.front().name));
  }
  throw ModelError({path.string()}, "",
                   with_numbers.empty()
                       ? "no sheet has two lines of numbers, expected a column for each channel"
                       : fmt::format("several sheets have lines of numbers: {}; say which one, as "
                                     "in {}#{}",
                                     names_of(with_numbers), name.file, with_numbers.front().name));
}

}  // namespace whirl::inline io
