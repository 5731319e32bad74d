#include "libio/results/temporary_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& what, const fs::path& beside) {
  std::error_code problem;
  fs::path parent = fs::temp_directory_path(problem);
  if (problem) {
    parent = fs::absolute(beside).parent_path();
    ::setenv("TMPDIR", parent.c_str(), 1);  // for the programs that this one calls
  }
  const std::string name = (parent / fmt::format("whirl_{}_XXXXXX", what)).string();
  if (const int code = folder_.make_folder(name)) {
    throw FileError(fmt::format("cannot make the folder {}: {}", name, std::strerror(code)));
  }
}

}  // namespace whirl::inline io
