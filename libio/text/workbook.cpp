#include "libio/text/workbook.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <minizip/unzip.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <utility>

#include "libio/text/delimited.hpp"
#include "libio/text/encoding.hpp"

namespace whirl::inline io {

namespace {

constexpr std::size_t most_part_bytes = std::size_t{1} << 26u;  ///< of one part, unpacked
constexpr std::size_t most_sheet_bytes = std::size_t{1} << 26u;
constexpr int most_rows = 1'048'576, most_columns = 16'384;  ///< of spreadsheet programs

/// A wrong file, on its way to a Parsed.
struct WrongWorkbook {
  std::string problem;
};

/// Bytes that minizip reads as a file.
struct BytesRead {
  const std::string* bytes = nullptr;
  std::size_t at = 0;
};

BytesRead& bytes_of(void* stream) {
  return *static_cast<BytesRead*>(stream);
}

zlib_filefunc64_def reads_of(BytesRead& from) {
  zlib_filefunc64_def reads{};
  reads.opaque = &from;
  reads.zopen64_file = [](void* opaque, const void*, int) { return opaque; };
  reads.zread_file = [](void*, void* stream, void* to, uLong size) -> uLong {
    BytesRead& read = bytes_of(stream);
    const std::size_t count = std::min<std::size_t>(size, read.bytes->size() - read.at);
    std::copy_n(read.bytes->data() + read.at, count, static_cast<char*>(to));
    read.at += count;
    return static_cast<uLong>(count);
  };
  reads.ztell64_file = [](void*, void* stream) -> ZPOS64_T { return bytes_of(stream).at; };
  reads.zseek64_file = [](void*, void* stream, ZPOS64_T offset, int origin) -> long {
    BytesRead& read = bytes_of(stream);
    const std::size_t base = origin == ZLIB_FILEFUNC_SEEK_CUR   ? read.at
                             : origin == ZLIB_FILEFUNC_SEEK_END ? read.bytes->size()
                                                                : 0;
    if (offset > read.bytes->size() - base) return -1;
    read.at = base + static_cast<std::size_t>(offset);
    return 0;
  };
  reads.zclose_file = [](void*, void*) { return 0; };
  reads.zerror_file = [](void*, void*) { return 0; };
  return reads;
}

/// An archive in memory.
class Archive {
 public:
  explicit Archive(const std::string& bytes) : from_{&bytes} {
    zlib_filefunc64_def reads = reads_of(from_);
    archive_.reset(unzOpen2_64("workbook", &reads));
    if (!archive_) throw WrongWorkbook{"it is no whole workbook"};
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// A part, unpacked; nothing: there is none.
  std::optional<std::string> part(const std::string& name) const {
    constexpr int as_written = 1;  // capitals count
    unzFile archive = archive_.get();
    if (unzLocateFile(archive, name.c_str(), as_written) != UNZ_OK) return std::nullopt;
    const auto damaged = [&] {
      return WrongWorkbook{fmt::format("its part {} is damaged", in_quotes(name))};
    };
    if (unzOpenCurrentFile(archive) != UNZ_OK) throw damaged();
    std::string text;
    std::string block(std::size_t{1} << 16u, '\0');
    int got = 1;
    while (got > 0 && text.size() <= most_part_bytes) {
      got = unzReadCurrentFile(archive, block.data(), static_cast<unsigned>(block.size()));
      if (got > 0) text.append(block, 0, static_cast<std::size_t>(got));
    }
    const bool is_whole = unzCloseCurrentFile(archive) == UNZ_OK;  // its checksum, read to the end
    if (text.size() > most_part_bytes) {
      throw WrongWorkbook{fmt::format("its part {} is larger than 64 MB", in_quotes(name))};
    }
    if (got < 0 || !is_whole) throw damaged();
    return text;
  }

 private:
  struct Close {
    void operator()(void* archive) const { unzClose(archive); }
  };
  BytesRead from_;
  std::unique_ptr<void, Close> archive_;
};

/// The name of an element without its namespace.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// An attribute by its name without namespace; "": there is none.
std::string_view attribute_of(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& a : node.attributes()) {
    const std::string_view written = a.name();
    const auto colon = written.find(':');
    if ((colon == std::string_view::npos ? written : written.substr(colon + 1)) == name) {
      return a.value();
    }
  }
  return "";
}

pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& child : node.children()) {
    if (local_name(child) == name) return child;
  }
  return {};
}

