// Rotors of ROSS, as JSON or TOML: a model comes of a file that can be read again, or problems with
// their places.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "libbase/error.hpp"
#include "libio/import/import_file.hpp"
#include "libio/model/model_file.hpp"
#include "tests/fuzz/scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace whirl;
  static const fuzz::Scratch scratch;
  const std::filesystem::path from = scratch.folder / "rotor.json", to = scratch.folder / "m.toml";
  std::ofstream(from, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    import_file(from, to, Replaces::anything);
  } catch (const ModelError& error) {
    if (error.problems().empty()) std::abort();
    return 0;
  } catch (const FileError&) {
    return 0;
  }
  read_model(to);  // throws nothing: what was written can be read
  return 0;
}
