#include "libio/text/table_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "libio/text/encoding.hpp"
#include "libio/text/workbook.hpp"

namespace whirl::inline io {

Parsed<NamedText> table_file(const std::filesystem::path& folder, const std::string& name,
                             FileKind kind,
                             const std::function<std::size_t(const std::string&)>& columns_in) {
  const SheetName sheet = sheet_name(name);
  const std::filesystem::path path = folder / sheet.file;
  const auto wrong = [&](const std::string& what) {
    return Parsed<NamedText>::failed(fmt::format("cannot read the file \"{}\"{}", path.string(),
                                                 what.starts_with("cannot") ? "" : ": " + what));
  };
  auto bytes = file_bytes(path, kind, most_text_bytes);
  if (!bytes) return wrong(bytes.problem);
  if (is_workbook(*bytes)) {
    auto found = sheet_of(*bytes, sheet, columns_in);
    if (!found) return wrong(found.problem);
    return NamedText{fmt::format("{}#{}", path.string(), found->name),
                     std::move(found.value->text)};
  }
  auto text = in_utf8(std::move(*bytes.value));
  if (!text) return wrong(text.problem);
  return NamedText{path.string(), std::move(*text.value)};
}

}  // namespace whirl::inline io