/// Calls f(child) for all children of a name.
template <class F>
void for_each_child(const pugi::xml_node& node, std::string_view name, F f) {
  for (const pugi::xml_node& child : node.children()) {
    if (local_name(child) == name) f(child);
  }
}

pugi::xml_document parsed(const std::string& text, const std::string& part) {
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default);
  if (!result) {
    throw WrongWorkbook{
        fmt::format("its part {} is no XML: {}", in_quotes(part), result.description())};
  }
  return document;
}

/// A part that every workbook has.
pugi::xml_document needed_part(const Archive& archive, const std::string& name) {
  const auto part = archive.part(name);
  if (!part) throw WrongWorkbook{"it has no sheets; is it another archive than .xlsx?"};
  return parsed(*part, name);
}

/// Text of a cell in one line, without what delimits cells.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return text;
}

/// A text with runs of its own formats; what says how it is pronounced is left out.
std::string text_in(const pugi::xml_node& item) {
  std::string text;
  for_each_child(item, "t", [&](const pugi::xml_node& t) { text += t.child_value(); });
  for_each_child(item, "r", [&](const pugi::xml_node& run) {
    for_each_child(run, "t", [&](const pugi::xml_node& t) { text += t.child_value(); });
  });
  return one_line(text);
}

std::vector<std::string> shared_texts(const Archive& archive) {
  std::vector<std::string> texts;
  const std::string name = "xl/sharedStrings.xml";
  const auto part = archive.part(name);
  if (!part) return texts;
  const pugi::xml_document document = parsed(*part, name);
  for_each_child(child_of(document, "sst"), "si",
                 [&](const pugi::xml_node& item) { texts.push_back(text_in(item)); });
  return texts;
}

/// A whole number from 0; nothing: the text is none.
std::optional<int> whole_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

struct Place {
  int row = 0, column = 0;  ///< from 1
};

/// "C7" or "$C$7"; nothing: it is none.
std::optional<Place> place_in(std::string_view text) {
  Place place;
  std::string digits;
  for (const char c : text) {
    if (c == '$') continue;
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 && digits.empty()) {
      place.column = 26 * place.column + std::toupper(static_cast<unsigned char>(c)) - 'A' + 1;
      if (place.column > most_columns) return std::nullopt;
    } else {
      digits += c;
    }
  }
  const auto row = whole_in(digits);
  if (!row || *row < 1 || *row > most_rows || place.column < 1) return std::nullopt;
  place.row = *row;
  return place;
}

/// What a cell shows; of a formula without a result the formula, which no number is.
std::string value_of(const pugi::xml_node& cell, const std::vector<std::string>& texts) {
  const std::string_view type = attribute_of(cell, "t");
  if (type == "inlineStr") return text_in(child_of(cell, "is"));
  const std::string value = one_line(child_of(cell, "v").child_value());
  const pugi::xml_node formula = child_of(cell, "f");
  if (value.empty() && formula && type != "str") {  // its result was never saved
    return one_line(std::string("=") + formula.child_value());
  }
  if (type != "s") return value;
  const auto at = whole_in(value);
  if (!at || static_cast<std::size_t>(*at) >= texts.size()) {
    throw WrongWorkbook{fmt::format("its cell {} names a text that is not there",
                                    in_quotes(attribute_of(cell, "r")))};
  }
  return texts[static_cast<std::size_t>(*at)];
}

