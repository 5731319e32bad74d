#include "libio/import/import_file.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "libio/import/parse_json.hpp"
#include "libio/import/ross_model.hpp"
#include "libio/model/model_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (!fs::is_regular_file(file) || !(text << in.rdbuf())) {
    throw FileError(file.string() + ": cannot be read, expected a file of ROSS, TOML or JSON");
  }
  return text.str();
}

/// The tree of a file, by how it begins.
ConfigNode tree_of(const std::string& text, const std::string& name) {
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string::npos && text[first] == '{';
  return is_json ? parse_json(text, name) : parse_toml(text, name);
}

/// A folder that goes when this does.
struct TemporaryFolder {
  fs::path path;

  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "whirl_import_XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw FileError(pattern + ": cannot make a folder");
    path = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// Refuses a model that cannot be read, before anything takes its place.
void require_readable(const ImportedModel& written, const std::string& file) {
  const TemporaryFolder folder;
  for (const ImportedTable& table : written.tables) {
    replace_file(folder.path / table.name, table.text);
  }
  try {
    parse_model(written.text, file, {}, folder.path);
  } catch (const ModelError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) p.where.line = 0;  // of the model, which is nowhere
    throw ModelError(std::move(problems));
  }
}

}  // namespace

Imported import_file(const fs::path& file, const fs::path& place, Replaces replaces) {
  if (fs::exists(place) && is_same_file(file, place)) {
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
  require_readable(written, file.string());
  for (const std::string& taken : imported.files) require_replaceable(taken, replaces);
  for (std::size_t i = 0; i < written.tables.size(); ++i) {
    replace_file(imported.files[i + 1], written.tables[i].text, replaces);
  }
  replace_file(place, written.text, replaces);
  imported.model = read_model(place);
  return imported;
}

}  // namespace whirl::inline io
