#pragma once
/// A folder for a file that is tried, in memory where there is such a place; removed when the
/// program ends.

#include <stdlib.h>

#include <filesystem>
#include <string>

namespace whirl::fuzz {

struct Scratch {
  Scratch() {
    namespace fs = std::filesystem;
    const bool has_memory = fs::is_directory("/dev/shm");
    std::string name = (has_memory ? "/dev/shm/" : fs::temp_directory_path().string() + "/");
    name += "whirl_fuzz_XXXXXX";
    folder = ::mkdtemp(name.data());
  }
  ~Scratch() { std::filesystem::remove_all(folder); }
  std::filesystem::path folder;
};

}  // namespace whirl::fuzz