std::string text_of_sheet(const std::string& part, const std::string& name,
                          const std::vector<std::string>& texts) {
  const pugi::xml_document document = parsed(part, name);
  std::string text;
  int last_row = 0;
  const auto check_size = [&] {
    if (text.size() > most_sheet_bytes) throw WrongWorkbook{"a sheet of it has more than 64 MB"};
  };
  for_each_child(
      child_of(child_of(document, "worksheet"), "sheetData"), "row",
      [&](const pugi::xml_node& row) {
        const int number = whole_in(attribute_of(row, "r")).value_or(last_row + 1);
        if (number <= last_row || number > most_rows) {
          throw WrongWorkbook{"rows of a sheet of it are in no order"};
        }
        text.append(static_cast<std::size_t>(number - last_row - (last_row > 0 ? 0 : 1)), '\n');
        last_row = number;
        int last_column = 0;
        for_each_child(row, "c", [&](const pugi::xml_node& cell) {
          const std::string_view where = attribute_of(cell, "r");
          const auto place = place_in(where);
          const int column = where.empty() ? last_column + 1 : place ? place->column : 0;
          if (column <= last_column) {
            throw WrongWorkbook{"cells of a row of it are in no order"};
          }
          text.append(static_cast<std::size_t>(column - std::max(last_column, 1)), cell_mark);
          text += value_of(cell, texts);
          last_column = column;
          check_size();
        });
        // a row of one cell is one of a sheet, too
        if (last_column == 1) text += cell_mark;
        check_size();
      });
  return text + "\n";
}

/// The parts of sheets by the ids that the workbook names them by.
std::map<std::string, std::string, std::less<>> parts_by_id(const Archive& archive) {
  std::map<std::string, std::string, std::less<>> parts;
  const std::string name = "xl/_rels/workbook.xml.rels";
  const pugi::xml_document document = needed_part(archive, name);
  for_each_child(child_of(document, "Relationships"), "Relationship",
                 [&](const pugi::xml_node& link) {
                   std::string target(attribute_of(link, "Target"));
                   const bool is_absolute = target.starts_with('/');
                   target = is_absolute ? target.substr(1) : "xl/" + target;
                   parts[std::string(attribute_of(link, "Id"))] = target;
                 });
  return parts;
}

std::vector<WorkbookSheet> all_sheets(const std::string& bytes) {
  const Archive archive(bytes);
  const auto parts = parts_by_id(archive);
  const std::string name = "xl/workbook.xml";
  const pugi::xml_document document = needed_part(archive, name);
  const std::vector<std::string> texts = shared_texts(archive);
  std::vector<WorkbookSheet> sheets;
  for_each_child(child_of(child_of(document, "workbook"), "sheets"), "sheet",
                 [&](const pugi::xml_node& node) {
                   const auto found = parts.find(attribute_of(node, "id"));
                   if (found == parts.end()) return;
                   const auto content = archive.part(found->second);
                   if (!content) return;
                   if (found->second.find("worksheets/") == std::string::npos) return;  // a chart
                   const std::string_view state = attribute_of(node, "state");
                   sheets.push_back({.name = one_line(std::string(attribute_of(node, "name"))),
                                     .text = text_of_sheet(*content, found->second, texts),
                                     .is_hidden = state == "hidden" || state == "veryHidden"});
                 });
  if (sheets.empty()) throw WrongWorkbook{"it has no sheets with cells"};
  return sheets;
}

/// A sheet without what is outside of a range; places stay.
Parsed<WorkbookSheet> cut(WorkbookSheet sheet, const std::string& range) {
  const auto colon = range.find(':');
  const auto from = place_in(range.substr(0, colon));
  const auto to = colon == std::string::npos ? std::nullopt : place_in(range.substr(colon + 1));
  if (!from || !to || to->row < from->row || to->column < from->column) {
    return Parsed<WorkbookSheet>::failed(
        fmt::format("found the range {}, expected one such as B4:H25", in_quotes(range)));
  }
  std::istringstream lines(sheet.text);
  std::string line, text;
  for (int row = 1; std::getline(lines, line) && row <= to->row; ++row) {
    if (row >= from->row) {
      const std::vector<Cell> cells = cells_of(line, Delimiter::cell);
      const int last = std::min(to->column, static_cast<int>(cells.size()));
      for (int column = 1; column <= last; ++column) {
        if (column > 1) text += cell_mark;
        if (column >= from->column) text += cells[static_cast<std::size_t>(column - 1)].text;
      }
      text += cell_mark;
    }
    text += '\n';
  }
  sheet.text = std::move(text);
  return sheet;
}

