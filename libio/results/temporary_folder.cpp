#include "libio/results/temporary_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
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
  std::string name = (parent / fmt::format("whirl_{}_XXXXXX", what)).string();
  if (!::mkdtemp(name.data())) {
    throw FileError(fmt::format("cannot make the folder {}: {}", name, std::strerror(errno)));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace whirl::inline io
