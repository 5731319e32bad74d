#include "libio/import/import_file.hpp"

#include <fmt/format.h>

#include "libio/import/parse_json.hpp"
#include "libio/import/ross_model.hpp"
#include "libio/model/model_file.hpp"
#include "libio/results/temporary_folder.hpp"
#include "libio/text/file_bytes.hpp"
#include "libio/text/files_in_use.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& file) {
  auto text = file_bytes(file, FileKind::regular, most_text_bytes);
  if (text) return std::move(*text.value);
  throw FileError(
      fmt::format("{}: {}; expected a file of ROSS, TOML or JSON", file.string(), text.problem));
}

/// The tree of a file, by how it begins: "[" begins a list of JSON, or a table of TOML. A
/// byte-order mark before it, as some editors leave, counts for nothing.
ConfigNode tree_of(std::string text, const std::string& name) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.starts_with(mark)) text.erase(0, mark.size());
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_list = name.ends_with(".json") && first != std::string::npos && text[first] == '[';
  const bool is_json = is_list || (first != std::string::npos && text[first] == '{');
  return is_json ? parse_json(text, name) : parse_toml(text, name);
}

/// The model as it will be read at its place, before anything is written there.
/// @throws ModelError  of the file, if what became of it cannot be read
Model readable(const ImportedModel& written, const fs::path& file, const fs::path& place) {
  const TemporaryFolder folder("import", place);
  for (const ImportedTable& table : written.tables) {
    replace_file(folder.path() / table.name, table.text);
  }
  try {
    return parse_model(written.text, place.string(), {}, folder.path());
  } catch (const ModelError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) p.where = {file.string()};  // the model is nowhere
    throw ModelError(std::move(problems));
  }
}

}  // namespace

Imported import_file(const fs::path& file, const fs::path& place, Replaces replaces) {
  if (fs::exists(place) && is_same_file(file, place)) {  // left out, --out is beside it
    throw FileError(place.string() + " is the file that is read; give another one with --out");
  }
  const std::string text = content_of(file);
  const ImportedModel written = model_of(read_ross(tree_of(text, file.string())),
                                         file.filename().string(), place.stem().string());
  Imported imported{.files = {place.string()},
                    .left_out = written.left_out,
                    .taken_differently = written.taken_differently};
  for (const ImportedTable& table : written.tables) {
    imported.files.push_back((place.parent_path() / table.name).string());
  }
  imported.model = readable(written, file, place);
  for (const std::string& taken : imported.files) require_replaceable(taken, replaces);
  for (std::size_t i = 0; i < written.tables.size(); ++i) {
    replace_file(imported.files[i + 1], written.tables[i].text, replaces);
  }
  replace_file(place, written.text, replaces);
  return imported;
}

}  // namespace whirl::inline io