/// How many columns the best line of a sheet names.
std::size_t most_named(const WorkbookSheet& sheet,
                       const std::function<std::size_t(const std::string&)>& columns_in) {
  constexpr int most_lines = 1000;  // of titles above a table
  std::istringstream lines(sheet.text);
  std::string line;
  std::size_t most = 0;
  for (int i = 0; i < most_lines && std::getline(lines, line); ++i) {
    if (!line.empty()) most = std::max(most, columns_in(line));
  }
  return most;
}

std::string names_of(const std::vector<const WorkbookSheet*>& sheets) {
  std::vector<std::string> names;
  for (const WorkbookSheet* sheet : sheets) names.push_back(in_quotes(sheet->name));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

SheetName sheet_name(const std::string& name) {
  const auto at = name.find('#');
  const std::string file = name.substr(0, at);
  const std::string lower = lower_case(file);
  const bool is_one = lower.ends_with(".xlsx") || lower.ends_with(".xlsm");
  if (at == std::string::npos || !is_one) return {.file = name};
  SheetName result{.file = file, .sheet = name.substr(at + 1)};
  if (const auto mark = result.sheet.rfind('!'); mark != std::string::npos) {
    result.range = result.sheet.substr(mark + 1);
    result.sheet.resize(mark);
  }
  const bool is_quoted =
      result.sheet.size() > 1 && result.sheet.front() == '\'' && result.sheet.back() == '\'';
  if (is_quoted) result.sheet = result.sheet.substr(1, result.sheet.size() - 2);
  return result;
}

bool is_workbook(const std::string& bytes) {
  return bytes.starts_with("PK\x03\x04");
}

Parsed<std::vector<WorkbookSheet>> sheets_of(const std::string& bytes) {
  try {
    return all_sheets(bytes);
  } catch (const WrongWorkbook& wrong) {
    return Parsed<std::vector<WorkbookSheet>>::failed(wrong.problem);
  }
}

Parsed<WorkbookSheet> sheet_of(const std::string& bytes, const SheetName& name,
                               const std::function<std::size_t(const std::string&)>& columns_in) {
  using Result = Parsed<WorkbookSheet>;
  auto sheets = sheets_of(bytes);
  if (!sheets) return Result::failed(sheets.problem);
  std::vector<const WorkbookSheet*> visible, best;
  std::size_t most = 2;  // a table has so many columns
  for (const WorkbookSheet& sheet : *sheets) {
    if (!name.sheet.empty() && sheet.name == name.sheet) {
      return name.range.empty() ? sheet : cut(sheet, name.range);
    }
    if (sheet.is_hidden) continue;
    visible.push_back(&sheet);
    const std::size_t named = most_named(sheet, columns_in);
    if (named > most) best.clear();
    if (named >= most) best.push_back(&sheet);
    most = std::max(most, named);
  }
  if (!name.sheet.empty()) {
    return Result::failed(
        fmt::format("it has no sheet {}; there are {}", in_quotes(name.sheet), names_of(visible)));
  }
  if (best.size() > 1) {
    return Result::failed(
        fmt::format("several of its sheets may be meant: {}; say which behind the name: {}#{}",
                    names_of(best), name.file, best.front()->name));
  }
  if (best.empty()) {
    return Result::failed(fmt::format(
        "none of its sheets ({}) has a line that names columns of this table", names_of(visible)));
  }
  return *best.front();
}

Where with_cell_name(Where where) {
  if (where.line < 1 || sheet_name(where.file).sheet.empty()) return where;
  std::string letters;
  for (int column = where.column; column > 0; column = (column - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('A' + (column - 1) % 26));
  }
  return {fmt::format("{}!{}{}", where.file, letters, where.line)};
}

}  // namespace whirl::inline io
