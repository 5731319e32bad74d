// The bytes of HDF5 and MATLAB files, which others' libraries read: whatever they are, this process
// lives, and meets numbers or an error.
//
// The first letter of an input says what it is: h an HDF5 file, m a MATLAB file, e a seed beside
// the corpus (its number in the next byte) with bytes changed: three bytes where, one what. Its
// checksum is right.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "libbase/error.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/results/hdf5.hpp"
#include "libio/results/hdf5/checksum.hpp"
#include "libio/results/result_schema.hpp"
#include "tests/fuzz/scratch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace whirl;

/// Laws come of a file, or what is wrong with it.
void read_laws(const fs::path& path) {
  for (const auto kind : {ForeignTable::Kind::response, ForeignTable::Kind::state_space}) {
    const auto found = law_table(path, "", {kind});
    if (!found && found.problem.empty()) std::abort();
  }
}

template <class Action>
void attempt(Action action) {
  try {
    action();
  } catch (const FileError&) {
  } catch (const ModelError&) {
  }
}

void read_attributes(const ResultReader& file, const std::string& object) {
  for (const std::string& name : file.attributes(object)) {
    attempt([&] { file.string_attribute(object, name); });
    attempt([&] { file.number_attribute(object, name); });
  }
}

void read_dataset(const ResultReader& file, const std::string& path) {
  switch (file.kind(path)) {
    case ObjectKind::real:
    case ObjectKind::integer:
      file.each_block(path, [](auto) {});
      break;
    case ObjectKind::complex:
      file.shape(path).size() == 1 ? void(file.complex_vector(path))
                                   : void(file.complex_matrix(path));
      break;
    case ObjectKind::text:
      file.strings(path);
      break;
    default:
      break;
  }
  file.axes(path);
}

void read_hdf5(const fs::path& path) {
  attempt([&] {
    const ResultReader file(path);
    for (const std::string& group : file.groups()) {
      attempt([&] { read_attributes(file, group); });
    }
    for (const std::string& dataset : file.datasets()) {
      attempt([&] { read_dataset(file, dataset); });
      attempt([&] { read_attributes(file, dataset); });
    }
  });
  attempt([&] { open_result(path); });
  attempt([&] { read_record(path, 1000.0); });
  read_laws(path);
}

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> all = [] {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(WHIRL_SOURCE_DIR "/tests/fuzz/results")) {
      paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> bytes;
    for (const fs::path& path : paths) {
      std::ostringstream text;
      text << std::ifstream(path, std::ios::binary).rdbuf();
      bytes.push_back(text.str().substr(0, text.str().rfind("\nwhirl: ")));
    }
    return bytes;
  }();
  return all;
}

/// A seed with bytes changed, under the right checksum.
void write_changed(const std::string& changes, const fs::path& path) {
  if (changes.empty()) return;
  std::string bytes = seeds()[static_cast<unsigned char>(changes[0]) % seeds().size()];
  for (std::size_t i = 1; i + 4 <= changes.size(); i += 4) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < 3; ++k) at = at << 8u | static_cast<unsigned char>(changes[i + k]);
    bytes[at % bytes.size()] = changes[i + 3];
  }
  std::ofstream(path, std::ios::binary) << bytes;
  hdf5::seal(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const fs::path hdf5 = scratch.folder / "file.h5", matlab = scratch.folder / "file.mat";
  switch (data[0]) {
    case 'h':
      std::ofstream(hdf5, std::ios::binary) << bytes;
      read_hdf5(hdf5);
      break;
    case 'e':
      write_changed(bytes, hdf5);
      if (fs::exists(hdf5)) read_hdf5(hdf5);
      break;
    case 'm':
      std::ofstream(matlab, std::ios::binary) << bytes;
      attempt([&] { read_record(matlab, 1000.0); });
      read_laws(matlab);
      break;
    default:
      break;
  }
  return 0;
}
